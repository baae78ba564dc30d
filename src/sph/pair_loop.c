/* Chooses the pair loop for the processor that it runs on. */
#include "base/isa.h"
#include "sph/pair_kernel.h"

typedef void pair_loop_isa(const struct pair_loop *, int32_t, int32_t);

pair_loop_isa pair_loop_run_v2;
#if defined(__x86_64__)
pair_loop_isa pair_loop_run_v3, pair_loop_run_v4;
#endif

void pair_loop_run(const struct pair_loop *loop, int32_t begin, int32_t end)
{
    switch (isa_best()) {
#if defined(__x86_64__)
    case ISA_V4:
        pair_loop_run_v4(loop, begin, end);
        return;
    case ISA_V3:
        pair_loop_run_v3(loop, begin, end);
        return;
#endif
    default:
        pair_loop_run_v2(loop, begin, end);
    }
}
