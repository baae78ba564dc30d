/* Planar impact of two materials whose shocks obey U_s = C + S U_p, (1.63)-(1.66): two flat slabs
 * at zero pressure meet, and a shock runs into each. Strength is left out. A porous body may be
 * given by its own linear relation, and a rigid wall as the mirror image of what strikes it. */
#ifndef BOLIDE_EXACT_IMPEDANCE_MATCH_H
#define BOLIDE_EXACT_IMPEDANCE_MATCH_H

#include "base/parameter.h"
#include "exact/exact.h"

struct exact_shock_material {
    double density, sound, slope, velocity; /* the first three NAN: those of the material */
    char *name;                             /* of that material; NULL: none */
};

struct exact_impedance_match {
    struct exact_shock_material material[2]; /* by enum exact_side */
    double at;
};

extern const struct parameter exact_impedance_match_table[];
extern const struct exact_class exact_impedance_match_class;

#endif
