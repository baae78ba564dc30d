/* Cavitation: a liquid holds the tension of its pressure of cavitation at most. Where it would hold
 * more, bubbles open as voids do in failed material: they bear no pressure and grow and close with
 * the volume; from then on the liquid there bears no tension. */
#ifndef BOLIDE_FAILURE_CAVITATION_H
#define BOLIDE_FAILURE_CAVITATION_H

#include "material/failure/common.h"

struct failure_cavitation {
    FAILURE_MEMBERS
    double tension; /* Pa */
    double vapour;  /* Pa, the pressure in bubbles, where they have one */
};

#define FAILURE_cavitation_NAME "cavitation"
#define FAILURE_cavitation_HELP "a liquid that opens bubbles where it is in tension"
#define FAILURE_cavitation_PARAMETERS(T)                                               \
    NUMBER(T, tension, "Pa", "0 Pa", NOT_NEGATIVE,                                     \
           "tension that it holds until bubbles open; water with dissolved air: none") \
    NUMBER(T, vapour, "Pa", "0 Pa", NOT_NEGATIVE,                                      \
           "vapour pressure: with the solver gas the pressure stays above `vapour` - " \
           "`tension`; other solvers do not use it")

BOLIDE_INLINE double failure_cavitation(const struct failure_cavitation *cavitation,
                                        const struct failing *point, double damage)
{
    return -point->pressure > cavitation->tension ? 1.0 : damage;
}

BOLIDE_INLINE struct failure_traits failure_cavitation_traits(
    const struct failure_cavitation *cavitation)
{
    struct failure_traits traits = failure_default_traits();
    traits.least = cavitation->vapour - cavitation->tension;
    traits.batched = true;
    traits.limits_tension = true;
    traits.of_fluids = true;
    return traits;
}

#endif
