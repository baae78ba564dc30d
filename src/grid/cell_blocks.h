/* The cell store: every field of the cells that a rank owns, one array each, block after block.
 *
 * Cells are those of the global grid, whose planes lie at the multiples of its edge, within a box,
 * the domain. A block holds 64, 16 x 16 or 8 x 8 x 8 of them, fewer where the domain ends; in a
 * block x runs fastest. Blocks lie in the order of their keys. A block of cells is made of whole
 * blocks of particles, whose first gives it its key, so that one partition serves both. Vectors
 * have three components in every dimension.
 *
 * Cells may be of several levels: those of level k are 2^k times as wide as the finest, of level 0.
 * A block has as many cells on all levels, and of a coarse one the key is that of the first of the
 * finest blocks that it covers, so that the keys of blocks in its place are all its own. Blocks
 * that touch differ by one level at most (levels.h). */
#ifndef BOLIDE_CELL_BLOCKS_H
#define BOLIDE_CELL_BLOCKS_H

#include "base/field.h"
#include "grid/block_table.h"
#include "parallel/partition.h"

enum { CELL_BLOCK_FIELDS = 40 };

/* The cells corner .. corner + count - 1 of the global grid of its level, whose first has index
 * `first`. */
struct cell_block {
    uint64_t key;
    int64_t corner[3];
    int count[3];
    int32_t first;
    int level;
};

/* Cells low .. high - 1 of level 0 along each axis. */
struct cell_region {
    int64_t low[3], high[3];
};

/* Blocks that cover the domain, in the order of their keys; `first` says nothing. */
struct cell_cover {
    int32_t count;
    struct cell_block *block;
    struct block_table table;
};

struct cell_blocks {
    int dimension;
    double edge; /* of a cell of level 0, m */
    int64_t low[3],
        high[3];      /* of the domain along each axis: its first cell, the one after its last */
    int levels;       /* of cells; 0, 1: there is one */
    bool periodic[3]; /* along which axes of several levels its cells are repeated */
    int regions;      /* where cells are of level 0; elsewhere they are as coarse as can be */
    struct cell_region *region; /* owned */
    const struct ranks *ranks;
    struct partition *partition;
    int threads;
    int32_t blocks, count; /* of blocks and of cells of this rank */
    int32_t copies, held;  /* of blocks of other ranks behind them (cell_copies.h), cells with those
                            * of copies */
    struct cell_block *block;
    struct block_table table; /* of the blocks and the copies by their keys */
    struct cell_cover whole;  /* of several levels on several ranks: the blocks of all ranks */
    uint64_t order;           /* grows whenever blocks come or go */
    int fields;
    struct field field[CELL_BLOCK_FIELDS];

    /* The core's fields, as field[].data. */
    uint64_t *id; /* the number of the cell in the domain, x fastest */
    uint16_t *material, *body;
    double *mass, *density, *energy, *pressure;
    double (*position)[3], (*velocity)[3];
    double *size; /* the edge of a cell, m; NULL: there is one level */
};

/* Cells of a block along each axis. */
BOLIDE_INLINE int cell_block_side(int dimension)
{
    return dimension == 1 ? 64 : dimension == 2 ? 16 : 8;
}

/* Cells of a block, and of a plane of it. */
BOLIDE_INLINE int cell_block_room(int dimension)
{
    return dimension == 3 ? 512 : dimension == 2 ? 256 : 64;
}
BOLIDE_INLINE int cell_plane_room(int dimension)
{
    return dimension == 3 ? 64 : dimension == 2 ? 16 : 1;
}

/* From a cell to the next along AXIS. */
BOLIDE_INLINE int32_t cell_stride(const struct cell_block *block, int axis)
{
    return axis == 0 ? 1 : axis == 1 ? block->count[0] : block->count[0] * block->count[1];
}

/* How many cells it has. */
BOLIDE_INLINE int32_t cell_block_cells(const struct cell_block *block)
{
    return block->count[0] * block->count[1] * block->count[2];
}

/* The edge of its cells, m. */
BOLIDE_INLINE double cell_block_edge(const struct cell_blocks *cells,
                                     const struct cell_block *block)
{
    return cells->edge * (double)(1 << block->level);
}

