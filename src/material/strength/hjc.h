/* Concrete after Holmquist, Johnson and Cook, with damage by tension. p* = p/f_c, T* = T/f_c:
 *
 *   Y/f_c = [A (1 - D) + B p*^N][1 + C ln max(rate/rate_0, 1)] <= S_max; no B term in tension (2-61)
 *   dD_c = (d eps_p + d mu_p)/max(D_1 (p* + T*)^D_2, eps_min)                                (2-62)
 *   dD_t/dt = a D_t (1 - D_t) (sigma_s/sigma_0 - 1)^gamma where sigma_s > sigma_0            (2-63)
 *   p >= -T (1 - max(D_c, D_t))
 *
 * D is D_c, in tension the larger of both. sigma_s is max(-p, 0)/(1 - D_t), or the largest
 * principal stress over that; over a step it is held, and D_t/(1 - D_t) grows by exactly exp(a
 * (sigma_s/sigma_0 - 1)^gamma dt), from D_t0 on. At its limit either damage becomes one, and the
 * concrete has failed: it bears no tension and no shear, or as rubble the friction B p*^N alone.
 * Source: Holmquist, Johnson and Cook, Proc. 14th Int. Symp. Ballistics (1993) 591; the damage by
 * tension after Jiang Dong (2010), both as in Cui, dissertation (2014). He names no constants of
 * (2-63): defaults are ours. */
#ifndef BOLIDE_STRENGTH_HJC_H
#define BOLIDE_STRENGTH_HJC_H

#include "base/exponential.h"
#include "material/strength/common.h"

enum hjc_tensile_stress { HJC_MEAN, HJC_PRINCIPAL };

struct strength_hjc {
    double shear_modulus;                       /* G, Pa */
    double a, b, n, c;                          /* A, B, N, C */
    double strength;                            /* f_c, Pa */
    double rate;                                /* rate_0, 1/s */
    double most;                                /* S_max */
    double tension;                             /* T, Pa */
    double d1, d2;                              /* D_1, D_2 */
    double damage_limit;                        /* D_c at which it fails */
    double least_strain;                        /* eps_min */
    double tensile_growth;                      /* a, 1/s; 0: tension does no damage */
    double tensile_threshold, tensile_exponent; /* sigma_0, Pa; gamma */
    double tensile_start, tensile_limit;        /* D_t0; D_t at which it breaks */
    int tensile_stress;                         /* enum hjc_tensile_stress: what sigma_s is */
    bool rubble;                                /* what has failed keeps its friction */
};

#define STRENGTH_hjc_NAME "hjc"
#define STRENGTH_hjc_HELP \
    "concrete after Holmquist, Johnson and Cook, with damage by crushing and by tension"
#define STRENGTH_hjc_PARAMETERS(T)                                                                \
    NUMBER(T, shear_modulus, "Pa", REQUIRED, POSITIVE, "shear modulus")                           \
    NUMBER(T, a, "", REQUIRED, NOT_NEGATIVE, "A: cohesion of intact concrete, relative to f_c")   \
    NUMBER(T, b, "", REQUIRED, NOT_NEGATIVE, "B: increase of strength with pressure")             \
    NUMBER(T, n, "", REQUIRED, POSITIVE, "N: exponent of the pressure")                           \
    NUMBER(T, c, "", REQUIRED, NOT_NEGATIVE, "C: factor of the logarithm of the strain rate")     \
    NUMBER(T, strength, "Pa", REQUIRED, POSITIVE,                                                 \
           "f_c: quasi-static uniaxial strength in compression")                                  \
    NUMBER(T, rate, "1/s", "1 1/s", POSITIVE, "strain rate below which the rate has no effect")   \
    NUMBER(T, most, "", REQUIRED, POSITIVE, "S_max: largest yield stress, relative to f_c")       \
    NUMBER(T, tension, "Pa", REQUIRED, NOT_NEGATIVE, "T: largest hydrostatic tension")            \
    NUMBER(T, d1, "", REQUIRED, NOT_NEGATIVE, "D_1: factor of the failure strain")                \
    NUMBER(T, d2, "", "1", POSITIVE, "D_2: exponent of the pressure in the failure strain")       \
    NUMBER(T, damage_limit, "", "1", FROM_ZERO_TO_ONE,                                            \
           "D_c: damage by crushing at which concrete fails")                                     \
    NUMBER(T, least_strain, "", REQUIRED, POSITIVE, "smallest failure strain")                    \
    NUMBER(T, tensile_growth, "1/s", "7e5 1/s", NOT_NEGATIVE,                                     \
           "a: growth rate of damage by tension; 0: no such damage")                              \
    NUMBER(T, tensile_threshold, "Pa", "2.5 MPa", POSITIVE,                                       \
           "sigma_0: tension up to which there is no damage")                                     \
    NUMBER(T, tensile_exponent, "", "1", POSITIVE, "gamma: exponent of tension/sigma_0 - 1")      \
    NUMBER(T, tensile_start, "", "1e-3", BETWEEN_ZERO_AND_ONE, "D_t0: initial damage by tension") \
    NUMBER(T, tensile_limit, "", "0.9", FROM_ZERO_TO_ONE,                                         \
           "damage by tension at which concrete fails")                                           \
    CHOICE(T, tensile_stress, "mean",                                                             \
           "which tension does damage: mean, or the largest principal stress", "mean",            \
           "principal")                                                                           \
    FLAG(T, rubble, "no", "whether failed concrete keeps its friction under pressure")

