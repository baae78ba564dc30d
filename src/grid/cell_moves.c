/* Blocks of cells that go to other ranks; see cell_blocks.h. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "grid/cell_blocks.h"
#include "parallel/block.h"
#include "parallel/exchange.h"

/* What goes with a block that moves to another rank: the block, then of each STATE field its
 * cells. */
static size_t bytes_that_go(const struct cell_blocks *cells)
{
    return sizeof(struct cell_block) + fields_bytes(cells->field, cells->fields, FIELD_STATE) *
                                           (size_t)cell_block_room(cells->dimension);
}

static void pack(const struct cell_blocks *cells, const struct cell_block *block, char *out)
{
    memcpy(out, block, sizeof *block);
    out += sizeof *block;
    for (int k = 0; k < cells->fields; k++) {
        const size_t bytes = field_bytes(&cells->field[k]),
                     all = bytes * (size_t)cell_block_cells(block);
        if (!(cells->field[k].declaration.kind & FIELD_STATE))
            continue;
        memcpy(out, (const char *)cells->field[k].data + (size_t)block->first * bytes, all);
        out += all;
    }
}

static void unpack(struct cell_blocks *cells, const struct cell_block *block, const char *in)
{
    in += sizeof *block;
    for (int k = 0; k < cells->fields; k++) {
        const size_t bytes = field_bytes(&cells->field[k]),
                     all = bytes * (size_t)cell_block_cells(block);
        if (!(cells->field[k].declaration.kind & FIELD_STATE))
            continue;
        memcpy((char *)cells->field[k].data + (size_t)block->first * bytes, in, all);
        in += all;
    }
}

/* The cells of a block that stays, from FIRST of the arrays that there were, to where they are. */
static void keep(struct cell_blocks *cells, const struct cell_block *block,
                 const struct field *before, int32_t first)
{
    for (int k = 0; k < cells->fields; k++) {
        const size_t bytes = field_bytes(&cells->field[k]);
        if (cells->field[k].declaration.kind & FIELD_STATE)
            memcpy((char *)cells->field[k].data + (size_t)block->first * bytes,
                   (const char *)before[k].data + (size_t)first * bytes,
                   bytes * (size_t)cell_block_cells(block));
    }
}

/* Blocks that stay, COUNT of STAYS, and so many packed ones at PACKED become the rank's own, with
 * COPIES of those beside them. */
static struct error *take_in(struct cell_blocks *cells, const struct cell_block *stays,
                             int32_t count, const char *packed, int32_t came, bool copies)
{
    const size_t bytes = bytes_that_go(cells);
    struct field before[CELL_BLOCK_FIELDS];
    struct cell_block *block = memory_allocate(((size_t)(count + came) + 1) * sizeof *block);
    if (!block)
        return out_of_memory_for("cells");
    memcpy(before, cells->field, sizeof before);
    for (int k = 0; k < cells->fields; k++)
        cells->field[k].data = NULL;
    memcpy(block, stays, (size_t)count * sizeof *block);
    for (int32_t b = 0; b < came; b++)
        memcpy(&block[count + b], packed + (size_t)b * bytes, sizeof *block);
    struct error *error = cell_blocks_take_own(cells, block, count + came, copies);
    for (int32_t b = 0; b < count && !error; b++)
        keep(cells, cell_block_find(cells, stays[b].key), before, stays[b].first);
    for (int32_t b = 0; b < came && !error; b++) {
        struct cell_block at;
        memcpy(&at, packed + (size_t)b * bytes, sizeof at);
        unpack(cells, cell_block_find(cells, at.key), packed + (size_t)b * bytes);
    }
    for (int k = 0; k < cells->fields; k++)
        free(before[k].data);
    return error;
}

static struct error *divide(struct cell_blocks *cells, const int64_t *work, bool anyway, bool *anew)
{
    struct block_weight *own = memory_allocate(((size_t)cells->blocks + 1) * sizeof *own);
    struct error *error = ranks_agree(cells->ranks, own ? NULL : out_of_memory_for("cells"));
    for (int32_t b = 0; b < cells->blocks && !error; b++)
        own[b] =
            (struct block_weight){cells->block[b].key, (double)cell_block_cells(&cells->block[b]) *
                                                           (work ? (double)work[b] : 1.0)};
    if (!error)
        error = partition_divide(cells->partition, own, cells->blocks, anyway, anew);
    free(own);
    return error;
}

/* Room for what of SEND goes to other ranks, and for what stays. */
struct passing {
    struct cell_block *stays;
    struct send_item *away;
    char *packed; /* in the order of `away` */
    int32_t count, goes;
};

