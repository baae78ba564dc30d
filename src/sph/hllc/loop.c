/* Chooses the pair loops with corrected gradients for the processor that they run on. */
#include "base/isa.h"
#include "sph/hllc/kernel.h"

ISA_CHOOSE(void, hllc_find_gradients, (const struct hllc_loop *loop, int32_t begin, int32_t end),
           (loop, begin, end))

ISA_CHOOSE(void, hllc_find_forces, (const struct hllc_loop *loop, int32_t begin, int32_t end),
           (loop, begin, end))
