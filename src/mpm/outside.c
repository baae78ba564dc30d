/* Loads on surfaces, and outflow through faces. The area of a body's surface at a node, times the
 * normal, is A_I = sum V grad N, as in the forces of stresses; inside the body it vanishes. A
 * pressure P gives the force -P A_I, which balances an equal pressure inside to rounding. (Cui,
 * dissertation (2014), (2-11), marks surface particles instead.) At an outflow face the normal
 * stress becomes that of material at rest outside, into which waves leave (Lysmer and Kuhlemeyer,
 * J. Eng. Mech. Div. ASCE 95 (1969) 859): f_n = -(p - p0) A_n - rho c A_n v_n' with v' at the end
 * of the step; or else that of the leaving material. */
#include <assert.h>
#include <string.h>

#include "material/material.h"
#include "model/particles/population.h"
#include "mpm/mpm_internal.h"
#include "mpm/surface.h"

/* A particle at X of half the size HALF, in cells, in a cell whose first node is at PLACE of the
 * patch and has index FIRST. */
struct reached {
    int place[3];
    int64_t first[3];
    const double *x;
    double half;
};

/* The slope of a shape function along an axis, computed with the factors FILL of the two faces of
 * its node and the slopes SLOPE of the window. K is the number of the node in the window, and
 * BEFORE the distance in FILL to the preceding node. */
static double filled_slope(const double *slope, int k, int window, const double *fill,
                           size_t before)
{
    double face = 0.0, sum = 0.0;
    for (int j = 0; j <= k; j++) {
        const double next = j + 1 < window ? face - slope[j] : 0.0;
        sum = (j > 0 ? face * *(fill - before) : 0.0) - next * *fill;
        face = next;
    }
    return sum;
}

static void give(const struct mpm *mpm, const struct layer *layer, const struct reached *reached,
                 const struct given *given, const double *fill, double *patch)
{
    const double *x = reached->x, half = reached->half;
    const enum grid_shape shape = (enum grid_shape)mpm->parameters.shape;
    const int dimension = layer->grid.dimension, window = 1 + layer->grid.reach + layer->grid.after;
    double value[3][4] = {{1.0}, {1.0}, {1.0}}, slope[3][4], around[4] = {0.0};
    int count[3] = {1, 1, 1};
    const bool round =
        given->around[0] != 0.0 || given->around[1] != 0.0 || given->around[2] != 0.0;
    assert(1 <= dimension && dimension <= 3);
    for (int axis = 0; axis < dimension; axis++) {
        count[axis] = window;
        for (int k = 0; k < window; k++) {
            const double r = x[axis] / mpm->edge - (double)(reached->first[axis] + k);
            const bool linear = shape == SHAPE_LINEAR; /* on a node all of the cell has slopes */
            value[axis][k] = linear && k ? 1.0 + r : shape_value(shape, r, half);
            slope[axis][k] = (linear ? (k ? 1.0 : -1.0) : shape_slope(shape, r, half)) / mpm->edge;
            if (axis == 0 && round)
                around[k] = fill ? value[0][k] : shape_around(shape, r, half);
        }
    }
    int at[3];
    for (at[0] = 0; at[0] < count[0]; at[0]++)
        for (at[1] = 0; at[1] < count[1]; at[1]++)
            for (at[2] = 0; at[2] < count[2]; at[2]++) {
                size_t node = 0;
                for (int axis = 0; axis < dimension; axis++)
                    node =
                        node * (size_t)layer->grid.side + (size_t)(reached->place[axis] + at[axis]);
                const double ring = around[at[0]] * value[1][at[1]] *
                                    (fill ? fill[node * FILL_STRIDE + FILL_RING] : 1.0);
                for (int n = 0; n < 3 && round; n++)
                    patch[node * BACK_STRIDE + (size_t)n] += given->around[n] * ring;
                const double all = value[0][at[0]] * value[1][at[1]] * value[2][at[2]];
                for (int n = 0; n < 3 && given->force; n++)
                    patch[node * BACK_STRIDE + (size_t)n] += given->force[n] * all;
                size_t step = 1;
                for (int k = dimension - 1; k >= 0; k--, step *= (size_t)layer->grid.side) {
                    double others = 1.0;
                    for (int axis = 0; axis < dimension; axis++)
                        others *= axis == k ? 1.0 : value[axis][at[axis]];
                    const double plain = slope[k][at[k]] * others,
                                 filled = fill ? filled_slope(slope[k], at[k], count[k],
                                                              fill + node * FILL_STRIDE + k,
                                                              step * FILL_STRIDE) *
                                                     others
                                               : plain;
                    for (int n = 0; n < 3; n++)
                        patch[node * BACK_STRIDE + (size_t)n] +=
                            given->by_slope[n][k] * (given->filled[n] == k ? filled : plain);
                }
            }
}

