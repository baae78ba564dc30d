/* The parts of SPH with corrected kernel gradients (`hllc`, `monaghan`). Private to this room. */
#ifndef BOLIDE_SPH_HLLC_INTERNAL_H
#define BOLIDE_SPH_HLLC_INTERNAL_H

#include "sph/sph_internal.h"

/* What moves a particle from level to level. */
struct hllc_derivative {
    double density, acceleration[3], power, strain_rate[6], spin[3];
};

/* A particle at level n, kept while the first stage of a step stands in the store. */
struct hllc_level {
    double density, energy, position[3], velocity[3], deviator[6], plastic_strain;
    struct hllc_derivative rate;
};

/* The store's fields that these methods use. Diameters are those of the start: h is constant. */
struct hllc_fields {
    struct sph_fields sph;
    double (*correction)[6];
    double (*slopes)[3]; /* NULL unless all is reconstructed */
    double *dp_drho, *dp_de;
    struct hllc_level *level;
    double (*level_history)[POINT_HISTORY]; /* with it; NULL where the plastic strain is all */
};
struct hllc_fields hllc_fields_of(const struct sph *sph, const struct simulation *simulation);

/* All rates of the state as it stands, hoop stress included; rows must hold. */
void hllc_find_rates(struct sph *sph, struct simulation *simulation, const struct hllc_fields *f);

/* dt = K h/c_E, the smallest, of equal ones that of the smallest id. */
void hllc_limit_step(const struct sph *sph, const struct simulation *simulation,
                     const struct hllc_fields *f, struct limit *limit);

#endif
