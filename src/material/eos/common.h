/* What the headers of the equations of state have in common: the traits that others ask of a model,
 * with a default for what a model does not have, and the curve that its temperatures are counted
 * from. */
#ifndef BOLIDE_EOS_COMMON_H
#define BOLIDE_EOS_COMMON_H

#include "material/point.h"

struct eos_traits {
    /* A of the shock adiabat U_s = c + A u from rest; NAN: that of a weak shock (see
     * riemann/slope.h). */
    double shock_slope;
    /* gamma where waves are those of an ideal gas, for exact solutions of them; NAN: they are not.
     * */
    double ratio_of_heats;
    /* The history that it needs: a sum of HISTORY_BIT. */
    unsigned history;
    /* Why its parameters do not go together, and the parameter to name; NULL when they do. */
    const char *wrong, *wrong_key;
};

/* The traits of a model that says no more. */
BOLIDE_INLINE struct eos_traits eos_default_traits(void)
{
    struct eos_traits traits = {NAN, NAN, 0, NULL, NULL};
    return traits;
}

#endif
