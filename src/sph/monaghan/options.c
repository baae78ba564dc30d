/* The options of SPH with corrected gradients and artificial viscosity, as a case names them. */
#include "sph/monaghan/monaghan.h"

static const char *const pair_stress_names[] = {"squares", "product", NULL};

const struct parameter monaghan_table[] = {
    {.key = "viscosity_alpha",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct monaghan_options, viscosity_alpha),
     .standard = "1",
     .above = 0.0,
     .below = 1e3,
     .closed = true,
     .help = "linear coefficient of the viscosity"},
    {.key = "viscosity_beta",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct monaghan_options, viscosity_beta),
     .standard = "1",
     .above = 0.0,
     .below = 1e3,
     .closed = true,
     .help = "quadratic coefficient of the viscosity"},
    {.key = "pair_stress",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct monaghan_options, pair_stress),
     .standard = "squares",
     .names = pair_stress_names,
     .help = "stress of a pair; squares: s_i/rho_i^2 + s_j/rho_j^2; product: (s_i + "
             "s_j)/(rho_i rho_j)"},
    HLLC_CONTINUITY_ROW(struct monaghan_options),
    HLLC_CORRECTION_ROW(struct monaghan_options),
    PARAMETER_END};
