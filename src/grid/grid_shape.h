/* Shape functions of the grid along one axis; those of a node in several dimensions are their
 * products. R is the distance of a particle from the node and HALF half the size of a particle,
 * both in cells; slopes are by r.
 *
 * About an axis a uniform pressure p at particles of radius x and area A in the plane pushes a node
 * with the sum of p A (x N' + N), which is to be the integral of p d(x N)/dx: nothing. shape_around
 * is what stands for N there so that it is for particles that fill the cells: gimp and quadratic
 * have the mean over a particle when N is that of its two ends, and cubic when N''/3 of half its
 * size squared is added, which is what the midpoint rule leaves out of (x N)'. It keeps a velocity
 * that grows with the radius. The need for it: Nairn and Guilkey, IJNME 101 (2015) 127, whose gimp
 * averages N' too.
 *
 * Source: Cui, dissertation (2014), (2-7); Bardenhagen and Kober, CMES 5 (2004) 477, for gimp,
 * whose particles keep their size; Steffen, Kirby and Berzins, IJNME 76 (2008) 922, for the
 * B-splines. */
#ifndef BOLIDE_GRID_SHAPE_H
#define BOLIDE_GRID_SHAPE_H

#include "base/base.h"

enum grid_shape { SHAPE_LINEAR, SHAPE_GIMP, SHAPE_QUADRATIC, SHAPE_CUBIC };

/* Which nodes a particle of a cell may reach: so many before and after the one with the index of
 * the cell. That is its low corner, or with CENTRED the node in its middle: quadratic functions,
 * whose support is three cells, then reach three nodes and not four. With functions AROUND an axis,
 * which are means over a particle, they reach further. */
struct shape_window {
    bool centred;
    int before, after;
};

BOLIDE_INLINE struct shape_window shape_window_of(enum grid_shape shape, bool around)
{
    const bool centred = shape == SHAPE_QUADRATIC && !around;
    const int before = shape == SHAPE_LINEAR ? 0 : 1;
    const struct shape_window window = {centred, before, centred ? 1 : 1 + before};
    return window;
}

BOLIDE_INLINE double shape_value(enum grid_shape shape, double r, double half)
{
    const double a = fabs(r);
    if (shape == SHAPE_GIMP) {
        const double inner = 1.0 - (r * r + half * half) / (2.0 * half), middle = 1.0 - a,
                     tail = maximum(1.0 + half - a, 0.0), outer = tail * tail / (4.0 * half);
        return a < half ? inner : a < 1.0 - half ? middle : outer;
    }
    if (shape == SHAPE_QUADRATIC) {
        const double tail = maximum(1.5 - a, 0.0);
        return a < 0.5 ? 0.75 - r * r : 0.5 * tail * tail;
    }
    if (shape == SHAPE_CUBIC) {
        const double tail = maximum(2.0 - a, 0.0);
        return a < 1.0 ? 2.0 / 3.0 - r * r * (1.0 - 0.5 * a) : tail * tail * tail / 6.0;
    }
    return maximum(1.0 - a, 0.0);
}

BOLIDE_INLINE double shape_slope(enum grid_shape shape, double r, double half)
{
    const double a = fabs(r), sign = r < 0.0 ? -1.0 : 1.0;
    if (shape == SHAPE_GIMP) {
        const double outer = -sign * maximum(1.0 + half - a, 0.0) / (2.0 * half);
        return a < half ? -r / half : a < 1.0 - half ? -sign : outer;
    }
    if (shape == SHAPE_QUADRATIC)
        return a < 0.5 ? -2.0 * r : -sign * maximum(1.5 - a, 0.0);
    if (shape == SHAPE_CUBIC) {
        const double tail = maximum(2.0 - a, 0.0);
        return a < 1.0 ? -r * (2.0 - 1.5 * a) : -0.5 * sign * tail * tail;
    }
    return a < 1.0 ? -sign : 0.0;
}

BOLIDE_INLINE double shape_around(enum grid_shape shape, double r, double half)
{
    const double a = fabs(r);
    if (shape == SHAPE_LINEAR)
        return shape_value(shape, r, half);
    if (shape == SHAPE_CUBIC) {
        const double bend = a < 1.0 ? 3.0 * a - 2.0 : maximum(2.0 - a, 0.0);
        return shape_value(shape, r, half) + half * half / 3.0 * bend;
    }
    const enum grid_shape over = shape == SHAPE_GIMP ? SHAPE_LINEAR : shape;
    return 0.5 * (shape_value(over, r - half, half) + shape_value(over, r + half, half));
}

#endif
