/* Johnson and Cook's yield stress, with isotropic hardening, rate and heat:
 *
 *   Y = (A + B eps^n)(1 + C ln max(rate/rate_0, 1))(1 - T*^m),  T* = (T - T_room)/(T_melt - T_room)   (2-64)
 *
 * T is T_room and the heat of the plastic work, dT = Y d eps/(rho c_v). Radial return solves
 *
 *   S_eq - 3 G d eps = Y(eps + d eps, d eps/dt)
 *
 * of the elastic trial S_eq, by Newton's method within a bracket; T is that before the step. The explicit variant is that
 * of the public MPM3D codes: d eps = (S_eq - Y)/[3 G + B n (eps + 1e-4)^(n-1)] with the Y before the step, then the
 * stress is put on Y after it; their Y before the step is stored, ours has the strain rate of the step.
 * Source: Johnson and Cook, Proc. 7th Int. Symp. Ballistics (1983) 541, in the form of Cui, dissertation (2014). */
#ifndef BOLIDE_STRENGTH_JOHNSON_COOK_H
#define BOLIDE_STRENGTH_JOHNSON_COOK_H

#include "material/strength/elastic.h"

enum johnson_cook_return { JOHNSON_COOK_IMPLICIT, JOHNSON_COOK_EXPLICIT };

struct strength_johnson_cook {
    double shear_modulus;        /* G, Pa */
    double a, b;                 /* A, B, Pa */
    double n, c;                 /* n, C */
    double rate;                 /* rate_0, 1/s */
    double m;                    /* NAN: heat does not soften, and what follows is not used */
    double room, melt, capacity; /* T_room, T_melt, K; c_v, J/(kg K) */
    int return_map;              /* enum johnson_cook_return */
};

BOLIDE_INLINE bool johnson_cook_softens(const struct strength_johnson_cook *solid)
{
    return !isnan(solid->m);
}

/* Why its parameters do not go together, *KEY is that it is about; NULL when they do. */
BOLIDE_INLINE const char *johnson_cook_wrong(const struct strength_johnson_cook *solid,
                                             const char **key)
{
    *key = isnan(solid->melt) ? "melt" : isnan(solid->capacity) ? "capacity" : "melt";
    if (!johnson_cook_softens(solid) || solid->melt > solid->room)
        return johnson_cook_softens(solid) && isnan(solid->capacity) ? "m needs this beside it"
                                                                     : NULL;
    return isnan(solid->melt) ? "m needs this beside it" : "this is not above `room`";
}

/* 1 - T*^m after HEATING by K. */
BOLIDE_INLINE double johnson_cook_softening(const struct strength_johnson_cook *solid,
                                            double heating)
{
    if (!johnson_cook_softens(solid) || heating <= 0.0)
        return 1.0;
    double share = heating / (solid->melt - solid->room);
    return share < 1.0 ? 1.0 - pow(share, solid->m) : 0.0;
}

/* 1 + C ln max(rate/rate_0, 1). */
BOLIDE_INLINE double johnson_cook_hastening(const struct strength_johnson_cook *solid, double rate)
{
    return rate > solid->rate ? 1.0 + solid->c * log(rate / solid->rate) : 1.0;
}

/* Y at plastic STRAIN, RATE (1/s) and HEATING (K). */
BOLIDE_INLINE double johnson_cook_stress(const struct strength_johnson_cook *solid, double strain,
                                         double rate, double heating)
{
    return (solid->a + solid->b * pow(strain, solid->n)) * johnson_cook_hastening(solid, rate) *
           johnson_cook_softening(solid, heating);
}

/* Y of slow flow. */
BOLIDE_INLINE double strength_johnson_cook_yield(const struct strength_johnson_cook *solid,
                                                 const struct point *point)
{
    double heating = johnson_cook_softens(solid) ? point->history[HISTORY_plastic_heating] : 0.0;
    return johnson_cook_stress(solid, point->history[HISTORY_plastic_strain], 0.0, heating);
}

/* The plastic strain of a step of DT that starts from STRAIN and SLOW, its Y of slow flow, with a trial stress beyond
 * that. What remains of the stress falls with it and Y grows, and Y bends down: from the left Newton's method does not
 * overshoot. Its first rounds take the hardening along its slope, which spares them a power. */
BOLIDE_INLINE double johnson_cook_flow(const struct strength_johnson_cook *solid, double dt,
                                       double trial, double strain, double slow, double softening)
{
    const double triple = 3.0 * solid->shear_modulus;
    const int guesses = strain > 0.0 ? 2 : 0;
    const double along = guesses ? (slow - solid->a * softening) * solid->n / strain : 0.0;
    double low = 0.0, high = (trial - slow) / triple, flow = high;
    for (int round = 0; round < 60; round++) {
        double now = strain + flow, rate = flow / dt, stress = slow + along * flow, slope = along;
        if (round >= guesses) {
            double power = solid->b * pow(now, solid->n) * softening;
            stress = solid->a * softening + power;
            slope = power * solid->n / now;
        }
        double hastening = johnson_cook_hastening(solid, rate);
        slope *= hastening;
        if (rate > solid->rate)
            slope += stress * solid->c / flow;
        double over = trial - triple * flow - stress * hastening;
        if (round >= guesses)
            *(over > 0.0 ? &low : &high) = flow;
        double next = flow + over / (triple + slope);
        if (!(next >= low && next <= high))
            next = 0.5 * (low + high);
        double change = fabs(next - flow);
        flow = next;
        if (round >= guesses && change <= 1e-4 * flow) /* the error left is about its square */
            break;
    }
    return flow;
}

BOLIDE_INLINE void strength_johnson_cook(const struct strength_johnson_cook *solid,
                                         const struct motion *motion, double bulk_modulus,
                                         struct point *point)
{
    (void)bulk_modulus;
    struct sym3 s = strength_elastic(solid->shear_modulus, motion, point->deviator);
    double trial = sym3_mises(s), strain = point->history[HISTORY_plastic_strain];
    double softening = johnson_cook_softens(solid)
                           ? johnson_cook_softening(solid, point->history[HISTORY_plastic_heating])
                           : 1.0;
    point->deviator = s;
    if (trial <= solid->a * softening)
        return;
    double triple = 3.0 * solid->shear_modulus, flow, stress;
    double yield = (solid->a + solid->b * pow(strain, solid->n)) * softening;
    if (solid->return_map == JOHNSON_COOK_EXPLICIT)
        yield *= johnson_cook_hastening(solid, strength_strain_rate(motion->strain_rate));
    if (trial <= yield)
        return;
    if (solid->return_map == JOHNSON_COOK_EXPLICIT) {
        double slope = solid->b * solid->n * pow(strain + 1e-4, solid->n - 1.0);
        flow = (trial - yield) / (triple + slope);
        stress = (solid->a + solid->b * pow(strain + flow, solid->n)) * softening *
                 johnson_cook_hastening(solid, flow / motion->dt);
        stress = minimum(stress, trial);
    } else {
        flow = johnson_cook_flow(solid, motion->dt, trial, strain, yield, softening);
        stress = trial - triple * flow;
    }
    point->deviator = sym3_scale(stress / trial, s);
    point->history[HISTORY_plastic_strain] = strain + flow;
    if (johnson_cook_softens(solid))
        point->history[HISTORY_plastic_heating] +=
            stress * flow / (motion->density * solid->capacity);
}

#endif
