/* From particles to the cells that the gas looks at: means over the particles around each, with
 * weights that fall off as shape functions at its nodes do, N_Ic N_I(x) summed over these (4-1) to
 * (4-6), over the volume that the same weights give. */
#include <stdlib.h>

#include "base/memory.h"
#include "couple/cfdmp.h"
#include "material/material.h"

/* The weight of a particle at R, in cells from the centre of the cell, along one axis. */
static double weight(enum grid_shape shape, double r, double half)
{
    return 0.5 * (shape_value(shape, r - 0.5, half) + shape_value(shape, r + 0.5, half));
}

/* What is summed over the particles of a cell; the materials are those of the gas solver. */
struct sums {
    double volume[2], mass[2], energy[2], momentum[3];
};

static void add_particle(const struct cfdmp *cfdmp, int32_t i, int which, double half,
                         struct sums *sums)
{
    enum { REACH = 2, SPAN = 2 * REACH + 1 };
    const struct particles *p = mpm_particles(cfdmp->mpm);
    const double *x = p->position[i], *u = p->velocity[i];
    int64_t cell[3] = {0, 0, 0};
    double w[3][SPAN];
    int span[3] = {1, 1, 1}, reach[3] = {0, 0, 0};
    for (int axis = 0; axis < 3; axis++) {
        w[axis][0] = 1.0;
        if (axis >= cfdmp->dimension)
            continue;
        const double place = x[axis] / cfdmp->edge;
        cell[axis] = (int64_t)floor(place) - cfdmp->cut.low[axis];
        span[axis] = SPAN;
        reach[axis] = REACH;
        for (int k = 0; k < SPAN; k++)
            w[axis][k] = weight(mpm_shape(cfdmp->mpm),
                                place - floor(place) - 0.5 - (double)(k - REACH), half);
    }
    int64_t at[3];
    for (int c = 0; c < span[2]; c++)
        for (int b = 0; b < span[1]; b++)
            for (int a = 0; a < span[0]; a++) {
                const int k[3] = {a, b, c};
                bool inside = true;
                for (int axis = 0; axis < 3; axis++) {
                    at[axis] = cell[axis] + k[axis] - reach[axis];
                    inside &= at[axis] >= 0 && at[axis] < cfdmp->count[axis];
                }
                const double part = w[0][a] * w[1][b] * w[2][c];
                const int32_t n =
                    !inside || part == 0.0
                        ? -1
                        : cfdmp->band_of[at[0] +
                                         cfdmp->count[0] * (at[1] + cfdmp->count[1] * at[2])];
                if (n < 0)
                    continue;
                const double mass = part * p->mass[i];
                sums[n].volume[which] += mass / p->density[i];
                sums[n].mass[which] += mass;
                sums[n].energy[which] += mass * p->energy[i];
                for (int axis = 0; axis < 3; axis++)
                    sums[n].momentum[axis] += mass * u[axis];
            }
}

static void put_cell(const struct gas_view *view, const struct sums *sums, int32_t i)
{
    const double volume = sums->volume[0] + sums->volume[1], mass = sums->mass[0] + sums->mass[1];
    if (!(mass > 0.0))
        return;
    double kinetic = 0.0;
    view->u[GAS_DENSITY][i] = mass / volume;
    for (int axis = 0; axis < 3; axis++) {
        view->u[GAS_MOMENTUM + axis][i] = sums->momentum[axis] / volume;
        kinetic += 0.5 * square(sums->momentum[axis] / volume) / (mass / volume);
    }
    view->u[GAS_ENERGY][i] = (sums->energy[0] + sums->energy[1]) / volume + kinetic;
    if (view->layout->two) {
        view->u[GAS_SECOND][i] = sums->mass[1] / volume;
        view->u[GAS_FRACTION][i] = sums->volume[1] / volume;
    }
    if (view->layout->lit)
        view->u[view->layout->burnt][i] = 1.0;
}

