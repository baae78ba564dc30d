/* Do the rows still hold every pair within support? A pair was listed when its distance at building was below
 * (1 + skin) times its support; it may have come into support since only if the two have approached each other, or
 * their supports have grown, by more than the difference. Motion is judged by blocks: a block's mean displacement,
 * the spread about it, and the growth of reach. Blocks that touch are compared pair by pair, also with each other's
 * images behind walls; blocks that do not touch have an edge of a block between them to eat up first. */
#include "particle/neighbours_hold.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "particle/block.h"

/* One block since the rows were built. */
struct moved {
    double smallest_reach; /* at building */
    double low[3];         /* nearest to each low wall, at building; NAN without wall */
    double high[3];
    unsigned walls;        /* bit 2 axis + side: had images behind this wall */
    double mean[3], spread, growth, largest_reach; /* now */
    int32_t first_neighbour, neighbours;
};

struct block_motion {
    int32_t blocks;
    int64_t capacity;
    struct moved *block;
    int64_t neighbour_count, neighbour_capacity;
    int32_t *neighbour; /* blocks that touch, itself included */
    double distance;    /* of the plan of images */
    bool touching;      /* supports fit into blocks, so that only blocks that touch could meet */
};

static struct error *out_of_memory(void)
{
    return error_new(ERROR_SYSTEM, "out of memory for the motion of blocks");
}

static struct error *reserve(struct neighbours *n, const struct particles *p)
{
    int64_t capacity = n->reference_capacity;
    if (!memory_reserve((void **)&n->origin, &capacity, p->count, 0, sizeof *n->origin))
        return out_of_memory();
    capacity = n->reference_capacity;
    if (!memory_reserve((void **)&n->origin_reach, &capacity, p->count, 0,
                        sizeof *n->origin_reach))
        return out_of_memory();
    n->reference_capacity = capacity;
    if (!n->motion)
        n->motion = memory_allocate(sizeof *n->motion);
    if (!n->motion || !memory_reserve((void **)&n->motion->block, &n->motion->capacity, p->blocks,
                                      0, sizeof *n->motion->block))
        return out_of_memory();
    n->motion->blocks = p->blocks;
    return NULL;
}

static void start_block(struct neighbours *n, const struct particles *p, struct reach reach,
                        const struct mirrors *mirrors, int32_t b)
{
    struct moved *m = &n->motion->block[b];
    *m = (struct moved){.smallest_reach = (double)INFINITY};
    double low[3] = {(double)INFINITY, (double)INFINITY, (double)INFINITY};
    double high[3] = {-(double)INFINITY, -(double)INFINITY, -(double)INFINITY};
    for (int32_t i = p->block[b].first; i < p->block[b].first + p->block[b].count; i++) {
        n->origin_reach[i] = reach.smoothing * reach.diameter[i];
        m->smallest_reach = minimum(m->smallest_reach, n->origin_reach[i]);
        for (int axis = 0; axis < 3; axis++) {
            n->origin[i][axis] = p->position[i][axis];
            low[axis] = minimum(low[axis], p->position[i][axis]);
            high[axis] = maximum(high[axis], p->position[i][axis]);
        }
    }
    for (int axis = 0; axis < 3; axis++) {
        m->low[axis] = low[axis] - mirrors->low[axis];
        m->high[axis] = mirrors->high[axis] - high[axis];
        m->walls |= (unsigned)(m->low[axis] < n->motion->distance) << (2 * axis);
        m->walls |= (unsigned)(m->high[axis] < n->motion->distance) << (2 * axis + 1);
    }
}

static int compare_keys(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = ((const struct block *)b)->key;
    return x < y ? -1 : x > y;
}

/* The blocks that touch block B, found by key: blocks are sorted by it. */
static struct error *list_touching(struct block_motion *motion, const struct particles *p,
                                   int32_t b)
{
    struct moved *m = &motion->block[b];
    if (!memory_reserve((void **)&motion->neighbour, &motion->neighbour_capacity,
                        motion->neighbour_count + 27, motion->neighbour_count,
                        sizeof *motion->neighbour))
        return out_of_memory();
    int64_t own[3], at[3];
    block_coordinates(p->block[b].key, own);
    m->first_neighbour = (int32_t)motion->neighbour_count;
    int y = p->dimension > 1, z = p->dimension > 2;
    for (at[0] = own[0] - 1; at[0] <= own[0] + 1; at[0]++)
        for (at[1] = own[1] - y; at[1] <= own[1] + y; at[1]++)
            for (at[2] = own[2] - z; at[2] <= own[2] + z; at[2]++) {
                uint64_t key = block_key(at);
                const struct block *found =
                    bsearch(&key, p->block, (size_t)p->blocks, sizeof *p->block, compare_keys);
                if (found)
                    motion->neighbour[motion->neighbour_count++] = (int32_t)(found - p->block);
            }
    m->neighbours = (int32_t)motion->neighbour_count - m->first_neighbour;
    return NULL;
}

static double block_edge(const struct particles *p)
{
    return p->cell * block_cells(p->dimension);
}

