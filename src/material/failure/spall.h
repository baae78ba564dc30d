/* Tension cut-off: a point fails where its tension reaches a given strength, all at once, when the
 * edge of the tension stands still, or when voids have grown. The tension is the largest principal
 * stress or the mean stress. */
#ifndef BOLIDE_FAILURE_SPALL_H
#define BOLIDE_FAILURE_SPALL_H

#include "material/failure/common.h"

enum spall_stress { SPALL_PRINCIPAL, SPALL_MEAN };
enum spall_onset { SPALL_AT_ONCE, SPALL_STANDING };

struct failure_spall {
    FAILURE_MEMBERS
    double strength; /* Pa */
    double growth;   /* of voids, to failure; 0: at once */
    int stress;      /* enum spall_stress */
    int onset;       /* enum spall_onset */
};

#define FAILURE_spall_NAME "spall"
#define FAILURE_spall_HELP "fails where the tension reaches the spall strength"
#define FAILURE_spall_PARAMETERS(T)                                                           \
    NUMBER(T, strength, "Pa", REQUIRED, POSITIVE, "tension at which it fails")                \
    CHOICE(T, stress, "principal",                                                            \
           "which tension; principal: the largest principal stress; mean: the mean stress",   \
           "principal", "mean")                                                               \
    CHOICE(T, onset, "at-once",                                                               \
           "when it fails; at-once: in the step in which the tension reaches the strength; "  \
           "standing: when the edge of the tension stands still, so that a pulse of several " \
           "strengths breaks off layer after layer; with SPH",                                \
           "at-once", "standing")                                                             \
    NUMBER(T, growth, "", "0", AT_START(NOT_NEGATIVE),                                        \
           "volume of the voids over that of the material at which it fails; while they "     \
           "grow, the mean tension falls from the strength to zero; 0: it fails at once")     \
    FAILURE_COMMON(T)

BOLIDE_INLINE double spall_tension(const struct failure_spall *spall, const struct failing *point)
{
    return spall->stress == SPALL_MEAN ? -point->pressure : failing_largest_stress(point);
}

BOLIDE_INLINE double failure_spall(const struct failure_spall *spall, const struct failing *point,
                                   double damage)
{
    const bool waits = spall->onset == SPALL_STANDING || spall->growth > 0.0;
    return !waits && spall_tension(spall, point) >= spall->strength * point->relative ? 1.0
                                                                                      : damage;
}

/* Where a wave of tension grows as it runs, the first plane in which it reaches the strength
 * breaks, and relieves what is ahead of it and behind. A front of particles is some diameters wide:
 * a part of it has passed that plane before it breaks, runs on, is soon far above the strength, and
 * would break all that it passes. So a standing particle fails when it has been above the strength
 * for EDGE transit times of sound while the strength lies within the change of tension over a
 * diameter: the edge of the tension is then a plane of spall, and does not run with a wave. Where
 * the tension is above the strength all around and grows everywhere alike, it fails after INSIDE
 * transit times. The gradient of tension is the force, of which that along the largest principal
 * stress counts. EDGE is the smallest number with which a triangular pulse breaks off equal layers.
 *
 * The overload of POINT after the step of MOTION, 1 where it fails; BEFORE: before; SOUND: of
 * longitudinal waves. */
BOLIDE_INLINE double spall_overload(const struct failure_spall *spall, const struct failing *point,
                                    const struct motion *motion, double sound, double before)
{
    const double edge = 5.0, inside = 20.0, faster = 6.0;
    const double strength = spall->strength * point->relative,
                 tension = spall_tension(spall, point);
    if (!(tension >= strength))
        return 0.0;
    const struct vec3 a = motion->acceleration;
    const double a2 = vec3_dot(a, a), transits = sound * motion->dt / motion->length;
    const double along = vec3_dot(a, sym3_dot(point->deviator, a));
    const double change = point->density * motion->length * sqrt(a2);
    if (tension - change < strength && along >= 0.5 * sym3_largest(point->deviator) * a2)
        return before + transits / edge;
    return square(sound * point->stretching) >= square(faster) * a2 ? before + transits / inside
                                                                    : before;
}

BOLIDE_INLINE struct failure_traits failure_spall_traits(const struct failure_spall *spall)
{
    struct failure_traits traits = failure_default_traits();
    traits.batched = true;
    traits.limits_tension = true;
    traits.growth = (struct void_growth){spall->strength, spall->growth};
    if (spall->growth > 0.0 && spall->stress != SPALL_MEAN) {
        traits.wrong = "voids grow by the mean tension: choose `stress: mean`";
        traits.wrong_key = "growth";
    }
    if (spall->growth > 0.0 && spall->onset != SPALL_AT_ONCE) {
        traits.wrong = "voids grow from the strength on: leave `onset` out";
        traits.wrong_key = "growth";
    }
    return traits;
}

#endif
