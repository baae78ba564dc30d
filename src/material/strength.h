/* Strength models: what a material does with shear; one header each, and the one list of them.
 *
 * A strength model is a parameter struct whose first member is the shear modulus, a pure function that takes a point
 * through a step, elastic trial and return included, and its yield stress in simple tension. To add one: its header and
 * its parameter table in strength/, its line in the list below, and the history that it needs in strength_history. */
#ifndef BOLIDE_STRENGTH_H
#define BOLIDE_STRENGTH_H

#include "material/strength/drucker_prager.h"
#include "material/strength/hjc.h"
#include "material/strength/johnson_cook.h"
#include "material/strength/perfect_plastic.h"

/* X(identifier): struct strength_<identifier>, strength_<identifier>() and strength_<identifier>_yield() in
 * strength/<identifier>.h, its table in strength/<identifier>.c (see choices.h). */
#define STRENGTH_LIST(X) \
    X(perfect_plastic)   \
    X(johnson_cook)      \
    X(drucker_prager)    \
    X(hjc)

#define STRENGTH_ENUM(name) STRENGTH_##name,
enum strength_kind { STRENGTH_NONE, STRENGTH_LIST(STRENGTH_ENUM) STRENGTH_KINDS };
#undef STRENGTH_ENUM

#define STRENGTH_MEMBER(name) struct strength_##name name;
struct strength {
    enum strength_kind kind;
    union {
        double shear_modulus;
        STRENGTH_LIST(STRENGTH_MEMBER)
    } of;
};
#undef STRENGTH_MEMBER

/* Shear modulus, Pa; zero for a fluid. */
BOLIDE_INLINE double strength_shear_modulus(const struct strength *strength)
{
    return strength->kind != STRENGTH_NONE ? strength->of.shear_modulus : 0.0;
}

/* Yield stress in simple tension, Pa, of slow flow at POINT; zero for a fluid. */
BOLIDE_INLINE double strength_yield(const struct strength *strength, const struct point *point)
{
    switch (strength->kind) {
#define STRENGTH_CASE(name) \
    case STRENGTH_##name:   \
        return strength_##name##_yield(&strength->of.name, point);
        STRENGTH_LIST(STRENGTH_CASE)
#undef STRENGTH_CASE
    default:
        return 0.0;
    }
}

/* Whether its step takes the pressure of the elastic trial. */
BOLIDE_INLINE bool strength_takes_pressure(const struct strength *strength)
{
    return strength->kind == STRENGTH_drucker_prager || strength->kind == STRENGTH_hjc;
}

/* Takes the deviator and history of POINT through a step, and its pressure where that returns too. BULK_MODULUS is that of
 * the equation of state, Pa. */
BOLIDE_INLINE void strength_step(const struct strength *strength, const struct motion *motion,
                                 double bulk_modulus, struct point *point)
{
    switch (strength->kind) {
#define STRENGTH_CASE(name)                                               \
    case STRENGTH_##name:                                                 \
        strength_##name(&strength->of.name, motion, bulk_modulus, point); \
        break;
        STRENGTH_LIST(STRENGTH_CASE)
#undef STRENGTH_CASE
    default:
        break;
    }
}

/* The slots of history that it needs. */
BOLIDE_INLINE unsigned strength_history(const struct strength *strength)
{
    if (strength->kind == STRENGTH_johnson_cook && johnson_cook_softens(&strength->of.johnson_cook))
        return HISTORY_BIT(plastic_heating);
    if (strength->kind == STRENGTH_hjc)
        return HISTORY_BIT(damage) |
               (strength->of.hjc.tensile_growth > 0.0 ? HISTORY_BIT(tensile_damage) : 0);
    return strength->kind == STRENGTH_drucker_prager ? HISTORY_BIT(dilation) : 0;
}

/* Why its parameters do not go together, *KEY is that it is about; NULL when they do. */
BOLIDE_INLINE const char *strength_wrong(const struct strength *strength, const char **key)
{
    if (strength->kind == STRENGTH_johnson_cook)
        return johnson_cook_wrong(&strength->of.johnson_cook, key);
    return NULL;
}

#endif
