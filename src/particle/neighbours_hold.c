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

/* The largest approach of the two, or of one to the other's images. */
static double pair_approach(const struct moved *a, const struct moved *b)
{
    unsigned walls = common_walls(a, b);
    double largest = 0.0;
    for (unsigned mirrored = 0; mirrored < 8; mirrored++)
        if (!(mirrored & ~walls))
            largest = maximum(largest, approach(a, b, mirrored));
    return largest;
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
        if (other->any && pair_approach(own, other) > slack)
            return false;
    }
    return true;
}

/* The largest of what blocks have done since the rows were built; where the smallest counts, of its negative. */
enum {
    REACH,
    MOTION, /* of all against all, */
    SLACK,  /* and the negative of what it may be */
    APPROACH,
    WALL,            /* the negative of the distance from a wall of what has no image behind it */
    BROKEN,          /* 1: neighbours have come nearer to each other than their own slack */
    RISE,            /* displacements, along each axis, */
    FALL = RISE + 3, /* and their negatives */
    JUDGED = FALL + 3
};

static void raise_to(double *most, double value) { *most = maximum(*most, value); }

/* Block B against the blocks that touch it, itself included. Where groups are judged, what blocks may approach by is
 * the room that groups which do not touch have between them. */
static void judge_touching(const struct neighbours *n, int dimension, int32_t b, double *most)
{
    const struct block_motion *motion = n->motion;
    const struct moved *own = &motion->block[b];
    for (int k = 0; k < TOUCHING_MAX && motion->judged != BY_ALL; k++) {
        int32_t c = motion->touching[b][k];
        if (c < 0)
            continue;
        const struct moved *other = &motion->block[c];
        double near = pair_approach(own, other);
        double slack = n->skin * (own->smallest_reach + other->smallest_reach);
        raise_to(&most[APPROACH], near);
        raise_to(&most[BROKEN], motion->judged == BY_BLOCKS && near > slack);
    }
    for (int g = 0; motion->judged == BY_GROUPS && g < motion->groups; g++)
        if (motion->group[(int64_t)b * motion->groups + g].any)
            raise_to(&most[BROKEN], !group_holds(n, dimension, b, g));
}

static void judge_block(const struct neighbours *n, int dimension, int32_t b, double *most)
{
    const struct moved *m = &n->motion->block[b];
    double mean = sqrt(square(m->mean[0]) + square(m->mean[1]) + square(m->mean[2]));
    raise_to(&most[REACH], m->largest_reach);
    raise_to(&most[MOTION], mean + m->spread + m->growth);
    raise_to(&most[SLACK], -n->skin * m->smallest_reach);
    for (int axis = 0; axis < 3; axis++) {
        double low = maximum(m->low[axis], n->motion->distance) + m->mean[axis] - m->spread;
        double high = maximum(m->high[axis], n->motion->distance) - m->mean[axis] - m->spread;
        raise_to(&most[WALL], isnan(m->low[axis]) ? -INFINITY : -low);
        raise_to(&most[WALL], isnan(m->high[axis]) ? -INFINITY : -high);
        raise_to(&most[RISE + axis], m->mean[axis] + m->spread);
        raise_to(&most[FALL + axis], m->spread - m->mean[axis]);
    }
    judge_touching(n, dimension, b, most);
}

/* Blocks that do not touch have come no nearer to each other than supports reach. */
static bool apart_hold(const struct particles *p, const double *most)
{
    double sum = 0.0;
    for (int axis = 0; axis < 3; axis++)
        sum += square(most[RISE + axis] + most[FALL + axis]);
    return sqrt(sum) + 2.0 * most[REACH] <= block_edge(p);
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
    double most[JUDGED];
    for (int k = 0; k < JUDGED; k++)
        most[k] = -INFINITY;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : most[:JUDGED])
    for (int32_t b = 0; b < p->blocks; b++)
        judge_block(n, p->dimension, b, most);
    ranks_maximum_of(p->ranks, most, JUDGED);
    if (most[BROKEN] > 0.0 || -most[WALL] < 2.0 * most[REACH])
        return false;
    /* Where supports outgrow groups, the motion of all against all is judged. */
    if (n->motion->judged == BY_ALL)
        return most[MOTION] <= -most[SLACK];
    return apart_hold(p, most) &&
           (n->motion->judged != BY_GROUPS || most[APPROACH] <= group_edge(p) - 2.0 * most[REACH]);
}
