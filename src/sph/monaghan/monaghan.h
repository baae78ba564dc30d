/* SPH with corrected kernel gradients, Heun's step and Monaghan's artificial viscosity: what hllc
 * is measured against. Source: Wang et al., Explosion and Shock Waves 44 (2024) 081431, (16), (17).
 * Private to SPH. */
#ifndef BOLIDE_SPH_MONAGHAN_H
#define BOLIDE_SPH_MONAGHAN_H

#include "sph/hllc/hllc.h"

enum monaghan_pair_stress { MONAGHAN_SQUARES, MONAGHAN_PRODUCT };

struct monaghan_options {
    int continuity, correction; /* as in struct hllc_options */
    int pair_stress;
    double viscosity_alpha, viscosity_beta;
};

extern const struct parameter monaghan_table[];
extern const struct sph_scheme monaghan_scheme;

#endif
