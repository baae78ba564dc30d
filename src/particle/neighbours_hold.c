/* Do the rows still hold every pair within support? A pair was listed when its distance at building
 * was below (1 + skin) times its support; it may have come into support since only if the two have
 * approached each other, or their supports have grown, by more than the difference. Motion is
 * judged by groups, the cubes of two cells that a block falls into: a group's mean displacement,
 * the spread about it, the growth of reach. Groups that touch are compared pair by pair, also with
 * each other's images behind walls and periodic faces; groups that do not touch have an edge of a
 * group between them to eat up first, which is judged by their blocks, and blocks that do not touch
 * have an edge of a block.
 *
 * Near rows are judged alike by the motion since they were found. For them the rows must have held
 * all pairs within (1 + near skin) times the support at that moment. */
#include "parallel/periodic.h"
#include "particle/block_motion.h"

enum {
    NEAR_LIFE = 3, /* steps that near rows must hold to be worth finding them */
    NEAR_REST = 24 /* steps without, where they are not */
};

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

/* What is judged: whether the rows hold all pairs within MARGIN times their support, or whether
 * near rows hold those within support. */
struct question {
    bool near;
    double margin,
        skin; /* of the moment ORIGIN was taken, what pairs may approach by, in supports */
    const double (*origin)[3], *origin_reach;
};

static struct question of_rows(const struct neighbours *n, double beyond)
{
    return (struct question){false, 1.0 + beyond, n->skin - beyond, (const double(*)[3])n->origin,
                             n->origin_reach};
}

static struct question of_near_rows(const struct neighbours *n)
{
    return (struct question){true, 1.0, n->near_skin, (const double(*)[3])n->near_origin,
                             n->near_reach};
}

/* Brings the motion of the groups of a block up to date, and their boxes. PERIODIC: along an axis;
 * a constant where this is inlined. */
BOLIDE_INLINE void follow_groups(struct neighbours *n, const struct particles *p,
                                 struct reach reach, const struct question *question, bool periodic,
                                 int32_t b, struct box *box)
{
    struct block_motion *motion = n->motion;
    struct moved *group = motion->group + (int64_t)b * motion->groups;
    for (int32_t i = p->block[b].first; i < p->block[b].first + p->block[b].count; i++) {
        int g = motion->group_of[i];
        double now = question->margin * reach.smoothing * reach.diameter[i];
        group[g].growth =
            maximum(group[g].growth, now - question->margin * question->origin_reach[i]);
        group[g].largest_reach = maximum(group[g].largest_reach, now);
        for (int axis = 0; axis < 3; axis++) {
            double at = p->position[i][axis], origin = question->origin[i][axis];
            if (periodic && images_repeat(&motion->mirrors, axis))
                at = periodic_nearest(&motion->mirrors, axis, at, origin);
            double moved = at - origin;
            box[g].low[axis] = minimum(box[g].low[axis], moved);
            box[g].high[axis] = maximum(box[g].high[axis], moved);
        }
    }
}

/* Brings the motion of a block and its groups up to date. */
static void follow_block(struct neighbours *n, const struct particles *p, struct reach reach,
                         const struct question *question, int32_t b)
{
    struct block_motion *motion = n->motion;
    struct moved *group = motion->group + (int64_t)b * motion->groups, *block = &motion->block[b];
    struct box box[GROUPS_MAX], whole = empty_box;
    block->growth = block->largest_reach = 0.0;
    for (int g = 0; g < motion->groups; g++) {
        group[g].growth = group[g].largest_reach = 0.0;
        box[g] = empty_box;
    }
    if (motion->periodic)
        follow_groups(n, p, reach, question, true, b, box);
    else
        follow_groups(n, p, reach, question, false, b, box);
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

/* Approach of A to B, whose motion is reflected on the axes of bit mask MIRRORED, and growth of
 * both. */
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

/* By how much the two may have approached each other. */
static double slack_of(const struct question *question, const struct moved *a,
                       const struct moved *b)
{
    return question->skin * (question->near ? a->smallest_near + b->smallest_near
                                            : a->smallest_reach + b->smallest_reach);
}

/* Group G of block B against the groups that touch it. */
static bool group_holds(const struct neighbours *n, const struct question *question, int dimension,
                        int32_t b, int g)
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
        if (other->any && pair_approach(own, other) > slack_of(question, own, other))
            return false;
    }
    return true;
}

/* The largest of what blocks have done since then; where the smallest counts, of its negative. */
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

/* Block B against the blocks that touch it, itself included. Where groups are judged, what blocks
 * may approach by is the room that groups which do not touch have between them. */
static void judge_touching(const struct neighbours *n, const struct question *question,
                           int dimension, int32_t b, double *most)
{
    const struct block_motion *motion = n->motion;
    const struct moved *own = &motion->block[b];
    for (int k = 0; k < TOUCHING_MAX && motion->judged != BY_ALL; k++) {
        int32_t c = motion->touching[b][k];
        if (c < 0)
            continue;
        const struct moved *other = &motion->block[c];
        double near = pair_approach(own, other);
        raise_to(&most[APPROACH], near);
        raise_to(&most[BROKEN],
                 motion->judged == BY_BLOCKS && near > slack_of(question, own, other));
    }
    for (int g = 0; motion->judged == BY_GROUPS && g < motion->groups; g++)
        if (motion->group[(int64_t)b * motion->groups + g].any)
            raise_to(&most[BROKEN], !group_holds(n, question, dimension, b, g));
}

