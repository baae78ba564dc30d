/* The slope of a material's shock adiabat: what the solvers of strong shocks take for `shock_slope`
 * of a side. */
#ifndef BOLIDE_RIEMANN_SHOCK_SLOPE_H
#define BOLIDE_RIEMANN_SHOCK_SLOPE_H

#include "material/material.h"

/* Half the fundamental derivative, (1 + (rho/c) dc/drho at constant entropy)/2, of the equation of
 * state at its reference density and zero energy, by a difference on the side of compression, where
 * the modulus may differ from that in tension: the slope of a weak shock. NAN where no sound
 * travels, as in a gas without energy. */
BOLIDE_INLINE double riemann_weak_shock_slope(const struct eos *eos)
{
    double rho = eos_reference_density(eos), history[POINT_HISTORY] = {0.0}, sound[3];
    double pressure = eos_evaluate(eos, rho, 0.0, history).pressure;
    const double step = 1e-5;
    for (int k = 0; k < 3; k++) {
        double change = step * (k + 1), there = rho * (1.0 + change);
        struct eos_value value = eos_evaluate(eos, there, pressure / rho * change, history);
        sound[k] = material_response(&value, there, 0.0, 0.0).sound_long;
    }
    double derivative = (4.0 * sound[1] - sound[2] - 3.0 * sound[0]) / (2.0 * step);
    return 0.5 * (1.0 + (1.0 + step) * derivative / sound[0]);
}

/* Slope A of U_s = c + A |u* - u|, as the equation of state has it, else that of a weak shock. At
 * least 0.05, since the curve must turn upwards; NAN where it cannot be computed. */
BOLIDE_INLINE double riemann_shock_slope(const struct material *material)
{
    const double own = eos_traits(&material->eos).shock_slope;
    const double slope = isnan(own) ? riemann_weak_shock_slope(&material->eos) : own;
    return slope < 0.05 ? 0.05 : slope;
}

#endif
