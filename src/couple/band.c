/* From particles to the cells that the gas looks at (4-1) to (4-6): means over the particles around
 * each, over the volume that the same weights give (smear.h). */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "couple/cfdmp.h"
#include "couple/smear.h"
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

/* Of a walk over the particles near the band: those that the gas computes count; solids must not
 * be here. */
struct looking {
    const struct cfdmp *cfdmp;
    int material[2];
    struct error *error;
};

static bool counts(void *context, int32_t i)
{
    struct looking *looking = context;
    const struct particles *p = mpm_particles(looking->cfdmp->mpm);
    enum { REACH = 2 }; /* of a particle, in cells */
    const double depth = depth_at(looking->cfdmp, p->position[i]),
                 band = (double)looking->cfdmp->parameters.overlap;
    if (looking->error ||
        !(depth < band + (double)(cfdmp_band_depth(looking->cfdmp->dimension) + REACH)))
        return false;
    if (p->material[i] == looking->material[0] || p->material[i] == looking->material[1])
        return depth > band - REACH;
    looking->error = check_solid(looking->cfdmp, i);
    return false;
}

struct error *cfdmp_fill_band(struct cfdmp *cfdmp)
{
    const struct gas_view view = gas_view(cfdmp->gas);
    struct smear smear = {.shape = mpm_shape(cfdmp->mpm),
                          .edge = cfdmp->edge,
                          .dimension = cfdmp->dimension,
                          .number = cfdmp->band_of};
    struct looking looking = {cfdmp, {view.material[0], view.material[1]}, NULL};
    struct smeared *all = NULL;
    struct keyed *order = NULL;
    int64_t count = 0;
    memcpy(smear.low, cfdmp->cut.low, sizeof smear.low);
    memcpy(smear.count, cfdmp->count, sizeof smear.count);
    struct error *error =
        smear_gather(cfdmp->mpm, &view, cfdmp->ranks, counts, &looking, &all, &count, &order);
    error = ranks_agree(cfdmp->ranks, error_join(error, looking.error));
    struct smear_sums *sums =
        error ? NULL : memory_allocate(((size_t)cfdmp->band_cells + 1) * sizeof *sums);
    for (int64_t n = 0; n < cfdmp->band_cells && sums; n++)
        sums[n] = (struct smear_sums){.kinetic = 0.0};
    for (int64_t k = 0; k < count && sums; k++)
        smear_particle(&smear, &all[order[k].index], sums);
    for (int64_t n = 0; n < cfdmp->band_cells && sums; n++) {
        int32_t block;
        const int32_t i = part_cell(view.cells, cfdmp->band[n], &block);
        if (i < 0)
            continue;
        put_cell(&view, &sums[n], i);
        cfdmp->changed[block] = true;
    }
    error = sums || error ? error : owned_error();
    free(all);
    free(order);
    free(sums);
    return ranks_agree(cfdmp->ranks, error);
}
