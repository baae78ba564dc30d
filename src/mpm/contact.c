/* Contact between bodies: each contact group has nodes of its own, and where two groups have the
 * same node, they push each other there so that they do not come closer. Groups in full contact get
 * one velocity. Source: Cui, dissertation (2014), section 2.2.5. */
#include "mpm/contact.h"

#include <string.h>

#include "base/memory.h"
#include "mpm/mpm_internal.h"

/* Finds the blocks of nodes that a layer has in common with others. */
static struct error *find_meetings(struct mpm *mpm, struct layer *layer)
{
    const struct grid *grid = &layer->grid;
    if (!memory_reserve((void **)&layer->meets, &layer->meets_capacity, grid->blocks, 0,
                        sizeof *layer->meets))
        return out_of_memory_for("%d blocks", grid->blocks);
    for (int32_t n = 0; n < grid->blocks; n++) {
        layer->meets[n] = false;
        for (int g = 0; g < mpm->layers; g++)
            if (&mpm->layer[g] != layer && mpm->layer[g].bins.count > 0)
                layer->meets[n] |= block_table_find(&mpm->layer[g].grid.table, grid->key[n]) >= 0;
    }
    return NULL;
}

/* Patches of the mass gradient where the layer meets others; with several ranks all patches, since
 * another rank may need them. */
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

/* Masses per radian grow with the radius, and so has their gradient a part that belongs to no
 * surface, which is taken out at the nodes of a block. On the axis and on a wall about it nothing
 * points along the radius. */
