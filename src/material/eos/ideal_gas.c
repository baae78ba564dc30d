/* What a case says of an ideal gas; the physics is in ideal_gas.h. */
#include "material/choices.h"

const char eos_ideal_gas_name[] = "ideal-gas";
const char eos_ideal_gas_help[] = "ideal gas, p = (gamma - 1) density energy";

const struct parameter eos_ideal_gas_parameters[] = {
    {.key = "density",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_ideal_gas, density),
     .unit = "kg/m^3",
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .help = "density at the start where a body gives none"},
    {.key = "gamma",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_ideal_gas, gamma),
     .standard = PARAMETER_REQUIRED,
     .above = 1.0,
     .below = INFINITY,
     .help = "ratio of the specific heats"},
    PARAMETER_END,
};
