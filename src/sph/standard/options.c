/* The options of classical SPH, as a case names them. */
#include "sph/standard/standard.h"

const struct parameter standard_table[] = {
    PARAMETER(NUMBER, struct standard_options, viscosity_quadratic, "20",
              "coefficient of D^2 rho k^2 in the artificial viscosity", .above = 0.0, .below = 1e3,
              .closed = true, .change = CHANGE_FROM_HERE),
    PARAMETER(NUMBER, struct standard_options, viscosity_linear, "0.5",
              "coefficient of D rho C k in the artificial viscosity", .above = 0.0, .below = 1e3,
              .closed = true, .change = CHANGE_FROM_HERE),
    SPH_MOTION_ROW(struct standard_options), SPH_ENERGY_ROW(struct standard_options),
    PARAMETER_END};
