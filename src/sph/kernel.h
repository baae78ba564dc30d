/* The cubic spline kernel of support 2h, phi = r/h: W(r) = w(phi)/N, dW/dr = w'(phi)/(4 h N) with
 *
 *   w  = 1 - 3 phi^2/2 + 3 phi^3/4,  (2 - phi)^3/4        (1.4)
 *   w' = -12 phi + 9 phi^2,          -3 (2 - phi)^2       (1.5)
 *   N  = 1.5 h, 0.7 pi h^2, pi h^3 in one, two, three dimensions.
 *
 * Source: Parshikov (2013), section 1.1. */
#ifndef BOLIDE_SPH_KERNEL_H
#define BOLIDE_SPH_KERNEL_H

#include "base/base.h"

BOLIDE_INLINE double kernel_shape(double phi)
{
    double tail = maximum(2.0 - phi, 0.0);
    return phi < 1.0 ? 1.0 - square(phi) * (1.5 - 0.75 * phi) : 0.25 * tail * square(tail);
}

BOLIDE_INLINE double kernel_shape_slope(double phi)
{
    double tail = maximum(2.0 - phi, 0.0);
    return phi < 1.0 ? phi * (9.0 * phi - 12.0) : -3.0 * square(tail);
}

/* 1/N from 1/h. */
BOLIDE_INLINE double kernel_norm(double inverse_h, int dimension)
{
    const double pi = 3.14159265358979323846;
    if (dimension == 1)
        return inverse_h * (1.0 / 1.5);
    if (dimension == 2)
        return square(inverse_h) * (1.0 / (0.7 * pi));
    return inverse_h * square(inverse_h) * (1.0 / pi);
}

/* W(r), 1/m^dimension. */
BOLIDE_INLINE double kernel_value(double r, double inverse_h, int dimension)
{
    return kernel_norm(inverse_h, dimension) * kernel_shape(r * inverse_h);
}

/* dW/dr, never positive. */
BOLIDE_INLINE double kernel_slope(double r, double inverse_h, int dimension)
{
    return 0.25 * inverse_h * kernel_norm(inverse_h, dimension) * kernel_shape_slope(r * inverse_h);
}

#endif
