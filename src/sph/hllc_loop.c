/* Chooses the pair loops with corrected gradients for the processor that they run on. */
#include "base/isa.h"
#include "sph/hllc_kernel.h"

typedef void hllc_pass_isa(const struct hllc_loop *, bool, int32_t, int32_t);

hllc_pass_isa hllc_pass_v2;
#if defined(__x86_64__)
hllc_pass_isa hllc_pass_v3, hllc_pass_v4;
#endif

static void run_pass(const struct hllc_loop *loop, bool forces, int32_t begin, int32_t end)
{
    switch (isa_best()) {
#if defined(__x86_64__)
    case ISA_V4:
        hllc_pass_v4(loop, forces, begin, end);
        return;
    case ISA_V3:
        hllc_pass_v3(loop, forces, begin, end);
        return;
#endif
    default:
        hllc_pass_v2(loop, forces, begin, end);
    }
}

void hllc_find_gradients(const struct hllc_loop *loop, int32_t begin, int32_t end)
{
    run_pass(loop, false, begin, end);
}

void hllc_find_forces(const struct hllc_loop *loop, int32_t begin, int32_t end)
{
    run_pass(loop, true, begin, end);
}
