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
    enum { REACH = 3 }; /* of a particle, in cells */
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

/* A particle as other ranks get it. */
struct shown {
    uint64_t id;
    double position[3], velocity[3], mass, density, energy, half;
    int64_t which; /* of the materials of the gas */
};

static int by_id(const void *left, const void *right)
{
    const struct shown *a = left, *b = right;
    return (a->id > b->id) - (a->id < b->id);
}

/* Collective: the particles of all ranks near the band, in the order of their ids; the caller frees
 * them. */
static struct error *show_near(const struct cfdmp *cfdmp, struct shown **all, int64_t *count)
{
    const struct particles *p = mpm_particles(cfdmp->mpm);
    const struct gas_view view = gas_view(cfdmp->gas);
    struct looking looking = {cfdmp, {view.material[0], view.material[1]}, NULL};
    struct shown *own = memory_allocate(((size_t)p->count + 1) * sizeof *own);
    struct error *error = own ? NULL : owned_error();
    int64_t near = 0;
    for (int32_t i = 0; own && i < p->count; i++) {
        if (!counts(&looking, i))
            continue;
        struct shown *shown = &own[near++];
        *shown = (struct shown){.id = p->id[i],
                                .mass = p->mass[i],
                                .density = p->density[i],
                                .energy = p->energy[i],
                                .half = mpm_half_size(cfdmp->mpm, p->body[i]),
                                .which = view.layout->two && p->material[i] == view.material[1]};
        memcpy(shown->position, p->position[i], sizeof shown->position);
        memcpy(shown->velocity, p->velocity[i], sizeof shown->velocity);
    }
    error = ranks_agree(cfdmp->ranks, error_join(error, looking.error));
    if (!error)
        error = ranks_gather(cfdmp->ranks, -1, own, near, sizeof *own, (void **)all, count);
    free(own);
    if (!error)
        qsort(*all, (size_t)*count, sizeof **all, by_id);
    return error;
}

struct error *cfdmp_fill_band(struct cfdmp *cfdmp)
{
    const struct gas_view view = gas_view(cfdmp->gas);
    struct smear smear = {.shape = mpm_shape(cfdmp->mpm),
                          .edge = cfdmp->edge,
                          .dimension = cfdmp->dimension,
                          .number = cfdmp->band_of};
    struct shown *all = NULL;
    int64_t count = 0;
    memcpy(smear.low, cfdmp->cut.low, sizeof smear.low);
    memcpy(smear.count, cfdmp->count, sizeof smear.count);
    TRY(show_near(cfdmp, &all, &count));
    struct smear_sums *sums = memory_allocate(((size_t)cfdmp->band_cells + 1) * sizeof *sums);
    for (int64_t n = 0; n < cfdmp->band_cells && sums; n++)
        sums[n] = (struct smear_sums){.kinetic = 0.0};
    struct particles one = {.dimension = cfdmp->dimension}; /* a store of one */
    smear.particles = &one;
    for (int64_t k = 0; k < count && sums; k++) {
        struct shown *shown = &all[k];
        one.position = &shown->position;
        one.velocity = &shown->velocity;
        one.mass = &shown->mass;
        one.density = &shown->density;
        one.energy = &shown->energy;
        smear_particle(&smear, 0, (int)shown->which, shown->half, sums);
    }
    for (int64_t n = 0; n < cfdmp->band_cells && sums; n++) {
        int32_t block;
        const int32_t i = part_cell(view.cells, cfdmp->band[n], &block);
        if (i < 0)
            continue;
        put_cell(&view, &sums[n], i);
        cfdmp->changed[block] = true;
    }
    struct error *error = sums ? NULL : owned_error();
    free(all);
    free(sums);
    return ranks_agree(cfdmp->ranks, error);
}
