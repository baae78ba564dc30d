/* The Riemann problem of two hypoelastic, perfectly plastic solids of any equation of state in
 * uniaxial strain: two half-spaces meet at a plane and stick, or one of them has a free surface
 * there. The deviator follows the logarithmic strain until yield, which may be reached at the
 * start. A solid with no shear modulus or no yield strength is a fluid with one wave. Heat is not
 * conducted. */
#ifndef BOLIDE_EXACT_ELASTIC_PLASTIC_RIEMANN_H
#define BOLIDE_EXACT_ELASTIC_PLASTIC_RIEMANN_H

#include "exact/solid_path.h"

struct exact_elastic_plastic_riemann {
    struct exact_solid solid[2]; /* by enum exact_side */
    double at;
};

extern const struct parameter exact_elastic_plastic_riemann_table[];
extern const struct exact_class exact_elastic_plastic_riemann_class;

#endif
