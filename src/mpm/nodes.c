/* What happens at nodes: sums of patches, the step of momentum, and walls.
 *
 * A wall lies on a plane of nodes, where the normal velocity is zero. Shape functions that reach
 * beyond it do as if the particles had images behind it: what a node behind the wall gets is added,
 * mirrored, to the node that it is the image of, and both then have the same velocity, mirrored. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "mpm/mpm_internal.h"

/* The wall at AT across AXIS does not lie on a plane of nodes. */
static struct error *between_planes(const struct simulation_case *input, const struct face *face,
                                    double edge)
{
    const double at = face->at;
    const double below = floor(at / edge) * edge, above = ceil(at / edge) * edge;
    const double cells = maximum(1.0, nearbyint(fabs(at / edge)));
    const double reach = edge * (double)bins_reach((int)input->dimension);
    char key[128] = "", advice[96] = "";
    if (face->boundary >= 0)
        snprintf(key, sizeof key, "%.120s.at", input->boundaries.names[face->boundary]);
    if (!(fabs(at) < reach))
        return input_error(input, "boundaries", key,
                           "%.6g m is beyond the grid of the solver mpm: with cells of %.6g m it "
                           "reaches %.6g m from zero",
                           at, edge, reach);
    if (fabs(at) / cells > input->resolution * (1.0 - 1e-6))
        snprintf(advice, sizeof advice, "; with `cell: %.9g m/%.15g` there is one at the wall",
                 fabs(at), cells);
    return input_error(input, "boundaries", key,
                       "%.9g m lies between planes of the grid of the solver mpm: with cells of "
                       "%.6g m they are at %.9g m and %.9g m%s",
                       at, edge, below + 0.0, above + 0.0 /* no -0 */, advice);
}

/* A load between planes that are so near each other that some of its force is lost. */
static struct error *too_near(const struct simulation_case *input, double edge)
{
    struct error *error = NULL;
    for (int i = 0; i < input->loads.count; i++) {
        const struct vector_value *between = &case_load(input, i)->between;
        char key[160];
        if (between->count == 0 || load_is_local(case_load(input, i)) ||
            between->at[1] - between->at[0] > (2.0 - 1e-6) * edge)
            continue;
        snprintf(key, sizeof key, "%.120s.between", input->loads.names[i]);
        error = error_join(error,
                           input_error(input, "loads", key,
                                       "%.6g m is less than two cells of the solver mpm, of %.6g "
                                       "m: widen it to hold the face and a cell on both sides of "
                                       "it, or some of the load is lost",
                                       between->at[1] - between->at[0], edge));
    }
    return error;
}

struct error *mpm_find_planes(struct mpm *mpm, const struct simulation *simulation)
{
    struct error *error = too_near(simulation->problem->input, mpm->edge);
    for (int axis = 0; axis < simulation->problem->dimension; axis++)
        for (int side = 0; side < 2; side++) {
            const struct face *face = &simulation->problem->place.face[axis][side];
            const double at = face->at, index = at / mpm->edge, plane = nearbyint(index);
            mpm->has_plane[axis][side] = face_closes(face);
            if (!face_closes(face))
                continue;
            if (fabs(index - plane) <= 1e-6 &&
                fabs(plane) < (double)bins_reach(simulation->problem->dimension))
                mpm->plane[axis][side] = (int64_t)plane;
            else
                error =
                    error_join(error, between_planes(simulation->problem->input, face, mpm->edge));
        }
    return error;
}

/* Index of the node that AT is the image of behind the wall SIDE across AXIS; the node's own on the
 * wall. */
static int64_t mirrored(const struct mpm *mpm, int axis, int side, int64_t at)
{
    return 2 * mpm->plane[axis][side] - at;
}

/* How far behind the wall a node is, in cells: 0 on it, negative before it. */
static int64_t behind(const struct mpm *mpm, int axis, int side, int64_t at)
{
    return side ? at - mpm->plane[axis][1] : mpm->plane[axis][0] - at;
}

