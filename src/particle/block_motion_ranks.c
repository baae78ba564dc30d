/* The blocks of other ranks that are adjacent to ours, and their motion; see block_motion.h. */
#include <stdlib.h>

#include "base/memory.h"
#include "parallel/block.h"
#include "particle/block_motion.h"

struct error *motion_out_of_memory(void) { return out_of_memory_for("the motion of blocks"); }

bool motion_key_beside(int dimension, const int64_t own[3], int k, uint64_t *key)
{
    const int offset[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
    int64_t at[3];
    if ((offset[1] && dimension < 2) || (offset[2] && dimension < 3))
        return false;
    for (int axis = 0; axis < 3; axis++)
        at[axis] = own[axis] + offset[axis];
    *key = block_key(at);
    return true;
}

int motion_compare_key(const void *key, const void *far)
{
    uint64_t x = *(const uint64_t *)key, y = *(const uint64_t *)far;
    return x < y ? -1 : x > y;
}

/* What goes to other ranks. */
struct sends {
    struct send_item *send;
    int64_t capacity;
    int32_t count;
};

/* Adds block B, once, to the list for the rank that owns the block of KEY. Entries from FIRST on
 * are of B. */
static bool add_send(const struct particles *p, const struct halo *halo, uint64_t key, int32_t b,
                     int32_t first, struct sends *sends)
{
    const struct region *other = bsearch(&key, halo->region, (size_t)halo->regions,
                                         sizeof *halo->region, motion_compare_key);
    bool is_new = other && other->rank != p->ranks->rank;
    for (int32_t e = first; e < sends->count && is_new; e++)
        is_new = sends->send[e].rank != other->rank;
    if (!is_new)
        return true;
    if (!memory_reserve((void **)&sends->send, &sends->capacity, sends->count + 1, sends->count,
                        sizeof *sends->send))
        return false;
    sends->send[sends->count++] = (struct send_item){other->rank, b};
    return true;
}

/* Finds our blocks that are adjacent to blocks of other ranks. */
static bool find_send_items(const struct particles *p, struct near_walls walls,
                            const struct halo *halo, struct sends *sends)
{
    int64_t own[3], low[3], high[3], at[3];
    uint64_t key;
    double shift[3];
    bool room = true;
    for (int32_t b = 0; b < p->blocks && room; b++) {
        const int32_t first = sends->count;
        block_coordinates(p->block[b].key, own);
        for (int k = 0; k < TOUCHING_MAX; k++)
            if (motion_key_beside(p->dimension, own, k, &key))
                room = room && add_send(p, halo, key, b, first, sends);
        for (int image = 1; image < IMAGE_CODES; image++) {
            if (!motion_blocks_across(p, walls, own, (image_code)image, low, high, shift))
                continue;
            for (at[0] = low[0]; at[0] <= high[0]; at[0]++)
                for (at[1] = low[1]; at[1] <= high[1]; at[1]++)
                    for (at[2] = low[2]; at[2] <= high[2]; at[2]++)
                        room = room && add_send(p, halo, block_key(at), b, first, sends);
        }
    }
    return room;
}

struct error *motion_meet(struct block_motion *motion, const struct particles *p,
                          struct near_walls walls, const struct halo *halo)
{
    struct sends sends = {0};
    bool found = find_send_items(p, walls, halo, &sends);
    struct error *error = ranks_agree(p->ranks, found ? NULL : motion_out_of_memory());
    if (!error)
        error = exchange_plan(&motion->exchange, p->ranks, sends.send, sends.count);
    free(sends.send);
    TRY(error);
    free(motion->far_key);
    motion->far_key = memory_allocate((size_t)motion->exchange.comes * sizeof *motion->far_key);
    uint64_t *own = memory_allocate((size_t)p->blocks * sizeof *own);
    for (int32_t b = 0; b < p->blocks && own; b++)
        own[b] = p->block[b].key;
    error = own && motion->far_key ? exchange_reserve(&motion->exchange, sizeof *own)
                                   : motion_out_of_memory();
    error = ranks_agree(p->ranks, error);
    if (!error) {
        exchange_start(&motion->exchange, own, sizeof *own, motion->far_key);
        exchange_finish(&motion->exchange);
    }
    free(own);
    return error;
}

void motion_meet_again(struct block_motion *motion, const struct particles *p)
{
    const size_t group_bytes = (size_t)motion->groups * sizeof *motion->group;
    exchange_start(&motion->exchange, motion->block, sizeof *motion->block,
                   motion->block + p->blocks);
    exchange_finish(&motion->exchange);
    exchange_start(&motion->exchange, motion->group, group_bytes,
                   motion->group + (int64_t)p->blocks * motion->groups);
    exchange_finish(&motion->exchange);
}
