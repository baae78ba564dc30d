/* The order of a step of classical SPH: the divergence of velocity, the viscosity that follows from
 * it, then the sums. */
#include "sph/standard/standard.h"

/* q = a D^2 rho k|k| + b D rho C k in compression, k = -div U (2.5). */
static void find_viscosity(const struct standard_options *options,
                           const struct simulation *simulation, const struct sph_fields *f)
{
    const struct particles *p = f->particles;
    const double quadratic = options->viscosity_quadratic, linear = options->viscosity_linear;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++) {
        const double *rate = f->rates.strain_rate[i];
        double k = maximum(-(rate[0] + rate[1] + rate[2]), 0.0), d = f->diameter[i];
        f->viscosity[i] = p->density[i] * d * k * (quadratic * d * k + linear * f->sound_long[i]);
    }
}

static void prepare(struct sph *sph, struct simulation *simulation, struct limit *limit)
{
    const struct sph_fields fields = sph_fields_of(sph, simulation);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < sph->particles->count; i++)
        fields.viscosity[i] = 0.0;
    contact_pack(sph, simulation, &fields);
    simulation_end_phase(simulation, PHASE_BLOCKS, "gather");
    contact_sum_pairs(sph, simulation, &fields);
    find_viscosity(sph->parameters.method.value, simulation, &fields);
    simulation_end_phase(simulation, PHASE_BLOCKS, "viscosity");
    contact_prepare(sph, simulation, limit);
}

static struct error *create(struct sph *sph, const struct simulation *simulation)
{
    contact_choose_kind(sph, simulation, STAR_MEAN);
    return NULL;
}

static unsigned traits_of(const void *of, int dimension)
{
    const struct standard_options *options = of;
    (void)dimension;
    return sph_traits_of(options->motion, options->energy) | SPH_VISCOUS;
}

static const struct field_row no_rows[] = {FIELD_ROWS_END};

static const char *energy_lost(const void *options)
{
    return sph_energy_lost_by(((const struct standard_options *)options)->energy);
}

const struct sph_scheme standard_scheme = {.name = "standard",
                                           .smoothing = {1.0, 1.0, 1.0},
                                           .courant = 0.4,
                                           .courant_limit = 1.0,
                                           .conducts = true,
                                           .breaks = true,
                                           .state_size = sizeof(struct contact_state),
                                           .rows = no_rows,
                                           .traits = traits_of,
                                           .energy_lost = energy_lost,
                                           .stride = contact_stride,
                                           .create = create,
                                           .start = sph_evaluate,
                                           .prepare = prepare,
                                           .advance = contact_advance};
