/* Do the rows still hold every pair within support? A pair was listed when its distance at building was below
 * (1 + skin) times its support; it may have come into support since only if the two have approached each other, or
 * their supports have grown, by more than the difference. Motion is judged by groups, the cubes of two cells that a
 * block falls into: a group's mean displacement, the spread about it, the growth of reach. Groups that touch are
 * compared pair by pair, also with each other's images behind walls; groups that do not touch have an edge of a group
 * between them to eat up first, which is judged by their blocks, and blocks that do not touch have an edge of a block. */
#include "particle/neighbours_hold.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "particle/block.h"

/* Groups along each axis of a block. */
static int groups_along(int dimension) { return block_cells(dimension) / 2; }

static double group_edge(const struct particles *p) { return 2.0 * p->cell; }

static double block_edge(const struct particles *p) { return p->cell * block_cells(p->dimension); }

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

static struct error *reserve(struct neighbours *n, const struct particles *p)
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
        !memory_reserve((void **)&m->group_of, &m->group_of_capacity, p->count, 0, 1))
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

/* The blocks that touch block B, found by key: blocks are sorted by it, those of other ranks too. */
static void list_touching(struct block_motion *motion, const struct particles *p, int32_t b)
{
    int64_t own[3];
    uint64_t key;
    block_coordinates(p->block[b].key, own);
    for (int k = 0; k < TOUCHING_MAX; k++) {
        motion->touching[b][k] = -1;
        if (!motion_key_beside(p->dimension, own, k, &key))
            continue;
        const struct block *found =
            bsearch(&key, p->block, (size_t)p->blocks, sizeof *p->block, compare_keys);
        const uint64_t *far = !found && motion->far_key
                                  ? bsearch(&key, motion->far_key, (size_t)motion->exchange.comes,
                                            sizeof key, motion_compare_key)
                                  : NULL;
        if (found)
            motion->touching[b][k] = (int32_t)(found - p->block);
        else if (far)
            motion->touching[b][k] = p->blocks + (int32_t)(far - motion->far_key);
    }
}

struct error *motion_start(struct neighbours *n, const struct particles *p, struct reach reach,
                           const struct mirrors *mirrors, double distance, const struct halo *halo,
                           int threads)
{
    TRY(ranks_agree(p->ranks, reserve_motion(n, p)));
    if (p->ranks->joined)
        TRY(motion_meet(n->motion, p, halo));
    TRY(ranks_agree(p->ranks, reserve(n, p)));
    struct block_motion *motion = n->motion;
    motion->distance = distance;
    double largest = 0.0;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : largest)
    for (int32_t b = 0; b < p->blocks; b++) {
        start_block(n, p, reach, mirrors, b);
        list_touching(motion, p, b);
        for (int32_t i = p->block[b].first; i < p->block[b].first + p->block[b].count; i++)
            largest = maximum(largest, n->origin_reach[i]);
    }
    double support = 2.0 * (1.0 + n->skin) * ranks_maximum(p->ranks, largest);
    motion->judged = support < group_edge(p)   ? BY_GROUPS
                     : support < block_edge(p) ? BY_BLOCKS
                                               : BY_ALL;
    n->order = p->order;
    return NULL;
}

void motion_free(struct neighbours *neighbours)
{
    free(neighbours->origin);
    free(neighbours->origin_reach);
    if (neighbours->motion) {
        free(neighbours->motion->block);
        free(neighbours->motion->group);
        free(neighbours->motion->touching);
        free(neighbours->motion->group_of);
        free(neighbours->motion->far_key);
        exchange_free(&neighbours->motion->exchange);
    }
    free(neighbours->motion);
}

/* The box of displacements of a group, then of a block. */
struct box {
    double low[3], high[3];
};

static const struct box empty_box = {{INFINITY, INFINITY, INFINITY},
                                     {-INFINITY, -INFINITY, -INFINITY}};

static void take_box(struct moved *m, const struct box *box)
{
    double spread = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        m->mean[axis] = 0.5 * (box->low[axis] + box->high[axis]);
        spread += square(0.5 * (box->high[axis] - box->low[axis]));
    }
    m->spread = sqrt(spread);
}

