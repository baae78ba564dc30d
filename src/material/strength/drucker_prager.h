/* Drucker and Prager's soil with a tension cut-off, tau = sqrt(S:S/2), sigma_m = -p:
 *
 *   shear    f^s = tau + q_phi sigma_m - k_phi                                   (2-70)
 *   tension  f^t = sigma_m - sigma^t, sigma^t at most k_phi/q_phi                (2-71)
 *   border   h = tau - tau^p - alpha^p (sigma_m - sigma^t)                       (2-67)
 *            tau^p = k_phi - q_phi sigma^t, alpha^p = sqrt(1 + q_phi^2) - q_phi  (2-68), (2-69)
 *
 * The elastic trial returns in shear by dl = f^s/(G + K q_phi q_psi) where sigma_m < sigma^t and
 * f^s > 0, or sigma_m >= sigma^t and h > 0; to sigma^t where sigma_m >= sigma^t and h <= 0. Tension
 * beyond sigma^t that a return in shear leaves is cut too, which the source does not say; a return
 * in tension leaves its shear to the next step. The volume that a return takes stays: see
 * `dilation` in material.h. Source: Cui, dissertation (2014); plastic strains as in the public
 * MPM3D codes. */
#ifndef BOLIDE_STRENGTH_DRUCKER_PRAGER_H
#define BOLIDE_STRENGTH_DRUCKER_PRAGER_H

#include "material/strength/common.h"

struct strength_drucker_prager {
    double shear_modulus; /* G, Pa */
    double friction;      /* q_phi */
    double cohesion;      /* k_phi, Pa */
    double dilatancy;     /* q_psi */
    double tension;       /* sigma^t, Pa */
};

#define STRENGTH_drucker_prager_NAME "drucker-prager"
#define STRENGTH_drucker_prager_HELP \
    "soil and rubble: shear strength that grows with pressure, and a tension cut-off"
#define STRENGTH_drucker_prager_PARAMETERS(T)                                               \
    NUMBER(T, shear_modulus, "Pa", REQUIRED, POSITIVE, "shear modulus")                     \
    NUMBER(T, friction, "", REQUIRED, POSITIVE,                                             \
           "q_phi: slope of the shear strength; 6 sin(phi)/(sqrt(3) (3 + sin(phi)))")       \
    NUMBER(T, cohesion, "Pa", REQUIRED, POSITIVE,                                           \
           "k_phi: shear strength without pressure; 6 c cos(phi)/(sqrt(3) (3 + sin(phi)))") \
    NUMBER(T, dilatancy, "", "0", NOT_NEGATIVE, "q_psi: volume gained in plastic shear")    \
    NUMBER(T, tension, "Pa", "0 Pa", NOT_NEGATIVE,                                          \
           "sigma^t: mean stress at which soil fails in tension, at most cohesion/friction")

BOLIDE_INLINE double drucker_prager_tension(const struct strength_drucker_prager *soil)
{
    return minimum(soil->tension, soil->cohesion / soil->friction);
}

/* sqrt(3) tau where shear flows. */
BOLIDE_INLINE double strength_drucker_prager_yield(const struct strength_drucker_prager *soil,
                                                   const struct point *point)
{
    return sqrt(3.0) * maximum(soil->cohesion + soil->friction * point->pressure, 0.0);
}

/* POINT->pressure is that of the elastic trial on entry. */
BOLIDE_INLINE void strength_drucker_prager(const struct strength_drucker_prager *soil,
                                           const struct motion *motion, double bulk_modulus,
                                           struct point *point)
{
    struct sym3 s = strength_elastic(soil->shear_modulus, motion, point->deviator);
    double q = soil->friction, most = drucker_prager_tension(soil);
    double tau = sqrt(0.5 * sym3_square(s)), mean = -point->pressure, strain = 0.0;
    double over = tau + q * mean - soil->cohesion;
    double border = tau - (soil->cohesion - q * most) - (sqrt(1.0 + square(q)) - q) * (mean - most);
    if (mean < most ? over > 0.0 : border > 0.0) {
        double flow = over / (soil->shear_modulus + bulk_modulus * q * soil->dilatancy);
        mean -= bulk_modulus * soil->dilatancy * flow;
        strain += flow * sqrt(1.0 / 3.0 + 2.0 / 9.0 * square(soil->dilatancy));
        s = sym3_scale((soil->cohesion - q * minimum(mean, most)) / tau, s);
    }
    if (mean > most) {
        strain += sqrt(2.0) / 3.0 * (mean - most) / bulk_modulus;
        mean = most;
    }
    point->deviator = s;
    point->pressure = -mean;
    point->history[HISTORY_plastic_strain] += strain;
}

BOLIDE_INLINE struct strength_traits strength_drucker_prager_traits(
    const struct strength_drucker_prager *soil)
{
    struct strength_traits traits = strength_default_traits();
    traits.limits_tension = true;
    (void)soil;
    traits.history = HISTORY_BIT(dilation);
    traits.takes_pressure = true;
    return traits;
}

#endif
