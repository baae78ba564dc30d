/* SPH with corrected gradients as the solver sees it: its fields, what a case may ask of it, and
 * the rates of a level; the step is heun.c. */
#include "sph/hllc/hllc.h"

#include "base/clock.h"
#include "sph/evaluate.h"

#define AT(member) .offset = offsetof(struct hllc_own_fields, member)

const struct field_row hllc_rows[] = {
    {.field = {"correction", NULL, "inverse second moment of the kernel", NUMBER_DOUBLE, 6,
               FIELD_DERIVED},
     AT(correction)},
    {.field = {"dp_drho", NULL, "derivative of pressure by density", NUMBER_DOUBLE, 1,
               FIELD_DERIVED},
     AT(dp_drho)},
    {.field = {"dp_de", NULL, "derivative of pressure by energy", NUMBER_DOUBLE, 1, FIELD_DERIVED},
     AT(dp_de)},
    {.field = {"level", NULL, "state and rates of level n", NUMBER_DOUBLE,
               sizeof(struct hllc_level) / sizeof(double), FIELD_DERIVED},
     AT(level)},
    {.field = {"slopes", NULL, "gradients of density, pressure, deviator", NUMBER_DOUBLE, 3,
               FIELD_DERIVED},
     .when = SPH_ALL_RECONSTRUCTED,
     AT(slopes)},
    {.field = {"level_history", NULL, "history of level n", NUMBER_DOUBLE, POINT_HISTORY,
               FIELD_DERIVED},
     .when = SPH_HISTORY,
     AT(level_history)},
    FIELD_ROWS_END,
};

struct hllc_fields hllc_fields_of(const struct sph *sph, const struct simulation *simulation)
{
    struct hllc_fields fields = {.sph = sph_fields_of(sph, simulation)};
    sph_bind_fields(sph, simulation, hllc_rows, &fields.own);
    return fields;
}

void hllc_start(const struct sph *sph, struct simulation *simulation)
{
    struct hllc_fields f = hllc_fields_of(sph, simulation);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < sph->particles->count; i++) {
        struct response r = sph_evaluate_point(simulation, &f.sph, i);
        f.own.dp_drho[i] = r.dp_drho;
        f.own.dp_de[i] = r.dp_de;
        if (f.sph.diameter[i] == 0.0) /* fresh */
            f.sph.diameter[i] =
                diameter_of_volume(sph->particles->mass[i] / sph->particles->density[i],
                                   simulation->problem->dimension);
    }
}

static void gradients_of_block(const void *of, const struct block *blocks, int32_t b)
{
    hllc_find_gradients(of, blocks[b].first, blocks[b].first + blocks[b].count);
}

static void forces_of_block(const void *of, const struct block *blocks, int32_t b)
{
    hllc_find_forces(of, blocks[b].first, blocks[b].first + blocks[b].count);
}

void hllc_find_rates(struct sph *sph, struct simulation *simulation, const struct hllc_fields *f)
{
    const struct particles *p = sph->particles;
    const struct pair_rates *rates = &f->sph.rates;
    const struct hllc_state *state = sph->state;
    const struct hllc_loop loop = {.kind = state->kind,
                                   .selection = state->selection,
                                   .record = sph->record,
                                   .empty = p->count + sph->neighbours.ghosts.count,
                                   .smoothing = sph->parameters.smoothing,
                                   .neighbours = &sph->neighbours,
                                   .by_mass = state->by_mass,
                                   .rates = {f->own.correction, f->own.slopes, rates->strain_rate,
                                             rates->spin, f->sph.density_rate, rates->acceleration,
                                             rates->power, rates->wall}};
    for (int pass = 0; pass < 2; pass++) {
        const struct sph_records records = hllc_records(sph, pass == 1);
        const struct sph_sweep sweep = {pass ? forces_of_block : gradients_of_block, &loop, 4,
                                        pass ? "pairs" : "gradients"};
        hllc_pack(sph, simulation, f, pass == 1);
        simulation_end_phase(simulation, PHASE_BLOCKS, "gather");
        sph_sweep(sph, simulation, &records, &sweep);
    }
    simulation_end_phase(simulation, PHASE_BLOCKS, "pair sums");
}

/* dt = K h/c_E. */
static struct ranked limit_of_particle(const struct sph *sph, const struct simulation *simulation,
                                       const void *context, int32_t i)
{
    const struct hllc_fields *f = context;
    const double ratio = sph->parameters.courant * sph->parameters.smoothing;
    (void)simulation;
    return (struct ranked){ratio * f->sph.diameter[i] / f->sph.sound_long[i], 0, SPH_LIMIT_SOUND};
}

