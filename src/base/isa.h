/* Instruction sets that the kernels are compiled for; all give the same bits. A kernel's file is compiled once for each,
 * with BOLIDE_ISA as its name; the file beside it chooses. */
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

/* In a kernel: the head of function NAME for its instruction set. */
#define ISA_JOIN_NAMES(name, isa) name##_##isa
#define ISA_JOIN(name, isa) ISA_JOIN_NAMES(name, isa)
#define ISA_KERNEL(result, name, ...)               \
    result ISA_JOIN(name, BOLIDE_ISA)(__VA_ARGS__); \
    result ISA_JOIN(name, BOLIDE_ISA)(__VA_ARGS__)

/* Beside it: defines NAME as the one for this processor. PARAMETERS and ARGUMENTS are those of the function, each in
 * parentheses. */
#if defined(__x86_64__)
#define ISA_CHOOSE(result, name, parameters, arguments)                      \
    result name##_v2 parameters, name##_v3 parameters, name##_v4 parameters; \
    result name parameters                                                   \
    {                                                                        \
        const enum isa isa = isa_best();                                     \
        return isa == ISA_V4   ? name##_v4 arguments                         \
               : isa == ISA_V3 ? name##_v3 arguments                         \
                               : name##_v2 arguments;                        \
    }
#else
#define ISA_CHOOSE(result, name, parameters, arguments) \
    result name##_v2 parameters;                        \
    result name parameters { return name##_v2 arguments; }
#endif

#endif
