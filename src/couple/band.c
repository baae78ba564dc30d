/* From particles to the cells that the gas looks at (4-1) to (4-6): means over the particles around
 * each, over the volume that the same weights give (smear.h). */
#include <string.h>

#include "base/memory.h"
#include "couple/cfdmp.h"
#include "material/material.h"

static void put_cell(const struct gas_view *view, const struct smear_sums *sums, int32_t i)
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

/* How far X is from the nearest open face, in cells. */
static double depth_at(const struct cfdmp *cfdmp, const double x[3])
{
    double least = INFINITY;
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int side = 0; side < 2; side++) {
            const double plane = (double)(side ? cfdmp->cut.high : cfdmp->cut.low)[axis];
            if (cfdmp->cut.open[axis][side])
                least = minimum(least, fabs(x[axis] / cfdmp->edge - plane));
        }
    return least;
}

/* The error of a solid particle that has come to the overlap: gas computes no solids. */
static struct error *solid_error(const struct cfdmp *cfdmp, int32_t i)
{
    const struct particles *p = mpm_particles(cfdmp->mpm);
    const struct simulation_case *input = cfdmp->mpm_part.place.input;
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

/* A walk over the particles near the band: those that the gas computes count. */
struct looking {
    const struct cfdmp *cfdmp;
    int material[2];
    bool solid; /* has been seen there, where none must be */
};

static bool counts(void *context, int32_t i)
{
    struct looking *looking = context;
    const struct particles *p = mpm_particles(looking->cfdmp->mpm);
    enum { REACH = 2 }; /* of a particle, in cells */
    const double depth = depth_at(looking->cfdmp, p->position[i]),
                 band = (double)looking->cfdmp->parameters.overlap;
    if (!(depth < band + (double)(cfdmp_band_depth(looking->cfdmp->dimension) + REACH)))
        return false;
    if (p->material[i] == looking->material[0] || p->material[i] == looking->material[1])
        return depth > band - REACH;
    if (depth < band)
#pragma omp atomic write
        looking->solid = true;
    return false;
}

/* The error of the first solid particle that is in the overlap. */
static struct error *find_solid(const struct looking *looking)
{
    const struct particles *p = mpm_particles(looking->cfdmp->mpm);
    struct error *error = NULL;
    for (int32_t i = 0; i < p->count && !error; i++)
        if (p->material[i] != looking->material[0] && p->material[i] != looking->material[1])
            error = solid_error(looking->cfdmp, i);
    return error;
}

/* Where the cells of the band are that this rank has. */
static void find_own(struct cfdmp *cfdmp)
{
    const struct cell_blocks *cells = gas_view(cfdmp->gas).cells;
    if (cfdmp->own_order == cells->order)
        return;
    cfdmp->own_order = cells->order;
    for (int axis = 0; axis < 3; axis++) {
        cfdmp->own_from[axis] = cfdmp->count[axis];
        cfdmp->own_to[axis] = 0;
    }
    for (int64_t n = 0; n < cfdmp->band_cells; n++) {
        int32_t block;
        if (part_cell(cells, cfdmp->band[n], &block) < 0)
            continue;
        for (int axis = 0; axis < 3; axis++) {
            const int64_t at = cfdmp->band[n][axis] - cfdmp->cut.low[axis];
            if (at < cfdmp->own_from[axis])
                cfdmp->own_from[axis] = at;
            if (at >= cfdmp->own_to[axis])
                cfdmp->own_to[axis] = at + 1;
        }
    }
}

/* The cells of the band take what SUMS have. */
static void put_band(struct cfdmp *cfdmp, const struct smear_sums *sums, int threads)
{
    const struct gas_view view = gas_view(cfdmp->gas);
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int64_t n = 0; n < cfdmp->band_cells; n++) {
        int32_t block;
        const int32_t i = part_cell(view.cells, cfdmp->band[n], &block);
        if (i < 0)
            continue;
        put_cell(&view, &sums[n], i);
#pragma omp atomic write
        cfdmp->changed[block] = true;
    }
}

struct error *cfdmp_fill_band(struct cfdmp *cfdmp)
{
    const struct simulation *simulation = &cfdmp->mpm_part.simulation;
    const struct gas_view view = gas_view(cfdmp->gas);
    const int threads = simulation->threads;
    struct smear smear = {.shape = mpm_shape(cfdmp->mpm),
                          .edge = cfdmp->edge,
                          .dimension = cfdmp->dimension,
                          .number = cfdmp->band_of};
    struct looking looking = {cfdmp, {view.material[0], view.material[1]}, false};
    memcpy(smear.low, cfdmp->cut.low, sizeof smear.low);
    memcpy(smear.count, cfdmp->count, sizeof smear.count);
    find_own(cfdmp);
    memcpy(smear.from, cfdmp->own_from, sizeof smear.from);
    memcpy(smear.to, cfdmp->own_to, sizeof smear.to);
    TRY(crowd_gather(&cfdmp->crowd, cfdmp->mpm, &view, simulation, counts, &looking));
    struct error *error = looking.solid ? find_solid(&looking) : NULL;
    if (!error && !memory_reserve((void **)&cfdmp->sums, &cfdmp->sums_capacity,
                                  cfdmp->band_cells + 1, 0, sizeof *cfdmp->sums))
        error = out_of_memory_for("the coupling");
    TRY(ranks_agree(cfdmp->ranks, error));
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int64_t n = 0; n < cfdmp->band_cells; n++)
        cfdmp->sums[n] = (struct smear_sums){.kinetic = 0.0};
    if (smear.from[0] < smear.to[0]) /* this rank has some */
        smear_crowd(&smear, &cfdmp->crowd, threads, cfdmp->sums);
    put_band(cfdmp, cfdmp->sums, threads);
    return NULL;
}
