/* What Monaghan's viscosity makes of SPH with corrected gradients, whose step it takes. */
#include "sph/monaghan/monaghan.h"

static struct error *create(struct sph *sph, const struct simulation *simulation)
{
    const struct monaghan_options *options = sph->parameters.method.value;
    struct hllc_state *state = sph->state;
    TRY(hllc_choose_kind(sph, simulation, true, false));
    state->by_mass = options->continuity == HLLC_CONTINUITY_MASS;
    state->selection = (struct hllc_selection){
        .others_share = options->correction == HLLC_CORRECTION_SYMMETRIC ? 0.5 : 0.0,
        .squares = options->pair_stress == MONAGHAN_SQUARES ? 1.0 : 0.0,
        .alpha = options->viscosity_alpha,
        .beta = options->viscosity_beta};
    return NULL;
}

static unsigned traits_of(const void *options, int dimension)
{
    (void)options;
    (void)dimension;
    return SPH_SUPPORT_KEPT | SPH_DENSITY_RATE;
}

static size_t stride_of(const void *options, int dimension)
{
    (void)options;
    return (size_t)hllc_stride((struct hllc_kind){.dimension = dimension, .viscous = true});
}

static const char *energy_lost(const void *options)
{
    return hllc_energy_lost_by(((const struct monaghan_options *)options)->correction);
}

const struct sph_scheme monaghan_scheme = {.name = "monaghan",
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
