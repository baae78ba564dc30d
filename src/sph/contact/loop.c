/* Chooses the pair loop for the processor that it runs on. */
#include "base/isa.h"
#include "sph/contact/kernel.h"

ISA_CHOOSE(void, pair_loop_run, (const struct pair_loop *loop, int32_t begin, int32_t end),
           (loop, begin, end))