bool mpm_near_wall(const struct mpm *mpm, const struct layer *layer, const int64_t at[3])
{
    const int64_t within = layer->grid.reach;
    for (int axis = 0; axis < layer->grid.dimension; axis++)
        for (int side = 0; side < 2; side++)
            if (mpm->has_plane[axis][side] && behind(mpm, axis, side, at[axis]) >= -within)
                return true;
    return false;
}

bool mpm_behind_wall(const struct mpm *mpm, const struct layer *layer, const int64_t at[3])
{
    for (int axis = 0; axis < layer->grid.dimension; axis++)
        for (int side = 0; side < 2; side++)
            if (mpm->has_plane[axis][side] && behind(mpm, axis, side, at[axis]) > 0)
                return true;
    return false;
}

bool mpm_block_near_wall(const struct mpm *mpm, const struct layer *layer, const int64_t corner[3])
{
    const int64_t within = layer->grid.reach;
    const int64_t last = block_cells(layer->grid.dimension) - 1;
    for (int axis = 0; axis < layer->grid.dimension; axis++)
        for (int side = 0; side < 2; side++)
            if (mpm->has_plane[axis][side] &&
                behind(mpm, axis, side, corner[axis] + (side ? last : 0)) >= -within)
                return true;
    return false;
}

void mpm_node_index(int dimension, const int64_t corner[3], int k, int64_t at[3])
{
    int place[3];
    bin_cell_place(dimension, k, place);
    for (int axis = 0; axis < 3; axis++)
        at[axis] = corner[axis] + place[axis];
}

/* Lists the nodes of a block that walls change. In CORNERS a node behind both walls may have no
 * mass but that of its images. */
static struct error *collect_block(const struct mpm *mpm, struct layer *layer, bool corners,
                                   int32_t block, const int64_t corner[3])
{
    if (!memory_reserve((void **)&layer->wall, &layer->wall_capacity, layer->walls + BLOCK_CELLS,
                        layer->walls, sizeof *layer->wall))
        return out_of_memory_for("%d nodes at walls", layer->walls);
    for (int k = 0; k < BLOCK_CELLS; k++) {
        struct wall_node *wall = &layer->wall[layer->walls];
        mpm_node_index(layer->grid.dimension, corner, k, wall->at);
        double *node = grid_node(&layer->main, block, k);
        if (!mpm_near_wall(mpm, layer, wall->at) ||
            (node[NODE_MASS] <= 0.0 && !(corners && mpm_behind_wall(mpm, layer, wall->at))))
            continue;
        wall->node = node;
        wall->booked = !mpm_is_far(mpm, layer, layer->grid.touch[block][0].bin);
        wall->back = grid_node(&layer->back, block, k);
        wall->normal = layer->normal.node ? grid_node(&layer->normal, block, k) : NULL;
        wall->mapped = layer->mapped.node ? grid_node(&layer->mapped, block, k) : NULL;
        memcpy(wall->sum, node, sizeof wall->sum);
        layer->walls++;
    }
    return NULL;
}

static struct error *collect_walls(const struct mpm *mpm, struct layer *layer, bool corners)
{
    layer->walls = 0;
    for (int32_t n = 0; n < layer->grid.blocks; n++) {
        int64_t corner[3];
        grid_corner(&layer->grid, n, corner);
        if (mpm_block_near_wall(mpm, layer, corner))
            TRY(collect_block(mpm, layer, corners, n, corner));
    }
    return NULL;
}

/* Which numbers of a node walls fold: scalars, and where vectors begin. */
struct folded {
    int scalars, scalar[BALANCE_NUMBERS], vectors, vector[2];
};

static const struct folded
    folded_main = {2, {NODE_MASS, NODE_MIXING}, 2, {NODE_MOMENTUM, NODE_FORCE}},
    folded_vector = {.vectors = 1},
    folded_back = {.scalars = 1, .scalar = {BACK_DIVERGENCE}, .vectors = 1},
    folded_heat = {.scalars = HEAT_NUMBERS, .scalar = {HEAT_ENERGY, HEAT_NUMBER, HEAT_SQUARE}},
    folded_balance = {.scalars = BALANCE_NUMBERS,
                      .scalar = {BALANCE_PRESSURE, BALANCE_SUM, BALANCE_NUMBER, BALANCE_SQUARE}};

