/* How the shock curve of a material bends: what the solvers of strong shocks take for `bend` of a side. */
#ifndef BOLIDE_RIEMANN_BEND_H
#define BOLIDE_RIEMANN_BEND_H

#include "material/material.h"

/* Slope A of U_s = c + A |u* - u|: (gamma + 1)/2 for an ideal gas, the limit of strong shocks; S_a of a shock
 * adiabat; elsewhere half the fundamental derivative, (1 + (rho/c) dc/drho at constant entropy)/2, of the material at
 * rest, which is the slope of a weak shock. At least 0.05, since the curve must bend upwards. */
BOLIDE_INLINE double riemann_shock_slope(const struct material *material)
{
    const double own = eos_traits(&material->eos).shock_slope;
    if (!isnan(own))
        return maximum(own, 0.05);
    double rho = material_density(material), history[POINT_HISTORY] = {0.0}, sound[2];
    double pressure = eos_evaluate(&material->eos, rho, 0.0, history).pressure;
    const double step = 1e-4;
    for (int k = 0; k < 2; k++) {
        double change = k ? step : -step, there = rho * (1.0 + change);
        double energy = pressure / rho * change;
        struct eos_value value = eos_evaluate(&material->eos, there, energy, history);
        sound[k] = material_response(&value, there, 0.0, 0.0).sound_long;
    }
    double slope = 0.5 * (1.0 + (sound[1] - sound[0]) / (step * (sound[0] + sound[1])));
    return slope > 0.05 ? slope : 0.05; /* a slope that is no number counts as the least */
}

#endif
