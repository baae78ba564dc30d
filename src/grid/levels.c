/* Levels of cells: see levels.h. */
#include "grid/levels.h"

#include <stdlib.h>

#include "base/memory.h"
#include "parallel/block.h"

/* A list of blocks that cover the domain, and how to find them. */
struct cover {
    const struct cell_blocks *cells;
    const struct cell_block *block;
    const struct block_table *table;
};

static bool is_inside(const struct cell_blocks *cells, int level, const int64_t at[3])
{
    bool inside = true;
    for (int axis = 0; axis < cells->dimension; axis++)
        inside &= at[axis] * (1 << level) >= cells->low[axis] &&
                  at[axis] * (1 << level) < cells->high[axis];
    return inside;
}

/* The number of the block whose key is that of the block of LEVEL that would hold cell AT, where it
 * covers that; else -1. */
static int32_t block_of(const struct cover *cover, int level, const int64_t at[3])
{
    const int32_t number =
        block_table_find(cover->table, cell_block_key(cover->cells->dimension, level, at));
    return number >= 0 && cover->block[number].level >= level ? number : -1;
}

static int32_t find(const struct cover *cover, int level, const int64_t place[3])
{
    int64_t at[3] = {place[0], place[1], place[2]};
    cell_into_domain(cover->cells, level, at);
    int32_t found = is_inside(cover->cells, level, at) ? block_of(cover, level, at) : -2;
    for (int l = level + 1; l < cover->cells->levels && found == -1; l++) {
        int64_t cell[3] = {0, 0, 0};
        for (int axis = 0; axis < cover->cells->dimension; axis++)
            cell[axis] = block_of_cell(at[axis], (int64_t)1 << (l - level));
        found = block_of(cover, l, cell);
    }
    for (int l = level - 1; l >= 0 && found == -1; l--) {
        int64_t cell[3] = {0, 0, 0};
        for (int axis = 0; axis < cover->cells->dimension; axis++)
            cell[axis] = at[axis] * (1 << (level - l));
        found = block_of(cover, l, cell);
    }
    return found;
}

const struct cell_block *cell_block_cover(const struct cell_blocks *cells, int level,
                                          const int64_t at[3])
{
    const struct cover cover = {cells, cells->block, &cells->table};
    const int32_t found = find(&cover, level, at);
    return found < 0 ? NULL : &cells->block[found];
}

const struct cell_block *cell_block_known(const struct cell_blocks *cells, int level,
                                          const int64_t at[3])
{
    if (!cell_blocks_are_spread(cells))
        return cell_block_cover(cells, level, at);
    const struct cell_cover *whole = &cells->whole;
    const struct cover cover = {cells, whole->block, &whole->table};
    const int32_t found = find(&cover, level, at);
    return found < 0 ? NULL : &whole->block[found];
}

/* The block of LEVEL with index AT along each axis; false where it is outside the domain. */
static bool block_at(const struct cell_blocks *cells, int level, const int64_t at[3],
                     struct cell_block *block)
{
    const int side = cell_block_side(cells->dimension);
    bool inside = true;
    *block = (struct cell_block){.count = {1, 1, 1}, .level = level};
    for (int axis = 0; axis < cells->dimension; axis++) {
        const int64_t begin = at[axis] * side, low = cell_domain_end(cells, level, axis, 0),
                      high = cell_domain_end(cells, level, axis, 1);
        block->corner[axis] = begin > low ? begin : low;
        block->count[axis] =
            (int)((begin + side < high ? begin + side : high) - block->corner[axis]);
        inside &= block->count[axis] > 0;
    }
    block->key = cell_block_key(cells->dimension, level, block->corner);
    return inside;
}

/* What is to be divided: a key of a coarse block with its level in the bits that are zero. */
static uint64_t mark_of(const struct cell_blocks *cells, int level, const int64_t at[3])
{
    return cell_block_key(cells->dimension, level, at) | (uint64_t)level;
}

/* Marks all blocks that hold what is wanted finer. */
static bool mark_wanted(const struct cell_blocks *cells, const struct cell_want *want,
                        int64_t wants, struct block_table *marks)
{
    if (!block_table_clear(marks, wants * (cells->levels - 1) + 1))
        return false;
    for (int64_t k = 0; k < wants; k++)
        for (int level = want[k].level + 1; level < cells->levels; level++) {
            int64_t at[3] = {0, 0, 0};
            for (int axis = 0; axis < cells->dimension; axis++)
                at[axis] = block_of_cell(want[k].at[axis], (int64_t)1 << (level - want[k].level));
            block_table_add(marks, mark_of(cells, level, at));
        }
    return true;
}

