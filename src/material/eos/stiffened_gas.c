/* What a case says of a stiffened gas; the physics is in stiffened_gas.h. */
#include "material/choices.h"

const char eos_stiffened_gas_name[] = "stiffened-gas";
const char eos_stiffened_gas_help[] =
    "stiffened gas, p = sound^2 (density - density_0) + (gamma - 1) density energy";

const struct parameter eos_stiffened_gas_parameters[] = {
    {.key = "density",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_stiffened_gas, density),
     .unit = "kg/m^3",
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .help = "density at zero pressure and energy"},
    {.key = "sound",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_stiffened_gas, sound),
     .unit = "m/s",
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .help = "sound speed at rest"},
    {.key = "gamma",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_stiffened_gas, gamma),
     .standard = PARAMETER_REQUIRED,
     .above = 1.0,
     .below = INFINITY,
     .help = "gamma of the thermal term"},
    PARAMETER_END,
};
