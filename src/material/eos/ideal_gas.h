/* Ideal gas: p = (gamma - 1) rho e. */
#ifndef BOLIDE_EOS_IDEAL_GAS_H
#define BOLIDE_EOS_IDEAL_GAS_H

#include "material/point.h"

struct eos_ideal_gas {
    double density; /* kg/m^3, of the initial state where a case gives none */
    double gamma;   /* ratio of specific heats */
};

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

#endif
