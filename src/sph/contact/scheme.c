/* The order of a step of first-order contact SPH, and what a case may ask of it. */
#include "material/material.h"
#include "sph/contact/contact.h"

#include "base/clock.h"
#include "sph/prune.h"

/* What the loop over blocks needs: compressed lists are made on the way. */
struct contact_sweep {
    struct pair_loop pairs;
    struct prune_loop prune;
};

static void rates_of_block(const void *of, const struct block *blocks, int32_t b)
{
    const struct contact_sweep *sweep = of;
    prune_loop_run(&sweep->prune, blocks, b);
    pair_loop_run(&sweep->pairs, blocks[b].first, blocks[b].first + blocks[b].count);
}

void contact_sum_pairs(struct sph *sph, struct simulation *simulation,
                       const struct sph_fields *fields)
{
    const struct contact_state *state = sph->state;
    const struct particles *p = sph->particles;
    const struct sph_records records = contact_records(sph);
    const struct contact_sweep sweep = {.pairs = {.kind = state->kind,
                                                  .record = sph->record,
                                                  .empty = p->count + sph->neighbours.ghosts.count,
                                                  .smoothing = sph->parameters.smoothing,
                                                  .neighbours = &sph->neighbours,
                                                  .groups = &sph->groups,
                                                  .body = p->body,
                                                  .density = p->density,
                                                  .rates = fields->rates},
                                        .prune = {sph->record, (int)sph->stride, p->dimension, NULL,
                                                  sph->parameters.smoothing, &sph->neighbours}};
    sph_sweep(sph, simulation, &records, &(struct sph_sweep){rates_of_block, &sweep, 1, "pairs"});
    sph->neighbours.prune = false;
    if (sph_axisymmetric(simulation))
        sph_add_hoop(sph, simulation, fields, NULL);
    simulation_end_phase(simulation, PHASE_BLOCKS, "pair sums");
}

static struct ranked limit_of_particle(const struct sph *sph, const struct simulation *simulation,
                                       const void *context, int32_t i)
{
    const struct sph_fields *f = context;
    const double *rate = f->rates.strain_rate[i];
    (void)simulation;
    return sph_courant_limit(sph, f, rate[0] + rate[1] + rate[2], i);
}

void contact_prepare(struct sph *sph, struct simulation *simulation, struct limit *limit)
{
    const struct sph_fields fields = sph_fields_of(sph, simulation);
    contact_pack(sph, simulation, &fields);
    simulation_end_phase(simulation, PHASE_BLOCKS, "gather");
    contact_sum_pairs(sph, simulation, &fields);
    *limit = sph_smallest_limit(sph, simulation, limit_of_particle, &fields);
    simulation_end_phase(simulation, PHASE_SHARED, "time step");
}

struct error *contact_advance(struct sph *sph, struct simulation *simulation, double dt)
{
    const struct sph_fields fields = sph_fields_of(sph, simulation);
    struct error *error = sph_update(sph, simulation, &fields, dt);
    simulation_end_phase(simulation, PHASE_BLOCKS, "state update");
    return error;
}

void contact_choose_kind(struct sph *sph, const struct simulation *simulation, enum pair_star star)
{
    struct contact_state *state = sph->state;
    state->kind = (struct pair_kind){.dimension = simulation->problem->dimension,
                                     .shear = sph_has(sph, SPH_SHEAR),
                                     .star = star,
                                     .drift = sph_has(sph, SPH_DRIFT),
                                     .depth = sph_deep(simulation),
                                     .turn = sph_has(sph, SPH_SPIN_KEPT),
                                     .breaks = sph_has(sph, SPH_BREAKS)};
    sph->stride = (size_t)record_stride(state->kind);
}

/* What the Riemann solvers of strong shocks need of each material. */
static struct error *find_slopes(struct sph *sph, const struct simulation *simulation)
{
    struct contact_state *state = sph->state;
    const struct simulation_case *input = simulation->problem->input;
    if (state->kind.star == STAR_DUKOWICZ)
        return sph_find_slopes(simulation, state->shock_slope);
    for (int m = 0; state->kind.star == STAR_EXACT_GAS && m < simulation->problem->materials; m++) {
        const struct material *material = &simulation->problem->material[m];
        state->shock_slope[m] = eos_ratio_of_heats(&material->eos);
        if (isnan(state->shock_slope[m]) || material_has_strength(material))
            return sph_option_error(sph, input, "riemann",
                                    "exact-gas solves contacts of ideal gases, and material "
                                    "\"%s\" is not one: use acoustic or dukowicz",
                                    input->materials.names[m]);
    }
    return NULL;
}

/* Spins correct what shear stress would brake, in the acoustic Riemann problem. */
static struct error *choose_rotation(struct sph *sph, const struct simulation *simulation)
{
    const struct contact_options *options = sph->parameters.method.value;
    const char *wrong = NULL;
    if (options->rotation != CONTACT_ROTATION_CORRECTED)
        return NULL;
    if (options->riemann != CONTACT_ACOUSTIC)
        wrong = "corrected needs `riemann: acoustic`";
    else if (simulation->problem->dimension == 1)
        wrong = "nothing rotates in 1-D";
    else if (!sph_has(sph, SPH_SHEAR))
        wrong = "corrected needs a material with strength: the rotation of a fluid is not slowed";
    if (wrong)
        return sph_option_error(sph, simulation->problem->input, "rotation", "%s", wrong);
    return NULL;
}

static struct error *create(struct sph *sph, const struct simulation *simulation)
{
    static const enum pair_star stars[] = {[CONTACT_ACOUSTIC] = STAR_ACOUSTIC,
                                           [CONTACT_DUKOWICZ] = STAR_DUKOWICZ,
                                           [CONTACT_EXACT_GAS] = STAR_EXACT_GAS};
    const struct contact_options *options = sph->parameters.method.value;
    TRY(choose_rotation(sph, simulation));
    contact_choose_kind(sph, simulation, stars[options->riemann]);
    return find_slopes(sph, simulation);
}

static unsigned traits_of(const void *of, int dimension)
{
    const struct contact_options *options = of;
    (void)dimension;
    return sph_traits_of(options->motion, options->energy) |
           (options->rotation == CONTACT_ROTATION_CORRECTED ? SPH_SPIN_KEPT : 0u);
}

size_t contact_stride(const void *options, int dimension)
{
    const struct pair_kind kind = {.dimension = dimension, .shear = dimension > 1};
    (void)options;
    return (size_t)record_stride(kind);
}

/* Linear waves run at the speed of sound, where a shock of jump u in a solid runs at c + A u. */
static double largest_jump(const void *of)
{
    const struct contact_options *options = of;
    return options->riemann == CONTACT_ACOUSTIC ? 1.0 : INFINITY;
}

static const struct field_row no_rows[] = {FIELD_ROWS_END};

static const char *energy_lost(const void *options)
{
    return sph_energy_lost_by(((const struct contact_options *)options)->energy);
}

const struct sph_scheme contact_scheme = {.name = "contact",
                                          .smoothing = {1.0, 1.0, 1.0},
                                          .courant = 0.4,
                                          .courant_limit = 1.0,
                                          .conducts = true,
                                          .breaks = true,
                                          .state_size = sizeof(struct contact_state),
                                          .rows = no_rows,
                                          .traits = traits_of,
                                          .energy_lost = energy_lost,
                                          .largest_jump = largest_jump,
                                          .stride = contact_stride,
                                          .create = create,
                                          .start = sph_evaluate,
                                          .prepare = contact_prepare,
                                          .advance = contact_advance};