/* The first cell of the domain along AXIS, or the one after its last, in cells of LEVEL. */
BOLIDE_INLINE int64_t cell_domain_end(const struct cell_blocks *cells, int level, int axis,
                                      int side)
{
    return (side ? cells->high : cells->low)[axis] /
           ((int64_t)1 << (axis < cells->dimension ? level : 0));
}

/* Takes AT, a cell of LEVEL, into the domain along periodic axes. */
BOLIDE_INLINE void cell_into_domain(const struct cell_blocks *cells, int level, int64_t at[3])
{
    for (int axis = 0; axis < cells->dimension; axis++) {
        if (!cells->periodic[axis])
            continue;
        const int64_t low = cell_domain_end(cells, level, axis, 0),
                      high = cell_domain_end(cells, level, axis, 1);
        at[axis] += at[axis] < low ? high - low : at[axis] >= high ? low - high : 0;
    }
}

/* A store without blocks, with the core's fields and COUNT more. The caller has set dimension,
 * edge, domain, ranks, partition and threads. */
struct error *cell_blocks_create(struct cell_blocks *cells, const struct field_declaration *more,
                                 int count);
/* Adds COUNT fields to a store without blocks. */
void cell_blocks_declare(struct cell_blocks *cells, const struct field_declaration *more,
                         int count);
void cell_blocks_destroy(struct cell_blocks *cells);

/* Gives this rank its slice of the blocks of the domain, all zero but ids and places. ERROR_STATE:
 * the domain has more cells than can be counted. */
struct error *cell_blocks_fill(struct cell_blocks *cells);

/* The blocks of LIST, COUNT of them, which cover the domain and are taken over, replace those that
 * there are, with all fields zero but ids and places. All ranks have the same list, and each gets
 * the blocks that it owns. */
struct error *cell_blocks_take(struct cell_blocks *cells, struct cell_block *list, int32_t count);
/* The same; what there was goes to OLD, to be destroyed. */
struct error *cell_blocks_renew(struct cell_blocks *cells, struct cell_block *list, int32_t count,
                                struct cell_blocks *old);

/* The COUNT blocks at BLOCK, which are taken over, replace those that there are; with COPIES of
 * those of other ranks beside them. */
struct error *cell_blocks_take_own(struct cell_blocks *cells, struct cell_block *block,
                                   int32_t count, bool copies);

/* Collective: before blocks are renewed with LIST, in the order of keys: this rank gets, in place
 * of its blocks, all that its part of LIST meets, be they its own or of other ranks. *MOVED: the
 * data of fields are elsewhere. */
struct error *cell_blocks_fetch(struct cell_blocks *cells, const struct cell_block *list,
                                int64_t count, bool *moved);

/* Whether there are several levels of cells, and other ranks have some of them. */
BOLIDE_INLINE bool cell_blocks_are_spread(const struct cell_blocks *cells)
{
    return cells->levels > 1 && cells->ranks->joined;
}

/* For qsort: by their keys. */
int cell_block_order(const void *a, const void *b);

/* The data of field NAME, which must exist; it holds until blocks come or go. */
void *cell_blocks_field(const struct cell_blocks *cells, const char *name);

/* The key of the block that holds the cell AT of the global grid of LEVEL. */
uint64_t cell_block_key(int dimension, int level, const int64_t at[3]);

/* The block with KEY, NULL where this rank does not own it. */
const struct cell_block *cell_block_find(const struct cell_blocks *cells, uint64_t key);

/* The block of LEVEL that holds its cell AT, NULL where this rank owns none. */
const struct cell_block *cell_block_at(const struct cell_blocks *cells, int level,
                                       const int64_t at[3]);

/* Collective: every block goes to the rank that owns it. With RECUT, or where the ranks' work since
 * the cut differs by too much, blocks are divided anew. WORK: of each block, how often its cells
 * were computed; NULL: all as often. */
struct error *cell_blocks_distribute(struct cell_blocks *cells, const int64_t *work, bool recut);

/* Collective: loads or saves every STATE field, as "cells/NAME", in the order of keys. */
struct error *cell_blocks_visit(struct cell_blocks *cells, struct visitor *visitor);

/* Collective: one number for the bits of all STATE fields. */
uint64_t cell_blocks_hash(const struct cell_blocks *cells);

/* Bytes that the store holds for each cell. */
size_t cell_blocks_bytes(const struct cell_blocks *cells);

#endif
