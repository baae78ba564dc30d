/* Strength models: what a material does with shear. One struct for all, as there is one model yet. */
#ifndef BOLIDE_STRENGTH_H
#define BOLIDE_STRENGTH_H

#include "material/strength/perfect_plastic.h"

enum strength_kind { STRENGTH_NONE, STRENGTH_PERFECT_PLASTIC, STRENGTH_KINDS };

struct strength {
    enum strength_kind kind;
    union {
        struct strength_perfect_plastic perfect_plastic;
    } of;
};

/* Shear modulus, Pa; zero for a fluid. */
BOLIDE_INLINE double strength_shear_modulus(const struct strength *strength)
{
    return strength->kind == STRENGTH_PERFECT_PLASTIC ? strength->of.perfect_plastic.shear_modulus
                                                      : 0.0;
}

/* Yield stress in simple tension, Pa; zero for a fluid. */
BOLIDE_INLINE double strength_yield(const struct strength *strength, const double *history)
{
    (void)history;
    return strength->kind == STRENGTH_PERFECT_PLASTIC ? strength->of.perfect_plastic.yield : 0.0;
}

/* Advances the deviator by DT. STRAIN_RATE is the whole symmetric velocity gradient. */
BOLIDE_INLINE void strength_step(const struct strength *strength, double dt,
                                 struct sym3 strain_rate, struct vec3 spin, struct sym3 *deviator,
                                 double *history)
{
    if (strength->kind == STRENGTH_PERFECT_PLASTIC)
        *deviator = strength_perfect_plastic(&strength->of.perfect_plastic, dt, strain_rate, spin,
                                             *deviator, &history[0]);
}

#endif
