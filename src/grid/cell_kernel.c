/* The cells of particles for one instruction set, named by BOLIDE_ISA; see cell_kernel.h. */
#include "grid/cell_kernel.h"

#include "base/isa.h"
#include "base/lanes.h"

enum { CHUNK = 64 };

BOLIDE_INLINE void find(const struct cell_loop *loop, int dimension, const double corner[3],
                        int32_t begin, int32_t end, uint8_t *cell)
{
    for (int32_t first = begin; first < end; first += CHUNK) {
        const int count = end - first < CHUNK ? end - first : CHUNK;
        const double(*position)[3] = loop->position + first;
        ALIGNED double number[CHUNK];
        for (int k = 0; k < count; k++)
            number[k] = cell_number(loop, dimension, corner, position[k]);
        for (int k = 0; k < count; k++)
            cell[first + k] = (uint8_t)(int)number[k];
    }
}

ISA_KERNEL(void, cell_loop_run, const struct cell_loop *loop, const double corner[3], int32_t begin,
           int32_t end, uint8_t *cell)
{
    if (loop->dimension == 1)
        find(loop, 1, corner, begin, end, cell);
    else if (loop->dimension == 2)
        find(loop, 2, corner, begin, end, cell);
    else
        find(loop, 3, corner, begin, end, cell);
}
