/* Ideal gas: p = (gamma - 1) rho e. */
#ifndef BOLIDE_EOS_IDEAL_GAS_H
#define BOLIDE_EOS_IDEAL_GAS_H

#include "material/eos/common.h"

struct eos_ideal_gas {
    double density; /* kg/m^3, of the initial state where a case gives none */
    double gamma;   /* ratio of specific heats */
};

#define EOS_ideal_gas_NAME "ideal-gas"
#define EOS_ideal_gas_HELP "ideal gas, p = (gamma - 1) density energy"
#define EOS_ideal_gas_SAMPLE \
    {                        \
        1.2, 1.4             \
    } /* air */
#define EOS_ideal_gas_PARAMETERS(T)                         \
    NUMBER(T, density, "kg/m^3", REQUIRED, POSITIVE,        \
           "initial density of bodies that do not set one") \
    NUMBER(T, gamma, "", REQUIRED, ABOVE_ONE, "ratio of the specific heats")

BOLIDE_INLINE struct eos_value eos_ideal_gas(const struct eos_ideal_gas *gas, double density,
                                             double energy, const double *history)
{
    (void)history;
    struct eos_value value;
    value.dp_drho = (gas->gamma - 1.0) * energy;
    value.dp_de = (gas->gamma - 1.0) * density;
    value.pressure = value.dp_drho * density;
    value.status = 0;
    return value;
}

BOLIDE_INLINE struct eos_traits eos_ideal_gas_traits(const struct eos_ideal_gas *gas)
{
    struct eos_traits traits = eos_default_traits();
    traits.shock_slope = 0.5 * (gas->gamma + 1.0); /* the limit of strong shocks */
    traits.ratio_of_heats = gas->gamma;
    traits.gas = true;
    traits.largest_compression = INFINITY;
    return traits;
}

BOLIDE_INLINE struct heat_curve eos_ideal_gas_curve(const struct eos_ideal_gas *gas,
                                                    const struct heat *heat, double density)
{
    struct heat_curve curve = {0.0, 0.0};
    (void)gas;
    (void)heat;
    (void)density;
    return curve;
}

#endif
