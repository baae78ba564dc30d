/* Between the stages of afdmp: the particles of the nest become the state of cells (3-3) to (3-8),
 * and cells become particles (3-14) to (3-20). */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "couple/afdmp.h"
#include "couple/gates.h"
#include "couple/smear.h"
#include "material/material.h"

static bool all(void *context, int32_t i)
{
    (void)context;
    (void)i;
    return true;
}

void afdmp_burn_all(struct afdmp *afdmp)
{
    const struct gas_view view = gas_view(afdmp->gas);
    for (int32_t i = 0; i < view.cells->count && view.layout->lit; i++)
        view.u[view.layout->burnt][i] = 1.0;
}

/* Energy of particles by the cell that they lie in. */
static void sum_energy(const struct smear *smear, const struct smeared *particle, double *energy)
{
    int64_t n = 0;
    for (int axis = 2; axis >= 0; axis--) {
        int64_t at = 0;
        if (axis < smear->dimension)
            at = (int64_t)floor(particle->position[axis] / smear->edge) - smear->low[axis];
        at = at < 0 ? 0 : at >= smear->count[axis] ? smear->count[axis] - 1 : at;
        n = n * smear->count[axis] + at;
    }
    energy[n] += particle->mass * particle->energy;
}

/* The fraction of volume that the second material has when both have come to one pressure, each
 * with HEAT more energy by its mass. */
static double fraction_of(const struct gas_view *view, const struct smear_sums *sums, double heat,
                          double volume)
{
    const double fraction = sums->volume[1] / (sums->volume[0] + sums->volume[1]);
    double mass[2], energy[2];
    for (int m = 0; m < 2; m++) {
        mass[m] = sums->mass[m] / volume;
        energy[m] = (sums->energy[m] + heat * sums->mass[m]) / volume;
    }
    if (!(mass[0] > 0.0 && mass[1] > 0.0))
        return fraction;
    return gas_relax(view->eos, mass, energy, fraction, 1.0);
}

/* Cell I of VOLUME gets what particles around it have; INTERNAL is its energy where the map is that
 * of the text. Returns the energy that it has not got, J. */
static double put_cell(const struct afdmp *afdmp, const struct gas_view *view,
                       const struct smear_sums *sums, double internal, double volume, int32_t i)
{
    const double mass = sums->mass[0] + sums->mass[1], energy = sums->energy[0] + sums->energy[1];
    double kinetic = 0.0, own = energy + sums->kinetic;
    for (int axis = 0; axis < 3; axis++) {
        view->u[GAS_MOMENTUM + axis][i] = sums->momentum[axis] / volume;
        kinetic += 0.5 * square(sums->momentum[axis]) / mass;
    }
    if (afdmp->parameters.map != AFDMP_CONSERVATIVE)
        own = kinetic + (afdmp->parameters.map == AFDMP_TEXT ? internal : energy);
    view->u[GAS_DENSITY][i] = mass / volume;
    view->u[GAS_ENERGY][i] = own / volume;
    view->u[GAS_SHOCK][i] = 0.0;
    if (view->layout->two) {
        const double heat = (own - kinetic - energy) / mass; /* of both alike */
        view->u[GAS_SECOND][i] = sums->mass[1] / volume;
        view->u[GAS_FRACTION][i] = fraction_of(view, sums, heat, volume);
    }
    return energy + sums->kinetic - own;
}

/* The cells of the nest get their states from SUMS. */
static void put_cells(struct afdmp *afdmp, struct simulation *simulation, const struct smear *smear,
                      const struct smear_sums *sums, const double *internal, bool *changed)
{
    const struct gas_view view = gas_view(afdmp->gas);
    int64_t place[3], n = 0;
    for (place[2] = 0; place[2] < smear->count[2]; place[2]++)
        for (place[1] = 0; place[1] < smear->count[1]; place[1]++)
            for (place[0] = 0; place[0] < smear->count[0]; place[0]++, n++) {
                int64_t at[3];
                int32_t block;
                for (int axis = 0; axis < 3; axis++)
                    at[axis] = smear->low[axis] + place[axis];
                const int32_t i = part_cell(view.cells, at, &block);
                if (i < 0)
                    continue;
                struct smear_sums own = sums[n];
                double heat = 0.0;
                for (int m = 0; m < 2; m++) {
                    own.energy[m] += view.heat[m] * own.mass[m];
                    heat += view.heat[m] * own.mass[m];
                }
                const double lost = put_cell(afdmp, &view, &own, internal[n] + heat,
                                             part_cell_volume(&afdmp->maker, afdmp->round, at), i);
                changed[block] = true;
                if (afdmp->parameters.map != AFDMP_CONSERVATIVE)
                    heat -= lost;
                if (heat != 0.0)
                    ledger_book(&simulation->ledger, LEDGER_EXCHANGE, 0.0, vec3_make(0.0, 0.0, 0.0),
                                vec3_make(0.0, 0.0, 0.0), heat);
            }
}

