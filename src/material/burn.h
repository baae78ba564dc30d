/* How an explosive becomes its products: the fraction F that has burnt, by which the pressure of
 * the products counts. What has not burnt bears no pressure and no shear, and sound travels in it
 * as the detonation does. The models are in burn/, one header each; without one all has burnt at
 * the start (artificial detonation). F never falls. A point is lit when a detonation of the model's
 * speed D that starts at one of the case's `detonations` arrives. Source: Cui, dissertation (2014).
 * */
#ifndef BOLIDE_BURN_H
#define BOLIDE_BURN_H

#include "material/burn/afterburn.h"
#include "material/burn/beta.h"
#include "material/burn/cj_threshold.h"
#include "material/burn/ignition_growth.h"
#include "material/burn/pressure_power.h"
#include "material/burn/programmed.h"

/* X(identifier): in burn/<identifier>.h struct burn_<identifier>, whose first member is the speed
 * of the detonation, burn_<identifier>_traits(), and its name, help and parameters (see choices.c).
 */
#define BURN_LIST(X, ...)            \
    BURN_FRACTIONS(X, ##__VA_ARGS__) \
    BURN_RATES(X, ##__VA_ARGS__)

/* Those whose fraction follows from the state and the time: burn_<identifier>() gives F. */
#define BURN_FRACTIONS(X, ...)   \
    X(programmed, ##__VA_ARGS__) \
    X(beta, ##__VA_ARGS__)       \
    X(cj_threshold, ##__VA_ARGS__)

/* Those with a rate: burn_<identifier>_rate() gives dF/dt, 1/s, and burn_<identifier>_ends() sets
 * the fractions at which terms of it end, in any order. */
#define BURN_RATES(X, ...)            \
    X(ignition_growth, ##__VA_ARGS__) \
    X(pressure_power, ##__VA_ARGS__)

#define BURN_ENUM(name) BURN_##name,
enum burn_kind { BURN_INSTANT, BURN_LIST(BURN_ENUM) BURN_KINDS };
#undef BURN_ENUM

#define BURN_MEMBER(name) struct burn_##name name;
struct burn {
    enum burn_kind kind;
    union {
        double speed;
        BURN_LIST(BURN_MEMBER)
    } of;
};
#undef BURN_MEMBER

/* In a switch: models of a list answer by burn_<identifier>FUNCTION() of their parameters. */
#define BURN_ANSWER(name, function, ...) \
    case BURN_##name:                    \
        return burn_##name##function(&burn->of.name, ##__VA_ARGS__);

BOLIDE_INLINE struct burn_traits burn_traits(const struct burn *burn)
{
    switch (burn->kind) {
        BURN_LIST(BURN_ANSWER, _traits)
    default:
        return burn_default_traits();
    }
}

/* Whether all has burnt at the start. */
BOLIDE_INLINE bool burn_is_instant(const struct burn *burn) { return burn->kind == BURN_INSTANT; }

/* Whether it burns by itself, where it is compressed; the others are lit. */
BOLIDE_INLINE bool burn_is_kinetic(const struct burn *burn) { return burn_traits(burn).kinetic; }

/* Whether it burns at a rate, which its state decides. */
BOLIDE_INLINE bool burn_has_rate(const struct burn *burn)
{
    switch (burn->kind) {
#define BURN_CASE(name) case BURN_##name:
        BURN_RATES(BURN_CASE)
#undef BURN_CASE
        return true;
    default:
        return false;
    }
}

/* The fraction burnt of POINT after a step; BEFORE: after the step before. */
BOLIDE_INLINE double burn_fraction(const struct burn *burn, const struct burning *point,
                                   double before)
{
    switch (burn->kind) {
#define BURN_CASE(name) \
    case BURN_##name:   \
        return maximum(before, burn_##name(&burn->of.name, point));
        BURN_FRACTIONS(BURN_CASE)
#undef BURN_CASE
    default:
        return 1.0;
    }
}

/* The rate of POINT, 1/s; zero where the model has none. */
BOLIDE_INLINE double burn_rate(const struct burn *burn, const struct reacting *point)
{
    switch (burn->kind) {
        BURN_RATES(BURN_ANSWER, _rate, point)
    default:
        return 0.0;
    }
}

/* The fractions at which terms of the rate end, in any order; zero for those that there are not. */
BOLIDE_INLINE void burn_rate_ends(const struct burn *burn, double end[BURN_ENDS])
{
    for (int k = 0; k < BURN_ENDS; k++)
        end[k] = 0.0;
    switch (burn->kind) {
        BURN_RATES(BURN_ANSWER, _ends, end)
    default:
        break;
    }
}

/* The state of the products made that of what has burnt to FRACTION: c^2 is F c_products^2 and (1 -
 * F) D^2. */
BOLIDE_INLINE void burn_mix(const struct burn *burn, double fraction, struct eos_value *value)
{
    value->pressure *= fraction;
    value->dp_drho = fraction * value->dp_drho + (1.0 - fraction) * square(burn->of.speed);
    value->dp_de *= fraction;
}

#endif