static struct given by_load(const struct mpm *mpm, const struct simulation *simulation,
                            const struct surface *surface, int32_t i)
{
    const struct particles *p = mpm->particles;
    const struct load_input *load = surface->load;
    const double volume = p->mass[i] / p->density[i],
                 sign = load->side == SIDE_HIGH ? volume : -volume;
    struct given given = {{{0.0}}, {0, 1, 2}, {0.0}, NULL};
    (void)mpm;
    for (int k = 0; k < simulation->problem->dimension; k++)
        if (load->traction.count) { /* a prescribed force, which balances no stress */
            given.by_slope[k][load->axis] = sign * surface->traction[k];
            given.filled[k] = -1;
        } else
            given.by_slope[k][k] = -volume * surface->pressure;
    if (simulation->problem->geometry == GEOMETRY_AXISYMMETRIC && !load->traction.count)
        given.around[0] = -volume * surface->pressure / p->position[i][0];
    return given;
}

/* A blast pushes on the particles of the surface that faces it. */
static struct given by_element(const struct mpm *mpm, const struct simulation *simulation,
                               const struct surface *surface, int32_t i)
{
    (void)mpm;
    (void)simulation;
    const double *force = surface->force[i];
    const bool any = force[0] != 0.0 || force[1] != 0.0 || force[2] != 0.0;
    return (struct given){{{0.0}}, {-1, -1, -1}, {0.0}, any ? force : NULL};
}

static struct given by_area(const struct mpm *mpm, const struct simulation *simulation,
                            const struct surface *surface, int32_t i)
{
    const struct particles *p = mpm->particles;
    struct given given = {{{0.0}}, {0, 1, 2}, {0.0}, NULL};
    (void)surface;
    for (int k = 0; k < simulation->problem->dimension; k++)
        given.by_slope[k][k] = p->mass[i] / p->density[i];
    if (simulation->problem->geometry == GEOMETRY_AXISYMMETRIC)
        given.around[0] = p->mass[i] / (p->density[i] * p->position[i][0]);
    return given;
}

/* Area, impedance times area, and normal stress times area. */
enum { FACE_AREA, FACE_IMPEDANCE, FACE_PUSH, FACE_FORCE };

static struct given by_outflow(const struct mpm *mpm, const struct simulation *simulation,
                               const struct surface *surface, int32_t i)
{
    const struct particles *p = mpm->particles;
    const double gauge = mpm->gauge[p->material[i]], volume = p->mass[i] / p->density[i];
    const double sign = surface->outflow_side == SIDE_HIGH ? 1.0 : -1.0;
    const int axis = surface->axis;
    struct given given = {{{0.0}}, {axis, axis, axis}, {0.0}, NULL};
    given.by_slope[FACE_AREA][axis] = sign * volume;
    given.by_slope[FACE_IMPEDANCE][axis] = sign * p->mass[i] * surface->sound[i];
    given.by_slope[FACE_PUSH][axis] =
        isnan(surface->outflow->pressure)
            ? sign * volume *
                  (p->pressure[i] + surface->viscosity[i] - gauge - p->deviator[i][axis])
            : sign * volume * (surface->outflow->pressure - gauge);
    for (int n = 0; n < 3; n++)
        given.around[n] = axis == 0 && simulation->problem->geometry == GEOMETRY_AXISYMMETRIC
                              ? given.by_slope[n][0] / p->position[i][0]
                              : 0.0;
    return given;
}

/* Whether nodes from FIRST, COUNT of them along each axis, may be on the surface. */
static bool is_near(const struct surface *surface, const int64_t first[3], int count)
{
    const struct mpm_outside *outside = surface->outside;
    if (!outside)
        return (double)(first[surface->axis] + count - 1) >= surface->low &&
               (double)first[surface->axis] <= surface->high;
    bool near = false;
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++) {
            const double plane = (double)(side ? outside->high : outside->low)[axis];
            near |= outside->open[axis][side] &&
                    (double)(first[axis] + count - 1) >= plane - surface->reach &&
                    (double)first[axis] <= plane + surface->reach;
        }
    return near;
}

