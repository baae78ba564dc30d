/* The Riemann problem of two hypoelastic, perfectly plastic solids of any equation of state in uniaxial
 * strain: two half-spaces meet at a plane and stick, or one of them has a free surface there. The
 * deviator follows the logarithmic strain until yield, which may be reached at the start. A solid with
 * no shear modulus or no yield strength is a fluid with one wave. Heat is not conducted. */
#ifndef BOLIDE_EXACT_ELASTIC_PLASTIC_RIEMANN_H
#define BOLIDE_EXACT_ELASTIC_PLASTIC_RIEMANN_H

#include "base/parameter.h"
#include "exact/exact.h"

struct exact_solid {
    double reference_density, bulk_modulus; /* of a barotropic solid; NAN: eos is given */
    double shear_modulus, yield;
    double density, velocity; /* at the start; density NAN: the reference density */
    double energy, deviator;  /* at the start */
    struct one_of eos;
    bool free; /* nothing is there: the other side's surface is free */
};

struct exact_elastic_plastic_riemann {
    struct exact_solid solid[2]; /* by enum exact_side */
    double at;
};

extern const struct parameter exact_elastic_plastic_riemann_table[];
extern const struct exact_class exact_elastic_plastic_riemann_class;

#endif
