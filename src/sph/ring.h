/* Rings about an axis of symmetry, with x = r. A particle is a ring of finite width, and its depth
 * is the mean of |r| over that width, from r - b to r + b:
 *
 *   d = r,   r >= b;      d = (r^2 + b^2)/(2 b),   r < b;      b = c (m/(4 rho))^(1/3), c = 1/2
 *
 * (Garcia-Senz et al., Mon. Not. R. Astron. Soc. 392 (2009) 346, take the mean under the kernel.)
 * On a lattice that starts half a diameter D from the axis b is D/4, and no ring differs. */
#ifndef BOLIDE_SPH_RING_H
#define BOLIDE_SPH_RING_H

#include "base/base.h"
#include "base/exponential.h"

/* The depth d, its slope dd/dr, and how much of the hoop strain rate is the radial one: 0 away from
 * the axis and 1 on it, where the two are equal. */
struct ring {
    double depth, slope, regular;
};

/* The ring at RADIUS, of either sign, with MASS per radian. */
BOLIDE_INLINE struct ring ring_of(double radius, double mass, double density)
{
    const double r = fabs(radius), share = 0.5;
    struct ring ring = {r, 1.0, 0.0};
    if (4.0 * density * (r * r * r) >= share * share * share * mass) /* nearly all */
        return ring;
    const double b = share * cube_root(0.25 * mass / density);
    ring.depth = (r * r + b * b) / (2.0 * b);
    ring.slope = r / b;
    ring.regular = (b * b - r * r) / (r * r + b * b);
    return ring;
}

/* The slope dd/dr of a ring at RADIUS whose depth is known. */
BOLIDE_INLINE double ring_slope(double radius, double depth)
{
    const double over = depth * depth - radius * radius;
    return over > 0.0 ? fabs(radius) / (depth + sqrt(over)) : 1.0;
}

/* The hoop strain rate at radial velocity U and radial strain rate E. */
BOLIDE_INLINE double ring_hoop_rate(struct ring ring, double u, double e)
{
    return ring.slope * u / ring.depth + ring.regular * e;
}

#endif
