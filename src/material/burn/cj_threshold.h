/* Burning by compression: an explosive becomes its products at once where it has been compressed by
 * a fraction f of what the state of Chapman and Jouguet takes,
 *
 *   (V_0 - V)/(V_0 - V_CJ) >= f
 *
 * There are no kinetics: the width of the zone is that of a shock of the method. Source:
 * Parshikov (2013), (5.19), with f = 1/2, and heat that is free in the next step, not in the
 * same. The foot of a numerical shock reaches 1/2 before the front is there, and the
 * detonation is 10 % too fast. */
#ifndef BOLIDE_BURN_CJ_THRESHOLD_H
#define BOLIDE_BURN_CJ_THRESHOLD_H

#include "material/burn/common.h"

struct burn_cj_threshold {
    double speed;     /* not given: the speed follows from the products */
    double volume;    /* V_CJ/V_0 */
    double threshold; /* of the compression to V_CJ */
};

#define BURN_cj_threshold_NAME "cj-threshold"
#define BURN_cj_threshold_HELP                                                        \
    "burns at once where it is compressed nearly to its Chapman-Jouguet state; with " \
    "`eos: blended-jwl`"
#define BURN_cj_threshold_PARAMETERS(T)                                                    \
    NUMBER(T, volume, "", REQUIRED, FROM_ZERO_TO_ONE,                                      \
           "V_CJ: volume of the Chapman-Jouguet state over that of the explosive at rest") \
    NUMBER(T, threshold, "", "0.9", FROM_ZERO_TO_ONE,                                      \
           "fraction of the compression to that state at which it burns")

/* F. */
BOLIDE_INLINE double burn_cj_threshold(const struct burn_cj_threshold *burn,
                                       const struct burning *point)
{
    return 1.0 - point->volume >= burn->threshold * (1.0 - burn->volume) ? 1.0 : 0.0;
}

BOLIDE_INLINE struct burn_traits burn_cj_threshold_traits(const struct burn_cj_threshold *burn)
{
    struct burn_traits traits = burn_default_traits();
    (void)burn;
    traits.kinetic = true;
    return traits;
}

#endif
