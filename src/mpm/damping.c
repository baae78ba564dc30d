/* Shear-mode damping of fluids: nothing else resists the shear that a grid makes by itself.
 *
 * The velocity at the corners of a cell has modes; S_ik = sum_I L_kI v_iI for k != i are those of shear, L_k the corner's
 * sign along axis k. A corner gets the force -a S_ik L_kI, a = (sum m/h) Q c/4 in three dimensions (2-46)-(2-48). In a
 * plane a cell has half as many corners a layer, which makes it 4 a. What the force takes heats the particles.
 * Source: Cui, dissertation (2014), section 2.4. */
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

static struct corners corners_of(const struct grid *grid, int cell)
{
    struct corners corners = {.count = 1 << grid->dimension};
    int place[3];
    bin_cell_place(grid->dimension, cell, place);
    for (int c = 0; c < corners.count; c++) {
        size_t node = 0;
        for (int axis = 0; axis < grid->dimension; axis++) {
            const int high = c >> axis & 1;
            node = node * (size_t)grid->side + (size_t)(place[axis] + grid->reach + high);
            corners.side[axis][c] = high ? 1.0 : -1.0;
        }
        corners.node[c] = node;
    }
    return corners;
}

/* Mass times Q c/h of a cell of fluid, *mass its mass; 0 when it holds a solid. */
static double strength_of(const struct mpm *mpm, const struct simulation *simulation,
                          const double *sound, const int32_t *list, int32_t count, double *mass)
{
    const struct particles *p = &simulation->particles;
    double sum = 0.0;
    *mass = 0.0;
    for (int32_t k = 0; k < count; k++) {
        const int32_t i = list[k];
        if (material_has_strength(&simulation->material[p->material[i]]))
            return 0.0;
        *mass += p->mass[i];
        sum += p->mass[i] * sound[i];
    }
    return sum * mpm->parameters.shear_damping / mpm->edge *
           (simulation->dimension == 3 ? 0.25 : 1.0);
}

/* Adds the forces of a cell to PATCH, and returns the power that they take. */
static double damp_cell(const struct mpm *mpm, int dimension, const struct corners *corners,
                        double strength, const double *nodes, double *patch)
{
    double shear[3][3] = {{0}}, power = 0.0;
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
            power += strength * s * shear[i][k];
            for (int c = 0; c < corners->count; c++)
                patch[corners->node[c] * BACK_STRIDE + (size_t)i] -=
                    strength * s * corners->side[k][c];
        }
    return power;
}

static void damp_bin(const struct mpm *mpm, struct simulation *simulation, struct layer *layer,
                     int32_t b, double dt)
{
    const struct bin *bin = &layer->bins.bin[b];
    const double *sound = mpm_fields_of(mpm, simulation).sound_long;
    double *nodes = grid_patch(&layer->grid, &layer->main, b),
           *patch = grid_patch(&layer->grid, &layer->back, b);
    grid_spread(&layer->grid, &layer->main, b);
    memset(patch, 0, (size_t)(layer->grid.patch * BACK_STRIDE) * sizeof *patch);
    for (int cell = 0; cell < BLOCK_CELLS; cell++) {
        const int32_t *list = layer->bins.list + bin->first + bin->cell[cell];
        const int32_t count = bin->cell[cell + 1] - bin->cell[cell];
        double mass, strength = strength_of(mpm, simulation, sound, list, count, &mass);
        if (!(strength > 0.0))
            continue;
        const struct corners corners = corners_of(&layer->grid, cell);
        const double heat =
            dt * damp_cell(mpm, layer->grid.dimension, &corners, strength, nodes, patch) / mass;
        for (int32_t k = 0; k < count; k++)
            simulation->particles.energy[list[k]] += heat;
    }
}

static void add_forces(const struct mpm *mpm, const struct simulation *simulation,
                       struct layer *layer)
{
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        grid_reduce(&layer->grid, &layer->back, n);
    mpm_add_forces(mpm, simulation, layer);
}

void mpm_damp_shear(struct mpm *mpm, struct simulation *simulation, double dt)
{
    if (!(mpm->parameters.shear_damping > 0.0) || simulation->dimension == 1)
        return;
    for (int g = 0; g < mpm->layers; g++) {
        struct layer *layer = &mpm->layer[g];
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
        for (int32_t b = 0; b < layer->bins.count; b++)
            if (!mpm_is_far(mpm, layer, b) && !layer->held)
                damp_bin(mpm, simulation, layer, b, dt);
    }
    mpm_exchange(mpm, simulation, offsetof(struct layer, back));
    for (int g = 0; g < mpm->layers; g++)
        if (!mpm->layer[g].held)
            add_forces(mpm, simulation, &mpm->layer[g]);
}
