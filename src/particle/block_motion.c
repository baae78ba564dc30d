/* What is noted of the particles when rows are built or near rows are found, to judge by how long
 * they hold; see block_motion.h. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "parallel/block.h"
#include "particle/block_motion.h"

static struct error *reserve_motion(struct neighbours *n, const struct particles *p)
{
    if (!n->motion)
        n->motion = memory_allocate(sizeof *n->motion);
    if (!n->motion)
        return motion_out_of_memory();
    n->motion->groups = 1;
    for (int axis = 0; axis < p->dimension; axis++)
        n->motion->groups *= groups_along(p->dimension);
    return NULL;
}

/* Room for near rows: as much as the rows take, of which what is not used is never touched. */
static bool reserve_near(struct neighbours *n, const struct particles *p, int threads)
{
    int64_t capacity = n->near_reference_capacity, entries = 0;
    if (!memory_reserve((void **)&n->near_origin, &capacity, p->count, 0, sizeof *n->near_origin))
        return false;
    capacity = n->near_reference_capacity;
    if (!memory_reserve((void **)&n->near_reach, &capacity, p->count, 0, sizeof *n->near_reach))
        return false;
    n->near_reference_capacity = capacity;
    if (!memory_reserve((void **)&n->near_block, &n->near_block_capacity, p->blocks, 0,
                        sizeof *n->near_block))
        return false;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int32_t b = 0; b < p->blocks; b++) {
        n->near_block[b] = 0;
        for (int32_t i = p->block[b].first; i < p->block[b].first + p->block[b].count; i++)
            n->near_block[b] += n->row[i].count;
    }
    for (int32_t b = 0; b < p->blocks; b++) {
        const int64_t of_block = n->near_block[b];
        n->near_block[b] = entries;
        entries += of_block;
    }
    return memory_reserve((void **)&n->near_entry, &n->near_capacity, entries, 0,
                          sizeof *n->near_entry) &&
           memory_reserve((void **)&n->near_row, &n->near_row_capacity, p->count, 0,
                          sizeof *n->near_row);
}

static struct error *reserve(struct neighbours *n, const struct particles *p, int threads)
{
    int64_t capacity = n->reference_capacity;
    if (!memory_reserve((void **)&n->origin, &capacity, p->count, 0, sizeof *n->origin))
        return motion_out_of_memory();
    capacity = n->reference_capacity;
    if (!memory_reserve((void **)&n->origin_reach, &capacity, p->count, 0, sizeof *n->origin_reach))
        return motion_out_of_memory();
    n->reference_capacity = capacity;
    struct block_motion *m = n->motion;
    const int64_t blocks = (int64_t)p->blocks + m->exchange.comes;
    const size_t group_bytes = (size_t)m->groups * sizeof *m->group;
    TRY(exchange_reserve(&m->exchange, group_bytes));
    if (!memory_reserve((void **)&m->block, &m->block_capacity, blocks, 0, sizeof *m->block) ||
        !memory_reserve((void **)&m->group, &m->group_capacity, blocks, 0, group_bytes) ||
        !memory_reserve((void **)&m->touching, &m->touching_capacity, p->blocks, 0,
                        sizeof *m->touching) ||
        !memory_reserve((void **)&m->group_of, &m->group_of_capacity, p->count, 0, 1) ||
        (n->near_skin > 0.0 && !reserve_near(n, p, threads)))
        return motion_out_of_memory();
    return NULL;
}

/* The group of a particle within its block at AT. */
static int group_of_place(const struct particles *p, const int64_t at[3], const double x[3])
{
    int64_t along = groups_along(p->dimension), group = 0;
    for (int axis = 0; axis < p->dimension; axis++) {
        int64_t index = cell_index(x[axis], group_edge(p), along * BLOCK_MIDDLE);
        group = group * along + (index - at[axis] * along);
    }
    return (int)group;
}

static void start_at_walls(struct moved *m, const struct mirrors *mirrors, double distance)
{
    for (int axis = 0; axis < 3; axis++) {
        if (images_repeat(mirrors, axis)) {
            m->low[axis] = m->high[axis] = (double)NAN;
            continue;
        }
        m->low[axis] -= mirrors->low[axis];
        m->high[axis] = mirrors->high[axis] - m->high[axis];
        m->walls |= (unsigned)(m->low[axis] < distance) << (2 * axis);
        m->walls |= (unsigned)(m->high[axis] < distance) << (2 * axis + 1);
    }
}

static struct moved nothing_moved(void)
{
    struct moved m = {.smallest_reach = (double)INFINITY};
    for (int axis = 0; axis < 3; axis++) {
        m.low[axis] = (double)INFINITY;
        m.high[axis] = -(double)INFINITY;
    }
    return m;
}