static void straighten(const struct mpm *mpm, struct layer *layer, int32_t block)
{
    int64_t corner[3], at[3];
    grid_corner(&layer->grid, block, corner);
    for (int k = 0; k < BLOCK_CELLS; k++) {
        mpm_node_index(layer->grid.dimension, corner, k, at);
        const bool inside = at[0] > 0 && !(mpm->has_plane[0][1] && at[0] >= mpm->plane[0][1]);
        double *slope = grid_node(&layer->normal, block, k);
        if (inside)
            slope[0] += grid_node(&layer->main, block, k)[NODE_MASS] / (mpm->edge * (double)at[0]);
        else
            slope[0] = 0.0;
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
    const bool round = simulation->problem->geometry == GEOMETRY_AXISYMMETRIC;
    for (int32_t n = 0; n < layer->grid.blocks && round; n++)
        if (layer->meets[n])
            straighten(mpm, layer, n);
}

/* Ratio of mass to mass gradient, in cells, at a node of a half-space filled with particles of a
 * SIZE, whose surface is at distance S beyond the node. */
static double ratio_at(enum grid_shape shape, double s, double size)
{
    double mass = 0.0, slope = 0.0;
    for (double r = s - 0.5 * size; r > -SURFACE_REACH; r -= size) {
        mass += size * shape_value(shape, r, 0.5 * size);
        slope += size * shape_slope(shape, r, 0.5 * size);
    }
    return slope > 1e-9 ? mass / slope : s < 0.0 ? 0.0 : (double)INFINITY;
}

/* Particles are those of the first body of a layer. Slopes that jump from particle to particle do
 * not tell s, so that for linear functions they are endlessly small, and it is M(s)/N(s), M the
 * integral of the function N. Particles much smaller than a cell count as FINEST, which bounds the
 * work. */
static const double finest = 1.0 / 1024;

void mpm_note_surfaces(struct mpm *mpm)
{
    const enum grid_shape shape = (enum grid_shape)mpm->parameters.shape;
    for (int g = 0; g < mpm->layers; g++) {
        int b = 0;
        while (mpm->layer_of_body[b] != g && mpm->layer_at_rest[b] != g)
            b++;
        const double size =
            shape == SHAPE_LINEAR ? 1.0 / 64 : maximum(2.0 * mpm->half_size[b], finest);
        for (int k = 0; k <= SURFACES; k++)
            mpm->layer[g].surface[k] =
                ratio_at(shape, SURFACE_REACH * (2.0 * k / SURFACES - 1.0), size);
    }
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

/* Which layer of a meeting has prescribed motion. */
enum prescribed_side { PRESCRIBED_NONE, PRESCRIBED_FIRST, PRESCRIBED_SECOND };

/* Two layers, and two blocks of theirs at the same position. */
struct meeting {
    struct layer *a, *b;
    int32_t in_a, in_b;
    int other; /* number of layer b */
    int law;
    struct contact_rule rule;
    int normal; /* enum contact_normal */
    int touch;  /* enum contact_touch */
    enum prescribed_side prescribed;
    bool frozen;
    double edge;
};

/* The distance from a node to the surface of a layer, in cells, positive outwards, from the layer's
 * mass and mass gradient at the node. */
static double surface_beyond(const struct meeting *m, const struct layer *layer, const double *node,
                             struct vec3 gradient)
{
    const double ratio = node[NODE_MASS] / (m->edge * sqrt(vec3_dot(gradient, gradient)));
    const double *surface = layer->surface;
    int low = 0, high = SURFACES;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (surface[middle] > ratio)
            high = middle;
        else
            low = middle;
    }
    const double part = isinf(surface[high]) /* hardly any slope, or none */
                            ? 1.0
                            : (ratio - surface[low]) / (surface[high] - surface[low]);
    return SURFACE_REACH * (2.0 * (low + part) / SURFACES - 1.0);
}

/* The outward normal of the first body at node K, from both mass gradients; zero where there is
 * none. A body whose surface is a cell or more outside the node has none, since its gradient may be
 * rounding only. */
static struct vec3 normal_at(const struct meeting *m, int k)
{
    const struct vec3 first = vector_at(grid_node(&m->a->normal, m->in_a, k)),
                      second = vector_at(grid_node(&m->b->normal, m->in_b, k)),
                      turned = vec3_scale(-1.0, second);
    const struct vec3 g = m->normal == NORMAL_FIRST    ? first
                          : m->normal == NORMAL_SECOND ? turned
                                                       : vec3_add(first, turned);
    const bool by_second = m->normal == NORMAL_SECOND;
    const struct layer *layer = by_second ? m->b : m->a;
    const double *node = grid_node(&layer->main, by_second ? m->in_b : m->in_a, k);
    if (m->normal != NORMAL_MEAN && surface_beyond(m, layer, node, g) > 0.99)
        return vec3_make(0.0, 0.0, 0.0);
    const double length = sqrt(vec3_dot(g, g));
    return length > 0.0 ? vec3_scale(1.0 / length, g) : vec3_make(0.0, 0.0, 0.0);
}

/* Whether there is a gap between the surfaces of two bodies at a node. */
static bool is_apart(const struct meeting *m, int k)
{
    const double *first = grid_node(&m->a->main, m->in_a, k),
                 *second = grid_node(&m->b->main, m->in_b, k);
    const double a = surface_beyond(m, m->a, first,
                                    vector_at(grid_node(&m->a->normal, m->in_a, k))),
                 b = surface_beyond(m, m->b, second,
                                    vector_at(grid_node(&m->b->normal, m->in_b, k)));
    return minimum(a, 1.0) + minimum(b, 1.0) < 0.0;
}

/* The state of contact of a node of layer a with each other layer, two bits each, in the last
 * component of its normal. */
enum { TOUCH_NUMBER = 3 };

static enum contact_state touch_of(const double *normal, int other)
{
    return (enum contact_state)((uint64_t)normal[TOUCH_NUMBER] >> 2 * other & 3);
}

static void set_touch(double *normal, int other, enum contact_state state)
{
    normal[TOUCH_NUMBER] += (double)((uint64_t)state << 2 * other);
}

/* The impulse on the body of FREE from one with prescribed motion in a step of DT; NORMAL points
 * out of FREE. The impulse and its work are noted in the second field of the prescribed layer. */
static struct contact_push push_by_prescribed(const struct meeting *m, int k, const double *node,
                                              const double *prescribed, struct vec3 normal,
                                              double dt)
{
    const struct layer *layer = m->prescribed == PRESCRIBED_FIRST ? m->a : m->b;
    const int32_t block = m->prescribed == PRESCRIBED_FIRST ? m->in_a : m->in_b;
    const struct contact_side side = side_of(node, dt);
    struct vec3 u = vec3_scale(1.0 / prescribed[NODE_MASS], vector_at(prescribed + NODE_MOMENTUM));
    struct contact_push push;
    if (m->frozen) {
        const struct vec3 g = vector_at(grid_node(&layer->normal, block, k));
        const double area = sqrt(vec3_dot(g, g)); /* times the density */
        const struct contact_outlet outlet = {area > 0.0 ? vec3_scale(1.0 / area, g) : g,
                                              area * layer->sound_long, area * layer->sound_shear};
        push.impulse = contact_run_out(side, vector_at(prescribed + NODE_FORCE), u, outlet, dt);
        push.state = CONTACT_NONE;
        const struct vec3 kick =
            vec3_add(vec3_scale(dt, vector_at(node + NODE_FORCE)), push.impulse);
        u = vec3_scale(1.0 / side.mass,
                       vec3_add(vector_at(node + NODE_MOMENTUM), vec3_scale(0.5, kick)));
    } else {
        push = contact_push_prescribed(side, u, normal, m->rule);
    }
    double *note = grid_node(&layer->back, block, k);
    note[0] += push.impulse.x;
    note[1] += push.impulse.y;
    note[2] += push.impulse.z;
    note[3] += vec3_dot(push.impulse, u);
    return push;
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
            normal = normal_at(m, k);
            if (vec3_dot(normal, normal) == 0.0 ||
                (m->rule.opens && m->touch == TOUCH_SURFACES && is_apart(m, k)))
                continue;
        }
        struct contact_push push;
        if (m->prescribed == PRESCRIBED_FIRST) {
            push = push_by_prescribed(m, k, second, first, vec3_scale(-1.0, normal), dt);
            push_node(second, 1.0 / dt, push.impulse);
        } else if (m->prescribed == PRESCRIBED_SECOND) {
            push = push_by_prescribed(m, k, first, second, normal, dt);
            push_node(first, 1.0 / dt, push.impulse);
        } else {
            push = contact_push(side_of(first, dt), side_of(second, dt), normal, m->rule);
            push_node(first, 1.0 / dt, push.impulse);
            push_node(second, -1.0 / dt, push.impulse);
        }
        if (m->law)
            set_touch(own, m->other, push.state);
    }
}

