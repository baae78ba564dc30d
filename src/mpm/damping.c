/* Shear-mode damping of fluids: nothing else resists the shear that a grid makes by itself.
 *
 * The velocity at the corners of a cell has modes; S_ik = sum_I L_kI v_iI for k != i are those of
 * shear, L_k the corner's sign along axis k. A corner gets the force -a S_ik L_kI, a = (sum m/h) Q
 * c/4 in three dimensions (2-46)-(2-48). In a plane a cell has half as many corners a layer, which
 * makes it 4 a. What the force takes heats the particles. Source: Cui, dissertation (2014), section
 * 2.4. */
#include <string.h>

#include "material/material.h"
#include "mpm/mpm_internal.h"

enum { CORNERS_MAX = 8 };

/* The corners of a cell: where they stand in the patch, and on which side along each axis. */
struct corners {
    int count;
    size_t node[CORNERS_MAX];
    double side[3][CORNERS_MAX];
};

/* Of the cell between nodes that begins LOW nodes before the one with the index of CELL of the
 * patch. */
static struct corners corners_of(const struct grid *grid, int cell, const int low[3])
{
    struct corners corners = {.count = 1 << grid->dimension};
    int place[3];
    bin_cell_place(grid->dimension, cell, place);
    for (int c = 0; c < corners.count; c++) {
        size_t node = 0;
        for (int axis = 0; axis < grid->dimension; axis++) {
            const int high = c >> axis & 1;
            node =
                node * (size_t)grid->side + (size_t)(place[axis] + grid->reach - low[axis] + high);
            corners.side[axis][c] = high ? 1.0 : -1.0;
        }
        corners.node[c] = node;
    }
    return corners;
}

/* The parts of a cell of a bin that lie in different cells between nodes: one, or where cells are
 * centred on nodes 2^dimension, bit k of the number set on the low side of the node along axis
 * k. */
struct parts {
    int count;
    double strength[CORNERS_MAX]; /* mass times Q c/h, 0 of a part that holds a solid */
};

static struct parts parts_of(const struct mpm *mpm, const struct simulation *simulation,
                             const int64_t index[3], const int32_t *list, int32_t count)
{
    const struct particles *p = mpm->particles;
    const double *sound = mpm_fields_of(mpm).sound_long;
    const double factor = mpm->parameters.shear_damping / mpm->edge *
                          (simulation->problem->dimension == 3 ? 0.25 : 1.0);
    const bool centred = p->shift > 0.0;
    struct parts parts = {centred ? 1 << simulation->problem->dimension : 1, {0.0}};
    bool solid[CORNERS_MAX] = {false};
    for (int32_t k = 0; k < count; k++) {
        const int32_t i = list[k];
        int part = 0;
        for (int axis = 0; axis < 3 && axis < simulation->problem->dimension && centred; axis++)
            part |= (p->position[i][axis] < (double)index[axis] * mpm->edge) << axis;
        solid[part] |= material_has_strength(&simulation->problem->material[p->material[i]]);
        parts.strength[part] += factor * p->mass[i] * sound[i];
    }
    for (int part = 0; part < parts.count; part++)
        if (solid[part])
            parts.strength[part] = 0.0;
    return parts;
}

/* Adds the forces of a cell to PATCH. */
static void damp_cell(const struct mpm *mpm, int dimension, const struct corners *corners,
                      double strength, const double *nodes, double *patch)
{
    double shear[3][3] = {{0}};
    for (int c = 0; c < corners->count; c++) {
        const double *node = nodes + corners->node[c] * NODE_STRIDE;
        for (int i = 0; i < dimension && node[NODE_MASS] > 0.0; i++)
            for (int k = 0; k < dimension; k++)
                shear[i][k] += corners->side[k][c] * node[NODE_MOMENTUM + i] / node[NODE_MASS];
    }
    for (int i = 0; i < dimension; i++)
        for (int k = 0; k < dimension; k++) {
            if (i == k)
                continue;
            const double s = mpm->parameters.damping == MPM_DAMPING_SYMMETRIC
                                 ? 0.5 * (shear[i][k] + shear[k][i])
                                 : shear[i][k];
            for (int c = 0; c < corners->count; c++)
                patch[corners->node[c] * BACK_STRIDE + (size_t)i] -=
                    strength * s * corners->side[k][c];
        }
}

static void damp_bin(const struct mpm *mpm, const struct simulation *simulation,
                     struct layer *layer, int32_t b)
{
    const struct bin *bin = &layer->bins.bin[b];
    const int dimension = layer->grid.dimension;
    double *nodes = grid_patch(&layer->grid, &layer->main, b),
           *patch = grid_patch(&layer->grid, &layer->back, b);
    int64_t block[3];
    block_coordinates(bin->key, block);
    grid_spread(&layer->grid, &layer->main, b);
    memset(patch, 0, (size_t)(layer->grid.patch * BACK_STRIDE) * sizeof *patch);
    for (int cell = 0; cell < BLOCK_CELLS; cell++) {
        int place[3];
        bin_cell_place(dimension, cell, place);
        const int64_t index[3] = {block[0] * block_cells(dimension) + place[0],
                                  block[1] * block_cells(dimension) + place[1],
                                  block[2] * block_cells(dimension) + place[2]};
        const struct parts parts =
            parts_of(mpm, simulation, index, layer->bins.list + bin->first + bin->cell[cell],
                     bin->cell[cell + 1] - bin->cell[cell]);
        for (int part = 0; part < parts.count; part++) {
            const int low[3] = {part & 1, part >> 1 & 1, part >> 2 & 1};
            if (!(parts.strength[part] > 0.0))
                continue;
            const struct corners corners = corners_of(&layer->grid, cell, low);
            damp_cell(mpm, dimension, &corners, parts.strength[part], nodes, patch);
        }
    }
}

/* What the forces take from the motion in a step of DT. */
static void find_heat(struct layer *layer, int32_t block, double dt)
{
    for (int k = 0; k < BLOCK_CELLS; k++) {
        const double *node = grid_node(&layer->main, block, k), mass = node[NODE_MASS];
        double *force = grid_node(&layer->back, block, k), work = 0.0;
        for (int c = 0; c < 3 && mass > 0.0; c++)
            work +=
                dt * force[c] * (node[NODE_MOMENTUM + c] + 0.5 * dt * node[NODE_FORCE + c]) / mass;
        force[BACK_HEAT] = mass > 0.0 ? -work / mass : 0.0;
    }
}

static void add_forces(const struct mpm *mpm, const struct simulation *simulation,
                       struct layer *layer, double dt)
{
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        grid_reduce(&layer->grid, &layer->back, n);
    mpm_add_forces(mpm, simulation, layer);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        find_heat(layer, n, dt);
    mpm_warm(mpm, simulation, layer, NULL);
}

void mpm_damp_shear(struct mpm *mpm, struct simulation *simulation, double dt)
{
    if (!(mpm->parameters.shear_damping > 0.0) || simulation->problem->dimension == 1)
        return;
    for (int g = 0; g < mpm->layers; g++) {
        struct layer *layer = &mpm->layer[g];
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
        for (int32_t b = 0; b < layer->bins.count; b++)
            if (!mpm_is_far(mpm, layer, b) && !layer->prescribed)
                damp_bin(mpm, simulation, layer, b);
    }
    mpm_exchange(mpm, simulation, offsetof(struct layer, back));
    for (int g = 0; g < mpm->layers; g++)
        if (!mpm->layer[g].prescribed)
            add_forces(mpm, simulation, &mpm->layer[g], dt);
}
