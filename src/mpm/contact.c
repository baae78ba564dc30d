/* Contact between bodies: each contact group has nodes of its own, and where two groups have the same node, they push each
 * other there so that they do not come closer. Groups in full contact get one velocity. Source: Cui, dissertation (2014),
 * section 2.2.5. */
#include "mpm/contact.h"

#include <string.h>

#include "base/memory.h"
#include "mpm/mpm_internal.h"

/* Which blocks of nodes a layer shares with others. */
static struct error *find_meetings(struct mpm *mpm, struct layer *layer)
{
    const struct grid *grid = &layer->grid;
    if (!memory_reserve((void **)&layer->meets, &layer->meets_capacity, grid->blocks, 0,
                        sizeof *layer->meets))
        return error_new(ERROR_SYSTEM, "out of memory for %d blocks", grid->blocks);
    for (int32_t n = 0; n < grid->blocks; n++) {
        layer->meets[n] = false;
        for (int g = 0; g < mpm->layers; g++)
            if (&mpm->layer[g] != layer && mpm->layer[g].bins.count > 0)
                layer->meets[n] |= block_table_find(&mpm->layer[g].grid.table, grid->key[n]) >= 0;
    }
    return NULL;
}

/* Patches of the gradient of mass, where the layer meets others; of several ranks all, as another may need them. */
static void find_slopes(struct mpm *mpm, const struct simulation *simulation, struct layer *layer)
{
    const struct transfer transfer = mpm_transfer_of(mpm, simulation, layer);
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
    for (int32_t b = 0; b < layer->bins.count; b++) {
        bool near = simulation->ranks->size > 1;
        for (int code = 0; code < GRID_AROUND && !near; code++)
            near = layer->grid.around[b][code] >= 0 && layer->meets[layer->grid.around[b][code]];
        if (near && !mpm_is_far(mpm, layer, b))
            transfer_slopes(&transfer, b);
    }
}

/* Their sums at nodes. */
static void find_normals(const struct mpm *mpm, const struct simulation *simulation,
                         struct layer *layer)
{
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        if (layer->meets[n])
            grid_reduce(&layer->grid, &layer->normal, n);
    mpm_fold_vectors(mpm, layer, &layer->normal);
}

static struct vec3 vector_at(const double *v) { return vec3_make(v[0], v[1], v[2]); }

/* Out of the first body, from both gradients of mass; zero where there is none. */
static struct vec3 normal_of(int rule, struct vec3 first, struct vec3 second)
{
    const struct vec3 turned = vec3_scale(-1.0, second);
    const struct vec3 g = rule == NORMAL_FIRST    ? first
                          : rule == NORMAL_SECOND ? turned
                                                  : vec3_add(first, turned);
    const double length = sqrt(vec3_dot(g, g));
    return length > 0.0 ? vec3_scale(1.0 / length, g) : vec3_make(0.0, 0.0, 0.0);
}

static void push_node(double *node, double factor, struct vec3 impulse)
{
    node[NODE_FORCE] += factor * impulse.x;
    node[NODE_FORCE + 1] += factor * impulse.y;
    node[NODE_FORCE + 2] += factor * impulse.z;
}

static struct contact_side side_of(const double *node, double dt)
{
    return (struct contact_side){
        node[NODE_MASS],
        vec3_add(vector_at(node + NODE_MOMENTUM), vec3_scale(dt, vector_at(node + NODE_FORCE)))};
}

/* Two layers and the blocks of nodes that are the same. */
struct meeting {
    struct layer *a, *b;
    int32_t in_a, in_b;
    int other; /* number of layer b */
    int law;
    struct contact_rule rule;
    int normal; /* enum contact_normal */
};

/* How a node of layer a touches others is a number of two bits for each of them, in the last number of its normal. */
enum { TOUCH_NUMBER = 3 };

static enum contact_state touch_of(const double *normal, int other)
{
    return (enum contact_state)((uint64_t)normal[TOUCH_NUMBER] >> 2 * other & 3);
}

static void set_touch(double *normal, int other, enum contact_state state)
{
    normal[TOUCH_NUMBER] += (double)((uint64_t)state << 2 * other);
}

/* A pair of layers at the nodes of a block. */
static void meet_block(const struct meeting *m, double least, double dt)
{
    for (int k = 0; k < BLOCK_CELLS; k++) {
        double *first = grid_node(&m->a->main, m->in_a, k),
               *second = grid_node(&m->b->main, m->in_b, k);
        if (!(first[NODE_MASS] > least && second[NODE_MASS] > least))
            continue;
        struct vec3 normal = vec3_make(0.0, 0.0, 0.0);
        double *own = grid_node(&m->a->normal, m->in_a, k);
        if (m->law) {
            normal = normal_of(m->normal, vector_at(own),
                               vector_at(grid_node(&m->b->normal, m->in_b, k)));
            if (vec3_dot(normal, normal) == 0.0)
                continue;
        }
        const struct contact_push push =
            contact_push(side_of(first, dt), side_of(second, dt), normal, m->rule);
        push_node(first, 1.0 / dt, push.impulse);
        push_node(second, -1.0 / dt, push.impulse);
        if (m->law)
            set_touch(own, m->other, push.state);
    }
}