/* The same for velocities that were mapped back from particles, where layers were in contact during
 * the step, or in full contact. */
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
        const struct vec3 normal = normal_at(m, k);
        const struct contact_rule rule = {state == CONTACT_STICKS ? (double)INFINITY : 0.0, false};
        const struct contact_side a = {first, vec3_scale(first, vector_at(u))},
                                  b = {second, vec3_scale(second, vector_at(v))};
        const struct contact_push push =
            m->prescribed == PRESCRIBED_FIRST
                ? contact_push_prescribed(b, vector_at(u), normal, rule)
            : m->prescribed == PRESCRIBED_SECOND
                ? contact_push_prescribed(a, vector_at(v), normal, rule)
                : contact_push(a, b, normal, rule);
        const double change[3] = {push.impulse.x, push.impulse.y, push.impulse.z};
        for (int c = 0; c < 3; c++) {
            u[c] += m->prescribed == PRESCRIBED_FIRST ? 0.0 : change[c] / first;
            v[c] += m->prescribed == PRESCRIBED_FIRST    ? change[c] / second
                    : m->prescribed == PRESCRIBED_SECOND ? 0.0
                                                         : -change[c] / second;
        }
    }
}

static int law_of(const struct simulation *simulation, const struct layer *a, const struct layer *b)
{
    return simulation->problem->law[a->group][b->group];
}

