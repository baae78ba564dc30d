/* Cockcroft and Latham's ductile damage: the largest principal stress, where it is tension, times
 * the plastic strain adds up to a work per volume,
 *
 *   D = (1/W_c) integral of max(sigma_1, 0) d eps
 *
 * Source: Cockcroft and Latham, J. Inst. Met. 96 (1968) 33. A mean tension of `spall`, where given,
 * fails the point at once. */
#ifndef BOLIDE_FAILURE_COCKCROFT_LATHAM_H
#define BOLIDE_FAILURE_COCKCROFT_LATHAM_H

#include "material/failure/common.h"

struct failure_cockcroft_latham {
    FAILURE_MEMBERS
    double work;  /* W_c, Pa */
    double spall; /* Pa; NAN: none */
    double band;  /* m; NAN: none */
};

#define FAILURE_cockcroft_latham_NAME "cockcroft-latham"
#define FAILURE_cockcroft_latham_HELP "ductile damage by the plastic work of the largest tension"
#define FAILURE_cockcroft_latham_PARAMETERS(T)                                   \
    NUMBER(T, work, "Pa", REQUIRED, POSITIVE, "W_c: work per volume at failure") \
    NUMBER(T, spall, "Pa", OPTIONAL, POSITIVE,                                   \
           "mean tension at which it fails at once; default: none")              \
    FAILURE_BAND(T) FAILURE_COMMON(T)

BOLIDE_INLINE double failure_cockcroft_latham(const struct failure_cockcroft_latham *failure,
                                              const struct failing *point, double damage)
{
    const double triaxiality = -point->pressure / maximum(sym3_mises(point->deviator), 1e-100);
    const double flow = point->flow * failing_haste(point, failure->band, triaxiality);
    const double grown = damage + maximum(failing_largest_stress(point), 0.0) * flow /
                                      (failure->work * point->relative);
    return -point->pressure >= failure->spall * point->relative
               ? 1.0
               : grown; /* not where there is none: NAN */
}

BOLIDE_INLINE struct failure_traits failure_cockcroft_latham_traits(
    const struct failure_cockcroft_latham *failure)
{
    struct failure_traits traits = failure_default_traits();
    traits.batched = true;
    traits.limits_tension = !isnan(failure->spall);
    return traits;
}

#endif
