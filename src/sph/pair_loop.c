/* Chooses the pair loop for the processor that it runs on. */
#include "sph/pair_kernel.h"

typedef void pair_loop_isa(const struct pair_loop *, int32_t, int32_t);

pair_loop_isa pair_loop_run_v2;
#if defined(__x86_64__)
pair_loop_isa pair_loop_run_v3, pair_loop_run_v4;
#endif

void pair_loop_run(const struct pair_loop *loop, int32_t begin, int32_t end)
{
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw")) {
        pair_loop_run_v4(loop, begin, end);
        return;
    }
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
        __builtin_cpu_supports("bmi2")) {
        pair_loop_run_v3(loop, begin, end);
        return;
    }
#endif
    pair_loop_run_v2(loop, begin, end);
}