/* Brings the motion of a block and its groups up to date. */
static void follow_block(struct neighbours *n, const struct particles *p, struct reach reach,
                         int32_t b)
{
    struct block_motion *motion = n->motion;
    struct moved *group = motion->group + (int64_t)b * motion->groups, *block = &motion->block[b];
    struct box box[GROUPS_MAX], whole = empty_box;
    block->growth = block->largest_reach = 0.0;
    for (int g = 0; g < motion->groups; g++) {
        group[g].growth = group[g].largest_reach = 0.0;
        box[g] = empty_box;
    }
    for (int32_t i = p->block[b].first; i < p->block[b].first + p->block[b].count; i++) {
        int g = motion->group_of[i];
        double now = reach.smoothing * reach.diameter[i];
        group[g].growth = maximum(group[g].growth, now - n->origin_reach[i]);
        group[g].largest_reach = maximum(group[g].largest_reach, now);
        for (int axis = 0; axis < 3; axis++) {
            double moved = p->position[i][axis] - n->origin[i][axis];
            box[g].low[axis] = minimum(box[g].low[axis], moved);
            box[g].high[axis] = maximum(box[g].high[axis], moved);
        }
    }
    for (int g = 0; g < motion->groups; g++) {
        if (!group[g].any)
            continue;
        take_box(&group[g], &box[g]);
        block->growth = maximum(block->growth, group[g].growth);
        block->largest_reach = maximum(block->largest_reach, group[g].largest_reach);
        for (int axis = 0; axis < 3; axis++) {
            whole.low[axis] = minimum(whole.low[axis], box[g].low[axis]);
            whole.high[axis] = maximum(whole.high[axis], box[g].high[axis]);
        }
    }
    take_box(block, &whole);
}

/* Approach of A to B, whose motion is reflected on the axes of bit mask MIRRORED, and growth of both. */
static double approach(const struct moved *a, const struct moved *b, unsigned mirrored)
{
    double sum = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        double other = mirrored >> axis & 1 ? -b->mean[axis] : b->mean[axis];
        sum += square(a->mean[axis] - other);
    }
    return sqrt(sum) + a->spread + b->spread + a->growth + b->growth;
}

/* The axes on which both have images behind one wall. */
static unsigned common_walls(const struct moved *a, const struct moved *b)
{
    unsigned both = a->walls & b->walls, axes = 0;
    for (int axis = 0; axis < 3; axis++)
        axes |= (unsigned)((both >> (2 * axis) & 3) != 0) << axis;
    return axes;
}

/* No approach of the two, or of one to the other's images, beyond SLACK. */
static bool pair_holds(const struct moved *a, const struct moved *b, double slack)
{
    unsigned walls = common_walls(a, b);
    for (unsigned mirrored = 0; mirrored < 8; mirrored++)
        if (!(mirrored & ~walls) && approach(a, b, mirrored) > slack)
            return false;
    return true;
}

/* Group G of block B against the groups that touch it. */
static bool group_holds(const struct neighbours *n, int dimension, int32_t b, int g)
{
    const struct block_motion *motion = n->motion;
    const struct moved *own = motion->group + (int64_t)b * motion->groups + g;
    int along = groups_along(dimension), at[3] = {0, 0, 0}, rest = g;
    for (int axis = dimension - 1; axis >= 0; axis--, rest /= along)
        at[axis] = rest % along;
    for (int k = 0; k < TOUCHING_MAX; k++) {
        int offset[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1}, block = 0, group = 0;
        if ((dimension < 2 && offset[1]) || (dimension < 3 && offset[2]))
            continue;
        for (int axis = 0, weight = 1; axis < 3; axis++, weight *= 3) {
            int there = at[axis] + offset[axis];
            int step = axis >= dimension ? 0 : there < 0 ? -1 : there >= along;
            block += weight * (step + 1);
            if (axis < dimension)
                group = group * along + there - step * along;
        }
        int32_t c = motion->touching[b][block];
        if (c < 0)
            continue;
        const struct moved *other = motion->group + (int64_t)c * motion->groups + group;
        double slack = n->skin * (own->smallest_reach + other->smallest_reach);
        if (other->any && !pair_holds(own, other, slack))
            return false;
    }
    return true;
}

/* Block B against the blocks that touch it, itself included. ROOM is what they may approach by where
 * their groups are judged too, since groups that do not touch lie that far apart. */