/* Whether BLOCK is to be divided: it is marked or meets a region of level 0. */
static bool is_pinned(const struct cell_blocks *cells, const struct block_table *marks,
                      const struct cell_block *block)
{
    if (block_table_find(marks, mark_of(cells, block->level, block->corner)) >= 0)
        return true;
    for (int r = 0; r < cells->regions; r++) {
        const struct cell_region *region = &cells->region[r];
        bool meets = true;
        for (int axis = 0; axis < cells->dimension; axis++) {
            const int64_t low = block->corner[axis] * (1 << block->level),
                          high = low + (int64_t)block->count[axis] * (1 << block->level),
                          period = cells->high[axis] - cells->low[axis];
            bool along = false;
            for (int k = -1; k <= 1; k++)
                along |= (k == 0 || cells->periodic[axis]) &&
                         low < region->high[axis] + k * period &&
                         high > region->low[axis] + k * period;
            meets &= along;
        }
        if (meets)
            return true;
    }
    return false;
}

/* Marks in SPLIT the blocks beside B that are coarser than it by more than a level. */
static void mark_coarse(const struct cover *cover, int32_t b, bool *split)
{
    const struct cell_block *block = &cover->block[b];
    const int dimension = cover->cells->dimension, all = dimension == 1   ? 3
                                                         : dimension == 2 ? 9
                                                                          : 27;
    for (int k = 0; k < all; k++) {
        const int to[3] = {k % 3 - 1, dimension > 1 ? k / 3 % 3 - 1 : 0,
                           dimension > 2 ? k / 9 - 1 : 0};
        int64_t at[3];
        for (int axis = 0; axis < 3; axis++)
            at[axis] = block->corner[axis] + (to[axis] < 0   ? -1
                                              : to[axis] > 0 ? block->count[axis]
                                                             : 0);
        const int32_t beside = find(cover, block->level, at);
        if (beside >= 0 && cover->block[beside].level > block->level + 1)
            split[beside] = true;
    }
}

/* A list that grows. */
struct blocks {
    struct cell_block *block;
    int64_t capacity;
    int32_t count;
};

static bool add(struct blocks *blocks, const struct cell_block *block)
{
    if (!memory_reserve((void **)&blocks->block, &blocks->capacity, blocks->count + 1,
                        blocks->count, sizeof *blocks->block))
        return false;
    blocks->block[blocks->count++] = *block;
    return true;
}

/* Adds the blocks of LEVEL with indices LOW .. HIGH along each axis that the domain has. */
static bool add_box(const struct cell_blocks *cells, int level, const int64_t low[3],
                    const int64_t high[3], struct blocks *blocks)
{
    bool room = true;
    int64_t at[3];
    for (at[2] = low[2]; at[2] <= high[2]; at[2]++)
        for (at[1] = low[1]; at[1] <= high[1]; at[1]++)
            for (at[0] = low[0]; at[0] <= high[0] && room; at[0]++) {
                struct cell_block block;
                if (block_at(cells, level, at, &block))
                    room = add(blocks, &block);
            }
    return room;
}

/* Puts the parts of each block of OLD that SPLIT marks, and the others, into NEW. */
static bool divide(const struct cell_blocks *cells, const struct blocks *old, const bool *split,
                   struct blocks *new)
{
    const int side = cell_block_side(cells->dimension);
    bool room = true;
    new->count = 0;
    for (int32_t b = 0; b < old->count && room; b++) {
        const struct cell_block *block = &old->block[b];
        int64_t low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
        for (int axis = 0; axis < cells->dimension; axis++) {
            low[axis] = 2 * block_of_cell(block->corner[axis], side);
            high[axis] = low[axis] + 1;
        }
        room = split[b] ? add_box(cells, block->level - 1, low, high, new) : add(new, block);
    }
    return room;
}

/* Divides blocks of BLOCKS once where they are too coarse; *DONE: none is. */
static bool refine(const struct cell_blocks *cells, const struct block_table *marks,
                   struct blocks *blocks, bool *done)
{
    struct block_table table = {0};
    struct blocks new = {0};
    bool *split = memory_allocate((size_t)blocks->count + 1);
    bool room = split && block_table_clear(&table, blocks->count + 1);
    const struct cover cover = {cells, blocks->block, &table};
    for (int32_t b = 0; b < blocks->count && room; b++)
        block_table_add(&table, blocks->block[b].key);
    for (int32_t b = 0; b < blocks->count && room; b++) {
        split[b] |= blocks->block[b].level > 0 && is_pinned(cells, marks, &blocks->block[b]);
        mark_coarse(&cover, b, split);
    }
    *done = room;
    for (int32_t b = 0; b < blocks->count && room; b++)
        *done &= !split[b];
    if (room && !*done) {
        room = divide(cells, blocks, split, &new);
        free(blocks->block);
        *blocks = new;
    }
    free(split);
    block_table_free(&table);
    return room;
}