struct error *afdmp_map_to_gas(struct afdmp *afdmp, struct simulation *simulation)
{
    struct particles *p = mpm_particles(afdmp->nest_mpm);
    const struct gas_view view = gas_view(afdmp->gas);
    struct smear smear = {.shape = mpm_shape(afdmp->nest_mpm),
                          .edge = afdmp->edge,
                          .dimension = afdmp->dimension,
                          .keeps = true};
    size_t cells = 1;
    for (int axis = 0; axis < 3; axis++) {
        smear.low[axis] = afdmp->nest_cut.low[axis];
        smear.count[axis] = afdmp->nest_cut.high[axis] - afdmp->nest_cut.low[axis];
        smear.to[axis] = smear.count[axis];
        cells *= (size_t)smear.count[axis];
    }
    struct crowd crowd = {.count = 0};
    TRY(crowd_gather(&crowd, afdmp->nest_mpm, &view, simulation, all, NULL));
    struct smear_sums *sums = memory_allocate(cells * sizeof *sums);
    double *internal = memory_allocate(cells * sizeof *internal);
    bool *changed = memory_allocate((size_t)view.cells->blocks + 1);
    struct error *error = ranks_agree(
        afdmp->ranks,
        sums && internal && changed ? NULL : out_of_memory_for("the map from particles to cells"));
    if (!error) {
        memset(internal, 0, cells * sizeof *internal);
        memset(changed, 0, (size_t)view.cells->blocks + 1);
        for (size_t n = 0; n < cells; n++)
            sums[n] = (struct smear_sums){.kinetic = 0.0};
        smear_crowd(&smear, &crowd, simulation->threads, sums);
        for (int64_t k = 0; k < crowd.count; k++)
            sum_energy(&smear, &crowd.particle[crowd.order[k].index], internal);
        for (int32_t i = 0; i < p->count; i++)
            particles_delete(p, i);
        afdmp_burn_all(afdmp);
        put_cells(afdmp, simulation, &smear, sums, internal, changed);
        gas_forget_markers(afdmp->gas);
        for (int64_t k = 0; k < crowd.count && !error; k++)
            error = gas_add_marker(afdmp->gas, crowd.particle[k].position,
                                   crowd.particle[k].which != 0);
        if (!error)
            error = gas_settle_markers(afdmp->gas);
        if (!error)
            error = gas_refresh(afdmp->gas, &afdmp->gas_part.simulation, changed);
    }
    crowd_free(&crowd);
    free(sums);
    free(internal);
    free(changed);
    return error;
}

/* What a cell has of one material. */
struct share {
    double mass, density, energy; /* kg, kg/m^3, J/kg */
};

/* The specific energies beyond those at which materials of MASS and DENSITY bear no pressure:
 * of each, that of its SHARE at one pressure with ENERGY together; returns their mean. */
static double find_heat(const struct gas_view *view, const double mass[2], const double density[2],
                        double energy, double heat[2])
{
    const struct shared shared = gate_share(view, mass, density, energy);
    for (int m = 0; m < 2; m++)
        heat[m] = shared.pressure / shared.slope[m];
    return (mass[0] * heat[0] + mass[1] * heat[1]) / (mass[0] + mass[1]);
}

/* The densities of two materials of MASS in VOLUME which have ENERGY together, one pressure and the
 * same heat. */
static void share_evenly(const struct gas_view *view, const double mass[2], double energy,
                         double volume, double density[2])
{
    enum { HALVINGS = 60 };
    double low = 0.0, high = 1.0; /* of the second */
    for (int k = 0; k < HALVINGS; k++) {
        const double at = 0.5 * (low + high);
        double heat[2];
        density[0] = mass[0] / ((1.0 - at) * volume);
        density[1] = mass[1] / (at * volume);
        find_heat(view, mass, density, energy, heat);
        if (heat[1] < heat[0]) /* the denser, the less it needs for the pressure */
            low = at;
        else
            high = at;
    }
}

/* The shares of both materials of cell I of VOLUME. Of a trace the other one has the mass.
 * Fractions of volume that diffuse on the grid leave a little of one material far too hot for
 * particles of its own: such a cell is divided so that both have the same heat. */
