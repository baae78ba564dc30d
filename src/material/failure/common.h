/* What the headers of the failure models have in common: what a step of a point brings to its
 * damage, the parameter that every model has, and the traits that others ask of a model. */
#ifndef BOLIDE_FAILURE_COMMON_H
#define BOLIDE_FAILURE_COMMON_H

#include "base/chance.h"
#include "base/exponential.h"
#include "material/strength/elastic.h"

/* A point after the elastic and plastic part of a step: what its damage may depend on. */
struct failing {
    double density;       /* kg/m^3 */
    double sound;         /* of volume waves, m/s */
    double yield;         /* of slow flow in simple tension, Pa */
    double pressure;      /* of density and energy, before a limit of tension, Pa */
    struct sym3 deviator; /* of stress, Pa */
    double flow, rate;    /* plastic strain of the step; equivalent strain rate, 1/s */
    double strain;        /* plastic, after the step */
    double stretching;    /* trace of the strain rate, 1/s */
    double homologous;    /* T* of the strength model; zero where it has none */
    double relative;      /* its strength over the characteristic one of its material */
    double length;        /* its size, m */
};

/* What every model has: the first members of its struct, and their rows. */
#define FAILURE_MEMBERS                                                           \
    double friction;                                                              \
    double weibull_modulus; /* NAN, or not positive: strength does not scatter */ \
    double weibull_volume;  /* m^3; NAN: that of each particle */                 \
    int seed;

#define FAILURE_FRICTION(T)                                                                     \
    NUMBER(T, friction, "", "0.3", NOT_NEGATIVE,                                                \
           "of failed material: its largest Mises stress over its pressure; that stress is at " \
           "most the yield stress")
#define FAILURE_SCATTER(T)                                                                      \
    NUMBER(T, weibull_modulus, "", OPTIONAL, AT_START(POSITIVE),                                \
           "Weibull modulus of the strength (or of the strain or work at failure), which then " \
           "varies from particle to particle; the given value is the characteristic one; "      \
           "default: no variation")                                                             \
    NUMBER(T, weibull_volume, "m^3", OPTIONAL, AT_START(POSITIVE),                              \
           "volume for which the given strength is the characteristic one; larger particles "   \
           "are weaker; default: the volume of each particle")                                  \
    COUNT(T, seed, "1", "seed of the random strengths: another seed is another specimen")

/* Of models whose damage grows with plastic strain. */
#define FAILURE_BAND(T)                                                                          \
    NUMBER(T, band, "m", OPTIONAL, POSITIVE,                                                     \
           "particle size for which failure strains are right in shear bands; where particles "  \
           "are larger, damage in shear grows faster by that ratio, since a band is as wide as " \
           "a few particles and its strain the smaller; default: it does not depend on the size")

#define FAILURE_COMMON(T) FAILURE_FRICTION(T) FAILURE_SCATTER(T)

/* The mean tension at which voids begin to grow, Pa, and their volume over that of the material at
 * failure; zero: there is no growth. */
struct void_growth {
    double strength, most;
};

struct failure_traits {
    bool limits_tension; /* by a stress that it is given */
    bool batched;        /* of many points at once: it does not ask for sound and yield */
    bool at_contacts;    /* pairs of particles break, points do not */
    bool of_fluids;      /* for material without strength, and for no other */
    double least;        /* where bubbles open, and as long as they are: the pressure of a liquid */
    double weakening;    /* fraction of the yield stress that damage has taken at failure */
    struct void_growth growth;
    /* Why its parameters do not go together, and the parameter to name; NULL when they do. */
    const char *wrong, *wrong_key;
};

BOLIDE_INLINE struct failure_traits failure_default_traits(void)
{
    struct failure_traits traits = {.least = -(double)INFINITY, .wrong = NULL};
    return traits;
}

/* How much faster damage grows at POINT than plastic strain says, with a band of BAND (NAN: none).
 * A shear band is a few particles wide whatever their size, so that its strain is in proportion to
 * BAND/size. Full where the mean stress is not tension, none from simple tension (a third of the
 * Mises stress) on, where a body thins as a whole. */
BOLIDE_INLINE double failing_haste(const struct failing *point, double band, double triaxiality)
{
    const double larger = maximum(point->length / band, 1.0);
    const double sheared = 1.0 - minimum(maximum(3.0 * triaxiality, 0.0), 1.0);
    return band > 0.0 ? 1.0 + (larger - 1.0) * sheared : 1.0;
}

/* The largest principal stress, Pa, positive in tension. */
BOLIDE_INLINE double failing_largest_stress(const struct failing *point)
{
    return sym3_largest(point->deviator) - point->pressure;
}

#endif
