/* Instruction sets that the kernels are compiled for; all give the same bits. */
#ifndef BOLIDE_ISA_H
#define BOLIDE_ISA_H

enum isa { ISA_V2, ISA_V3, ISA_V4 }; /* of x86-64; V2 stands for the compiler's own elsewhere */

/* The best that this processor knows. */
static inline enum isa isa_best(void)
{
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
        return ISA_V4;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
        __builtin_cpu_supports("bmi2"))
        return ISA_V3;
#endif
    return ISA_V2;
}

#endif
