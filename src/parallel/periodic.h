/* Places along periodic axes.
 *
 * A particle that leaves through one face comes in through the other: its place is taken modulo the
 * period. So that nothing depends on when that happens, and on which side of the seam a pair lies,
 * places, faces and period are multiples of one small power of two, the grain, which is some 1e-15
 * of the domain: shifts by the period and differences of places are then exact. */
#ifndef BOLIDE_PERIODIC_H
#define BOLIDE_PERIODIC_H

#include "parallel/ghosts.h"

BOLIDE_INLINE double periodic_period(const struct mirrors *mirrors, int axis)
{
    return mirrors->high[axis] - mirrors->low[axis];
}

/* X rounded to the grain: the rounder is so large that doubles next to it are a grain apart. */
BOLIDE_INLINE double periodic_rounded(const struct mirrors *mirrors, int axis, double x)
{
    return (x + mirrors->rounder[axis]) - mirrors->rounder[axis];
}

/* The place nearest to NEAR that X, a multiple of the grain, repeats at. */
BOLIDE_INLINE double periodic_nearest(const struct mirrors *mirrors, int axis, double x,
                                      double near)
{
    const double period = periodic_period(mirrors, axis);
    return x + period * rint((near - x) / period);
}

/* The place inside, low <= x < high, that X, a multiple of the grain, repeats at. */
BOLIDE_INLINE double periodic_inside(const struct mirrors *mirrors, int axis, double x)
{
    const double period = periodic_period(mirrors, axis);
    return x - period * floor((x - mirrors->low[axis]) / period);
}

/* Makes AXIS periodic between LOW and HIGH, which it rounds to the grain. Places up to twice
 * the farther face are rounded to it; images, up to four times, are exact. */
BOLIDE_INLINE void images_make_periodic(struct mirrors *mirrors, int axis, double low, double high)
{
    int exponent;
    frexp(2.0 * maximum(fabs(low), fabs(high)), &exponent);
    mirrors->rounder[axis] = ldexp(3.0, exponent);
    mirrors->low[axis] = periodic_rounded(mirrors, axis, low);
    mirrors->high[axis] = periodic_rounded(mirrors, axis, high);
}

#endif
