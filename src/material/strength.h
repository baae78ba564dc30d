/* Strength models: what a material does with shear; one header each, and the lists of them.
 *
 * A strength model is a parameter struct whose first member is the shear modulus, a pure function
 * that takes a point through a step, elastic trial and return included, its yield stress in simple
 * tension, its traits, and its parameters as rows. To add one: its header in strength/, and its
 * line in the first list below. */
#ifndef BOLIDE_STRENGTH_H
#define BOLIDE_STRENGTH_H

#include "material/strength/drucker_prager.h"
#include "material/strength/failure_wave.h"
#include "material/strength/hjc.h"
#include "material/strength/johnson_cook.h"
#include "material/strength/johnson_holmquist.h"
#include "material/strength/perfect_plastic.h"

/* X(identifier): in strength/<identifier>.h struct strength_<identifier>, strength_<identifier>(),
 * strength_<identifier>_yield(), strength_<identifier>_traits(), and the name, help and parameters
 * STRENGTH_<identifier>_NAME, _HELP and _PARAMETERS (see choices.c). */
#define STRENGTH_LIST(X, ...)           \
    X(perfect_plastic, ##__VA_ARGS__)   \
    X(johnson_cook, ##__VA_ARGS__)      \
    X(drucker_prager, ##__VA_ARGS__)    \
    X(hjc, ##__VA_ARGS__)               \
    X(johnson_holmquist, ##__VA_ARGS__) \
    X(failure_wave, ##__VA_ARGS__)

/* The plain ones: they remember the plastic strain alone and leave the pressure as it is. Hot loops
 * are compiled for each of them. */
#define STRENGTH_PLAIN(X, ...) X(perfect_plastic, ##__VA_ARGS__)

/* Those with a step of many points at once, strength_<identifier>_batch(): see batch.h. */
#define STRENGTH_BATCHED(X, ...)        \
    X(perfect_plastic, ##__VA_ARGS__)   \
    X(johnson_cook, ##__VA_ARGS__)      \
    X(johnson_holmquist, ##__VA_ARGS__) \
    X(failure_wave, ##__VA_ARGS__)

/* Those that heat softens: strength_<identifier>_homologous(). */
#define STRENGTH_SOFTENED(X, ...) X(johnson_cook, ##__VA_ARGS__)

/* Those with traits.weakened: strength_<identifier>_weaken(). */
#define STRENGTH_WEAKENED(X, ...) X(johnson_cook, ##__VA_ARGS__)

/* Those of metals, with traits.melts: strength_<identifier>_melt(). */
#define STRENGTH_MELTING(X, ...)      \
    X(perfect_plastic, ##__VA_ARGS__) \
    X(johnson_cook, ##__VA_ARGS__)

/* Those that change the pressure of the equation of state: strength_<identifier>_cut(). */
#define STRENGTH_CUTTING(X, ...) \
    X(hjc, ##__VA_ARGS__)        \
    X(johnson_holmquist, ##__VA_ARGS__)

/* Those of a given elastic limit, with constants of the equation of state at rest:
 * strength_<identifier>_take(), _given_limit(), _bears(). */
#define STRENGTH_RESTING(X, ...) X(johnson_holmquist, ##__VA_ARGS__)

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

/* In a switch: models of a list answer by strength_<identifier>FUNCTION() of their parameters. */
#define STRENGTH_ANSWER(name, function, ...) \
    case STRENGTH_##name:                    \
        return strength_##name##function(&strength->of.name, ##__VA_ARGS__);

/* Whether it is that of a solid. */
BOLIDE_INLINE bool strength_is_solid(const struct strength *strength)
{
    return strength->kind != STRENGTH_NONE;
}

/* Shear modulus, Pa; zero for a fluid. */
BOLIDE_INLINE double strength_shear_modulus(const struct strength *strength)
{
    return strength_is_solid(strength) ? strength->of.shear_modulus : 0.0;
}

/* Yield stress in simple tension, Pa, of slow flow at POINT; zero for a fluid. */
BOLIDE_INLINE double strength_yield(const struct strength *strength, const struct point *point)
{
    switch (strength->kind) {
        STRENGTH_LIST(STRENGTH_ANSWER, _yield, point)
    default:
        return 0.0;
    }
}

BOLIDE_INLINE struct strength_traits strength_traits(const struct strength *strength)
{
    switch (strength->kind) {
        STRENGTH_LIST(STRENGTH_ANSWER, _traits)
    default:
        return strength_default_traits();
    }
}

/* Whether its step takes the pressure of the elastic trial, and may return it too. */
BOLIDE_INLINE bool strength_takes_pressure(const struct strength *strength)
{
    return strength_traits(strength).takes_pressure;
}

/* Whether its own damage breaks it. */
BOLIDE_INLINE bool strength_breaks(const struct strength *strength)
{
    return strength_traits(strength).breaks;
}

/* Whether its damage spreads. */
BOLIDE_INLINE bool strength_spreads(const struct strength *strength)
{
    return strength_traits(strength).spread_speed > 0.0;
}

/* The step, s, in which damage that spreads grows accurately on particles of SIZE, m: a simple step
 * of larger ones makes its front slow. INFINITY: none spreads. */
BOLIDE_INLINE double strength_spread_step(const struct strength *strength, double size)
{
    const double speed = strength_traits(strength).spread_speed, courant = 0.08;
    return speed > 0.0 ? courant * size / speed : (double)INFINITY;
}

/* Whether it is none or a plain model. */
BOLIDE_INLINE bool strength_is_plain(const struct strength *strength)
{
    switch (strength->kind) {
#define STRENGTH_CASE(name) case STRENGTH_##name:
        STRENGTH_PLAIN(STRENGTH_CASE)
#undef STRENGTH_CASE
    case STRENGTH_NONE:
        return true;
    default:
        return false;
    }
}

/* Takes the deviator and history of POINT through a step, and its pressure where that returns too.
 * BULK_MODULUS is that of the equation of state, Pa. */
BOLIDE_INLINE void strength_step(const struct strength *strength, const struct motion *motion,
                                 double bulk_modulus, struct point *point)
{
    switch (strength->kind) {
        STRENGTH_LIST(STRENGTH_ANSWER, , motion, bulk_modulus, point)
    default:
        break;
    }
}

/* The same of a plain model or none: small enough for a loop over many points. */
BOLIDE_INLINE void strength_plain_step(const struct strength *strength, const struct motion *motion,
                                       struct point *point)
{
    switch (strength->kind) {
        STRENGTH_PLAIN(STRENGTH_ANSWER, , motion, 0.0, point)
    default:
        break;
    }
}

/* The same of many points of a fluid or of a model with traits.batched; the rest keep their
 * deviators. */
BOLIDE_INLINE void strength_batch(const struct strength *strength, struct batch *batch)
{
    switch (strength->kind) {
        STRENGTH_BATCHED(STRENGTH_ANSWER, _batch, batch)
    default:
        memcpy(batch->new_deviator, batch->deviator, sizeof batch->deviator);
    }
}

/* Cuts the tension of a state that the material does not bear, and adds what bulking has done. Its
 * sound stays that of the equation of state. */
BOLIDE_INLINE void strength_cut(const struct strength *strength, const double *history,
                                struct eos_value *value)
{
    switch (strength->kind) {
        STRENGTH_CUTTING(STRENGTH_ANSWER, _cut, history, value)
    default:
        break;
    }
}

/* Takes what it needs of the equation of state: REST is that at rest, of DENSITY. */
BOLIDE_INLINE void strength_take(struct strength *strength, double density,
                                 const struct eos_value *rest)
{
    switch (strength->kind) {
        STRENGTH_RESTING(STRENGTH_ANSWER, _take, density, rest)
    default:
        break;
    }
}

/* Takes the fraction of its yield stress that damage of the failure model has taken at failure. */
BOLIDE_INLINE void strength_weaken(struct strength *strength, double weakening)
{
    switch (strength->kind) {
        STRENGTH_WEAKENED(STRENGTH_ANSWER, _weaken, weakening)
    default:
        break;
    }
}

/* Leaves the fraction LEFT of its shear modulus and yield stress. */
BOLIDE_INLINE void strength_melt(struct strength *strength, double left)
{
    switch (strength->kind) {
        STRENGTH_MELTING(STRENGTH_ANSWER, _melt, left)
    default:
        break;
    }
}

/* The stress in uniaxial strain that the source of its constants gives as elastic limit, Pa; NAN:
 * it has none. */
BOLIDE_INLINE double strength_given_limit(const struct strength *strength)
{
    switch (strength->kind) {
        STRENGTH_RESTING(STRENGTH_ANSWER, _given_limit)
    default:
        return NAN;
    }
}

/* Whether uniaxial strain to mu = COMPRESSION under PRESSURE at RATE, 1/s, stays below its intact
 * strength. */
BOLIDE_INLINE bool strength_bears(const struct strength *strength, double compression,
                                  double pressure, double rate)
{
    switch (strength->kind) {
        STRENGTH_RESTING(STRENGTH_ANSWER, _bears, compression, pressure, rate)
    default:
        return false;
    }
}

/* T* = (T - room)/(melt - room) of a point that plastic work has heated by HEATING, K: at most one;
 * zero where heat does not soften it. */
BOLIDE_INLINE double strength_homologous(const struct strength *strength, double heating)
{
    switch (strength->kind) {
        STRENGTH_SOFTENED(STRENGTH_ANSWER, _homologous, heating)
    default:
        return 0.0;
    }
}

/* The same of many points. */
BOLIDE_INLINE void strength_batch_homologous(const struct strength *strength,
                                             const struct batch *batch, double *homologous)
{
    switch (strength->kind) {
#define STRENGTH_CASE(name)                                                                  \
    case STRENGTH_##name:                                                                    \
        for (int k = 0; k < batch->count; k++)                                               \
            homologous[k] =                                                                  \
                strength_##name##_homologous(&strength->of.name, batch->plastic_heating[k]); \
        break;
        STRENGTH_SOFTENED(STRENGTH_CASE)
#undef STRENGTH_CASE
    default:
        for (int k = 0; k < batch->count; k++)
            homologous[k] = 0.0;
    }
}

/* The slots of history that it needs. */
BOLIDE_INLINE unsigned strength_history(const struct strength *strength)
{
    return strength_traits(strength).history;
}

/* Why its parameters do not go together, *KEY is that it is about; NULL when they do. */
BOLIDE_INLINE const char *strength_wrong(const struct strength *strength, const char **key)
{
    struct strength_traits traits = strength_traits(strength);
    *key = traits.wrong_key;
    return traits.wrong;
}

#endif