static bool block_holds(const struct neighbours *n, int32_t b, double room)
{
    const struct block_motion *motion = n->motion;
    const struct moved *own = &motion->block[b];
    for (int k = 0; k < TOUCHING_MAX; k++) {
        int32_t c = motion->touching[b][k];
        if (c < 0)
            continue;
        const struct moved *other = &motion->block[c];
        double slack = motion->judged == BY_GROUPS
                           ? room
                           : n->skin * (own->smallest_reach + other->smallest_reach);
        if (!pair_holds(own, other, slack))
            return false;
    }
    return true;
}

/* No particle without image has come within reach of a wall. */
static bool walls_hold(const struct block_motion *motion, int32_t b, double largest)
{
    const struct moved *m = &motion->block[b];
    for (int axis = 0; axis < 3; axis++) {
        double low = maximum(m->low[axis], motion->distance) + m->mean[axis] - m->spread;
        double high = maximum(m->high[axis], motion->distance) - m->mean[axis] - m->spread;
        if ((!isnan(m->low[axis]) && low < 2.0 * largest) ||
            (!isnan(m->high[axis]) && high < 2.0 * largest))
            return false;
    }
    return true;
}

/* What all ranks' blocks together have done since the rows were built. */
struct together {
    double largest_reach, motion, slack;
    struct box span;
};

static struct together together_of(const struct neighbours *n, const struct particles *p)
{
    struct together t = {.slack = (double)INFINITY, .span = empty_box};
    for (int32_t b = 0; b < p->blocks; b++) {
        const struct moved *m = &n->motion->block[b];
        double mean = sqrt(square(m->mean[0]) + square(m->mean[1]) + square(m->mean[2]));
        t.largest_reach = maximum(t.largest_reach, m->largest_reach);
        t.motion = maximum(t.motion, mean + m->spread + m->growth);
        t.slack = minimum(t.slack, n->skin * m->smallest_reach);
        for (int axis = 0; axis < 3; axis++) {
            t.span.low[axis] = minimum(t.span.low[axis], m->mean[axis] - m->spread);
            t.span.high[axis] = maximum(t.span.high[axis], m->mean[axis] + m->spread);
        }
    }
    double all[9] = {t.largest_reach, t.motion, -t.slack};
    for (int axis = 0; axis < 3; axis++) {
        all[3 + axis] = t.span.high[axis];
        all[6 + axis] = -t.span.low[axis];
    }
    ranks_maximum_of(p->ranks, all, (int)COUNT_OF(all));
    t.largest_reach = all[0];
    t.motion = all[1];
    t.slack = -all[2];
    for (int axis = 0; axis < 3; axis++) {
        t.span.high[axis] = all[3 + axis];
        t.span.low[axis] = -all[6 + axis];
    }
    return t;
}

/* Blocks that do not touch have come no nearer to each other than supports reach. */
static bool apart_hold(const struct together *t, const struct particles *p)
{
    double sum = 0.0;
    for (int axis = 0; axis < 3; axis++)
        sum += square(t->span.high[axis] - t->span.low[axis]);
    return sqrt(sum) + 2.0 * t->largest_reach <= block_edge(p);
}

static bool local_hold(const struct neighbours *n, const struct particles *p, int32_t b,
                       double largest)
{
    const struct block_motion *motion = n->motion;
    if (motion->judged == BY_ALL)
        return true;
    if (!block_holds(n, b, group_edge(p) - 2.0 * largest))
        return false;
    for (int g = 0; motion->judged == BY_GROUPS && g < motion->groups; g++)
        if (motion->group[(int64_t)b * motion->groups + g].any &&
            !group_holds(n, p->dimension, b, g))
            return false;
    return true;
}

bool neighbours_hold(struct neighbours *n, const struct particles *p, struct reach reach,
                     int threads)
{
    if (n->builds == 0 || n->order != p->order)
        return false;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int32_t b = 0; b < p->blocks; b++)
        follow_block(n, p, reach, b);
    motion_meet_again(n->motion, p);
    const struct together all = together_of(n, p);
    /* Where supports outgrow groups, the motion of all against all is judged. */
    bool hold = n->motion->judged == BY_ALL ? all.motion <= all.slack : apart_hold(&all, p);
#pragma omp parallel for schedule(static) num_threads(threads) reduction(&& : hold)
    for (int32_t b = 0; b < p->blocks; b++)
        hold = hold && walls_hold(n->motion, b, all.largest_reach) &&
               local_hold(n, p, b, all.largest_reach);
    return ranks_minimum(p->ranks, hold) > 0.0;
}