static void give_bin(const struct mpm *mpm, const struct simulation *simulation,
                     const struct layer *layer, const struct surface *surface, int32_t b)
{
    const struct particles *p = mpm->particles;
    const struct bin *bin = &layer->bins.bin[b];
    const int dimension = layer->grid.dimension;
    double *patch = grid_patch(&layer->grid, &layer->back, b);
    const double *fill =
        mpm_is_by_faces(&mpm->parameters) ? grid_patch(&layer->grid, &layer->fill, b) : NULL;
    memset(patch, 0, (size_t)(layer->grid.patch * BACK_STRIDE) * sizeof *patch);
    const int cells = block_cells(dimension), window = 1 + layer->grid.reach + layer->grid.after;
    int64_t corner[3], node[3];
    block_coordinates(bin->key, corner);
    for (int axis = 0; axis < 3; axis++)
        node[axis] = corner[axis] * cells - layer->grid.reach;
    if (!is_near(surface, node, cells + window))
        return;
    for (int cell = 0; cell < BLOCK_CELLS; cell++) {
        struct reached reached;
        bin_cell_place(dimension, cell, reached.place);
        for (int axis = 0; axis < 3; axis++)
            reached.first[axis] = node[axis] + reached.place[axis];
        if (surface->outside && !is_near(surface, reached.first, window))
            continue;
        for (int32_t k = bin->cell[cell]; k < bin->cell[cell + 1]; k++) {
            const int32_t i = layer->bins.list[bin->first + k];
            const struct given given = surface->of(mpm, simulation, surface, i);
            if (surface->force && !given.force)
                continue;
            reached.x = p->position[i];
            reached.half = mpm->half_size[p->body[i]];
            if (surface->body < 0 || p->body[i] == surface->body)
                give(mpm, layer, &reached, &given, fill, patch);
        }
    }
}

/* Collective: the sums of a surface at the nodes of all layers without prescribed motion. */
static void sum_surface(struct mpm *mpm, struct simulation *simulation,
                        const struct surface *surface)
{
    for (int g = 0; g < mpm->layers; g++) {
        const struct layer *layer = &mpm->layer[g];
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
        for (int32_t b = 0; b < layer->bins.count; b++)
            if (!mpm_is_far(mpm, layer, b) && !layer->prescribed)
                give_bin(mpm, simulation, layer, surface, b);
    }
    mpm_exchange(mpm, simulation, offsetof(struct layer, back));
    for (int g = 0; g < mpm->layers; g++) {
        struct layer *layer = &mpm->layer[g];
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
        for (int32_t n = 0; n < layer->grid.blocks; n++)
            if (!layer->prescribed)
                grid_reduce(&layer->grid, &layer->back, n);
    }
}

/* The force along the outward normal of a face in a step of DT, computed from the state of a node
 * before walls act, and the node's SUM of the face. */
static double face_force(const struct surface *surface, const double *node, const double *sum,
                         double dt)
{
    const double sign = surface->outflow_side == SIDE_HIGH ? 1.0 : -1.0, mass = node[NODE_MASS];
    if (!(sum[FACE_AREA] > 0.0 && mass > 0.0))
        return 0.0;
    if (isnan(surface->outflow->pressure))
        return -sum[FACE_PUSH];
    const double damping = maximum(sum[FACE_IMPEDANCE], 0.0),
                 momentum = sign * (node[NODE_MOMENTUM + surface->axis] +
                                    dt * node[NODE_FORCE + surface->axis]) -
                            dt * sum[FACE_PUSH];
    return -sum[FACE_PUSH] - damping * momentum / (mass + dt * damping);
}

/* Converts the sums of a face to forces: at all nodes, then again at nodes near walls, whose state
 * before the walls acted is stored separately. */
static void push_face(struct layer *layer, const struct surface *surface, double dt, int threads)
{
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        for (int k = 0; k < BLOCK_CELLS; k++) {
            double *sum = grid_node(&layer->back, n, k);
            sum[FACE_FORCE] = face_force(surface, grid_node(&layer->main, n, k), sum, dt);
        }
    for (int32_t w = 0; w < layer->walls; w++)
        layer->wall[w].back[FACE_FORCE] =
            face_force(surface, layer->wall[w].sum, layer->wall[w].back, dt);
    const double sign = surface->outflow_side == SIDE_HIGH ? 1.0 : -1.0;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        for (int k = 0; k < BLOCK_CELLS; k++) {
            double *sum = grid_node(&layer->back, n, k);
            const double force = sign * sum[FACE_FORCE];
            for (int c = 0; c < BACK_STRIDE; c++)
                sum[c] = c == surface->axis ? force : 0.0;
        }
}

