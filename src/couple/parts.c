/* The places of both parts of a coupled run, and the faces and the band of its region. */
#include <stdlib.h>

#include "base/memory.h"
#include "couple/cfdmp.h"
#include "material/material.h"

/* Blocks the cells behind the band. */
static void block_inside(struct cfdmp *cfdmp)
{
    int64_t low[3], high[3];
    for (int axis = 0; axis < 3; axis++) {
        int64_t at[2];
        cfdmp_blocked(cfdmp, axis, at);
        low[axis] = at[0];
        high[axis] = at[1];
    }
    part_block(&cfdmp->maker, &cfdmp->gas_part, low, high);
}

static struct error *make_gas_part(struct cfdmp *cfdmp, const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    struct coupled_part *part = &cfdmp->gas_part;
    TRY(part_begin(&cfdmp->maker, part, input));
    part->place.resolution = cfdmp->edge;
    for (int b = 0; b < input->bodies.count; b++)
        part->elsewhere[b] = is_solid(input, b);
    const struct cell_blocks domain = part_domain(input, cfdmp->edge);
    TRY(cfdmp_find_region(cfdmp, input, &domain));
    TRY(cfdmp_check_region(cfdmp, input));
    block_inside(cfdmp);
    part_pin(&cfdmp->maker, &part->place, 0, cfdmp->cut.low, cfdmp->cut.high);
    TRY(part_create(&cfdmp->maker, part, simulation, &gas_class, &cfdmp->parameters.gas));
    cfdmp->gas = part->solver;
    return NULL;
}

static struct error *make_mpm_part(struct cfdmp *cfdmp, const struct simulation *simulation)
{
    struct coupled_part *part = &cfdmp->mpm_part;
    TRY(part_begin(&cfdmp->maker, part, simulation->problem->input));
    part_cut_bodies(&cfdmp->maker, part, cfdmp->cut.low, cfdmp->cut.high);
    part_close_faces(&cfdmp->maker, part, &cfdmp->cut, &simulation->problem->place);
    TRY(part_create(&cfdmp->maker, part, simulation, &mpm_class, &cfdmp->parameters.mpm));
    cfdmp->mpm = part->solver;
    mpm_limit_by_nodes(cfdmp->mpm);
    return NULL;
}

/* The least number of cells from AT, a place in the region, to an open face. */
static int64_t depth_of(const struct cfdmp *cfdmp, const int64_t at[3])
{
    int64_t depth = INT64_MAX;
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int side = 0; side < 2; side++) {
            const int64_t here = side ? cfdmp->count[axis] - 1 - at[axis] : at[axis];
            if (cfdmp->cut.open[axis][side] && here < depth)
                depth = here;
        }
    return depth;
}

static struct error *find_band(struct cfdmp *cfdmp)
{
    const int64_t from = cfdmp->parameters.overlap, to = from + cfdmp_band_depth(cfdmp->dimension);
    const int64_t *n = cfdmp->count;
    const int64_t all = n[0] * n[1] * n[2];
    cfdmp->band_of = owned_new(&cfdmp->owned, (size_t)all * sizeof *cfdmp->band_of);
    if (!cfdmp->band_of)
        return out_of_memory_for("the coupling");
    for (int pass = 0; pass < 2; pass++) {
        int64_t at[3], k = 0;
        cfdmp->band_cells = 0;
        for (at[2] = 0; at[2] < n[2]; at[2]++)
            for (at[1] = 0; at[1] < n[1]; at[1]++)
                for (at[0] = 0; at[0] < n[0]; at[0]++, k++) {
                    const int64_t depth = depth_of(cfdmp, at);
                    const bool in_band = depth >= from && depth < to;
                    cfdmp->band_of[k] = in_band ? (int32_t)cfdmp->band_cells : -1;
                    for (int axis = 0; axis < 3 && in_band && pass; axis++)
                        cfdmp->band[cfdmp->band_cells][axis] = cfdmp->cut.low[axis] + at[axis];
                    cfdmp->band_cells += in_band;
                }
        if (pass == 0) {
            cfdmp->band =
                owned_new(&cfdmp->owned, ((size_t)cfdmp->band_cells + 1) * sizeof *cfdmp->band);
            if (!cfdmp->band)
                return out_of_memory_for("the coupling");
        }
    }
    return NULL;
}

static struct error *make_sides(struct cfdmp *cfdmp)
{
    int64_t most = 0;
    for (int axis = 0; axis < 3; axis++)
        for (int s = 0; s < 2; s++) {
            struct side *side = &cfdmp->side[axis][s];
            if (!cfdmp->cut.open[axis][s])
                continue;
            side->gates = 1;
            for (int other = 0; other < 3; other++)
                side->gates *= other == axis ? 1 : cfdmp->count[other];
            side->gate = owned_new(&cfdmp->owned, (size_t)side->gates * sizeof *side->gate);
            cfdmp->cut.passed[axis][s] =
                owned_new(&cfdmp->owned, (size_t)(side->gates * GAS_PASSED) * sizeof(double));
            side->flank = owned_new(&cfdmp->owned, (size_t)side->gates * sizeof *side->flank);
            side->rest = owned_new(&cfdmp->owned, (size_t)side->gates * sizeof *side->rest);
            if (!side->gate || !cfdmp->cut.passed[axis][s] || !side->flank || !side->rest)
                return out_of_memory_for("the coupling");
            most = side->gates > most ? side->gates : most;
        }
    cfdmp->bits = owned_new(&cfdmp->owned, (size_t)most * sizeof *cfdmp->side[0][0].flank);
    return cfdmp->bits ? NULL : out_of_memory_for("the coupling");
}

struct error *cfdmp_make_parts(struct cfdmp *cfdmp, struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    cfdmp->ranks = simulation->ranks;
    cfdmp->dimension = simulation->problem->dimension;
    cfdmp->round = geometry_power(simulation->problem->geometry) > 0;
    cfdmp->edge = part_edge(&cfdmp->parameters.mpm, input);
    cfdmp->maker = (struct part_maker){&cfdmp->owned, cfdmp->edge, cfdmp->dimension};
    TRY(make_gas_part(cfdmp, simulation));
    TRY(make_mpm_part(cfdmp, simulation));
    for (int axis = 0; axis < 3; axis++)
        cfdmp->count[axis] = cfdmp->cut.high[axis] - cfdmp->cut.low[axis];
    TRY(find_band(cfdmp));
    return make_sides(cfdmp);
}

void cfdmp_free_parts(struct cfdmp *cfdmp)
{
    part_free(&cfdmp->gas_part, &gas_class);
    part_free(&cfdmp->mpm_part, &mpm_class);
    owned_free(&cfdmp->owned);
    crowd_free(&cfdmp->crowd);
    free(cfdmp->sums);
    free(cfdmp->leaving.index);
    free(cfdmp->changed);
    free(cfdmp->push);
}