/* Adds what a node behind a wall has to the node whose image it is, and makes it equal to that. */
static void fold_onto(double *node, double *onto, int axis, const struct folded *folded)
{
    for (int s = 0; s < folded->scalars; s++) {
        const int k = folded->scalar[s];
        node[k] = onto[k] += node[k];
    }
    for (int v = 0; v < folded->vectors; v++)
        for (int c = 0; c < 3; c++) {
            const int k = folded->vector[v] + c;
            const double sign = c == axis ? -1.0 : 1.0;
            onto[k] += sign * node[k];
            node[k] = sign * onto[k];
        }
}

/* Walls in one of the fields. */
static void fold(const struct mpm *mpm, struct layer *layer, const struct grid_field *field,
                 const struct folded *folded)
{
    for (int axis = 0; axis < layer->grid.dimension; axis++)
        for (int side = 0; side < 2 && layer->walls; side++)
            for (int32_t w = 0; w < layer->walls && mpm->has_plane[axis][side]; w++) {
                const struct wall_node *wall = &layer->wall[w];
                double *node = field == &layer->main     ? wall->node
                               : field == &layer->mapped ? wall->mapped
                               : field == &layer->back   ? wall->back
                                                         : wall->normal;
                const int64_t far = behind(mpm, axis, side, wall->at[axis]);
                if (far == 0)
                    for (int v = 0; v < folded->vectors; v++)
                        node[folded->vector[v] + axis] = 0.0;
                if (far <= 0)
                    continue;
                int64_t at[3] = {wall->at[0], wall->at[1], wall->at[2]};
                at[axis] = mirrored(mpm, axis, side, at[axis]);
                double *onto = grid_node_at(&layer->grid, field, at);
                if (onto)
                    fold_onto(node, onto, axis, folded);
            }
}

void mpm_mirror_contact(const struct mpm *mpm, const struct layer *layer)
{
    for (int32_t w = 0; w < layer->walls; w++) {
        const struct wall_node *wall = &layer->wall[w];
        int64_t at[3] = {wall->at[0], wall->at[1], wall->at[2]};
        double sign[3] = {1.0, 1.0, 1.0};
        bool mirror = false;
        for (int axis = 0; axis < layer->grid.dimension; axis++)
            for (int side = 0; side < 2; side++)
                if (mpm->has_plane[axis][side] && behind(mpm, axis, side, at[axis]) > 0) {
                    at[axis] = mirrored(mpm, axis, side, at[axis]);
                    sign[axis] = -1.0;
                    mirror = true;
                }
        if (!mirror)
            continue;
        const double *image = grid_node_at(&layer->grid, &layer->main, at),
                     *heat = grid_node_at(&layer->grid, &layer->back, at);
        for (int c = 0; c < 3 && image; c++)
            wall->node[NODE_FORCE + c] = sign[c] * image[NODE_FORCE + c];
        wall->back[BACK_HEAT] = heat ? heat[BACK_HEAT] : 0.0;
    }
}

static void add_gravity(const struct simulation *simulation, const struct layer *layer,
                        int32_t block)
{
    for (int k = 0; k < BLOCK_CELLS; k++) {
        double *node = grid_node(&layer->main, block, k);
        for (int c = 0; c < 3; c++)
            node[NODE_FORCE + c] += node[NODE_MASS] * simulation->problem->gravity[c];
    }
}

struct error *mpm_sum_nodes(const struct mpm *mpm, const struct simulation *simulation,
                            struct layer *layer)
{
    const bool heavy = problem_has_gravity(simulation->problem) && !layer->prescribed;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++) {
        grid_reduce(&layer->grid, &layer->main, n);
        if (heavy)
            add_gravity(simulation, layer, n);
    }
    /* about an axis such nodes may have forces, which are lost (see mpm_book_hoop) */
    TRY(collect_walls(mpm, layer,
                      simulation->problem->geometry != GEOMETRY_AXISYMMETRIC ||
                          mpm_is_by_faces(&mpm->parameters)));
    fold(mpm, layer, &layer->main, &folded_main);
    return NULL;
}

