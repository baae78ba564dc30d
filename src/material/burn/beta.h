/* Beta burn: as programmed, or sooner where the explosive is compressed. F is the larger of that of
 * the programmed burn and
 *
 *   (1 - V) rho_0 D^2/p_CJ,   which is 1 above 0.95,   V = rho_0/rho
 *
 * Source: the public MPM3D codes; Zhang, Chen and Liu, The material point method (2017). */
#ifndef BOLIDE_BURN_BETA_H
#define BOLIDE_BURN_BETA_H

#include "material/burn/programmed.h"

struct burn_beta {
    double speed;    /* D, m/s */
    double pressure; /* p_CJ, Pa */
};

#define BURN_beta_NAME "beta"
#define BURN_beta_HELP "as programmed, or earlier where it is compressed"
#define BURN_beta_PARAMETERS(T)                                        \
    NUMBER(T, speed, "m/s", REQUIRED, POSITIVE, "D: detonation speed") \
    NUMBER(T, pressure, "Pa", REQUIRED, POSITIVE, "p_CJ: Chapman-Jouguet pressure")

/* F. */
BOLIDE_INLINE double burn_beta(const struct burn_beta *burn, const struct burning *point)
{
    const struct burn_programmed programmed = {burn->speed};
    double pressed = (1.0 - point->volume) * point->rest * square(burn->speed) / burn->pressure;
    return maximum(burn_programmed(&programmed, point), pressed > 0.95 ? 1.0 : pressed);
}

BOLIDE_INLINE struct burn_traits burn_beta_traits(const struct burn_beta *burn)
{
    struct burn_traits traits = burn_default_traits();
    traits.pressure = burn->pressure;
    return traits;
}

#endif
