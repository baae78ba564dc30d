/* Chooses the heat loop for the processor that it runs on. */
#include "base/isa.h"
#include "sph/heat_kernel.h"

typedef void heat_loop_isa(const struct heat_loop *, int32_t, int32_t);

heat_loop_isa heat_loop_run_v2;
#if defined(__x86_64__)
heat_loop_isa heat_loop_run_v3, heat_loop_run_v4;
#endif

void heat_loop_run(const struct heat_loop *loop, int32_t begin, int32_t end)
{
    switch (isa_best()) {
#if defined(__x86_64__)
    case ISA_V4:
        heat_loop_run_v4(loop, begin, end);
        return;
    case ISA_V3:
        heat_loop_run_v3(loop, begin, end);
        return;
#endif
    default:
        heat_loop_run_v2(loop, begin, end);
    }
}