/* Contact laws and frozen bodies need normals. */
static bool wants_normals(const struct mpm *mpm, const struct simulation *simulation)
{
    for (int g = 0; g < mpm->layers; g++) {
        if (mpm->layer[g].frozen)
            return true;
        for (int h = 0; h < mpm->layers; h++)
            if (law_of(simulation, &mpm->layer[g], &mpm->layer[h]))
                return true;
    }
    return false;
}

/* Contact of layers G and H in a step of DT; with DT zero, contact of their velocities. */
static void meet_pair(struct mpm *mpm, const struct simulation *simulation, int g, int h, double dt)
{
    struct layer *a = &mpm->layer[g], *b = &mpm->layer[h];
    const bool first = a->prescribed, second = b->prescribed;
    const bool frozen = (first ? a : b)->frozen;
    const int law = law_of(simulation, a, b);
    const struct contact_surface *surface = &simulation->problem->surface[law / LAW_SURFACE];
    const struct contact_rule rule = {law & LAW_SLIP ? surface->friction : (double)INFINITY,
                                      (law & LAW_NO_TENSION) != 0};
    if ((first && second) || (frozen && !(dt > 0.0)))
        return;
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
    for (int32_t n = 0; n < a->grid.blocks; n++) {
        const int32_t other = a->meets[n] && b->bins.count > 0
                                  ? block_table_find(&b->grid.table, a->grid.key[n])
                                  : -1;
        const struct meeting meeting = {.a = a,
                                        .b = b,
                                        .in_a = n,
                                        .in_b = other,
                                        .other = h,
                                        .law = law,
                                        .rule = rule,
                                        .normal = surface->normal,
                                        .touch = surface->touch,
                                        .prescribed = first    ? PRESCRIBED_FIRST
                                                      : second ? PRESCRIBED_SECOND
                                                               : PRESCRIBED_NONE,
                                        .frozen = frozen,
                                        .edge = mpm->edge};
        if (other >= 0 && dt > 0.0)
            meet_block(&meeting, law ? mpm->least_mass : 0.0, dt);
        else if (other >= 0)
            join_block(&meeting);
    }
}

/* All pairs of layers, in a fixed order. */
static void meet_pairs(struct mpm *mpm, const struct simulation *simulation, double dt)
{
    for (int g = 0; g < mpm->layers; g++)
        for (int h = g + 1; h < mpm->layers; h++)
            meet_pair(mpm, simulation, g, h, dt);
}

static void clear_notes(const struct layer *layer)
{
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        for (int k = 0; k < BLOCK_CELLS; k++)
            memset(grid_node(&layer->back, n, k), 0, BACK_STRIDE * sizeof(double));
}

/* Books the impulse and work of bodies with prescribed motion. Nodes before a wall also get what
 * they have in common with their image, so their entry includes the wall's. */
static void book_notes(const struct mpm *mpm, struct simulation *simulation,
                       const struct layer *layer)
{
    for (int32_t n = 0; n < layer->grid.blocks; n++) {
        int64_t corner[3], at[3];
        if (!layer->meets[n] || mpm_is_far(mpm, layer, layer->grid.touch[n][0].bin))
            continue;
        grid_corner(&layer->grid, n, corner);
        for (int k = 0; k < BLOCK_CELLS; k++) {
            const double *note = grid_node(&layer->back, n, k);
            const struct vec3 impulse = vector_at(note);
            mpm_node_index(layer->grid.dimension, corner, k, at);
            if (vec3_dot(impulse, impulse) == 0.0 || mpm_behind_wall(mpm, layer, at))
                continue;
            const struct vec3 place =
                vec3_scale(mpm->edge, vec3_make((double)at[0], (double)at[1], (double)at[2]));
            ledger_book(&simulation->ledger, LEDGER_PISTONS, 0.0, impulse, place, note[3]);
            if (mpm_near_wall(mpm, layer, at))
                ledger_book(&simulation->ledger, LEDGER_WALLS, 0.0, vec3_scale(-1.0, impulse),
                            place, 0.0);
        }
    }
}

/* Clears all normals, since adjacent blocks may be read before theirs are computed. */
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

