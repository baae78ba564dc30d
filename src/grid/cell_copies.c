/* Copies of blocks of other ranks; see cell_copies.h. */
#include "grid/cell_copies.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "grid/levels.h"
#include "parallel/block.h"

/* Blocks of other ranks that have been found, some of them more than once. */
struct found {
    const struct cell_blocks *cells;
    struct cell_block *block;
    int64_t capacity;
    int32_t count;
    bool failed;
};

static void take(struct found *found, const struct cell_block *block)
{
    const struct cell_blocks *cells = found->cells;
    if (partition_owner(cells->partition, block->key) == cells->ranks->rank || found->failed)
        return;
    found->failed = !memory_reserve((void **)&found->block, &found->capacity, found->count + 1,
                                    found->count, sizeof *found->block);
    if (!found->failed)
        found->block[found->count++] = *block;
}

/* The cell beside BLOCK in the direction TO, -1, 0 or 1 along each axis: along it the first one of
 * the block where that is 0. */
static void cell_beside(const struct cell_block *block, const int to[3], int64_t at[3])
{
    for (int axis = 0; axis < 3; axis++)
        at[axis] = block->corner[axis] + (to[axis] < 0   ? -1
                                          : to[axis] > 0 ? block->count[axis]
                                                         : 0);
}

/* Takes the finer blocks that touch BLOCK in the direction TO. */
static void take_finer(struct found *found, const struct cell_block *block, const int to[3])
{
    const int dimension = found->cells->dimension;
    for (int k = 0; k < 1 << dimension; k++) {
        int64_t at[3] = {0, 0, 0};
        bool again = false;
        for (int axis = 0; axis < dimension; axis++) {
            const int high = k >> axis & 1;
            const int64_t begin = 2 * block->corner[axis],
                          end = begin + 2 * (int64_t)block->count[axis];
            again |= to[axis] != 0 && high;
            at[axis] = to[axis] < 0 ? begin - 1 : to[axis] > 0 ? end : high ? end - 1 : begin;
        }
        const struct cell_block *part =
            again ? NULL : cell_block_known(found->cells, block->level - 1, at);
        if (part)
            take(found, part);
    }
}

/* Whether cells of another level are beside a face of BLOCK. */
static bool meets_level(const struct cell_blocks *cells, const struct cell_block *block)
{
    bool meets = false;
    for (int k = 0; k < 2 * cells->dimension && !meets; k++) {
        int to[3] = {0, 0, 0};
        int64_t at[3];
        to[k / 2] = k % 2 ? 1 : -1;
        cell_beside(block, to, at);
        const struct cell_block *beside = cell_block_known(cells, block->level, at);
        meets = beside && beside->level != block->level;
    }
    return meets;
}

