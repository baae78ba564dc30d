/* Threshold fracture: a pair of particles whose contact stress exceeds the strength carries none,
 * and both sides see a free surface. It is the pairs of SPH's first-order methods that break
 * (sph/contact/body.h); points keep no memory of it, so that a pair bonds again once it is
 * compressed. Source: Parshikov (2013), (2.52)-(2.54). */
#ifndef BOLIDE_FAILURE_THRESHOLD_H
#define BOLIDE_FAILURE_THRESHOLD_H

#include "material/failure/common.h"

struct failure_threshold {
    FAILURE_MEMBERS
    double strength; /* along a pair, in tension, Pa */
    double shear;    /* across it, Pa; NAN: `strength` */
};

#define FAILURE_threshold_NAME "threshold"
#define FAILURE_threshold_HELP \
    "pairs of particles part where their contact stress exceeds a strength, without memory"
#define FAILURE_threshold_PARAMETERS(T)                                                           \
    NUMBER(T, strength, "Pa", REQUIRED, POSITIVE, "tension along a pair at which it parts")       \
    NUMBER(                                                                                       \
        T, shear, "Pa", OPTIONAL, POSITIVE,                                                       \
        "shear stress across a pair at which it slips, or parts in tension; default: `strength`") \
    FAILURE_SCATTER(T)

BOLIDE_INLINE double failure_threshold(const struct failure_threshold *threshold,
                                       const struct failing *point, double damage)
{
    (void)threshold;
    (void)point;
    return damage;
}

BOLIDE_INLINE struct failure_traits failure_threshold_traits(
    const struct failure_threshold *threshold)
{
    struct failure_traits traits = failure_default_traits();
    (void)threshold;
    traits.batched = true;
    traits.limits_tension = true;
    traits.at_contacts = true;
    return traits;
}

#endif
