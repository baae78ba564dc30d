/* The cells of particles within the block that they are stored in: what finding bins spends its
 * time on. Compiled once an instruction set. */
#ifndef BOLIDE_GRID_CELL_KERNEL_H
#define BOLIDE_GRID_CELL_KERNEL_H

#include "parallel/block.h"

/* The cell of a particle outside of the block that it is stored in. */
enum { CELL_ELSEWHERE = 255 };

/* Cells of edge EDGE, number 0 from -SHIFT on; those below LOW and above HIGH do not exist, what
 * would be in them is in the outermost. */
struct cell_loop {
    int dimension;
    double edge, shift;
    const double (*position)[3];
    double low[3], high[3];
};

/* The number of the cell of a particle at X in the block whose first cell has index CORNER. */
BOLIDE_INLINE double cell_number(const struct cell_loop *loop, int dimension,
                                 const double corner[3], const double x[3])
{
    const double cells = block_cells(dimension);
    double sum = 0.0, away = 0.0;
    for (int axis = 0; axis < dimension; axis++) {
        const double index = floor((x[axis] + loop->shift) / loop->edge);
        const double at = minimum(maximum(index, loop->low[axis]), loop->high[axis]) - corner[axis];
        sum = sum * cells + at;
        away += fabs(at - 0.5 * (cells - 1.0)) < 0.5 * cells ? 0.0 : 1.0;
    }
    return away > 0.0 ? (double)CELL_ELSEWHERE : sum;
}

/* Writes to CELL[i] the cell of each particle i of BEGIN .. END - 1 in the block whose first cell
 * has index CORNER. */
void cell_loop_run(const struct cell_loop *loop, const double corner[3], int32_t begin, int32_t end,
                   uint8_t *cell);

#endif
