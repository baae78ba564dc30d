/* Chooses the second-order pair loop for the processor that it runs on. */
#include "base/isa.h"
#include "sph/muscl_kernel.h"

typedef void muscl_loop_isa(const struct muscl_loop *, int32_t, int32_t);

muscl_loop_isa muscl_loop_run_v2;
#if defined(__x86_64__)
muscl_loop_isa muscl_loop_run_v3, muscl_loop_run_v4;
#endif

void muscl_loop_run(const struct muscl_loop *loop, int32_t begin, int32_t end)
{
    switch (isa_best()) {
#if defined(__x86_64__)
    case ISA_V4:
        muscl_loop_run_v4(loop, begin, end);
        return;
    case ISA_V3:
        muscl_loop_run_v3(loop, begin, end);
        return;
#endif
    default:
        muscl_loop_run_v2(loop, begin, end);
    }
}