static int by_id(const void *left, const void *right)
{
    const uint64_t a = *(const uint64_t *)left, b = *(const uint64_t *)right;
    return (a > b) - (a < b);
}

/* Whether a particle at X may count for the band. */
static bool is_near(const struct cfdmp *cfdmp, const double x[3])
{
    enum { REACH = 3 };
    const double depth = (double)(cfdmp->parameters.overlap + 2 * cfdmp->dimension + REACH);
    bool near = false;
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int side = 0; side < 2; side++) {
            const double plane = (double)(side ? cfdmp->cut.high : cfdmp->cut.low)[axis];
            near |= cfdmp->cut.open[axis][side] && fabs(x[axis] / cfdmp->edge - plane) < depth;
        }
    return near;
}

/* The error of a solid particle that has come to the overlap: gas computes no solids. */
static struct error *check_solid(const struct cfdmp *cfdmp, int32_t i)
{
    const struct particles *p = mpm_particles(cfdmp->mpm);
    const struct simulation_case *input = &cfdmp->mpm_part.input;
    const double *x = p->position[i];
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int side = 0; side < 2; side++) {
            const double plane = (double)(side ? cfdmp->cut.high : cfdmp->cut.low)[axis],
                         way = fabs(x[axis] / cfdmp->edge - plane);
            if (cfdmp->cut.open[axis][side] && way < (double)cfdmp->parameters.overlap)
                return error_new(
                    ERROR_STATE,
                    "step %lld, t = %.6g s: the solid \"%s\" has come to (%.6g, %.6g, %.6g) m, "
                    "into "
                    "the overlap of gas and material points at the face %c = %.6g m of the region: "
                    "the gas cannot see it there; enlarge the `region` of the solver",
                    (long long)cfdmp->mpm_part.simulation.step + 1, cfdmp->mpm_part.simulation.time,
                    input->bodies.names[p->body[i]], x[0], x[1], x[2], "xyz"[axis],
                    plane * cfdmp -> edge);
        }
    return NULL;
}

struct error *cfdmp_fill_band(struct cfdmp *cfdmp)
{
    struct key {
        uint64_t id;
        int32_t i;
    };
    const struct particles *p = mpm_particles(cfdmp->mpm);
    const struct gas_view view = gas_view(cfdmp->gas);
    struct key *key = memory_allocate(((size_t)p->count + 1) * sizeof *key);
    struct sums *sums = memory_allocate(((size_t)cfdmp->band_cells + 1) * sizeof *sums);
    if (!key || !sums) {
        free(key);
        free(sums);
        return error_new(ERROR_SYSTEM, "out of memory for the cells beside particles");
    }
    int32_t near = 0;
    struct error *error = NULL;
    for (int32_t i = 0; i < p->count && !error; i++) {
        if (!is_near(cfdmp, p->position[i]))
            continue;
        if (p->material[i] == view.material[0] || p->material[i] == view.material[1])
            key[near++] = (struct key){p->id[i], i};
        else
            error = check_solid(cfdmp, i);
    }
    if (error) {
        free(key);
        free(sums);
        return error;
    }
    qsort(key, (size_t)near, sizeof *key, by_id);
    for (int64_t n = 0; n < cfdmp->band_cells; n++)
        sums[n] = (struct sums){{0.0}, {0.0}, {0.0}, {0.0}};
    for (int32_t k = 0; k < near; k++) {
        const int32_t i = key[k].i;
        const int which = view.layout->two && p->material[i] == view.material[1];
        add_particle(cfdmp, i, which, mpm_half_size(cfdmp->mpm, p->body[i]), sums);
    }
    for (int64_t n = 0; n < cfdmp->band_cells; n++) {
        int32_t block;
        put_cell(&view, &sums[n], cfdmp_cell(view.cells, cfdmp->band[n], &block));
        cfdmp->changed[block] = true;
    }
    free(key);
    free(sums);
    return NULL;
}
