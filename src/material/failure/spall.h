/* Tension cut-off: a point fails where its tension reaches a given strength, all at once. The
 * tension is the largest principal stress or the mean stress. */
#ifndef BOLIDE_FAILURE_SPALL_H
#define BOLIDE_FAILURE_SPALL_H

#include "material/failure/common.h"

enum spall_stress { SPALL_PRINCIPAL, SPALL_MEAN };

struct failure_spall {
    FAILURE_MEMBERS
    double strength; /* Pa */
    int stress;      /* enum spall_stress */
};

#define FAILURE_spall_NAME "spall"
#define FAILURE_spall_HELP "fails where the tension reaches the spall strength"
#define FAILURE_spall_PARAMETERS(T)                                                         \
    NUMBER(T, strength, "Pa", REQUIRED, POSITIVE, "tension at which it fails")              \
    CHOICE(T, stress, "principal",                                                          \
           "which tension; principal: the largest principal stress; mean: the mean stress", \
           "principal", "mean")                                                             \
    FAILURE_COMMON(T)

BOLIDE_INLINE double failure_spall(const struct failure_spall *spall, const struct failing *point,
                                   double damage)
{
    const double tension =
        spall->stress == SPALL_MEAN ? -point->pressure : failing_largest_stress(point);
    return tension >= spall->strength * point->relative ? 1.0 : damage;
}

BOLIDE_INLINE struct failure_traits failure_spall_traits(const struct failure_spall *spall)
{
    struct failure_traits traits = failure_default_traits();
    (void)spall;
    traits.batched = true;
    traits.limits_tension = true;
    return traits;
}

#endif
