/* The cells of particles within the block that they are stored in: what finding bins spends its time on. Compiled once an
 * instruction set. */
#ifndef BOLIDE_GRID_CELL_KERNEL_H
#define BOLIDE_GRID_CELL_KERNEL_H

#include <stdint.h>

/* The cell of a particle outside of the block that it is stored in. */
enum { CELL_ELSEWHERE = 255 };

/* Cells of edge EDGE; those below LOW and above HIGH do not exist, what would be in them is in the outermost. */
struct cell_loop {
    int dimension;
    double edge;
    const double (*position)[3];
    double low[3], high[3];
};

/* Writes to CELL[i] the cell of each particle i of BEGIN .. END - 1 in the block whose first cell has index CORNER. */
void cell_loop_run(const struct cell_loop *loop, const double corner[3], int32_t begin, int32_t end,
                   uint8_t *cell);

#endif
