/* The order of a step of second-order contact SPH, and what a case may ask of it. */
#include "sph/muscl/muscl.h"

#include <stdlib.h>

#include "base/clock.h"
#include "material/any.h"
#include "material/material.h"
#include "sph/lanes.h"
#include "sph/prune.h"

#define AT(member) .offset = offsetof(struct muscl_own_fields, member)

const struct field_row muscl_rows[] = {
    {.field = {"correction", NULL, "inverse second moment of the kernel", NUMBER_DOUBLE, 0,
               FIELD_STATE},
     .size = SPH_SIZE_TENSOR,
     AT(correction)},
    {.field = {"velocity_gradient", NULL, "gradient of velocity", NUMBER_DOUBLE, 0, FIELD_STATE},
     .size = SPH_SIZE_GRADIENT,
     AT(velocity_gradient)},
    {.field = {"stress_gradient", NULL, "gradient of stress", NUMBER_DOUBLE, 0, FIELD_STATE},
     .size = SPH_SIZE_STRESS_GRADIENT,
     AT(stress_gradient)},
    {.field = {"expected_force", "N/m^3", "force of the next step", NUMBER_DOUBLE, 3, FIELD_STATE},
     .where = "method: muscl",
     AT(force)},
    {.field = {"closure", "m", "displacement that closes areas", NUMBER_DOUBLE, 3, FIELD_STATE},
     .when = SPH_PLANE,
     .where = "method: muscl in 2-D and 3-D",
     AT(closure)},
    {.field = {"heat_at_rest", "J/kg", "energy less the elastic one, when it last flowed",
               NUMBER_DOUBLE, 1, FIELD_STATE},
     .when = SPH_SHEAR,
     .where = "method: muscl, solids in 2-D and 3-D",
     AT(heat)},
    {.field = {"credit", "J/kg", "work that particles near it may still give", NUMBER_DOUBLE, 1,
               FIELD_STATE},
     .when = SPH_SHEAR,
     .where = "method: muscl, solids in 2-D and 3-D",
     AT(credit)},
    {.field = {"touch", NULL, "touches a body that it may be apart from", NUMBER_DOUBLE, 1,
               FIELD_STATE},
     .when = SPH_BODIES,
     .where = "method: muscl, several bodies",
     AT(touch)},
    {.field = {"hoop_stress", NULL, "hoop stress half a step ahead", NUMBER_DOUBLE, 1,
               FIELD_PASSING},
     .when = SPH_AXISYMMETRIC,
     AT(hoop_stress)},
    FIELD_ROWS_END,
};

struct muscl_fields muscl_fields_of(const struct sph *sph, const struct simulation *simulation)
{
    struct muscl_fields fields = {.sph = sph_fields_of(sph, simulation)};
    sph_bind_fields(sph, simulation, muscl_rows, &fields.own);
    return fields;
}

/* What the loop over blocks needs: compressed lists are made on the way. */
struct muscl_sweep {
    struct muscl_loop pairs;
    struct prune_loop prune;
};

static void rates_of_block(const void *of, const struct block *blocks, int32_t b)
{
    const struct muscl_sweep *sweep = of;
    prune_loop_run(&sweep->prune, blocks, b);
    muscl_loop_run(&sweep->pairs, blocks[b].first, blocks[b].first + blocks[b].count);
}

