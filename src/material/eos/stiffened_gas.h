/* Stiffened gas: a liquid or solid of constant sound speed at rest, heated like a gas.
 *
 *   p = C_0^2 (rho - rho_0) + (gamma - 1) rho e
 *
 * which is p = (gamma - 1) rho e' - gamma p_inf with gamma p_inf = rho_0 C_0^2 and the energy
 * counted from the state at rest, e = e' - C_0^2/(gamma - 1). The sound speed vanishes at p =
 * -p_inf, which no state reaches that is warmer than the cold curve; below, c^2 is held at
 * C_0^2/100, times rho/rho_0 in expansion. Source: Wang, Chen and Huang (2024), (18). */
#ifndef BOLIDE_EOS_STIFFENED_GAS_H
#define BOLIDE_EOS_STIFFENED_GAS_H

#include "material/eos/common.h"

struct eos_stiffened_gas {
    double density; /* rho_0, kg/m^3: zero pressure at zero energy */
    double sound;   /* C_0, m/s, at rest */
    double gamma;
};

#define EOS_stiffened_gas_NAME "stiffened-gas"
#define EOS_stiffened_gas_HELP \
    "stiffened gas, p = sound^2 (density - density_0) + (gamma - 1) density energy"
#define EOS_stiffened_gas_SAMPLE \
    {                            \
        1000.0, 1480.0, 4.4      \
    } /* water */
#define EOS_stiffened_gas_PARAMETERS(T)                                                     \
    NUMBER(T, density, "kg/m^3", REQUIRED, POSITIVE, "density at zero pressure and energy") \
    NUMBER(T, sound, "m/s", REQUIRED, POSITIVE, "sound speed at rest")                      \
    NUMBER(T, gamma, "", REQUIRED, ABOVE_ONE, "gamma of the thermal term")

BOLIDE_INLINE struct eos_value eos_stiffened_gas(const struct eos_stiffened_gas *gas,
                                                 double density, double energy,
                                                 const double *history)
{
    (void)history;
    struct eos_value value;
    double c2 = square(gas->sound), heat = gas->gamma - 1.0;
    value.pressure = c2 * (density - gas->density) + heat * density * energy;
    value.dp_drho = c2 + heat * energy;
    value.dp_de = heat * density;
    value.status = 0;
    eos_hold_sound(&value, density, 0.01 * c2 * minimum(density / gas->density, 1.0));
    return value;
}

BOLIDE_INLINE struct eos_traits eos_stiffened_gas_traits(const struct eos_stiffened_gas *gas)
{
    struct eos_traits traits = eos_default_traits();
    traits.stiffened = true;
    traits.shock_slope = 0.25 * (gas->gamma + 1.0); /* of a weak shock: a liquid is stiff */
    return traits;
}

/* The isentrope of the state at rest, T_r = T_0 (rho/rho_0)^(gamma - 1). */
BOLIDE_INLINE struct heat_curve eos_stiffened_gas_curve(const struct eos_stiffened_gas *gas,
                                                        const struct heat *heat, double density)
{
    struct heat_curve curve;
    double ratio = density / gas->density, g = gas->gamma, c2 = square(gas->sound);
    double rise = power(ratio, g - 1.0);
    curve.temperature = heat->temperature * rise;
    curve.energy = c2 * ((rise / g - 1.0) / (g - 1.0) + 1.0 / (g * ratio));
    return curve;
}

#endif
