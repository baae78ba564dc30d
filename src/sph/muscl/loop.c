/* Chooses the second-order pair loop for the processor that it runs on. */
#include "base/isa.h"
#include "sph/muscl/kernel.h"

ISA_CHOOSE(void, muscl_loop_run, (const struct muscl_loop *loop, int32_t begin, int32_t end),
           (loop, begin, end))