static void start_block(struct neighbours *n, const struct particles *p, struct reach reach,
                        const struct mirrors *mirrors, int32_t b)
{
    struct block_motion *motion = n->motion;
    struct moved *group = motion->group + (int64_t)b * motion->groups;
    int64_t at[3];
    block_coordinates(p->block[b].key, at);
    for (int g = 0; g < motion->groups; g++)
        group[g] = nothing_moved();
    motion->block[b] = nothing_moved();
    for (int32_t i = p->block[b].first; i < p->block[b].first + p->block[b].count; i++) {
        motion->group_of[i] = (uint8_t)group_of_place(p, at, p->position[i]);
        n->origin_reach[i] = reach.smoothing * reach.diameter[i];
        struct moved *both[] = {&group[motion->group_of[i]], &motion->block[b]};
        for (int k = 0; k < 2; k++) {
            both[k]->any = true;
            both[k]->smallest_reach = minimum(both[k]->smallest_reach, n->origin_reach[i]);
            for (int axis = 0; axis < 3; axis++) {
                n->origin[i][axis] = p->position[i][axis];
                both[k]->low[axis] = minimum(both[k]->low[axis], p->position[i][axis]);
                both[k]->high[axis] = maximum(both[k]->high[axis], p->position[i][axis]);
            }
        }
    }
    for (int g = 0; g < motion->groups; g++)
        start_at_walls(&group[g], mirrors, motion->distance);
    start_at_walls(&motion->block[b], mirrors, motion->distance);
}

static int compare_keys(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = ((const struct block *)b)->key;
    return x < y ? -1 : x > y;
}

/* Found by key: blocks are sorted by it, those of other ranks too. */
int32_t motion_block_of(const struct block_motion *motion, const struct particles *p, uint64_t key)
{
    const struct block *found =
        bsearch(&key, p->block, (size_t)p->blocks, sizeof *p->block, compare_keys);
    const uint64_t *far = !found && motion->far_key
                              ? bsearch(&key, motion->far_key, (size_t)motion->exchange.comes,
                                        sizeof key, motion_compare_key)
                              : NULL;
    return found ? (int32_t)(found - p->block)
           : far ? p->blocks + (int32_t)(far - motion->far_key)
                 : -1;
}

/* The blocks that touch block B. */
static void list_touching(struct block_motion *motion, const struct particles *p, int32_t b)
{
    int64_t own[3];
    uint64_t key;
    block_coordinates(p->block[b].key, own);
    for (int k = 0; k < TOUCHING_MAX; k++) {
        motion->touching[b][k] = -1;
        if (motion_key_beside(p->dimension, own, k, &key))
            motion->touching[b][k] = motion_block_of(motion, p, key);
    }
}

struct error *motion_start(struct neighbours *n, const struct particles *p, struct reach reach,
                           struct near_walls walls, const struct halo *halo, int threads)
{
    TRY(ranks_agree(p->ranks, reserve_motion(n, p)));
    if (p->ranks->joined)
        TRY(motion_meet(n->motion, p, walls, halo));
    TRY(ranks_agree(p->ranks, reserve(n, p, threads)));
    struct block_motion *motion = n->motion;
    motion->distance = motion->taken_seam = walls.distance;
    motion->mirrors = *walls.mirrors;
    motion->periodic = images_periodic(walls.mirrors);
    motion->taken_approach = motion->taken_apart = 0.0;
    motion->taken_wall = -walls.distance;
    double largest = 0.0;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : largest)
    for (int32_t b = 0; b < p->blocks; b++) {
        start_block(n, p, reach, walls.mirrors, b);
        list_touching(motion, p, b);
        for (int32_t i = p->block[b].first; i < p->block[b].first + p->block[b].count; i++)
            largest = maximum(largest, n->origin_reach[i]);
    }
    double support = 2.0 * (1.0 + n->skin) * ranks_maximum(p->ranks, largest);
    motion->judged = support < group_edge(p)   ? BY_GROUPS
                     : support < block_edge(p) ? BY_BLOCKS
                                               : BY_ALL;
    TRY(ranks_agree(p->ranks, motion_list_seams(motion, p, walls)));
    n->order = p->order;
    n->near = n->prune = false;
    motion_start_near(n, p, reach, threads);
    return NULL;
}

static void start_near_block(struct neighbours *n, const struct particles *p, struct reach reach,
                             int32_t b)
{
    struct block_motion *motion = n->motion;
    struct moved *group = motion->group + (int64_t)b * motion->groups, *block = &motion->block[b];
    block->smallest_near = (double)INFINITY;
    for (int g = 0; g < motion->groups; g++)
        group[g].smallest_near = (double)INFINITY;
    for (int32_t i = p->block[b].first; i < p->block[b].first + p->block[b].count; i++) {
        struct moved *own = &group[motion->group_of[i]];
        n->near_reach[i] = reach.smoothing * reach.diameter[i];
        memcpy(n->near_origin[i], p->position[i], sizeof n->near_origin[i]);
        own->smallest_near = minimum(own->smallest_near, n->near_reach[i]);
        block->smallest_near = minimum(block->smallest_near, n->near_reach[i]);
    }
}

void motion_start_near(struct neighbours *n, const struct particles *p, struct reach reach,
                       int threads)
{
    if (!near_wanted(n))
        return;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int32_t b = 0; b < p->blocks; b++)
        start_near_block(n, p, reach, b);
    n->near = n->prune = true;
    n->near_steps = 1;
}

void motion_free(struct neighbours *neighbours)
{
    free(neighbours->origin);
    free(neighbours->origin_reach);
    free(neighbours->near_origin);
    free(neighbours->near_reach);
    free(neighbours->near_row);
    free(neighbours->near_entry);
    free(neighbours->near_block);
    if (neighbours->motion) {
        free(neighbours->motion->block);
        free(neighbours->motion->group);
        free(neighbours->motion->touching);
        free(neighbours->motion->block_seam.pair);
        free(neighbours->motion->group_seam.pair);
        free(neighbours->motion->group_of);
        free(neighbours->motion->far_key);
        exchange_free(&neighbours->motion->exchange);
    }
    free(neighbours->motion);
}