/* Stores the forces before contact in the second field of layers without prescribed motion. */
static void keep_forces(const struct layer *layer, int threads)
{
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        for (int k = 0; k < BLOCK_CELLS && layer->meets[n]; k++)
            memcpy(grid_node(&layer->back, n, k), grid_node(&layer->main, n, k) + NODE_FORCE,
                   3 * sizeof(double));
}

/* The work of the contact forces of a step of DT on a layer at node K of its block. */
static double work_of_contact(const struct layer *layer, int32_t block, int k, double dt)
{
    const double *node = grid_node(&layer->main, block, k),
                 *kept = grid_node(&layer->back, block, k);
    double work = 0.0;
    for (int c = 0; c < 3 && node[NODE_MASS] > 0.0; c++)
        work += dt * (node[NODE_FORCE + c] - kept[c]) *
                (node[NODE_MOMENTUM + c] + 0.5 * dt * node[NODE_FORCE + c]) / node[NODE_MASS];
    return work;
}

/* The energy that contact dissipates at node K of a block of layer G, per mass of the layers
 * without prescribed motion. */
static double heat_of_contact(const struct mpm *mpm, int g, int32_t block, int k, double dt)
{
    double heat = 0.0, mass = 0.0;
    for (int h = 0; h < mpm->layers; h++) {
        const struct layer *layer = &mpm->layer[h];
        const int32_t in = h == g ? block
                           : layer->bins.count > 0
                               ? block_table_find(&layer->grid.table, mpm->layer[g].grid.key[block])
                               : -1;
        if (in < 0)
            continue;
        if (layer->prescribed) {
            heat += grid_node(&layer->back, in, k)[BACK_HEAT]; /* the work of what holds it */
        } else {
            heat -= work_of_contact(layer, in, k, dt);
            mass += grid_node(&layer->main, in, k)[NODE_MASS];
        }
    }
    return mass > 0.0 ? heat / mass : 0.0;
}

/* Adds the energy that contact dissipates to the particles of all layers without prescribed motion.
 * */
static void heat_by_contact(struct mpm *mpm, const struct simulation *simulation, double dt)
{
    for (int g = 0; g < mpm->layers; g++) {
        const struct layer *layer = &mpm->layer[g];
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
        for (int32_t n = 0; n < layer->grid.blocks; n++)
            for (int k = 0; k < BLOCK_CELLS && !layer->prescribed; k++)
                grid_node(&layer->back, n, k)[BACK_HEAT] =
                    layer->meets[n] ? heat_of_contact(mpm, g, n, k, dt) : 0.0;
    }
    for (int g = 0; g < mpm->layers; g++)
        if (!mpm->layer[g].prescribed)
            mpm_mirror_contact(mpm, &mpm->layer[g]);
    for (int g = 0; g < mpm->layers; g++)
        if (!mpm->layer[g].prescribed)
            mpm_warm(mpm, simulation, &mpm->layer[g], mpm->layer[g].meets);
}

void mpm_meet(struct mpm *mpm, struct simulation *simulation, double dt)
{
    const bool normals = wants_normals(mpm, simulation);
    for (int g = 0; g < mpm->layers && normals; g++)
        find_slopes(mpm, simulation, &mpm->layer[g]);
    if (normals)
        mpm_exchange(mpm, simulation, offsetof(struct layer, normal));
    for (int g = 0; g < mpm->layers && normals; g++)
        find_normals(mpm, simulation, &mpm->layer[g]);
    for (int g = 0; g < mpm->layers; g++)
        if (mpm->layer[g].prescribed)
            clear_notes(&mpm->layer[g]);
        else
            keep_forces(&mpm->layer[g], simulation->threads);
    meet_pairs(mpm, simulation, dt);
    heat_by_contact(mpm, simulation, dt);
    for (int g = 0; g < mpm->layers; g++)
        if (mpm->layer[g].prescribed)
            book_notes(mpm, simulation, &mpm->layer[g]);
}

void mpm_join_velocities(struct mpm *mpm, const struct simulation *simulation)
{
    meet_pairs(mpm, simulation, 0.0);
}
