/* What a Riemann problem is posed between, and what it gives. */
#ifndef BOLIDE_RIEMANN_SIDE_H
#define BOLIDE_RIEMANN_SIDE_H

#include "base/base.h"

/* One side: impedance rho c (kg/m^2/s), velocity and stress (positive in tension) along the axis
 * from left to right. Solvers of strong shocks also take the density (kg/m^3) and the slope of the
 * shock adiabat: A of U_s = c + A |u* - u|, or the ratio of specific heats of a gas. */
struct side {
    double impedance, velocity, stress, density, shock_slope;
};

struct contact {
    double velocity, stress;
};

#endif
