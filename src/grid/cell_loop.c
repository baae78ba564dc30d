/* Chooses the loop of cell_kernel.h for the processor that it runs on. */
#include "base/isa.h"
#include "grid/cell_kernel.h"

ISA_CHOOSE(void, cell_loop_run,
           (const struct cell_loop *loop, const double corner[3], int32_t begin, int32_t end,
            uint8_t *cell),
           (loop, corner, begin, end, cell))