/* Whether the node AT has a part of the surface. Behind a wall are the nodes whose images have. */
static bool is_on(const struct mpm *mpm, const struct surface *surface, const int64_t at[3])
{
    const struct mpm_outside *outside = surface->outside;
    const int across = surface->axis;
    int64_t place = at[across];
    for (int side = 0; side < 2; side++)
        if (mpm->has_plane[across][side] &&
            (side == 0 ? place < mpm->plane[across][side] : place > mpm->plane[across][side]))
            place = 2 * mpm->plane[across][side] - place;
    if (!outside)
        return (double)place >= surface->low && (double)place <= surface->high;
    bool near = false;
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++)
            near |= outside->open[axis][side] &&
                    fabs((double)(at[axis] - (side ? outside->high : outside->low)[axis])) <=
                        surface->reach;
    return near;
}

/* Converts areas, which have been noted, to the forces of what is outside. */
static void push_outside(struct layer *layer, const struct mpm_outside *outside)
{
    int64_t corner[3], at[3];
    for (int32_t n = 0; n < layer->grid.blocks; n++) {
        grid_corner(&layer->grid, n, corner);
        for (int k = 0; k < BLOCK_CELLS; k++) {
            double *area = grid_node(&layer->back, n, k);
            mpm_node_index(layer->grid.dimension, corner, k, at);
            mpm_push_area(outside, at, area, area);
        }
    }
}

/* Sets to zero what nodes of a block have that are not on the surface. */
static void keep_surface(const struct mpm *mpm, const struct layer *layer,
                         const struct surface *surface, int32_t block)
{
    int64_t corner[3], at[3];
    grid_corner(&layer->grid, block, corner);
    for (int k = 0; k < BLOCK_CELLS; k++) {
        const double *node = grid_node(&layer->main, block, k);
        mpm_node_index(layer->grid.dimension, corner, k, at);
        if (!(is_on(mpm, surface, at) && node[NODE_MASS] > 0.0))
            memset(grid_node(&layer->back, block, k), 0, BACK_STRIDE * sizeof(double));
    }
}

/* Applies the forces in the second field. Particles get the forces of their own nodes but move with
 * velocities that include the images at walls, so the forces near walls are saved before images are
 * added. */
static void push_nodes(const struct mpm *mpm, struct simulation *simulation, struct layer *layer,
                       const struct surface *surface, double dt)
{
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        keep_surface(mpm, layer, surface, n);
    if (surface->load)
        mpm_book_load(mpm, layer, dt, &simulation->load[surface->index]);
    mpm_note_pushed(layer,
                    surface->load      ? SURFACE_LOADS
                    : surface->outflow ? SURFACE_OUTFLOWS
                                       : SURFACE_OUTSIDE,
                    simulation->threads);
    if (surface->outside)
        push_outside(layer, surface->outside);
    mpm_add_forces(mpm, simulation, layer);
}

static void push_surface(struct mpm *mpm, struct simulation *simulation,
                         const struct surface *surface, double dt)
{
    sum_surface(mpm, simulation, surface);
    for (int g = 0; g < mpm->layers; g++) {
        struct layer *layer = &mpm->layer[g];
        if (layer->prescribed)
            continue;
        if (surface->outflow)
            push_face(layer, surface, dt, simulation->threads);
        push_nodes(mpm, simulation, layer, surface, dt);
    }
}

/* Fills in what load SURFACE is in a step of DT, and whether it may push ANY particle. */
static struct error *find_load(struct mpm *mpm, struct simulation *simulation,
                               struct surface *surface, double dt, bool *any)
{
    static const char *const keys[] = {"traction.1", "traction.2", "traction.3"};
    const struct load_input *load = surface->load;
    const char *name = simulation->problem->input->loads.names[surface->index];
    const double time = simulation->time + 0.5 * dt;
    const bool local = load_is_local(load);
    assert(load->traction.count <= 3);
    if (local) {
        const struct population population = population_of_particles(mpm->particles);
        loads_clear(&mpm->loads, &population);
        surface->force = mpm->loads.force;
    }
    TRY(loads_push(&mpm->loads, simulation, surface->index, simulation->time, dt, local));
    *any = !local || mpm->loads.pushes;
    for (int k = 0; k < load->traction.count; k++)
        TRY(simulation_value_at(simulation, time, &load->traction.at[k], name, keys[k],
                                &surface->traction[k]));
    return load->traction.count || local
               ? NULL
               : simulation_value_at(simulation, time, &load->pressure, name, "pressure",
                                     &surface->pressure);
}

