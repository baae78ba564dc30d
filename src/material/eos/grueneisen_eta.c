/* What a case says of a Mie-Grüneisen solid in eta; see grueneisen_eta.h. */
#include "material/choices.h"

const char eos_grueneisen_eta_name[] = "grueneisen-eta";
const char eos_grueneisen_eta_help[] =
    "Mie-Grueneisen with gamma density constant, one formula in compression and tension";

const struct parameter eos_grueneisen_eta_parameters[] = {
    {.key = "density",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_grueneisen_eta, density),
     .unit = "kg/m^3",
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .help = "density at zero pressure and energy"},
    {.key = "sound",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_grueneisen_eta, sound),
     .unit = "m/s",
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .help = "shock speed of a vanishing shock, C_0 of U_s = C_0 + s U_p"},
    {.key = "slope",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_grueneisen_eta, slope),
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .closed = true,
     .help = "slope of the shock adiabat, s of U_s = C_0 + s U_p"},
    {.key = "gamma",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct eos_grueneisen_eta, gamma),
     .standard = PARAMETER_REQUIRED,
     .above = 0.0,
     .below = INFINITY,
     .closed = true,
     .help = "Grueneisen coefficient at zero pressure"},
    PARAMETER_END,
};
