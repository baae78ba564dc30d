/* A long rod that erodes as it penetrates a thick target: Alekseevskii (1966), Tate (1967). The rod
 * is rigid but for a thin layer at its nose; there the modified Bernoulli equation holds, rho_p (v
 * - u)^2/2 + Y = rho_t u^2/2 + R, v the velocity of the tail and u that of the nose. Its sample
 * takes the place along the axis, from the face of the target at the start; the contact is the
 * nose, and the star state has the velocity and the pressure there. */
#ifndef BOLIDE_EXACT_LONG_ROD_H
#define BOLIDE_EXACT_LONG_ROD_H

#include "base/parameter.h"
#include "exact/exact.h"

struct exact_long_rod {
    double length, speed; /* of the rod at the start */
    double rod_density, target_density;
    double rod_strength, target_strength; /* Y and R */
};

extern const struct parameter exact_long_rod_table[];
extern const struct exact_class exact_long_rod_class;

#endif
