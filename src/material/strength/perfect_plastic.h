/* Perfect von Mises plasticity: radial return to sqrt(3/2 S:S) = Y, (1.61), (1.62).
 * Source: Parshikov (2013), sections 1.3 and 1.5. */
#ifndef BOLIDE_STRENGTH_PERFECT_PLASTIC_H
#define BOLIDE_STRENGTH_PERFECT_PLASTIC_H

#include "material/strength/common.h"

struct strength_perfect_plastic {
    double shear_modulus; /* G, Pa */
    double yield;         /* Y_0, Pa, in simple tension */
};

#define STRENGTH_perfect_plastic_NAME "perfect-plastic"
#define STRENGTH_perfect_plastic_HELP "elastic up to a constant von Mises yield stress"
#define STRENGTH_perfect_plastic_PARAMETERS(T)                          \
    NUMBER(T, shear_modulus, "Pa", REQUIRED, POSITIVE, "shear modulus") \
    NUMBER(T, yield, "Pa", REQUIRED, POSITIVE, "yield stress in simple tension")

BOLIDE_INLINE double strength_perfect_plastic_yield(const struct strength_perfect_plastic *solid,
                                                    const struct point *point)
{
    (void)point;
    return solid->yield;
}

BOLIDE_INLINE void strength_perfect_plastic(const struct strength_perfect_plastic *solid,
                                            const struct motion *motion, double bulk_modulus,
                                            struct point *point)
{
    (void)bulk_modulus;
    struct sym3 s = strength_elastic(solid->shear_modulus, motion, point->deviator);
    double mises = sym3_mises(s);
    double over = mises - solid->yield;
    double keep = over > 0.0 ? solid->yield / mises : 1.0;
    point->history[HISTORY_plastic_strain] +=
        over > 0.0 ? over / (3.0 * solid->shear_modulus) : 0.0;
    point->deviator = sym3_scale(keep, s);
}

BOLIDE_INLINE void strength_perfect_plastic_batch(const struct strength_perfect_plastic *solid,
                                                  struct batch *b)
{
    for (int k = 0; k < b->count; k++) {
        struct motion motion = batch_motion(b, k);
        struct point point = {.deviator = batch_tensor(b->deviator, k),
                              .history = {b->plastic_strain[k]}};
        strength_perfect_plastic(solid, &motion, 0.0, &point);
        batch_keep_tensor(b->new_deviator, k, point.deviator);
        b->plastic_strain[k] = point.history[HISTORY_plastic_strain];
    }
}

BOLIDE_INLINE void strength_perfect_plastic_melt(struct strength_perfect_plastic *solid,
                                                 double left)
{
    solid->shear_modulus *= left;
    solid->yield *= left;
}

BOLIDE_INLINE struct strength_traits strength_perfect_plastic_traits(
    const struct strength_perfect_plastic *solid)
{
    struct strength_traits traits = strength_default_traits();
    (void)solid;
    traits.batched = traits.melts = true;
    return traits;
}

#endif
