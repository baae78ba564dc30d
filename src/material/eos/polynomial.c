/* What a case says of a polynomial; the physics is in polynomial.h. */
#include "material/choices.h"

const char eos_polynomial_name[] = "polynomial";
const char eos_polynomial_help[] =
    "cubic of the compression, without energy: intact ceramics and glasses";

const struct parameter eos_polynomial_parameters[] = {
    {.key = "density",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_polynomial, density),
     .unit = "kg/m^3",
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .help = "density at zero pressure"},
    {.key = "bulk_modulus",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_polynomial, bulk_modulus),
     .unit = "Pa",
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .help = "K_1: bulk modulus at zero pressure, and in tension"},
    {.key = "second_modulus",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_polynomial, second_modulus),
     .unit = "Pa",
     .standard = PARAMETER_REQUIRED,
     .help = "K_2: coefficient of mu^2 in compression"},
    {.key = "third_modulus",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_polynomial, third_modulus),
     .unit = "Pa",
     .standard = PARAMETER_REQUIRED,
     .help = "K_3: coefficient of mu^3 in compression"},
    PARAMETER_END,
};
