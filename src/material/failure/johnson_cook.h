/* Johnson and Cook's ductile damage: each plastic strain d eps adds d eps/eps_f, with the failure
 * strain
 *
 *   eps_f = (D1 + D2 exp(D3 s)) (1 + D4 ln max(rate/rate_0, 1)) (1 + D5 T*)
 *
 * s is the mean stress over the Mises stress, positive in tension. The source's tests end at s =
 * 1.5: eps_f keeps its value of there beyond. It is never less than a least strain, since D1 + D2
 * exp(D3 s) of some published sets falls below zero. Its default exceeds the plastic strain of the
 * outermost SPH particle in its short tension while a shock of a few GPa reflects at a free face.
 * T* is that of the strength model. A mean tension of `spall`, where given, fails the point at
 * once. Source: Johnson and Cook, Eng. Fract. Mech. 21 (1985) 31; the least strain is ours.
 *
 * Damage can weaken the strength, by the fraction beta D where D grows by D_c d eps/(eps_f - p_d)
 * from the plastic strain p_d on and the point fails at D = D_c; our damage is D/D_c. Source:
 * Borvik, Hopperstad, Berstad and Langseth, Eur. J. Mech. A 20 (2001) 685, recalled. */
#ifndef BOLIDE_FAILURE_JOHNSON_COOK_H
#define BOLIDE_FAILURE_JOHNSON_COOK_H

#include "material/failure/common.h"

struct failure_johnson_cook {
    FAILURE_MEMBERS
    double d1, d2, d3, d4, d5;
    double rate;         /* rate_0, 1/s */
    double least_strain; /* of eps_f */
    double spall;        /* Pa; NAN: none */
    double band;         /* m; NAN: none */
    double coupling;     /* beta */
    double critical;     /* D_c */
    double onset;        /* p_d */
};

#define FAILURE_johnson_cook_NAME "johnson-cook"
#define FAILURE_johnson_cook_HELP \
    "ductile damage by plastic strain, dependent on triaxiality, strain rate and temperature"
#define FAILURE_johnson_cook_PARAMETERS(T)                                                      \
    NUMBER(T, d1, "", REQUIRED, ANY, "D1: failure strain at high triaxiality")                  \
    NUMBER(T, d2, "", REQUIRED, ANY, "D2: factor of exp(D3 mean stress/Mises stress)")          \
    NUMBER(T, d3, "", REQUIRED, ANY, "D3: negative where tension embrittles")                   \
    NUMBER(T, d4, "", "0", ANY, "D4: factor of the logarithm of the strain rate")               \
    NUMBER(T, d5, "", "0", ANY, "D5: factor of T* of the strength model")                       \
    NUMBER(T, rate, "1/s", "1 1/s", POSITIVE, "strain rate below which the rate has no effect") \
    NUMBER(T, least_strain, "", "0.01", POSITIVE,                                               \
           "least failure strain, where the formula gives less")                                \
    NUMBER(T, spall, "Pa", OPTIONAL, POSITIVE,                                                  \
           "mean tension at which it fails at once; default: none")                             \
    NUMBER(T, coupling, "", "0", FROM_ZERO_TO_ONE,                                              \
           "beta: damage D takes the fraction beta D of the yield stress; 0: none, 1: as in "   \
           "Borvik's model; with `strength: johnson-cook`")                                     \
    NUMBER(T, critical, "", "1", FROM_ZERO_TO_ONE,                                              \
           "D_c: damage D at failure; the field `damage` is D/D_c; matters with `coupling`")    \
    NUMBER(T, onset, "", "0", NOT_NEGATIVE, "p_d: plastic strain at which damage begins")       \
    FAILURE_BAND(T) FAILURE_COMMON(T)

/* eps_f at the mean stress over Mises stress TRIAXIALITY, RATE (1/s) and T* HOMOLOGOUS. */
BOLIDE_INLINE double johnson_cook_failure_strain(const struct failure_johnson_cook *failure,
                                                 double triaxiality, double rate, double homologous)
{
    const double of_stress =
        failure->d1 + failure->d2 * exponential(failure->d3 * minimum(triaxiality, 1.5));
    const double of_rate = 1.0 + failure->d4 * logarithm(maximum(rate / failure->rate, 1.0));
    const double of_heat = 1.0 + failure->d5 * homologous;
    return maximum(of_stress * of_rate * of_heat, failure->least_strain);
}

BOLIDE_INLINE double failure_johnson_cook(const struct failure_johnson_cook *failure,
                                          const struct failing *point, double damage)
{
    const double mises = maximum(sym3_mises(point->deviator), 1e-100);
    const double triaxiality = maximum(-point->pressure / mises, -20.0);
    const double strain =
        johnson_cook_failure_strain(failure, triaxiality, point->rate, point->homologous);
    const double flow = point->flow * failing_haste(point, failure->band, triaxiality);
    const double whole = strain * point->relative,
                 left = maximum(whole - failure->onset, 0.1 * whole);
    const double grown =
        damage + (flow > 0.0 && point->strain > failure->onset ? flow / left : 0.0);
    return -point->pressure >= failure->spall * point->relative
               ? 1.0
               : grown; /* not where there is none: NAN */
}

BOLIDE_INLINE struct failure_traits failure_johnson_cook_traits(
    const struct failure_johnson_cook *failure)
{
    struct failure_traits traits = failure_default_traits();
    traits.batched = true;
    traits.limits_tension = !isnan(failure->spall);
    traits.weakening = failure->coupling * failure->critical;
    return traits;
}

#endif