/* Pair sums of all particles, from records half of STEP ahead. */
static void sum_pairs(struct sph *sph, struct simulation *simulation,
                      const struct muscl_fields *fields, double step)
{
    const struct particles *p = sph->particles;
    sph->ahead = 0.5 * step;
    muscl_pack(sph, simulation);
    simulation_end_phase(simulation, PHASE_BLOCKS, "gather");
    const struct sph_records records = muscl_records(sph);
    const struct muscl_sweep sweep = {
        .pairs = {.kind = muscl_kind_of(sph),
                  .record = sph->record,
                  .empty = p->count + sph->neighbours.ghosts.count,
                  .place = sph->place,
                  .smoothing = sph->parameters.smoothing,
                  .neighbours = &sph->neighbours,
                  .groups = &sph->groups,
                  .body = p->body,
                  .density = p->density,
                  .velocity = (const double(*)[3])p->velocity,
                  .rates = {fields->sph.rates, fields->own.correction,
                            fields->own.velocity_gradient, fields->own.stress_gradient,
                            fields->own.force, fields->sph.packing, fields->sph.volume,
                            fields->own.closure, fields->own.credit}},
        .prune = {sph->record, (int)sph->stride, p->dimension, sph->place,
                  sph->parameters.smoothing, &sph->neighbours}};
    sph_sweep(sph, simulation, &records, &(struct sph_sweep){rates_of_block, &sweep, 1, "pairs"});
    sph->neighbours.prune = false;
    if (sph_parts_bodies(sph))
        muscl_find_touch(sph, simulation, step, fields->own.touch);
    frozen_push(sph, simulation, fields);
    if (sph_axisymmetric(simulation))
        sph_add_hoop(sph, simulation, &fields->sph, fields->own.hoop_stress);
    simulation_end_phase(simulation, PHASE_BLOCKS, "pair sums");
}

static struct ranked limit_of_particle(const struct sph *sph, const struct simulation *simulation,
                                       const void *context, int32_t i)
{
    const struct muscl_fields *f = context;
    struct ranked limit = sph_courant_limit(sph, &f->sph, muscl_divergence(simulation, f, i), i);
    if (sph_axisymmetric(simulation)) { /* a ring wider than its radius vibrates faster */
        const double depth = sph_ring(sph->particles, i).depth;
        const double narrow = sph->parameters.courant * 2.0 * depth / f->sph.sound_long[i];
        limit.what = narrow < limit.value ? SPH_LIMIT_SOUND : limit.what;
        limit.value = minimum(narrow, limit.value);
    }
    return limit;
}

/* Which bodies touch at the start: before the first sums, which say how full space was then. */
static void start_touch(struct sph *sph, struct simulation *simulation,
                        const struct muscl_fields *fields)
{
    const struct sph_records records = muscl_records(sph);
    sph->ahead = 0.0;
    muscl_pack(sph, simulation);
    sph_records_finish(sph, simulation, &records);
    muscl_find_touch(sph, simulation, 0.0, fields->own.touch);
}

/* The step is chosen from the rates of the step before, as the records are. The first step has
 * none: its first sums only provide them. */
static void prepare(struct sph *sph, struct simulation *simulation, struct limit *limit)
{
    const struct muscl_fields fields = muscl_fields_of(sph, simulation);
    if (simulation->step == 0 && sph_parts_bodies(sph))
        start_touch(sph, simulation, &fields);
    for (int round = simulation->step == 0 ? 0 : 1; round < 2; round++) {
        *limit = sph_smallest_limit(sph, simulation, limit_of_particle, &fields);
        simulation_end_phase(simulation, PHASE_SHARED, "time step");
        sum_pairs(sph, simulation, &fields, limit->dt);
    }
}

static struct error *advance(struct sph *sph, struct simulation *simulation, double dt)
{
    const struct sph_fields fields = sph_fields_of(sph, simulation);
    if (!sph_has(sph, SPH_STILL))
        frozen_book(sph, simulation, dt);
    struct error *error = sph_update(sph, simulation, &fields, dt);
    simulation_end_phase(simulation, PHASE_BLOCKS, "state update");
    return error;
}