static struct error *pack_all(const struct cell_blocks *cells, const struct send_item *send,
                              int32_t sends, struct passing *p)
{
    const size_t bytes = bytes_that_go(cells);
    for (int32_t k = 0; k < sends; k++)
        p->goes += send[k].rank != cells->ranks->rank;
    p->stays = memory_allocate(((size_t)(sends - p->goes) + 1) * sizeof *p->stays);
    p->away = memory_allocate(((size_t)p->goes + 1) * sizeof *p->away);
    p->packed = memory_allocate((size_t)p->goes * bytes + 1);
    if (!p->stays || !p->away || !p->packed)
        return out_of_memory_for("cells");
    int32_t goes = 0;
    for (int32_t k = 0; k < sends; k++) {
        const struct cell_block *block = &cells->block[send[k].item];
        if (send[k].rank == cells->ranks->rank) {
            p->stays[p->count++] = *block;
            continue;
        }
        p->away[goes] = (struct send_item){send[k].rank, goes};
        pack(cells, block, p->packed + (size_t)goes++ * bytes);
    }
    return NULL;
}

/* Blocks go where SEND, so many, says, be it to this rank; what comes takes their place, with
 * COPIES of those beside it. */
static struct error *pass_blocks(struct cell_blocks *cells, const struct send_item *send,
                                 int32_t sends, bool copies)
{
    struct passing passing = {0};
    void *came = NULL;
    int32_t count = 0;
    struct error *error = ranks_agree(cells->ranks, pack_all(cells, send, sends, &passing));
    if (!error)
        error = exchange_once(cells->ranks, passing.away, passing.goes, passing.packed,
                              bytes_that_go(cells), &came, &count);
    free(passing.away);
    free(passing.packed);
    if (!error)
        error = ranks_agree(cells->ranks,
                            take_in(cells, passing.stays, passing.count, came, count, copies));
    free(passing.stays);
    free(came);
    return error;
}

/* All blocks go to their owners; those that stay too. */
static struct error *migrate(struct cell_blocks *cells)
{
    struct send_item *send = memory_allocate(((size_t)cells->blocks + 1) * sizeof *send);
    struct error *error = ranks_agree(cells->ranks, send ? NULL : out_of_memory_for("cells"));
    for (int32_t b = 0; b < cells->blocks && !error; b++)
        send[b] = (struct send_item){partition_owner(cells->partition, cells->block[b].key), b};
    if (!error)
        error = pass_blocks(cells, send, cells->blocks, true);
    free(send);
    return error;
}

struct error *cell_blocks_distribute(struct cell_blocks *cells, const int64_t *work, bool recut)
{
    if (!cells->ranks->joined)
        return NULL;
    if (!recut && !partition_is_uneven(cells->partition))
        return NULL;
    bool anew;
    TRY(divide(cells, work, recut, &anew));
    return anew ? migrate(cells) : NULL;
}

/* How many keys a block of LEVEL covers. */
static uint64_t keys_of(int dimension, int level)
{
    const int blocks = cell_block_side(dimension) / block_cells(dimension);
    uint64_t keys = 1;
    for (int side = blocks << level; side > 1; side /= 2)
        keys *= 8; /* of all axes, be they there or not */
    return keys;
}

/* Sends of blocks to be made, and whether some go to other ranks. */
struct sends {
    struct send_item *item;
    int64_t capacity;
    int32_t count;
    bool away, failed;
};

/* Block B goes to the owners of all blocks of LIST, COUNT of them, that meet it. */
static void send_to_meeting(const struct cell_blocks *cells, int32_t b,
                            const struct cell_block *list, int64_t count, struct sends *sends)
{
    const struct cell_block *block = &cells->block[b];
    const uint64_t end = block->key + keys_of(cells->dimension, block->level);
    int64_t low = 0, high = count; /* list[low].key <= block->key < list[high].key */
    int last = -1;
    while (high - low > 1) {
        const int64_t middle = (low + high) / 2;
        *(list[middle].key <= block->key ? &low : &high) = middle;
    }
    for (int64_t k = low; k < count && list[k].key < end && !sends->failed; k++) {
        const int owner = partition_owner(cells->partition, list[k].key);
        if (list[k].key + keys_of(cells->dimension, list[k].level) <= block->key || owner == last)
            continue;
        sends->failed = !memory_reserve((void **)&sends->item, &sends->capacity, sends->count + 1,
                                        sends->count, sizeof *sends->item);
        if (!sends->failed)
            sends->item[sends->count++] = (struct send_item){owner, b};
        sends->away |= owner != cells->ranks->rank;
        last = owner;
    }
}

struct error *cell_blocks_fetch(struct cell_blocks *cells, const struct cell_block *list,
                                int64_t count, bool *moved)
{
    struct sends sends = {0};
    *moved = false;
    if (!cell_blocks_are_spread(cells))
        return NULL;
    for (int32_t b = 0; b < cells->blocks; b++)
        send_to_meeting(cells, b, list, count, &sends);
    double away = sends.away;
    struct error *error =
        ranks_agree_on(cells->ranks, sends.failed ? out_of_memory_for("cells") : NULL, &away, 1);
    *moved = !error && away > 0.0;
    if (*moved)
        error = pass_blocks(cells, sends.item, sends.count, false);
    free(sends.item);
    return error;
}
