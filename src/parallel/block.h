/* Cells and blocks of the global grid. A block's key interleaves the bits of its coordinates, so
 * that blocks near in storage are near in space. */
#ifndef BOLIDE_BLOCK_H
#define BOLIDE_BLOCK_H

#include "base/base.h"

enum { BLOCK_AXIS_BITS = 21, BLOCK_MIDDLE = 1 << (BLOCK_AXIS_BITS - 1), BLOCK_CELLS = 64 };

/* The particles first .. first + count - 1 lie in the block of this key (see particles_sort). */
struct block {
    uint64_t key;
    int32_t first, count;
};

/* Cells of a block along each axis: 64, 8 x 8, 4 x 4 x 4. */
BOLIDE_INLINE int block_cells(int dimension)
{
    return dimension == 1 ? 64 : dimension == 2 ? 8 : 4;
}

/* Index of the cell of edge CELL that holds X, kept within +-LIMIT so that what flies off stays
 * countable. */
BOLIDE_INLINE int64_t cell_index(double x, double cell, int64_t limit)
{
    double index = floor(x / cell);
    if (!(index > (double)-limit))
        return -limit;
    return index < (double)limit ? (int64_t)index : limit - 1;
}

/* The block, along one axis, of a cell of index INDEX where a block has CELLS of them. */
BOLIDE_INLINE int64_t block_of_cell(int64_t index, int64_t cells)
{
    return index >= 0 ? index / cells : (index + 1) / cells - 1;
}

/* Spreads the low 21 bits of V to every third bit. */
BOLIDE_INLINE uint64_t bits_spread(uint64_t v)
{
    v &= 0x1fffff;
    v = (v | v << 32) & 0x1f00000000ffffu;
    v = (v | v << 16) & 0x1f0000ff0000ffu;
    v = (v | v << 8) & 0x100f00f00f00f00fu;
    v = (v | v << 4) & 0x10c30c30c30c30c3u;
    v = (v | v << 2) & 0x1249249249249249u;
    return v;
}

BOLIDE_INLINE uint64_t bits_gather(uint64_t v)
{
    v &= 0x1249249249249249u;
    v = (v ^ v >> 2) & 0x10c30c30c30c30c3u;
    v = (v ^ v >> 4) & 0x100f00f00f00f00fu;
    v = (v ^ v >> 8) & 0x1f0000ff0000ffu;
    v = (v ^ v >> 16) & 0x1f00000000ffffu;
    v = (v ^ v >> 32) & 0x1fffff;
    return v;
}

/* Key of the block with coordinates AT, each within +-2^20. */
BOLIDE_INLINE uint64_t block_key(const int64_t at[3])
{
    return bits_spread((uint64_t)(at[0] + BLOCK_MIDDLE)) |
           bits_spread((uint64_t)(at[1] + BLOCK_MIDDLE)) << 1 |
           bits_spread((uint64_t)(at[2] + BLOCK_MIDDLE)) << 2;
}

BOLIDE_INLINE void block_coordinates(uint64_t key, int64_t at[3])
{
    for (int axis = 0; axis < 3; axis++)
        at[axis] = (int64_t)bits_gather(key >> axis) - BLOCK_MIDDLE;
}

#endif
