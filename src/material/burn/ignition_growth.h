/* Ignition and growth: the rate at which an explosive becomes its products, of the mass fraction l
 * of these, the pressure and the compression c of the explosive:
 *
 *   dl/dt = I (1 - l)^b (c - a)^x                        l < F_I
 *         + G (1 - l)^c l^d (p/100 GPa)^y                l < F_G
 *         + H (1 - l)^e l^g (p/100 GPa)^z                l > F_H
 *
 * c = v_0/v_s - 1 of the explosive alone, or of the mixture; without compression nothing ignites.
 * Source: Lee and Tarver, Phys. Fluids 23 (1980) 2362; the first two terms as in Parshikov (2013),
 * (5.12), with his exponents as defaults; the third of Tarver, Hallquist and Erickson, 8th
 * Detonation Symp. (1985) 951. */
#ifndef BOLIDE_BURN_IGNITION_GROWTH_H
#define BOLIDE_BURN_IGNITION_GROWTH_H

#include "material/burn/common.h"

enum ignition_compression { IGNITION_EXPLOSIVE, IGNITION_MIXTURE };

struct burn_ignition_growth {
    double speed; /* not given: the speed follows from the rate */
    double ignition, ignition_depletion, ignition_threshold, ignition_power, ignition_until;
    double growth, growth_depletion, growth_products, growth_power, growth_until;
    double completion, completion_depletion, completion_products, completion_power, completion_from;
    int compression; /* enum ignition_compression */
};

#define BURN_ignition_growth_NAME "ignition-growth"
#define BURN_ignition_growth_HELP \
    "burns at a rate that pressure and compression decide; with `eos: reactive-jwl`"
#define BURN_ignition_growth_PARAMETERS(T)                                                      \
    NUMBER(T, ignition, "1/s", REQUIRED, NOT_NEGATIVE, "I: rate of ignition")                   \
    NUMBER(T, ignition_depletion, "", "2/9", NOT_NEGATIVE, "b: exponent of 1 - l")              \
    NUMBER(T, ignition_threshold, "", "0", NOT_NEGATIVE, "a: compression that ignites nothing") \
    NUMBER(T, ignition_power, "", "4", POSITIVE, "x: exponent of the compression beyond a")     \
    NUMBER(T, ignition_until, "", "1", FROM_ZERO_TO_ONE, "F_I: largest l of ignition")          \
    NUMBER(T, growth, "1/s", REQUIRED, NOT_NEGATIVE, "G: rate of growth at 100 GPa")            \
    NUMBER(T, growth_depletion, "", "2/9", NOT_NEGATIVE, "c: exponent of 1 - l")                \
    NUMBER(T, growth_products, "", "2/3", NOT_NEGATIVE, "d: exponent of l")                     \
    NUMBER(T, growth_power, "", "1.4", POSITIVE, "y: exponent of the pressure")                 \
    NUMBER(T, growth_until, "", "1", FROM_ZERO_TO_ONE, "F_G: largest l of growth")              \
    NUMBER(T, completion, "1/s", "0 1/s", NOT_NEGATIVE, "H: rate of completion at 100 GPa")     \
    NUMBER(T, completion_depletion, "", "2/3", NOT_NEGATIVE, "e: exponent of 1 - l")            \
    NUMBER(T, completion_products, "", "2/3", NOT_NEGATIVE, "g: exponent of l")                 \
    NUMBER(T, completion_power, "", "1", POSITIVE, "z: exponent of the pressure")               \
    NUMBER(T, completion_from, "", "0", FROM_ZERO_TO_ONE, "F_H: least l of completion")         \
    CHOICE(T, compression, "explosive",                                                         \
           "whose compression ignites; explosive: that of the explosive in the mixture; "       \
           "mixture: that of both",                                                             \
           "explosive", "mixture")

/* x^n of x >= 0. */
BOLIDE_INLINE double burn_power(double x, double n)
{
    return x > 0.0 ? power(x, n) : n > 0.0 ? 0.0 : 1.0;
}

/* dl/dt at BURNT, PRESSURE (Pa) and COMPRESSION, 1/s. */
BOLIDE_INLINE double ignition_growth_rate(const struct burn_ignition_growth *burn, double burnt,
                                          double pressure, double compression)
{
    const double left = maximum(1.0 - burnt, 0.0), p = maximum(pressure, 0.0) * 1e-11;
    double rate = 0.0;
    if (burnt < burn->ignition_until && compression > burn->ignition_threshold)
        rate += burn->ignition * burn_power(left, burn->ignition_depletion) *
                power(compression - burn->ignition_threshold, burn->ignition_power);
    if (burnt < burn->growth_until && burnt > 0.0)
        rate += burn->growth * burn_power(left, burn->growth_depletion) *
                burn_power(burnt, burn->growth_products) * burn_power(p, burn->growth_power);
    if (burnt > burn->completion_from)
        rate += burn->completion * burn_power(left, burn->completion_depletion) *
                burn_power(burnt, burn->completion_products) *
                burn_power(p, burn->completion_power);
    return rate;
}

BOLIDE_INLINE double burn_ignition_growth_rate(const struct burn_ignition_growth *burn,
                                               const struct reacting *point)
{
    const double volume =
        burn->compression == IGNITION_MIXTURE ? point->volume : point->explosive_volume;
    return ignition_growth_rate(burn, point->burnt, point->pressure, 1.0 / volume - 1.0);
}

BOLIDE_INLINE void burn_ignition_growth_ends(const struct burn_ignition_growth *burn,
                                             double end[BURN_ENDS])
{
    end[0] = burn->ignition_until;
    end[1] = burn->growth_until;
    end[2] = burn->completion_from;
}

BOLIDE_INLINE struct burn_traits burn_ignition_growth_traits(
    const struct burn_ignition_growth *burn)
{
    struct burn_traits traits = burn_default_traits();
    (void)burn;
    traits.kinetic = traits.phases = true;
    return traits;
}

#endif
