/* Grady's spall strength, from energy: a fragment forms where elastic energy suffices for its
 * surface, by brittle cracks or by ductile holes:
 *
 *   P_brittle = (3 rho c K_c^2 rate)^(1/3),   P_ductile = sqrt(2 rho c^2 Y eps_c)
 *
 * with the speed c of volume waves, the toughness K_c, the rate of volume strain, the yield stress
 * Y and the strain eps_c of the holes, 0.15. The smaller one is the mean tension at which the point
 * fails. Source: Grady, J. Mech. Phys. Solids 36 (1988) 353. */
#ifndef BOLIDE_FAILURE_GRADY_H
#define BOLIDE_FAILURE_GRADY_H

#include "material/failure/common.h"

struct failure_grady {
    FAILURE_MEMBERS
    double toughness_squared; /* K_c^2, Pa^2 m; NAN: ductile alone */
    double strain;            /* eps_c; zero: brittle alone */
};

#define FAILURE_grady_NAME "grady"
#define FAILURE_grady_HELP "spall strength from toughness, yield stress and strain rate"
#define FAILURE_grady_PARAMETERS(T)                                               \
    NUMBER(T, toughness_squared, "Pa^2*m", OPTIONAL, POSITIVE,                    \
           "K_c^2: square of the fracture toughness; default: no brittle spall")  \
    NUMBER(T, strain, "", "0.15", NOT_NEGATIVE,                                   \
           "eps_c: volume strain of holes at ductile spall; 0: no ductile spall") \
    FAILURE_COMMON(T)

/* The mean tension at which POINT fails, Pa. */
BOLIDE_INLINE double grady_strength(const struct failure_grady *failure,
                                    const struct failing *point)
{
    const double impedance = point->density * point->sound;
    double strength = (double)INFINITY;
    if (failure->strain > 0.0 && point->yield > 0.0)
        strength = sqrt(2.0 * impedance * point->sound * point->yield * failure->strain);
    if (failure->toughness_squared > 0.0)
        strength = minimum(strength, power(3.0 * impedance * failure->toughness_squared *
                                               maximum(point->stretching, 0.0),
                                           1.0 / 3.0));
    return strength;
}

BOLIDE_INLINE double failure_grady(const struct failure_grady *failure, const struct failing *point,
                                   double damage)
{
    return point->pressure < 0.0 &&
                   -point->pressure >= grady_strength(failure, point) * point->relative
               ? 1.0
               : damage;
}

BOLIDE_INLINE struct failure_traits failure_grady_traits(const struct failure_grady *failure)
{
    struct failure_traits traits = failure_default_traits();
    traits.limits_tension = true;
    if (!(failure->toughness_squared > 0.0) && !(failure->strain > 0.0)) {
        traits.wrong = "with no strain of holes it needs a toughness";
        traits.wrong_key = "strain";
    }
    return traits;
}

#endif
