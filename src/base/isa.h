/* Instruction sets that the kernels are compiled for; all give the same bits. A kernel's file is
 * compiled once for each, with BOLIDE_ISA as its name; the file beside it chooses. */
#ifndef BOLIDE_ISA_H
#define BOLIDE_ISA_H

enum isa {
    ISA_V2,
    ISA_V3,
    ISA_V4
}; /* of x86-64; elsewhere V2 is what the compiler takes by default */

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

/* Beside it: ISA_CHOOSE defines NAME as the one for this processor. PARAMETERS and ARGUMENTS are
 * those of the function, each in parentheses. ISA_DECLARE declares those of all sets, as functions
 * of one TYPE, and ISA_LIST lists them, the least first. A build for a single set names it
 * BOLIDE_ONLY_ISA. */
#if defined(BOLIDE_ONLY_ISA)
enum { ISA_COMPILED = 1 };
#define ISA_CHOOSE(result, name, parameters, arguments) \
    result ISA_JOIN(name, BOLIDE_ONLY_ISA) parameters;  \
    result name parameters { return ISA_JOIN(name, BOLIDE_ONLY_ISA) arguments; }
#define ISA_DECLARE(type, name) type ISA_JOIN(name, BOLIDE_ONLY_ISA)
#define ISA_LIST(name) ISA_JOIN(name, BOLIDE_ONLY_ISA)
#else
enum { ISA_COMPILED = 3 };
#define ISA_CHOOSE(result, name, parameters, arguments)                      \
    result name##_v2 parameters, name##_v3 parameters, name##_v4 parameters; \
    result name parameters                                                   \
    {                                                                        \
        const enum isa isa = isa_best();                                     \
        return isa == ISA_V4   ? name##_v4 arguments                         \
               : isa == ISA_V3 ? name##_v3 arguments                         \
                               : name##_v2 arguments;                        \
    }
#define ISA_DECLARE(type, name) type name##_v2, name##_v3, name##_v4
#define ISA_LIST(name) name##_v2, name##_v3, name##_v4
#endif

/* How many functions of ISA_LIST this processor can run. */
static inline int isa_count(void)
{
    const int known = (int)isa_best() + 1;
    return known < ISA_COMPILED ? known : ISA_COMPILED;
}

#endif
