/* Chooses the heat loop for the processor that it runs on. */
#include "base/isa.h"
#include "sph/conduction/kernel.h"

ISA_CHOOSE(void, heat_loop_run, (const struct heat_loop *loop, int32_t begin, int32_t end),
           (loop, begin, end))
