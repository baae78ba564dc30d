/* How an explosive becomes its products: the share F that has burnt, by which the pressure of the products counts. What
 * has not burnt bears no pressure and no shear, and sound travels in it as the detonation does.
 *
 *   instant      F = 1 from the start (artificial detonation)
 *   programmed   F = 0 before the lighting time t_L, then (t - t_L) D/(1.5 h), at most 1            (3-1), (3-2)
 *   beta         the larger of that and (1 - V) rho_0 D^2/p_CJ, which is 1 above 0.95
 *
 * with the detonation speed D and the point's own length h; F never falls. t_L is when a detonation of speed D that
 * starts at one of the case's `detonations` arrives. Source: Cui, dissertation (2014); the beta burn is that of the
 * public MPM3D codes. */
#ifndef BOLIDE_BURN_H
#define BOLIDE_BURN_H

#include "material/point.h"

enum burn_kind { BURN_INSTANT, BURN_PROGRAMMED, BURN_BETA, BURN_KINDS };

struct burn_programmed {
    double speed; /* D, m/s */
};

struct burn_beta {
    double speed;    /* D, m/s */
    double pressure; /* p_CJ, Pa */
};

struct burn {
    enum burn_kind kind;
    union {
        double speed;
        struct burn_programmed programmed;
        struct burn_beta beta;
    } of;
};

/* The share burnt of a point that is lit at LIGHTING after a step that ends at TIME (s); BEFORE: of the step before; LENGTH
 * in m; VOLUME = rho_0/rho and the density at rest, kg/m^3. */
BOLIDE_INLINE double burn_share(const struct burn *burn, double before, double lighting,
                                double time, double length, double volume, double rest)
{
    if (burn->kind == BURN_INSTANT)
        return 1.0;
    double share = before, passed = time - lighting;
    if (passed >= 0.0)
        share = maximum(share, minimum(passed * burn->of.speed / (1.5 * length), 1.0));
    if (burn->kind == BURN_BETA) {
        double pressed = (1.0 - volume) * rest * square(burn->of.speed) / burn->of.beta.pressure;
        share = maximum(share, pressed > 0.95 ? 1.0 : pressed);
    }
    return share;
}

/* The state of the products made that of what has burnt to SHARE: c^2 is F c_products^2 and (1 - F) D^2. */
BOLIDE_INLINE void burn_mix(const struct burn *burn, double share, struct eos_value *value)
{
    value->pressure *= share;
    value->dp_drho = share * value->dp_drho + (1.0 - share) * square(burn->of.speed);
    value->dp_de *= share;
}

#endif
