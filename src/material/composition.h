/* What an explosive consists of: atoms of a formula unit, and its heat of formation. */
#ifndef BOLIDE_COMPOSITION_H
#define BOLIDE_COMPOSITION_H

#include "base/base.h"

struct composition {
    double carbon, hydrogen, nitrogen, oxygen; /* atoms of a formula unit; all zero: not known */
    double formation;                          /* J/kg, at 298.15 K */
};

BOLIDE_INLINE bool composition_is_known(const struct composition *of)
{
    return of->carbon + of->hydrogen + of->nitrogen + of->oxygen > 0.0;
}

#endif