struct error *levels_list(const struct cell_blocks *cells, const struct cell_want *want,
                          int64_t wants, struct cell_block **list, int64_t *count)
{
    const int level = cells->levels - 1;
    const int64_t width = (int64_t)cell_block_side(cells->dimension) << level;
    int64_t low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
    for (int axis = 0; axis < cells->dimension; axis++) {
        low[axis] = block_of_cell(cells->low[axis], width);
        high[axis] = block_of_cell(cells->high[axis] - 1, width);
    }
    struct blocks blocks = {0};
    struct block_table marks = {0};
    bool done = false, room = mark_wanted(cells, want, wants, &marks) &&
                              add_box(cells, level, low, high, &blocks);
    while (room && !done)
        room = refine(cells, &marks, &blocks, &done);
    block_table_free(&marks);
    *list = blocks.block;
    *count = blocks.count;
    if (room) {
        qsort(blocks.block, (size_t)blocks.count, sizeof *blocks.block, cell_block_order);
        return NULL;
    }
    free(blocks.block);
    *list = NULL;
    *count = 0;
    return out_of_memory_for("cells");
}

/* Whether BLOCKS cover the domain of CELLS in the order of their keys, and none touches one that is
 * coarser by more than a level. */
static bool is_whole(const struct cell_blocks *cells, const struct cell_block *block, int32_t count)
{
    struct block_table table = {0};
    const struct cover cover = {cells, block, &table};
    bool *split = memory_allocate((size_t)count + 1);
    bool whole = split && block_table_clear(&table, count + 1);
    double all = 1.0, covered = 0.0;
    for (int axis = 0; axis < cells->dimension; axis++)
        all *= (double)(cells->high[axis] - cells->low[axis]);
    for (int32_t b = 0; b < count && whole; b++) {
        double own = 1.0;
        for (int axis = 0; axis < cells->dimension; axis++)
            own *= (double)(block[b].count[axis] * (1 << block[b].level));
        covered += own;
        whole = b == 0 || block[b - 1].key < block[b].key;
        block_table_add(&table, block[b].key);
    }
    for (int32_t b = 0; b < count && whole; b++) {
        whole = find(&cover, block[b].level, block[b].corner) == b;
        mark_coarse(&cover, b, split);
    }
    for (int32_t b = 0; b < count && whole; b++)
        whole = !split[b];
    free(split);
    block_table_free(&table);
    return whole && covered == all;
}

struct error *levels_visit(struct cell_blocks *cells, struct visitor *visitor)
{
    const bool spread = cell_blocks_are_spread(cells);
    const struct cell_block *all = spread ? cells->whole.block : cells->block;
    int64_t count = spread ? cells->whole.count : cells->blocks;
    const bool known = count > 0;
    TRY(visitor->visit(visitor, "levels/count", NUMBER_INT64, &count, 1, 1));
    if (count < 0 || count > INT32_MAX || (visitor->most && count > visitor->most))
        return error_new(ERROR_SYSTEM, "levels/count is %lld: a file of this size has 0 to %lld",
                         (long long)count, (long long)visitor->most);
    int64_t *number = memory_allocate(((size_t)count + 1) * 2 * sizeof *number);
    struct cell_block *block = memory_allocate(((size_t)count + 1) * sizeof *block);
    struct error *error = number && block ? NULL : out_of_memory_for("cells");
    for (int64_t b = 0; b < count && known && !error; b++) {
        number[2 * b] = (int64_t)all[b].key;
        number[2 * b + 1] = all[b].level;
    }
    if (!error)
        error = visitor->visit(visitor, "levels/blocks", NUMBER_INT64, number, count, 2);
    bool right = true;
    for (int64_t b = 0; b < count && !known && !error && right; b++) {
        const int side = cell_block_side(cells->dimension),
                  blocks = side / block_cells(cells->dimension);
        int64_t at[3];
        right = number[2 * b + 1] >= 0 && number[2 * b + 1] < cells->levels;
        block_coordinates((uint64_t)number[2 * b], at);
        for (int axis = 0; axis < 3; axis++)
            at[axis] = axis < cells->dimension && right
                           ? block_of_cell(at[axis], (int64_t)blocks << number[2 * b + 1])
                           : 0;
        right = right && block_at(cells, (int)number[2 * b + 1], at, &block[b]) &&
                block[b].key == (uint64_t)number[2 * b];
    }
    free(number);
    if (known || error) {
        free(block);
        return error;
    }
    if (!right || !is_whole(cells, block, (int32_t)count)) {
        free(block);
        return error_new(ERROR_SYSTEM, "levels/blocks do not cover the domain");
    }
    return cell_blocks_take(cells, block, (int32_t)count);
}
