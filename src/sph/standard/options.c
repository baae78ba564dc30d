/* The options of classical SPH, as a case names them. */
#include "sph/standard/standard.h"

const struct parameter standard_table[] = {
    {.key = "viscosity_quadratic",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct standard_options, viscosity_quadratic),
     .standard = "20",
     .above = 0.0,
     .below = 1e3,
     .closed = true,
     .help = "coefficient of D^2 rho k^2 in the artificial viscosity"},
    {.key = "viscosity_linear",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct standard_options, viscosity_linear),
     .standard = "0.5",
     .above = 0.0,
     .below = 1e3,
     .closed = true,
     .help = "coefficient of D rho C k in the artificial viscosity"},
    SPH_MOTION_ROW(struct standard_options),
    SPH_ENERGY_ROW(struct standard_options),
    PARAMETER_END};
