/* What a case says of a Mie-Grüneisen solid in mu; see grueneisen_polynomial.h. */
#include "material/choices.h"

const char eos_grueneisen_polynomial_name[] = "grueneisen-polynomial";
const char eos_grueneisen_polynomial_help[] =
    "Mie-Grueneisen about the shock adiabat as a cubic of the compression";

const struct parameter eos_grueneisen_polynomial_parameters[] = {
    {.key = "density",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_grueneisen_polynomial, density),
     .unit = "kg/m^3",
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .help = "density at zero pressure and energy"},
    {.key = "sound",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_grueneisen_polynomial, sound),
     .unit = "m/s",
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .help = "shock speed of a vanishing shock, C_0 of U_s = C_0 + s U_p"},
    {.key = "slope",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_grueneisen_polynomial, slope),
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .closed = true,
     .help = "slope of the shock adiabat, s of U_s = C_0 + s U_p"},
    {.key = "gamma",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_grueneisen_polynomial, gamma),
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .closed = true,
     .help = "Grueneisen coefficient"},
    PARAMETER_END,
};
