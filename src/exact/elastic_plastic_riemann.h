/* The Riemann problem of two barotropic, hypoelastic, perfectly plastic solids in uniaxial strain: two
 * half-spaces free of shear stress meet at a plane and stick. The deviator follows the logarithmic strain
 * until yield. A solid with no shear modulus or no yield strength is a liquid with one wave. The energy
 * is the work of the stress since the start, where it is zero; nothing depends on it. */
#ifndef BOLIDE_EXACT_ELASTIC_PLASTIC_RIEMANN_H
#define BOLIDE_EXACT_ELASTIC_PLASTIC_RIEMANN_H

#include "base/parameter.h"
#include "exact/exact.h"

struct exact_solid {
    double reference_density, bulk_modulus, shear_modulus, yield;
    double density, velocity; /* at the start; density NAN: the reference density */
};

struct exact_elastic_plastic_riemann {
    struct exact_solid solid[2]; /* by enum exact_side */
    double at;
};

extern const struct parameter exact_elastic_plastic_riemann_table[];
extern const struct exact_class exact_elastic_plastic_riemann_class;

#endif