struct error *motion_start(struct neighbours *n, const struct particles *p, struct reach reach,
                           const struct mirrors *mirrors, double distance)
{
    TRY(reserve(n, p));
    struct block_motion *motion = n->motion;
    motion->distance = distance;
    motion->neighbour_count = 0;
    double largest = 0.0;
    for (int32_t b = 0; b < p->blocks; b++) {
        start_block(n, p, reach, mirrors, b);
        TRY(list_touching(motion, p, b));
    }
    for (int32_t i = 0; i < p->count; i++)
        largest = maximum(largest, n->origin_reach[i]);
    motion->touching = 2.0 * (1.0 + n->skin) * largest < block_edge(p) &&
                       distance < block_edge(p);
    return NULL;
}

void motion_free(struct neighbours *neighbours)
{
    free(neighbours->origin);
    free(neighbours->origin_reach);
    if (neighbours->motion) {
        free(neighbours->motion->block);
        free(neighbours->motion->neighbour);
    }
    free(neighbours->motion);
}

/* Brings a block's motion up to date. */
static void follow_block(struct neighbours *n, const struct particles *p, struct reach reach,
                         int32_t b)
{
    struct moved *m = &n->motion->block[b];
    double low[3] = {(double)INFINITY, (double)INFINITY, (double)INFINITY};
    double high[3] = {-(double)INFINITY, -(double)INFINITY, -(double)INFINITY};
    m->growth = m->largest_reach = 0.0;
    for (int32_t i = p->block[b].first; i < p->block[b].first + p->block[b].count; i++) {
        double now = reach.smoothing * reach.diameter[i];
        m->growth = maximum(m->growth, now - n->origin_reach[i]);
        m->largest_reach = maximum(m->largest_reach, now);
        for (int axis = 0; axis < 3; axis++) {
            double moved = p->position[i][axis] - n->origin[i][axis];
            low[axis] = minimum(low[axis], moved);
            high[axis] = maximum(high[axis], moved);
        }
    }
    double spread = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        m->mean[axis] = 0.5 * (low[axis] + high[axis]);
        spread += square(0.5 * (high[axis] - low[axis]));
    }
    m->spread = sqrt(spread);
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

/* The axes on which both blocks have images behind one wall. */
static unsigned common_walls(const struct moved *a, const struct moved *b)
{
    unsigned both = a->walls & b->walls, axes = 0;
    for (int axis = 0; axis < 3; axis++)
        axes |= (unsigned)((both >> (2 * axis) & 3) != 0) << axis;
    return axes;
}

static bool touching_hold(const struct neighbours *n, int32_t b)
{
    const struct moved *a = &n->motion->block[b];
    for (int32_t k = 0; k < a->neighbours; k++) {
        int32_t c = n->motion->neighbour[a->first_neighbour + k];
        const struct moved *other = &n->motion->block[c];
        double slack = n->skin * (a->smallest_reach + other->smallest_reach);
        unsigned walls = common_walls(a, other);
        for (unsigned mirrored = 0; mirrored < 8; mirrored++)
            if (!(mirrored & ~walls) && approach(a, other, mirrored) > slack)
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

/* Without blocks to compare: the motion of all against all. */
static bool all_hold(const struct neighbours *n)
{
    double motion = 0.0, slack = (double)INFINITY;
    for (int32_t b = 0; b < n->motion->blocks; b++) {
        const struct moved *m = &n->motion->block[b];
        double mean = sqrt(square(m->mean[0]) + square(m->mean[1]) + square(m->mean[2]));
        motion = maximum(motion, mean + m->spread + m->growth);
        slack = minimum(slack, n->skin * m->smallest_reach);
    }
    return motion <= slack;
}

/* Blocks that do not touch have come no nearer to each other than supports reach. */
static bool apart_hold(const struct block_motion *motion, double largest, double edge)
{
    double low[3] = {(double)INFINITY, (double)INFINITY, (double)INFINITY};
    double high[3] = {-(double)INFINITY, -(double)INFINITY, -(double)INFINITY}, sum = 0.0;
    for (int32_t b = 0; b < motion->blocks; b++)
        for (int axis = 0; axis < 3; axis++) {
            const struct moved *m = &motion->block[b];
            low[axis] = minimum(low[axis], m->mean[axis] - m->spread);
            high[axis] = maximum(high[axis], m->mean[axis] + m->spread);
        }
    for (int axis = 0; axis < 3; axis++)
        sum += square(high[axis] - low[axis]);
    return sqrt(sum) + 2.0 * largest <= edge;
}

bool neighbours_hold(struct neighbours *n, const struct particles *p, struct reach reach,
                     int threads)
{
    if (n->builds == 0 || n->count != p->count || n->motion->blocks != p->blocks)
        return false;
    double largest = 0.0;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : largest)
    for (int32_t b = 0; b < p->blocks; b++) {
        follow_block(n, p, reach, b);
        largest = maximum(largest, n->motion->block[b].largest_reach);
    }
    bool hold = true;
    if (!n->motion->touching)
        hold = all_hold(n);
    else
        hold = apart_hold(n->motion, largest, block_edge(p));
#pragma omp parallel for schedule(static) num_threads(threads) reduction(&& : hold)
    for (int32_t b = 0; b < p->blocks; b++)
        hold = hold && walls_hold(n->motion, b, largest) &&
               (!n->motion->touching || touching_hold(n, b));
    return hold;
}
