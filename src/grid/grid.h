/* The nodes of the grid that exist: those of blocks that hold particles, and of blocks that these
 * reach into. Empty space costs nothing.
 *
 * A block of cells has a patch: its own nodes and those that its particles reach beyond. Particles
 * add to the patch of their block in the order of bins; a node's value is the sum over the patches
 * that cover it, in the order of block keys. So no value depends on threads, ranks or storage. A
 * block of nodes holds as many as cells: those at the low corners of the cells with the same
 * key. */
#ifndef BOLIDE_GRID_H
#define BOLIDE_GRID_H

#include "grid/bins.h"
#include "grid/grid_shape.h"

/* Blocks about a block, itself included: the offset o of -1, 0, 1 on each axis is digit o + 1 of a
 * number to the base 3, the first axis on top. */
enum { GRID_AROUND = 27 };

/* A patch that covers nodes of a block: that of bin `bin`, which sees the block at offset
 * `code`. */
struct grid_touch {
    int32_t bin, code;
};

/* The part that a patch and a block of nodes share: so many nodes along each axis, the place of the
 * first in either. */
struct grid_overlap {
    int count[3], from[3], at[3];
};

struct grid {
    int dimension;
    int reach,
        after;       /* nodes that a cell reaches before the one with its index, 0 or 1; after it */
    int side, patch; /* nodes of a patch along an axis; in all */
    int32_t bins, blocks;
    uint64_t *key;                  /* of blocks of nodes, ascending */
    int32_t (*around)[GRID_AROUND]; /* of each bin, the blocks of nodes; -1: none */
    struct grid_touch (
        *touch)[GRID_AROUND]; /* of each block of nodes, by bin; behind the last bin -1 */

    struct grid_overlap overlap[GRID_AROUND];
    uint64_t *bin_key; /* that the plan was made for */
    int64_t bin_capacity, block_capacity, bin_key_capacity, touch_capacity;
    struct block_table table;
};

/* So many numbers a node, in patches and as sums. */
struct grid_field {
    int stride;
    double *node, *patch;
    int64_t node_capacity, patch_capacity;
};

/* A grid whose cells reach the nodes of WINDOW. */
void grid_start(struct grid *grid, int dimension, struct shape_window window);
/* Makes the blocks for BINS; quick while their keys stay. */
struct error *grid_plan(struct grid *grid, const struct bins *bins);
void grid_free(struct grid *grid);

/* Room for the field on the blocks as planned; its numbers are left as they are. */
struct error *grid_field_reserve(struct grid_field *field, const struct grid *grid);
/* The same of one that has patches alone. */
struct error *grid_patches_reserve(struct grid_field *field, const struct grid *grid);
void grid_field_free(struct grid_field *field);

/* The sums of nodes of block BLOCK over all patches. */
void grid_reduce(const struct grid *grid, struct grid_field *field, int32_t block);
/* Fills the patch of BIN with the nodes' numbers. */
void grid_spread(const struct grid *grid, struct grid_field *field, int32_t bin);

BOLIDE_INLINE double *grid_patch(const struct grid *grid, const struct grid_field *field,
                                 int32_t bin)
{
    return field->patch + (size_t)bin * (size_t)grid->patch * (size_t)field->stride;
}

/* The numbers of node K, 0 .. 63, of a block. */
BOLIDE_INLINE double *grid_node(const struct grid_field *field, int32_t block, int k)
{
    return field->node + ((size_t)block * BLOCK_CELLS + (size_t)k) * (size_t)field->stride;
}

/* The index of the node of the global grid with number 0 of a block. */
BOLIDE_INLINE void grid_corner(const struct grid *grid, int32_t block, int64_t corner[3])
{
    block_coordinates(grid->key[block], corner);
    for (int axis = 0; axis < 3; axis++)
        corner[axis] *= axis < grid->dimension ? block_cells(grid->dimension) : 0;
}

/* The numbers of the node at index AT of the global grid, NULL when there is no such node. */
double *grid_node_at(const struct grid *grid, const struct grid_field *field, const int64_t at[3]);

#endif
