/* The state of the SPH solver and the parts of its step. Private to this room. */
#ifndef BOLIDE_SPH_INTERNAL_H
#define BOLIDE_SPH_INTERNAL_H

#include "sph/pair_kernel.h"
#include "sph/sph.h"

/* The store's fields that this solver adds, found once a step. */
struct sph_fields {
    double *diameter; /* D = (m/rho)^(1/dimension) (1.70) */
    double *sound_long, *sound_shear;
    double *viscosity; /* artificial viscous pressure (2.5), standard method only */
    struct pair_rates rates;
};

struct sph {
    struct sph_parameters parameters;
    struct pair_kind kind;
    double bend[MATERIALS_MAX]; /* of riemann/bend.h, by material */
    struct neighbours neighbours;
    struct contact_groups groups;
    struct reach reach;
    int64_t steps_since_build;
    double *record;
    int64_t record_capacity; /* in records */
};

struct sph_fields sph_fields_of(const struct sph *sph, const struct simulation *simulation);

/* Diameter, pressure and sound speeds of all particles as they stand. */
void sph_evaluate(const struct sph *sph, struct simulation *simulation);

/* Packs the records of owned particles, then of ghosts. */
void sph_pack(struct sph *sph, const struct simulation *simulation);

/* Updates every particle from level n to n + 1. ERROR_STATE names the particle (the one with the smallest id)
 * whose new state is impossible. */
struct error *sph_update(const struct sph *sph, struct simulation *simulation, double dt);

#endif
