/* A steady plane detonation that runs towards larger x: the shock, the reaction zone after it, and
 * the state of Chapman and Jouguet from its end on, as if a piston followed. Zeldovich (1940), von
 * Neumann (1942), Doering (1943). */
#ifndef BOLIDE_EXACT_ZND_H
#define BOLIDE_EXACT_ZND_H

#include "base/parameter.h"
#include "exact/exact.h"
#include "material/material.h"

struct exact_znd {
    char *material;         /* its name */
    double density;         /* ahead of the front, kg/m^3; NAN: that of the equation of state */
    double at, velocity;    /* m, place of the front at time zero; m/s, of the explosive ahead */
    struct material models; /* of the material, taken before it is solved */
};

extern const struct parameter exact_znd_table[];
extern const struct exact_class exact_znd_class;

#endif