/* max(D_c, D_t). */
BOLIDE_INLINE double hjc_whole_damage(const double *history)
{
    return maximum(history[HISTORY_damage], history[HISTORY_tensile_damage]);
}

/* Y at PRESSURE (Pa), DAMAGE and RATE (1/s). */
BOLIDE_INLINE double hjc_stress(const struct strength_hjc *concrete, double pressure, double damage,
                                double rate)
{
    double relative = pressure / concrete->strength;
    double whole = concrete->a * (1.0 - damage);
    if (relative > 0.0)
        whole += concrete->b * power(relative, concrete->n);
    if (rate > concrete->rate)
        whole *= 1.0 + concrete->c * logarithm(rate / concrete->rate);
    return concrete->strength * minimum(whole, concrete->most);
}

/* The denominator of (2-62): the strain at which concrete under PRESSURE fails. */
BOLIDE_INLINE double hjc_failure_strain(const struct strength_hjc *concrete, double pressure)
{
    double relative = (pressure + concrete->tension) / concrete->strength;
    double strain = relative > 0.0 ? concrete->d1 * power(relative, concrete->d2) : 0.0;
    return maximum(strain, concrete->least_strain);
}

/* D_t after DT under sigma_s = STRESS. */
BOLIDE_INLINE double hjc_tensile_damage(const struct strength_hjc *concrete, double damage,
                                        double stress, double dt)
{
    if (!(stress > concrete->tensile_threshold) || damage >= 1.0)
        return damage;
    double from = maximum(damage, concrete->tensile_start);
    double over = stress / concrete->tensile_threshold - 1.0;
    double growth = concrete->tensile_growth * power(over, concrete->tensile_exponent) * dt;
    double after = 1.0 / (1.0 + (1.0 - from) / from * exponential(-growth));
    return after >= concrete->tensile_limit ? 1.0 : after;
}

/* Crushing by a plastic strain or compression of STRAIN under the pressure of POINT. */
BOLIDE_INLINE void hjc_crush(const struct strength_hjc *concrete, double strain,
                             struct point *point)
{
    double damage = point->history[HISTORY_damage];
    damage += strain / hjc_failure_strain(concrete, point->pressure);
    point->history[HISTORY_damage] = damage >= concrete->damage_limit ? 1.0 : damage;
}

/* Of what has not failed; of what has the friction, where it keeps that. */
BOLIDE_INLINE double hjc_strength(const struct strength_hjc *concrete, const struct point *point,
                                  double rate)
{
    const double *history = point->history;
    double damage = point->pressure < 0.0 ? hjc_whole_damage(history) : history[HISTORY_damage];
    if (hjc_whole_damage(history) < 1.0)
        return hjc_stress(concrete, point->pressure, damage, rate);
    return concrete->rubble ? hjc_stress(concrete, point->pressure, 1.0, rate) : 0.0;
}

BOLIDE_INLINE double strength_hjc_yield(const struct strength_hjc *concrete,
                                        const struct point *point)
{
    return hjc_strength(concrete, point, 0.0);
}

/* sigma_s of POINT. */
BOLIDE_INLINE double hjc_pull(const struct strength_hjc *concrete, const struct point *point)
{
    double stress = -point->pressure;
    if (concrete->tensile_stress == HJC_PRINCIPAL)
        stress += sym3_largest(point->deviator);
    return maximum(stress, 0.0) / (1.0 - point->history[HISTORY_tensile_damage]);
}

/* POINT->pressure is that of its density. */
BOLIDE_INLINE void strength_hjc(const struct strength_hjc *concrete, const struct motion *motion,
                                double bulk_modulus, struct point *point)
{
    (void)bulk_modulus;
    if (motion->compaction > 0.0)
        hjc_crush(concrete, motion->compaction, point);
    struct sym3 s = strength_elastic(concrete->shear_modulus, motion, point->deviator);
    double yield = hjc_strength(concrete, point, strength_strain_rate(motion->strain_rate));
    double trial = sym3_mises(s);
    if (trial > yield) {
        double flow = (trial - yield) / (3.0 * concrete->shear_modulus);
        s = sym3_scale(yield / trial, s);
        point->history[HISTORY_plastic_strain] += flow;
        hjc_crush(concrete, flow, point);
    }
    point->deviator = s;
    if (concrete->tensile_growth > 0.0 && point->history[HISTORY_tensile_damage] < 1.0)
        point->history[HISTORY_tensile_damage] =
            hjc_tensile_damage(concrete, point->history[HISTORY_tensile_damage],
                               hjc_pull(concrete, point), motion->dt);
    if (hjc_whole_damage(point->history) >= 1.0 && !concrete->rubble)
        point->deviator = sym3_scale(0.0, s);
}

/* Cuts the tension of a state that concrete does not bear. Its sound stays that of the uncut. */
BOLIDE_INLINE void strength_hjc_cut(const struct strength_hjc *concrete, const double *history,
                                    struct eos_value *value)
{
    double most = concrete->tension * maximum(1.0 - hjc_whole_damage(history), 0.0);
    value->pressure = maximum(value->pressure, -most);
}

BOLIDE_INLINE struct strength_traits strength_hjc_traits(const struct strength_hjc *concrete)
{
    struct strength_traits traits = strength_default_traits();
    traits.limits_tension = true;
    traits.history = HISTORY_BIT(damage);
    if (concrete->tensile_growth > 0.0)
        traits.history |= HISTORY_BIT(tensile_damage);
    traits.takes_pressure = true;
    return traits;
}

#endif