void hllc_prepare(struct sph *sph, struct simulation *simulation, struct limit *limit)
{
    const struct hllc_fields f = hllc_fields_of(sph, simulation);
    hllc_find_rates(sph, simulation, &f);
    *limit = sph_smallest_limit(sph, simulation, limit_of_particle, &f);
    simulation_end_phase(simulation, PHASE_SHARED, "time step");
}

struct error *hllc_choose_kind(struct sph *sph, const struct simulation *simulation, bool viscous,
                               bool reconstructed)
{
    const struct simulation_case *input = simulation->problem->input;
    struct hllc_state *state = sph->state;
    if (simulation->problem->geometry == GEOMETRY_PLANE_STRESS)
        return input_error(input, "geometry", NULL,
                           "plane stress is not for hllc and monaghan: use another method");
    if (simulation->problem->dimension == 3 || sph_axisymmetric(simulation))
        return input_error(input, simulation->problem->dimension == 3 ? "dimension" : "geometry",
                           NULL,
                           "hllc and monaghan are for lines and plane strain: a copper bar that "
                           "strikes a wall loses 3 %% of its energy in axisymmetry and 5 %% in 3-D "
                           "with them, and stays 15 %% too long; use another method");
    if (sph_has_laws(simulation))
        return input_error(input, "contacts", NULL,
                           "with hllc and monaghan all bodies stick and carry tension: use another "
                           "method");
    state->kind = (struct hllc_kind){simulation->problem->dimension, viscous, reconstructed};
    sph->stride = (size_t)hllc_stride(state->kind);
    if (sph->stride < HLLC_GRADIENT_STRIDE)
        sph->stride = HLLC_GRADIENT_STRIDE;
    return NULL;
}

static struct error *create(struct sph *sph, const struct simulation *simulation)
{
    const struct hllc_options *options = sph->parameters.method.value;
    struct hllc_state *state = sph->state;
    const bool all = options->reconstruction == HLLC_RECONSTRUCTION_ALL;
    if (all && simulation->problem->dimension > 1)
        return sph_option_error(sph, simulation->problem->input, "reconstruction",
                                "all is for 1-D; in 2-D, give velocity");
    TRY(hllc_choose_kind(sph, simulation, false,
                         options->reconstruction != HLLC_RECONSTRUCTION_NONE));
    state->by_mass = options->continuity == HLLC_CONTINUITY_MASS;
    state->selection = (struct hllc_selection){
        .others_share = options->correction == HLLC_CORRECTION_SYMMETRIC ? 0.5 : 0.0,
        .scalars_share = all ? 1.0 : 0.0,
        .parting = options->approach_switch ? 0.0 : (double)INFINITY};
    return NULL;
}

static unsigned traits_of(const void *of, int dimension)
{
    const struct hllc_options *options = of;
    (void)dimension;
    return SPH_SUPPORT_KEPT | SPH_DENSITY_RATE |
           (options->reconstruction == HLLC_RECONSTRUCTION_ALL ? SPH_ALL_RECONSTRUCTED : 0u);
}

static size_t stride_of(const void *of, int dimension)
{
    const struct hllc_options *options = of;
    return (size_t)hllc_stride(
        (struct hllc_kind){.dimension = dimension,
                           .reconstructed = options->reconstruction != HLLC_RECONSTRUCTION_NONE});
}

const char *hllc_energy_lost_by(int correction)
{
    return correction == HLLC_CORRECTION_OWN
               ? "with `correction: own` the forces and the powers of a pair do not cancel at free "
                 "surfaces and where particles are disordered: finer particles lose less, "
                 "`correction: symmetric` loses the error of the step alone"
               : "with `correction: symmetric` the error of the step is lost: a smaller `courant` "
                 "loses less";
}

static const char *energy_lost(const void *options)
{
    return hllc_energy_lost_by(((const struct hllc_options *)options)->correction);
}

const struct sph_scheme hllc_scheme = {.name = "hllc",
                                       .smoothing = {1.2, 1.2, 1.2},
                                       .courant = 0.3,
                                       .courant_limit = 1.0,
                                       .state_size = sizeof(struct hllc_state),
                                       .rows = hllc_rows,
                                       .traits = traits_of,
                                       .energy_lost = energy_lost,
                                       .stride = stride_of,
                                       .wide_step = true,
                                       .create = create,
                                       .start = hllc_start,
                                       .prepare = hllc_prepare,
                                       .advance = hllc_advance};