static void start(const struct sph *sph, struct simulation *simulation)
{
    const struct muscl_fields f = muscl_fields_of(sph, simulation);
    int dimension = simulation->problem->dimension, tensors = tensor_components(dimension);
    for (int32_t i = 0; i < sph->particles->count; i++) {
        double *l = f.own.correction + (size_t)i * (size_t)tensors;
        for (int a = 0; a < dimension && l[0] == 0.0; a++) /* fresh */
            l[dimension - 1 - a] = 1.0;
        if (f.sph.density_start && f.sph.density_start[i] == 0.0) /* fresh */
            f.sph.density_start[i] = sph->particles->density[i];
    }
    sph_evaluate(sph, simulation);
}

static struct error *refuse(const struct sph *sph, const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    const struct muscl_options *options = sph->parameters.method.value;
    struct error *error = NULL;
    if (options->motion == SPH_MOTION_CONTACT && simulation->problem->dimension > 1)
        error =
            sph_option_error(sph, input, "motion",
                             "muscl moves particles with their contacts in 1-D only: leave this "
                             "out, or use `method: contact`");
    for (int c = 0; c < input->contacts.count; c++)
        for (int side = 0; side < 2; side++)
            if (case_body(input, case_contact(input, c)->body[side])->frozen)
                error = error_join(
                    error, input_error(input, "contacts", input->contacts.names[c],
                                       "with muscl a frozen body sticks to what it touches"));
    return error;
}

static struct error *create(struct sph *sph, const struct simulation *simulation)
{
    struct muscl_state *state = sph->state;
    TRY(refuse(sph, simulation));
    state->kind = (struct muscl_kind){simulation->problem->dimension, sph_has(sph, SPH_SHEAR),
                                      sph_deep(simulation)};
    sph->stride = (size_t)muscl_stride(state->kind);
    sph->places = true;
    sph->largest_support = ((const struct muscl_options *)sph->parameters.method.value)->support;
    for (int m = 0; m < simulation->problem->materials; m++)
        state->mark[m] = muscl_mark(m, eos_traits(&simulation->problem->material[m].eos).gas);
    return sph_find_slopes(simulation, state->shock_slope);
}

static void destroy(struct sph *sph)
{
    struct muscl_state *state = sph->state;
    free(state->end);
}

/* In 1-D density and spacing must not drift apart; in 2-D and 3-D a mean of contact velocities
 * would smear jets. */
static unsigned traits_of(const void *of, int dimension)
{
    const struct muscl_options *options = of;
    const int motion = options->motion >= 0 ? options->motion
                       : dimension == 1     ? SPH_MOTION_CONTACT
                                            : SPH_MOTION_PARTICLE;
    return sph_traits_of(motion, options->energy) | SPH_FINITE_STRAIN |
           (dimension > 1 ? SPH_PACKING : 0u);
}

static size_t stride_of(const void *options, int dimension)
{
    (void)options;
    const struct muscl_kind kind = {dimension, dimension > 1, false};
    return (size_t)muscl_stride(kind) + PLACE_STRIDE;
}

static const char *energy_lost(const void *options)
{
    return sph_energy_lost_by(((const struct muscl_options *)options)->energy);
}

/* Soft solids, and fluids. */
static bool loses_tension(const struct material *material)
{
    struct point rest = {.density = material_density(material)};
    const struct response r = any_material_evaluate(material, &rest);
    return muscl_firmness(r.sound_long, r.sound_shear) < 1.0;
}

const struct sph_scheme muscl_scheme = {.name = "muscl",
                                        .smoothing = {1.0, 1.2, 1.2},
                                        .courant = 0.4,
                                        .courant_limit = 0.45,
                                        .conducts = true,
                                        .touches = true,
                                        .stands = true,
                                        .state_size = sizeof(struct muscl_state),
                                        .rows = muscl_rows,
                                        .traits = traits_of,
                                        .energy_lost = energy_lost,
                                        .loses_tension = loses_tension,
                                        .stride = stride_of,
                                        .create = create,
                                        .start = start,
                                        .rebuilt = frozen_find,
                                        .prepare = prepare,
                                        .advance = advance,
                                        .destroy = destroy};
