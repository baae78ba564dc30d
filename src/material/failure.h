/* Failure models: how a solid breaks; one header each, and the list of them.
 *
 * A model adds to the damage of a point what a step does; at one the point has failed. What failed
 * material is, is the same with all models (material.h): it bears no tension, its shear stress is
 * at most its friction, and where it is drawn apart it keeps its density and voids open. To add a
 * model: its header in failure/, and its line in the list below. */
#ifndef BOLIDE_FAILURE_H
#define BOLIDE_FAILURE_H

#include "material/failure/cavitation.h"
#include "material/failure/cockcroft_latham.h"
#include "material/failure/grady.h"
#include "material/failure/johnson_cook.h"
#include "material/failure/spall.h"
#include "material/failure/threshold.h"

/* X(identifier): in failure/<identifier>.h struct failure_<identifier>, that begins with
 * FAILURE_MEMBERS, failure_<identifier>(), which gives the damage after a step,
 * failure_<identifier>_traits(), and its name, help and parameters (see choices.c). */
#define FAILURE_LIST(X, ...)           \
    X(spall, ##__VA_ARGS__)            \
    X(johnson_cook, ##__VA_ARGS__)     \
    X(cockcroft_latham, ##__VA_ARGS__) \
    X(grady, ##__VA_ARGS__)            \
    X(threshold, ##__VA_ARGS__)        \
    X(cavitation, ##__VA_ARGS__)

#define FAILURE_ENUM(name) FAILURE_##name,
enum failure_kind { FAILURE_NONE, FAILURE_LIST(FAILURE_ENUM) FAILURE_KINDS };
#undef FAILURE_ENUM

struct failure_common {
    FAILURE_MEMBERS
};

#define FAILURE_MEMBER(name) struct failure_##name name;
struct failure {
    enum failure_kind kind;
    union {
        struct failure_common common;
        FAILURE_LIST(FAILURE_MEMBER)
    } of;
};
#undef FAILURE_MEMBER

/* In a switch: models of a list answer by failure_<identifier>FUNCTION() of their parameters. */
#define FAILURE_ANSWER(name, function, ...) \
    case FAILURE_##name:                    \
        return failure_##name##function(&failure->of.name, ##__VA_ARGS__);

/* Whether the material has a failure model. */
BOLIDE_INLINE bool failure_acts(const struct failure *failure)
{
    return failure->kind != FAILURE_NONE;
}

/* Whether strength differs from point to point. */
BOLIDE_INLINE bool failure_scatters(const struct failure *failure)
{
    return failure_acts(failure) && failure->of.common.weibull_modulus > 0.0;
}

/* The strength of a particle of VOLUME, m^3, over the characteristic one, as Weibull distributes
 * it: the share exp(-V/V_0 s^m) of all particles bears more than s. ID decides which it is. */
BOLIDE_INLINE double failure_relative_strength(const struct failure *failure, uint64_t id,
                                               double volume)
{
    const struct failure_common *common = &failure->of.common;
    const double chance = chance_of(id, (uint64_t)common->seed);
    const double specimens = common->weibull_volume > 0.0 ? volume / common->weibull_volume : 1.0;
    return power(-logarithm(chance) / specimens, 1.0 / common->weibull_modulus);
}

/* The damage of POINT after a step; DAMAGE: before. */
BOLIDE_INLINE double failure_damage(const struct failure *failure, const struct failing *point,
                                    double damage)
{
    switch (failure->kind) {
        FAILURE_LIST(FAILURE_ANSWER, , point, damage)
    default:
        return damage;
    }
}

BOLIDE_INLINE struct failure_traits failure_traits(const struct failure *failure)
{
    switch (failure->kind) {
        FAILURE_LIST(FAILURE_ANSWER, _traits)
    default:
        return failure_default_traits();
    }
}

/* Whether spall_overload() says when a point fails. */
BOLIDE_INLINE bool failure_waits(const struct failure *failure)
{
    return failure->kind == FAILURE_spall && failure->of.spall.onset == SPALL_STANDING;
}

/* Why its parameters do not go together, *KEY is that it is about; NULL when they do. */
BOLIDE_INLINE const char *failure_wrong(const struct failure *failure, const char **key)
{
    const struct failure_traits traits = failure_traits(failure);
    *key = traits.wrong_key;
    return traits.wrong;
}

#endif
