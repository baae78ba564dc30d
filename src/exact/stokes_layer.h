/* The layer between two streams of a viscous fluid that slide over each other, Stokes' first
 * problem: at time zero u_x = U sign(y).
 *   u = U erf(eta), eta = y/(2 sqrt(nu t)),
 * and a line of fluid that stood across the streams has moved by the integral of u over time, for y
 * > 0
 *   X = U [t erf(eta) + y sqrt(t/(pi nu)) exp(-eta^2) - y^2/(2 nu) erfc(eta)].
 * Source: Lamb, Hydrodynamics; Parshikov (2013), (2.7). */
#ifndef BOLIDE_EXACT_STOKES_LAYER_H
#define BOLIDE_EXACT_STOKES_LAYER_H

#include "base/base.h"

/* u/U at the distance Y, m, from the plane; VISCOSITY is kinematic, m^2/s. */
BOLIDE_INLINE double stokes_layer_velocity(double y, double time, double viscosity)
{
    return erf(0.5 * y / sqrt(viscosity * time));
}

/* X/U, s. */
BOLIDE_INLINE double stokes_layer_displacement(double y, double time, double viscosity)
{
    const double distance = fabs(y), eta = 0.5 * distance / sqrt(viscosity * time);
    const double moved =
        time * erf(eta) +
        distance * sqrt(time / (3.14159265358979323846 * viscosity)) * exp(-square(eta)) -
        0.5 * square(distance) / viscosity * erfc(eta);
    return copysign(moved, y);
}

#endif
