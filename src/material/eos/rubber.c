/* What a case says of rubber; the physics is in rubber.h. */
#include "material/choices.h"

const char eos_rubber_name[] = "rubber";
const char eos_rubber_help[] =
    "constant sound speed, p = sound^2 (density - density_0), without energy";

const struct parameter eos_rubber_parameters[] = {
    {.key = "density",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_rubber, density),
     .unit = "kg/m^3",
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .help = "density at zero pressure"},
    {.key = "sound",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_rubber, sound),
     .unit = "m/s",
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .help = "sound speed"},
    PARAMETER_END,
};
