/* Which particle lies in which cell of the grid, found anew each step: groups of bodies that share
 * nothing, in a group blocks of cells by key, in a block its cells, in a cell the particles by id.
 * What is added up in this order does not depend on how the particles are stored; storage that is
 * nearly in this order makes it quick. */
#ifndef BOLIDE_BINS_H
#define BOLIDE_BINS_H

#include "base/error.h"
#include "grid/block_table.h"
#include "parallel/block.h"

enum { BIN_GROUPS = 16 };

/* A block of a group. The particles of cell C are list[first + cell[c]] .. list[first + cell[c + 1]
 * - 1]. */
struct bin {
    uint64_t key;
    int32_t first, cell[BLOCK_CELLS + 1];
};

/* The particles: COUNT of them at POSITION, stored in BLOCKS of cells of edge EDGE, the first of
 * which begins at -SHIFT; an index means the same particle while ORDER stays. Where there are
 * several GROUPS, a body belongs to one of them. Cells below LOW and above HIGH do not exist: what
 * rounding puts there is in the outermost. */
struct binned {
    int dimension;
    double edge, shift;
    int32_t count, blocks;
    const struct block *block;
    const double (*position)[3];
    const uint64_t *id;
    uint64_t order;
    int64_t low[3], high[3];
    int groups;
    const uint8_t *group_of_body;
    const uint16_t *body;
};

/* Cells and planes between them have indices within this distance from zero. */
int64_t bins_reach(int dimension);

struct stray;
struct candidate;

struct bins {
    int32_t count, *list;
    struct bin *bin;
    int32_t begin[BIN_GROUPS + 1]; /* bins of group g: begin[g] .. begin[g + 1] - 1 */
    int64_t moved;                 /* particles that have left the cell they were stored by */

    /* Kept from step to step. */
    /* of each particle: its cell within the block it is stored in; the same when last stored */
    uint8_t *cell, *home;
    uint64_t order;
    int64_t list_capacity, cell_capacity, home_capacity, bin_capacity;
    int32_t strays;
    struct stray *stray, *sorted;
    int64_t stray_capacity, sorted_capacity;
    struct candidate *candidate;
    int64_t candidate_capacity;
    struct block_table table;
};

/* Finds the cells of particles, and which lie in other blocks than they are stored in, the strays;
 * fills the bins from that. ERROR_STATE when a particle lies beyond what blocks can count. */
struct error *bins_find(struct bins *bins, const struct binned *particles, int threads);
struct error *bins_fill(struct bins *bins, const struct binned *particles, int threads);

/* Between the two: the key of the block that stray K lies in, and its *INDEX; whether particle I is
 * one. */
uint64_t bins_stray(const struct bins *bins, int32_t k, int32_t *index);
bool bins_is_stray(const struct bins *bins, int32_t i);

/* Tells that the particles are now stored in the order of the bins' list: bin after bin, which is
 * BINNED's order ORDER. */
void bins_settle(struct bins *bins, uint64_t order, int threads);
/* The same as bins_find after it, where particles have become others since: those of the storage
 * blocks with a flag in AGAIN; all from BEFORE on are new. */
struct error *bins_find_again(struct bins *bins, const struct binned *particles, const bool *again,
                              int32_t before, int threads);
void bins_free(struct bins *bins);

/* The cell of a block along each axis, from its number in the block. */
BOLIDE_INLINE void bin_cell_place(int dimension, int cell, int place[3])
{
    const int cells = block_cells(dimension);
    place[0] = place[1] = place[2] = 0;
    for (int axis = dimension - 1; axis >= 0; axis--, cell /= cells)
        place[axis] = cell % cells;
}

#endif
