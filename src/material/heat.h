/* The thermal part of a material: temperature from density and energy, and back. Temperature is
 * counted from a curve e_r(rho) of the equation of state whose temperature T_r(rho) is known:
 *
 *   T = T_r + (e - e_r)/C_V
 *
 * The curve is in the header of each equation of state, eos_<identifier>_curve(). Source: Parshikov
 * (2013), (3.1)-(3.3). */
#ifndef BOLIDE_HEAT_H
#define BOLIDE_HEAT_H

#include "material/eos.h"

/* Temperature (K) at DENSITY and ENERGY (J/kg). */
BOLIDE_INLINE double heat_temperature(const struct heat *heat, const struct eos *eos,
                                      double density, double energy)
{
    struct heat_curve curve = eos_curve(eos, heat, density);
    return curve.temperature + (energy - curve.energy) / heat->capacity;
}

/* The energy (J/kg) at which DENSITY has TEMPERATURE. */
BOLIDE_INLINE double heat_energy(const struct heat *heat, const struct eos *eos, double density,
                                 double temperature)
{
    struct heat_curve curve = eos_curve(eos, heat, density);
    return curve.energy + heat->capacity * (temperature - curve.temperature);
}

/* Why a material has no temperature; NULL when it has one. */
BOLIDE_INLINE const char *heat_wrong(const struct heat *heat, const struct eos *eos)
{
    const struct heat some = {1.0, 1.0, 1.0};
    if (isnan(eos_curve(eos, &some, eos_reference_density(eos)).temperature))
        return "its equation of state gives no temperature";
    return heat->capacity > 0.0 ? NULL : "it has no `heat: {capacity: ...}`";
}

#endif