static struct error *push_loads(struct mpm *mpm, struct simulation *simulation, double dt)
{
    const struct simulation_case *input = simulation->problem->input;
    const struct population population = population_of_particles(mpm->particles);
    TRY(ranks_agree(simulation->ranks, loads_follow(&mpm->loads, simulation, &population)));
    for (int i = 0; i < input->loads.count; i++) {
        const struct load_input *load = case_load(input, i);
        const bool local = load_is_local(load), part = load->between.count > 0 && !local;
        struct surface surface = {.body = load->body,
                                  .low = part ? load->between.at[0] / mpm->edge : -(double)INFINITY,
                                  .high = part ? load->between.at[1] / mpm->edge : (double)INFINITY,
                                  .axis = load->axis,
                                  .of = local ? by_element : by_load,
                                  .load = load,
                                  .index = i};
        if (!load_acts_at(load, simulation->time))
            continue;
        bool any;
        TRY(find_load(mpm, simulation, &surface, dt, &any));
        if (ranks_maximum(simulation->ranks, any) > 0.0)
            push_surface(mpm, simulation, &surface, dt);
    }
    return NULL;
}

struct error *mpm_push_surfaces(struct mpm *mpm, struct simulation *simulation, double dt)
{
    static const double reaches[] = {
        [SHAPE_LINEAR] = 1.0, [SHAPE_GIMP] = 1.5, [SHAPE_QUADRATIC] = 1.5, [SHAPE_CUBIC] = 2.0};
    const struct simulation_case *input = simulation->problem->input;
    const double reach = reaches[mpm->parameters.shape];
    for (int g = 0; g < mpm->layers; g++)
        memset(mpm->layer[g].is_pushed, 0, sizeof mpm->layer[g].is_pushed);
    if (input->loads.count > 0)
        TRY(push_loads(mpm, simulation, dt));
    if (mpm->outside) {
        const struct surface surface = {
            .body = -1, .of = by_area, .outside = mpm->outside, .reach = reach};
        push_surface(mpm, simulation, &surface, dt);
    }
    const struct mpm_fields fields = mpm_fields_of(mpm);
    for (int axis = 0; axis < simulation->problem->dimension; axis++)
        for (int side = 0; side < 2; side++) {
            const struct face *face = &simulation->problem->place.face[axis][side];
            const struct surface surface = {.body = -1,
                                            .sound = fields.sound_long,
                                            .viscosity = fields.viscosity,
                                            .low = face->at / mpm->edge - reach,
                                            .high = face->at / mpm->edge + reach,
                                            .axis = axis,
                                            .of = by_outflow,
                                            .outflow = face,
                                            .outflow_side = side};
            if (face_lets_out(face))
                push_surface(mpm, simulation, &surface, dt);
        }
    return NULL;
}

/* Takes out particles beyond FACE. */
static void lose_through(const struct mpm *mpm, struct simulation *simulation,
                         const struct face *face, int axis, double sign)
{
    struct particles *p = mpm->particles;
    for (int32_t k = 0; k < p->count; k++) {
        const double *x = p->position[k], *u = p->velocity[k], m = p->mass[k];
        if (sign * (x[axis] - face->at) <= 0.0 ||
            p->body[k] >= simulation->problem->input->bodies.count) /* gone through another face */
            continue;
        const struct vec3 velocity = vec3_make(u[0], u[1], u[2]);
        ledger_book(&simulation->ledger, LEDGER_OUTFLOWS, -m, vec3_scale(-m, velocity),
                    vec3_make(x[0], x[1], x[2]),
                    -m * (p->energy[k] + 0.5 * vec3_dot(velocity, velocity)));
        particles_delete(p, k);
    }
}

void mpm_lose_particles(const struct mpm *mpm, struct simulation *simulation)
{
    for (int axis = 0; axis < simulation->problem->dimension; axis++)
        for (int side = 0; side < 2; side++) {
            const struct face *face = &simulation->problem->place.face[axis][side];
            if (face_lets_out(face))
                lose_through(mpm, simulation, face, axis, side ? 1.0 : -1.0);
        }
}
