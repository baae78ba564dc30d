/* What the exact solutions with a centre share: the geometry, slab (nu = 1), cylinder (2) or ball
 * (3), and quadrature. Their sample takes the distance from the centre (in a slab x, of either
 * sign), and their velocity is that away from the centre; they have no contact and no star
 * states. */
#ifndef BOLIDE_EXACT_RADIAL_H
#define BOLIDE_EXACT_RADIAL_H

#include "base/base.h"

enum radial_geometry { RADIAL_SLAB, RADIAL_CYLINDER, RADIAL_BALL, RADIAL_GEOMETRIES };

/* The number nu of dimensions in which things spread. */
static inline double radial_dimensions(int geometry) { return (double)geometry + 1.0; }

/* Surface of the unit ball of nu dimensions: 2, 2 pi, 4 pi. */
static inline double radial_surface(int geometry)
{
    return geometry == RADIAL_SLAB ? 2.0 : geometry == RADIAL_CYLINDER ? 2.0 * M_PI : 4.0 * M_PI;
}

/* The integral of CURVE(context, x) from LOW to HIGH: five Gauss points on each of PANELS
 * panels. */
static inline double radial_integral(double (*curve)(const void *context, double x),
                                     const void *context, double low, double high, int panels)
{
    static const double place[5] = {-0.906179845938663993, -0.538469310105683091, 0.0,
                                    0.538469310105683091, 0.906179845938663993};
    static const double weight[5] = {0.236926885056189088, 0.478628670499366468,
                                     0.568888888888888889, 0.478628670499366468,
                                     0.236926885056189088};
    double half = 0.5 * (high - low) / panels, sum = 0.0;
    for (int panel = 0; panel < panels; panel++)
        for (int k = 0; k < 5; k++)
            sum += weight[k] * curve(context, low + half * (2.0 * panel + 1.0 + place[k]));
    return half * sum;
}

#endif