static void judge_block(const struct neighbours *n, const struct question *question, int dimension,
                        int32_t b, double *most)
{
    const struct moved *m = &n->motion->block[b];
    double mean = sqrt(square(m->mean[0]) + square(m->mean[1]) + square(m->mean[2]));
    raise_to(&most[REACH], m->largest_reach);
    raise_to(&most[MOTION], mean + m->spread + m->growth);
    raise_to(&most[SLACK], -0.5 * slack_of(question, m, m));
    for (int axis = 0; axis < 3; axis++) {
        double low = maximum(m->low[axis], n->motion->distance) + m->mean[axis] - m->spread;
        double high = maximum(m->high[axis], n->motion->distance) - m->mean[axis] - m->spread;
        raise_to(&most[WALL], isnan(m->low[axis]) ? -INFINITY : -low);
        raise_to(&most[WALL], isnan(m->high[axis]) ? -INFINITY : -high);
        raise_to(&most[RISE + axis], m->mean[axis] + m->spread);
        raise_to(&most[FALL + axis], m->spread - m->mean[axis]);
    }
    judge_touching(n, question, dimension, b, most);
}

/* Approach of blocks that do not touch. */
static double approach_apart(const double *most)
{
    double sum = 0.0;
    for (int axis = 0; axis < 3; axis++)
        sum += square(most[RISE + axis] + most[FALL + axis]);
    return sqrt(sum);
}

/* What touches across periodic faces. */
static void judge_seams(const struct block_motion *motion, const struct question *question,
                        int threads, double *most)
{
    const struct seam *blocks = &motion->block_seam, *groups = &motion->group_seam;
    double approached = -INFINITY;
    bool broken = false;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max           \
                                                                         : approached) \
    reduction(||                                                                       \
              : broken)
    for (int64_t k = 0; k < blocks->count; k++) {
        const struct moved *own = &motion->block[blocks->pair[k].own],
                           *other = &motion->block[blocks->pair[k].other];
        const double near = pair_approach(own, other);
        approached = maximum(approached, near);
        broken |= motion->judged == BY_BLOCKS && near > slack_of(question, own, other);
    }
#pragma omp parallel for schedule(static) num_threads(threads) reduction(|| : broken)
    for (int64_t k = 0; k < groups->count; k++) {
        const struct moved *own = &motion->group[groups->pair[k].own],
                           *other = &motion->group[groups->pair[k].other];
        broken |= other->any && pair_approach(own, other) > slack_of(question, own, other);
    }
    raise_to(&most[APPROACH], approached);
    raise_to(&most[BROKEN], broken);
}

/* The most that two particles may have approached each other across periodic faces. */
static double approach_of_faces(const struct block_motion *motion, const double *most)
{
    double largest = 0.0;
    for (int axis = 0; axis < 3; axis++)
        if (images_repeat(&motion->mirrors, axis))
            largest = maximum(largest, most[RISE + axis] + most[FALL + axis]);
    return largest;
}

/* Collective: the answer, and in MOST what it follows from. */
static bool answer(struct neighbours *n, const struct particles *p, struct reach reach,
                   const struct question *question, int threads, double *most)
{
    struct block_motion *motion = n->motion;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int32_t b = 0; b < p->blocks; b++)
        follow_block(n, p, reach, question, b);
    motion_meet_again(motion, p);
    for (int k = 0; k < JUDGED; k++)
        most[k] = -INFINITY;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : most[:JUDGED])
    for (int32_t b = 0; b < p->blocks; b++)
        judge_block(n, question, p->dimension, b, most);
    if (motion->periodic)
        judge_seams(motion, question, threads, most);
    ranks_maximum_of(p->ranks, most, JUDGED);
    double support = 2.0 * most[REACH], apart = approach_apart(most), near = most[APPROACH],
           wall = -most[WALL];
    double seam =
        (question->near ? motion->taken_seam : motion->distance) - approach_of_faces(motion, most);
    if (question->near) {
        wall = -motion->taken_wall - most[MOTION];
        apart += motion->taken_apart;
        near += motion->taken_approach;
    }
    if (most[BROKEN] > 0.0 || minimum(wall, seam) < support)
        return false;
    /* Where supports outgrow groups, the motion of all against all is judged. */
    if (motion->judged == BY_ALL)
        return most[MOTION] <= -most[SLACK];
    return apart + support <= block_edge(p) &&
           (motion->judged != BY_GROUPS || near + support <= group_edge(p));
}

bool neighbours_hold(struct neighbours *n, const struct particles *p, struct reach reach,
                     int threads)
{
    double most[JUDGED];
    struct question question = of_near_rows(n);
    if (n->builds == 0 || n->order != p->order)
        return false;
    n->rest -= n->rest > 0;
    if (n->near && answer(n, p, reach, &question, threads, most)) {
        n->near_steps++;
        return true;
    }
    if (n->near && n->near_steps < NEAR_LIFE)
        n->rest = NEAR_REST;
    n->near = n->prune = false;
    question = of_rows(n, near_wanted(n) ? n->near_skin : 0.0);
    if (!answer(n, p, reach, &question, threads, most))
        return false;
    n->motion->taken_approach = most[APPROACH];
    n->motion->taken_apart = approach_apart(most);
    n->motion->taken_wall = most[WALL];
    n->motion->taken_seam = n->motion->distance - approach_of_faces(n->motion, most);
    motion_start_near(n, p, reach, threads);
    return true;
}
