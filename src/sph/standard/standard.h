/* Classical SPH with artificial viscosity: the sums of contact SPH with the means of a pair in
 * place of its contact, and a viscous pressure. Source: Parshikov (2013), (1.15)-(1.17), (2.5).
 * Private to SPH. */
#ifndef BOLIDE_SPH_STANDARD_H
#define BOLIDE_SPH_STANDARD_H

#include "sph/contact/contact.h"

struct standard_options {
    double viscosity_quadratic, viscosity_linear;
    int motion, energy; /* enum sph_motion, enum sph_energy */
};

extern const struct parameter standard_table[];
extern const struct sph_scheme standard_scheme;

#endif
