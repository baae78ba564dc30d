/* Programmed burn: an explosive burns when the detonation arrives from where it is lit. F = 0
 * before the lighting time t_L, then
 *
 *   F = (t - t_L) D/(1.5 h), at most 1            (3-1), (3-2)
 *
 * with the speed D of the detonation and the point's own length h. Source: Cui, dissertation
 * (2014). */
#ifndef BOLIDE_BURN_PROGRAMMED_H
#define BOLIDE_BURN_PROGRAMMED_H

#include "material/burn/common.h"

struct burn_programmed {
    double speed; /* D, m/s */
};

#define BURN_programmed_NAME "programmed"
#define BURN_programmed_HELP "burns when the detonation arrives from its ignition point"
#define BURN_programmed_PARAMETERS(T) \
    NUMBER(T, speed, "m/s", REQUIRED, POSITIVE, "D: detonation speed")

/* F. */
BOLIDE_INLINE double burn_programmed(const struct burn_programmed *burn,
                                     const struct burning *point)
{
    return point->passed >= 0.0 ? minimum(point->passed * burn->speed / (1.5 * point->length), 1.0)
                                : 0.0;
}

BOLIDE_INLINE struct burn_traits burn_programmed_traits(const struct burn_programmed *burn)
{
    struct burn_traits traits = burn_default_traits();
    (void)burn;
    traits.by_time = true;
    return traits;
}

#endif