void mpm_fold_vectors(const struct mpm *mpm, struct layer *layer, const struct grid_field *field)
{
    const bool is_main = field == &layer->main || field == &layer->mapped;
    fold(mpm, layer, field, is_main ? &folded_main : &folded_vector);
}

void mpm_fold_heat(const struct mpm *mpm, struct layer *layer)
{
    fold(mpm, layer, &layer->back, &folded_heat);
}

void mpm_fold_balance(const struct mpm *mpm, struct layer *layer)
{
    fold(mpm, layer, &layer->back, &folded_balance);
}

void mpm_add_forces(const struct mpm *mpm, const struct simulation *simulation, struct layer *layer)
{
    for (int32_t w = 0; w < layer->walls; w++)
        for (int c = 0; c < 3; c++)
            layer->wall[w].sum[NODE_FORCE + c] += layer->wall[w].back[c];
    mpm_fold_vectors(mpm, layer, &layer->back);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        for (int k = 0; k < BLOCK_CELLS; k++)
            for (int c = 0; c < 3; c++)
                grid_node(&layer->main, n, k)[NODE_FORCE + c] += grid_node(&layer->back, n, k)[c];
}

bool mpm_covers(const struct layer *layer, int32_t bin, const bool *of)
{
    bool covers = false;
    for (int code = 0; code < GRID_AROUND; code++) {
        const int32_t block = layer->grid.around[bin][code];
        covers |= block >= 0 && of[block];
    }
    return covers;
}

void mpm_warm(const struct mpm *mpm, const struct simulation *simulation, struct layer *layer,
              const bool *of)
{
    const struct transfer transfer = mpm_transfer_of(mpm, simulation, layer);
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
    for (int32_t b = 0; b < layer->bins.count; b++) {
        if (mpm_is_far(mpm, layer, b) || (of && !mpm_covers(layer, b, of)))
            continue;
        grid_spread(&layer->grid, &layer->back, b);
        transfer_warm(&transfer, b);
    }
}

/* Whether the plane across x that a node is at is the axis of symmetry. */
static bool is_at_axis(const struct mpm *mpm, const struct simulation *simulation, int64_t x)
{
    return simulation->problem->geometry == GEOMETRY_AXISYMMETRIC &&
           !(mpm->has_plane[0][1] && mpm->plane[0][1] - x < x - mpm->plane[0][0]);
}

void mpm_book_wall(const struct mpm *mpm, struct simulation *simulation,
                   const struct wall_node *wall, double push[3])
{
    const struct vec3 place = vec3_scale(
        mpm->edge, vec3_make((double)wall->at[0], (double)wall->at[1], (double)wall->at[2]));
    if (is_at_axis(mpm, simulation, wall->at[0])) {
        ledger_book(&simulation->ledger, LEDGER_AXIS, 0.0, vec3_make(push[0], 0.0, 0.0), place,
                    0.0);
        push[0] = 0.0;
    }
    ledger_book(&simulation->ledger, LEDGER_WALLS, 0.0, vec3_make(push[0], push[1], push[2]), place,
                0.0);
}

/* Weights work with the velocities of nodes, those of the particles but at walls: what they do
 * there beyond what mpm_book_gravity has. */
static void book_weight(struct simulation *simulation, const struct wall_node *wall, double dt)
{
    const double *sum = wall->sum, *node = wall->node;
    double work = 0.0;
    for (int k = 0; k < 3; k++) {
        const double before = node[NODE_VELOCITY + k] - dt * node[NODE_ACCELERATION + k];
        work += dt * simulation->problem->gravity[k] * (1.0 - 0.5 * node[NODE_MIXING]) *
                (sum[NODE_MASS] * before - sum[NODE_MOMENTUM + k]);
    }
    ledger_book(&simulation->ledger, LEDGER_GRAVITY, 0.0, vec3_make(0.0, 0.0, 0.0),
                vec3_make(0.0, 0.0, 0.0), work);
}