/* Takes all blocks that touch BLOCK, be it in a corner. */
static void take_touching(struct found *found, const struct cell_block *block)
{
    const int dimension = found->cells->dimension;
    for (int k = 0; k < 27; k++) {
        const int to[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
        int64_t at[3];
        if ((dimension < 2 && to[1]) || (dimension < 3 && to[2]) || (!to[0] && !to[1] && !to[2]))
            continue;
        cell_beside(block, to, at);
        const struct cell_block *beside = cell_block_known(found->cells, block->level, at);
        if (beside && beside->level < block->level)
            take_finer(found, block, to);
        else if (beside)
            take(found, beside);
    }
}

/* Puts what was found behind the blocks, each once. */
static struct error *append(struct cell_blocks *cells, struct found *found)
{
    int64_t held = cells->count;
    const size_t all = (size_t)(cells->blocks + found->count) + 1;
    struct cell_block *block = memory_allocate(all * sizeof *block);
    if (!block || !block_table_clear(&cells->table, (int64_t)all)) {
        free(block);
        return out_of_memory_for("cells");
    }
    memcpy(block, cells->block, (size_t)cells->blocks * sizeof *block);
    for (int32_t b = 0; b < cells->blocks; b++)
        block_table_add(&cells->table, block[b].key);
    qsort(found->block, (size_t)found->count, sizeof *found->block, cell_block_order);
    for (int32_t k = 0; k < found->count; k++) {
        if (k > 0 && found->block[k].key == found->block[k - 1].key)
            continue;
        struct cell_block *copy = &block[cells->blocks + cells->copies++];
        *copy = found->block[k];
        copy->first = (int32_t)held;
        block_table_add(&cells->table, copy->key);
        held += cell_block_cells(copy);
        if (held > INT32_MAX) {
            free(block);
            return error_new(ERROR_STATE, "more than %d cells on one rank", INT32_MAX);
        }
    }
    free(cells->block);
    cells->block = block;
    cells->held = (int32_t)held;
    return NULL;
}

struct error *cell_copies_add(struct cell_blocks *cells)
{
    struct found found = {.cells = cells};
    if (!cell_blocks_are_spread(cells) || !cells->partition->cut)
        return NULL;
    for (int32_t b = 0; b < cells->blocks; b++)
        if (meets_level(cells, &cells->block[b]))
            take_touching(&found, &cells->block[b]);
    struct error *error = found.failed       ? out_of_memory_for("cells")
                          : found.count == 0 ? NULL
                                             : append(cells, &found);
    free(found.block);
    return error;
}

void cell_copies_free(struct cell_copies *copies)
{
    free(copies->sent);
    free(copies->came);
    exchange_free(&copies->exchange);
    *copies = (struct cell_copies){0};
}

/* A block that a rank has a copy of. */
struct wanted {
    uint64_t key;
    int32_t rank;
};

/* Takes down what other ranks want: COUNT blocks. */
static struct error *promise(struct cell_copies *copies, const struct cell_blocks *cells,
                             const struct wanted *wanted, int32_t count, size_t bytes)
{
    struct send_item *send = memory_allocate(((size_t)count + 1) * sizeof *send);
    copies->sent = memory_allocate(((size_t)count + 1) * sizeof *copies->sent);
    copies->came = memory_allocate(((size_t)cells->copies + 1) * bytes);
    struct error *error = ranks_agree(
        cells->ranks,
        send && copies->sent && copies->came ? NULL : out_of_memory_for("the cells beyond blocks"));
    for (int32_t k = 0; k < count && !error; k++) {
        const struct cell_block *block = cell_block_find(cells, wanted[k].key);
        assert(block);
        copies->sent[k] = (int32_t)(block - cells->block);
        send[k] = (struct send_item){wanted[k].rank, k};
    }
    if (!error)
        error = exchange_plan(&copies->exchange, cells->ranks, send, count);
    if (!error)
        error = ranks_agree(cells->ranks, exchange_reserve(&copies->exchange, bytes));
    free(send);
    return error;
}

struct error *cell_copies_plan(struct cell_copies *copies, const struct cell_blocks *cells,
                               int numbers)
{
    cell_copies_free(copies);
    copies->numbers = numbers;
    if (!cell_blocks_are_spread(cells))
        return NULL;
    const size_t room = (size_t)cells->copies + 1,
                 bytes =
                     (size_t)cell_block_room(cells->dimension) * (size_t)numbers * sizeof(double);
    struct wanted *wanted = memory_allocate(room * sizeof *wanted);
    struct send_item *owner = memory_allocate(room * sizeof *owner);
    void *came = NULL;
    int32_t count = 0;
    struct error *error = ranks_agree(
        cells->ranks, wanted && owner ? NULL : out_of_memory_for("the cells beyond blocks"));
    for (int32_t k = 0; k < cells->copies && !error; k++) {
        const uint64_t key = cells->block[cells->blocks + k].key;
        wanted[k] = (struct wanted){key, cells->ranks->rank};
        owner[k] = (struct send_item){partition_owner(cells->partition, key), k};
    }
    if (!error)
        error = exchange_once(cells->ranks, owner, cells->copies, wanted, sizeof *wanted, &came,
                              &count);
    if (!error)
        error = promise(copies, cells, came, count, bytes);
    assert(error || copies->exchange.comes == cells->copies);
    free(wanted);
    free(owner);
    free(came);
    return error;
}

void cell_copies_start(struct cell_copies *copies, const struct cell_blocks *cells,
                       const double *const *field)
{
    const size_t room = (size_t)cell_block_room(cells->dimension);
    double *out = copies->exchange.buffer;
    if (!cell_blocks_are_spread(cells))
        return;
    for (int32_t k = 0; k < copies->exchange.goes; k++) {
        const struct cell_block *block = &cells->block[copies->sent[copies->exchange.send[k].item]];
        for (int n = 0; n < copies->numbers; n++, out += room)
            memcpy(out, field[n] + block->first, (size_t)cell_block_cells(block) * sizeof *out);
    }
    exchange_start(&copies->exchange, NULL, room * (size_t)copies->numbers * sizeof *out,
                   copies->came);
}

void cell_copies_finish(struct cell_copies *copies, const struct cell_blocks *cells,
                        double *const *field)
{
    const size_t room = (size_t)cell_block_room(cells->dimension);
    const double *in = copies->came;
    if (!cell_blocks_are_spread(cells))
        return;
    exchange_finish(&copies->exchange);
    for (int32_t k = 0; k < cells->copies; k++) {
        const struct cell_block *block = &cells->block[cells->blocks + k];
        for (int n = 0; n < copies->numbers; n++, in += room)
            memcpy(field[n] + block->first, in, (size_t)cell_block_cells(block) * sizeof *in);
    }
}
