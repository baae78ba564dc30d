/* Which blocks a domain of several levels of cells has, and which block covers a place of it. */
#ifndef BOLIDE_LEVELS_H
#define BOLIDE_LEVELS_H

#include "grid/cell_blocks.h"

/* Cells 2^LEVELS_MOST times as wide as the finest are the coarsest. */
enum { LEVELS_MOST = 8 };

/* The block that holds cell AT of LEVEL is to be of that level, or finer. */
struct cell_want {
    int64_t at[3];
    int level;
};

/* All blocks of the domain, in the order of their keys: those that meet a region are of level 0,
 * the others as coarse as the WANTS, so many, allow while no two that touch, be it in a corner,
 * differ by more than a level. The faces of the domain lie on planes of two cells of the coarsest
 * level. Free *list. */
struct error *levels_list(const struct cell_blocks *cells, const struct cell_want *want,
                          int64_t wants, struct cell_block **list, int64_t *count);

/* Shows the keys and levels of the blocks of all ranks to VISITOR, which may load them: then they
 * come without cells. */
struct error *levels_visit(struct cell_blocks *cells, struct visitor *visitor);

/* The block, of any level, that covers cell AT of LEVEL, or the first part of it, taken into the
 * domain along periodic axes; NULL outside it, and where neither the block nor a copy of it is on
 * this rank. */
const struct cell_block *cell_block_cover(const struct cell_blocks *cells, int level,
                                          const int64_t at[3]);

/* The same of the blocks of all ranks, which this rank knows but has not: without its cells. */
const struct cell_block *cell_block_known(const struct cell_blocks *cells, int level,
                                          const int64_t at[3]);

/* The index of cell AT, of the level of BLOCK, which holds it. */
BOLIDE_INLINE int32_t cell_index_in(const struct cell_block *block, const int64_t at[3])
{
    int32_t i = block->first;
    for (int axis = 0; axis < 3; axis++)
        i += (int32_t)(at[axis] - block->corner[axis]) * cell_stride(block, axis);
    return i;
}

#endif
