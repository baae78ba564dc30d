/* The options of SPH with corrected gradients and artificial viscosity, as a case names them. */
#include "sph/monaghan/monaghan.h"

static const char *const pair_stress_names[] = {"squares", "product", NULL};

const struct parameter monaghan_table[] = {
    PARAMETER(NUMBER, struct monaghan_options, viscosity_alpha, "1",
              "linear coefficient of the viscosity", .above = 0.0, .below = 1e3, .closed = true),
    PARAMETER(NUMBER, struct monaghan_options, viscosity_beta, "1",
              "quadratic coefficient of the viscosity", .above = 0.0, .below = 1e3, .closed = true),
    PARAMETER(
        CHOICE, struct monaghan_options, pair_stress, "squares",
        "stress of a pair; squares: s_i/rho_i^2 + s_j/rho_j^2; product: (s_i + s_j)/(rho_i rho_j)",
        .names = pair_stress_names),
    HLLC_CONTINUITY_ROW(struct monaghan_options),
    HLLC_CORRECTION_ROW(struct monaghan_options),
    PARAMETER_END};