/* A wall changes the momentum of particles by what they get from a node in excess of what they have
 * put into it. */
static void book_walls(const struct mpm *mpm, struct simulation *simulation,
                       const struct layer *layer, double dt)
{
    const double flip = mpm->parameters.flip;
    for (int32_t w = 0; w < layer->walls; w++) {
        const struct wall_node *wall = &layer->wall[w];
        const double *sum = wall->sum, *node = wall->node, mass = sum[NODE_MASS];
        if (!wall->booked)
            continue;
        double push[3];
        for (int k = 0; k < 3; k++) {
            const double gain =
                flip * dt * mass * node[NODE_ACCELERATION + k] +
                (1.0 - flip) * (mass * node[NODE_VELOCITY + k] - sum[NODE_MOMENTUM + k]);
            const double before = node[NODE_VELOCITY + k] - dt * node[NODE_ACCELERATION + k];
            const double mixed = node[NODE_MIXING] * (mass * before - sum[NODE_MOMENTUM + k]);
            push[k] = gain + flip * mixed - dt * sum[NODE_FORCE + k];
        }
        mpm_book_wall(mpm, simulation, wall, push);
        book_weight(simulation, wall, dt);
    }
}

void mpm_advance_nodes(const struct mpm *mpm, struct simulation *simulation, struct layer *layer,
                       double dt)
{
    const bool prescribed = layer->prescribed;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        for (int k = 0; k < BLOCK_CELLS; k++) {
            double *node = grid_node(&layer->main, n, k);
            const double mass = node[NODE_MASS];
            if (mass <= 0.0) { /* what shape functions around the axis, or slopes reach */
                memset(node, 0, NODE_STRIDE * sizeof *node);
                continue;
            }
            node[NODE_MIXING] = mixing_of_velocity(dt * node[NODE_MIXING] / mass);
            for (int c = 0; c < 3; c++) {
                const double force = prescribed ? 0.0 : node[NODE_FORCE + c];
                node[NODE_VELOCITY + c] = (node[NODE_MOMENTUM + c] + dt * force) / mass;
                node[NODE_ACCELERATION + c] = force / mass;
            }
        }
    if (!prescribed)
        book_walls(mpm, simulation, layer, dt);
}

/* The main field has the momentum of bodies with prescribed motion, at the start of the step. */
static void keep_velocities(const struct simulation *simulation, struct layer *layer, bool momentum)
{
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        for (int k = 0; k < BLOCK_CELLS; k++) {
            const double *node = grid_node(&layer->main, n, k), mass = node[NODE_MASS];
            double *back = grid_node(&layer->back, n, k);
            for (int c = 0; c < 3; c++)
                back[c] = mass > 0.0 ? node[NODE_VELOCITY + c] / (momentum ? mass : 1.0) : 0.0;
        }
}

void mpm_find_velocities(const struct mpm *mpm, const struct simulation *simulation,
                         struct layer *layer, bool plain)
{
    if (layer->prescribed) {
        keep_velocities(simulation, layer, plain);
        return;
    }
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++) {
        if (!plain)
            grid_reduce(&layer->grid, &layer->back, n);
        for (int k = 0; k < BLOCK_CELLS && plain; k++) {
            const double *node = grid_node(&layer->main, n, k);
            memcpy(grid_node(&layer->back, n, k), node + NODE_MOMENTUM, 3 * sizeof *node);
        }
    }
    if (!plain)
        fold(mpm, layer, &layer->back, &folded_back);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        for (int k = 0; k < BLOCK_CELLS; k++) {
            const double mass = grid_node(&layer->main, n, k)[NODE_MASS];
            double *node = grid_node(&layer->back, n, k);
            for (int c = 0; c < 3; c++)
                node[c] = mass > 0.0 ? node[c] / mass : 0.0;
            node[BACK_DIVERGENCE] = mass > 0.0 ? node[BACK_DIVERGENCE] / mass : 0.0;
        }
}
