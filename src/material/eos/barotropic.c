/* What a case says of a barotropic medium; the physics is in barotropic.h. */
#include "material/choices.h"

const char eos_barotropic_name[] = "barotropic";
const char eos_barotropic_help[] =
    "constant bulk modulus, p = bulk_modulus (1 - density_0/density), without energy";

const struct parameter eos_barotropic_parameters[] = {
    {.key = "density",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_barotropic, density),
     .unit = "kg/m^3",
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .help = "density at zero pressure"},
    {.key = "bulk_modulus",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_barotropic, bulk_modulus),
     .unit = "Pa",
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .help = "bulk modulus"},
    PARAMETER_END,
};