/* The same of velocities that particles have mapped back: where layers touched in the step, or in full contact. */
static void join_block(const struct meeting *m)
{
    for (int k = 0; k < BLOCK_CELLS; k++) {
        const double *own = grid_node(&m->a->normal, m->in_a, k);
        const enum contact_state state = m->law ? touch_of(own, m->other) : CONTACT_STICKS;
        const double first = grid_node(&m->a->main, m->in_a, k)[NODE_MASS],
                     second = grid_node(&m->b->main, m->in_b, k)[NODE_MASS];
        double *u = grid_node(&m->a->back, m->in_a, k), *v = grid_node(&m->b->back, m->in_b, k);
        if (state == CONTACT_NONE || !(first > 0.0 && second > 0.0))
            continue;
        const struct vec3 normal =
            normal_of(m->normal, vector_at(own), vector_at(grid_node(&m->b->normal, m->in_b, k)));
        const struct contact_rule rule = {state == CONTACT_STICKS ? (double)INFINITY : 0.0, false};
        const struct contact_push push = contact_push(
            (struct contact_side){first, vec3_scale(first, vector_at(u))},
            (struct contact_side){second, vec3_scale(second, vector_at(v))}, normal, rule);
        const double change[3] = {push.impulse.x, push.impulse.y, push.impulse.z};
        for (int c = 0; c < 3; c++) {
            u[c] += change[c] / first;
            v[c] -= change[c] / second;
        }
    }
}

static bool any_law(const struct mpm *mpm, const struct simulation *simulation)
{
    for (int g = 0; g < mpm->layers; g++)
        for (int h = 0; h < mpm->layers; h++)
            if (simulation->law[g][h])
                return true;
    return false;
}

/* All pairs of layers, in a fixed order: in a step of DT, or with DT zero their velocities. */
static void meet_pairs(struct mpm *mpm, const struct simulation *simulation, double dt)
{
    for (int g = 0; g < mpm->layers; g++)
        for (int h = g + 1; h < mpm->layers; h++) {
            struct layer *a = &mpm->layer[g], *b = &mpm->layer[h];
            const int law = simulation->law[g][h];
            const struct contact_surface *surface = &simulation->surface[law / LAW_SURFACE];
            const struct contact_rule rule = {law & LAW_SLIP ? surface->friction : (double)INFINITY,
                                              (law & LAW_NO_TENSION) != 0};
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
            for (int32_t n = 0; n < a->grid.blocks; n++) {
                const int32_t other = a->meets[n] && b->bins.count > 0
                                          ? block_table_find(&b->grid.table, a->grid.key[n])
                                          : -1;
                const struct meeting meeting = {a, b, n, other, h, law, rule, surface->normal};
                if (other >= 0 && dt > 0.0)
                    meet_block(&meeting, law ? mpm->least_mass : 0.0, dt);
                else if (other >= 0)
                    join_block(&meeting);
            }
        }
}

/* Blocks that lie side by side have no normals yet. */
static void clear_touches(struct layer *layer)
{
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        for (int k = 0; k < BLOCK_CELLS; k++)
            memset(grid_node(&layer->normal, n, k), 0, BACK_STRIDE * sizeof(double));
}

struct error *mpm_find_meetings(struct mpm *mpm)
{
    for (int g = 0; g < mpm->layers; g++) {
        TRY(find_meetings(mpm, &mpm->layer[g]));
        clear_touches(&mpm->layer[g]);
    }
    return NULL;
}

void mpm_meet(struct mpm *mpm, const struct simulation *simulation, double dt)
{
    const bool laws = any_law(mpm, simulation);
    for (int g = 0; g < mpm->layers && laws; g++)
        find_slopes(mpm, simulation, &mpm->layer[g]);
    if (laws)
        mpm_exchange(mpm, simulation, offsetof(struct layer, normal));
    for (int g = 0; g < mpm->layers && laws; g++)
        find_normals(mpm, simulation, &mpm->layer[g]);
    meet_pairs(mpm, simulation, dt);
}

void mpm_join_velocities(struct mpm *mpm, const struct simulation *simulation)
{
    meet_pairs(mpm, simulation, 0.0);
}
