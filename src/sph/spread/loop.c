/* Chooses the spread loop for the processor that it runs on. */
#include "base/isa.h"
#include "sph/spread/kernel.h"

ISA_CHOOSE(void, spread_loop_run, (const struct spread_loop *loop, int32_t begin, int32_t end),
           (loop, begin, end))