static void split_cell(const struct gas_view *view, int32_t i, double volume, struct share share[2])
{
    static const double trace = 1e-3, factor = 10.0;
    const double density = view->u[GAS_DENSITY][i];
    const double second = view->layout->two ? view->u[GAS_SECOND][i] : 0.0,
                 fraction = view->layout->two ? view->u[GAS_FRACTION][i] : 0.0;
    double kinetic = 0.0, heat[2];
    for (int axis = 0; axis < 3; axis++)
        kinetic += 0.5 * square(view->u[GAS_MOMENTUM + axis][i]) / density;
    const double energy = (view->u[GAS_ENERGY][i] - kinetic) * volume;
    const double part[2] = {1.0 - fraction, fraction},
                 mass[2] = {(density - second) * volume, second * volume};
    int only = -1;
    for (int m = 0; m < 2; m++)
        if (!(mass[m] > trace * density * volume && part[m] > 0.0))
            only = 1 - m;
    share[0] = share[1] = (struct share){0.0, 0.0, 0.0};
    if (only >= 0) {
        share[only] = (struct share){density * volume, density, energy / (density * volume)};
        return;
    }
    double own[2] = {mass[0] / (part[0] * volume), mass[1] / (part[1] * volume)};
    const double mean = find_heat(view, mass, own, energy, heat);
    if (maximum(heat[0], heat[1]) > factor * mean)
        share_evenly(view, mass, energy, volume, own);
    const struct shared shared = gate_share(view, mass, own, energy);
    for (int m = 0; m < 2; m++)
        share[m] =
            (struct share){mass[m], own[m], (shared.pressure - shared.cold[m]) / shared.slope[m]};
}

/* Particles of the gas solver's material WHICH in cell I at AT, which get SHARE of it. */
static struct error *make_particles(struct afdmp *afdmp, const struct gas_view *view, int which,
                                    const struct share *share, int32_t i, const int64_t at[3])
{
    struct particles *p = mpm_particles(afdmp->last_mpm);
    const int body = part_body_of(&afdmp->gas_part.place, view->material[which]);
    const int64_t each = part_particles_across(afdmp->last_mpm, body);
    int64_t count = 1;
    int32_t first;
    for (int axis = 0; axis < afdmp->dimension; axis++)
        count *= each;
    TRY(particles_append(p, (int32_t)count, &first));
    for (int32_t k = 0; k < count; k++) {
        const int32_t n = first + k;
        const int64_t place[3] = {k % each, k / each % each, k / (each * each)};
        p->id[n] =
            particle_id(body, (int64_t)PARTICLE_CREATED + (int64_t)view->cells->id[i] * count + k);
        p->body[n] = (uint16_t)body;
        p->material[n] = (uint16_t)view->material[which];
        p->mass[n] = share->mass / (double)count;
        p->density[n] = share->density;
        p->energy[n] = share->energy;
        for (int axis = 0; axis < afdmp->dimension; axis++)
            p->position[n][axis] =
                ((double)at[axis] + ((double)place[axis] + 0.5) / (double)each) * afdmp->edge;
        if (afdmp->round)
            p->mass[n] *= p->position[n][0] / (((double)at[0] + 0.5) * afdmp->edge);
        for (int axis = 0; axis < 3; axis++)
            p->velocity[n][axis] = view->u[GAS_MOMENTUM + axis][i] / view->u[GAS_DENSITY][i];
        part_burn(p, n);
        mpm_welcome(afdmp->last_mpm, &afdmp->last.simulation, n);
    }
    return NULL;
}

struct error *afdmp_map_to_points(struct afdmp *afdmp, struct simulation *simulation)
{
    TRY(gas_refine(afdmp->gas, &afdmp->gas_part.simulation));
    const struct gas_view view = gas_view(afdmp->gas);
    const struct gas_cut *region = &afdmp->region;
    for (int32_t b = 0; b < view.cells->blocks; b++) {
        const struct cell_block *block = &view.cells->block[b];
        int32_t i = block->first;
        int64_t at[3];
        for (at[2] = block->corner[2]; at[2] < block->corner[2] + block->count[2]; at[2]++)
            for (at[1] = block->corner[1]; at[1] < block->corner[1] + block->count[1]; at[1]++)
                for (at[0] = block->corner[0]; at[0] < block->corner[0] + block->count[0];
                     at[0]++, i++) {
                    bool inside = true;
                    struct share share[2];
                    for (int axis = 0; axis < 3; axis++)
                        inside &= at[axis] >= region->low[axis] && at[axis] < region->high[axis];
                    if (inside)
                        continue;
                    split_cell(&view, i, part_cell_volume(&afdmp->maker, afdmp->round, at), share);
                    for (int m = 0; m < 2; m++) {
                        if (!(share[m].mass > 0.0))
                            continue;
                        share[m].energy -= view.heat[m];
                        if (view.heat[m] != 0.0)
                            ledger_book(&simulation->ledger, LEDGER_EXCHANGE, 0.0,
                                        vec3_make(0.0, 0.0, 0.0), vec3_make(0.0, 0.0, 0.0),
                                        -view.heat[m] * share[m].mass);
                        TRY(make_particles(afdmp, &view, m, &share[m], i, at));
                    }
                }
    }
    return NULL;
}

void afdmp_hide_cells(struct afdmp *afdmp)
{
    struct cell_blocks *cells = gas_view(afdmp->gas).cells;
    const struct gas_cut *nest = &afdmp->nest_cut;
    if (afdmp->stage == (double)AFDMP_DETONATION)
        part_hide_cells(cells, nest->low, nest->high);
    else if (afdmp->stage == (double)AFDMP_INTERACTION)
        part_hide_cells(cells, cells->low, cells->high);
}
