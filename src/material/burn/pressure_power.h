/* Burning at a rate that grows with a power of the pressure, of the mass fraction l of the
 * products:
 *
 *   dl/dt = G (p/100 GPa)^b (1 - l)^c   where p > p_i
 *
 * With `eos: blended-jwl` this is JWL++. Source: Souers, Anderson, Mercer, McGuire and Vitello,
 * Propellants Explos. Pyrotech. 25 (2000) 54. */
#ifndef BOLIDE_BURN_PRESSURE_POWER_H
#define BOLIDE_BURN_PRESSURE_POWER_H

#include "material/burn/ignition_growth.h"

struct burn_pressure_power {
    double speed; /* not given: the speed follows from the products */
    double rate, power, depletion;
    double threshold; /* Pa */
};

#define BURN_pressure_power_NAME "pressure-power"
#define BURN_pressure_power_HELP                                                  \
    "burns at a rate that grows with a power of the pressure, as in JWL++; with " \
    "`eos: blended-jwl` or `reactive-jwl`"
#define BURN_pressure_power_PARAMETERS(T)                                   \
    NUMBER(T, rate, "1/s", REQUIRED, NOT_NEGATIVE, "G: rate at 100 GPa")    \
    NUMBER(T, power, "", REQUIRED, POSITIVE, "b: exponent of the pressure") \
    NUMBER(T, depletion, "", "1", NOT_NEGATIVE, "c: exponent of 1 - l")     \
    NUMBER(T, threshold, "Pa", "0 Pa", NOT_NEGATIVE, "p_i: pressure up to which nothing burns")

/* dl/dt at BURNT and PRESSURE (Pa), 1/s. */
BOLIDE_INLINE double pressure_power_rate(const struct burn_pressure_power *burn, double burnt,
                                         double pressure)
{
    if (!(pressure > burn->threshold))
        return 0.0;
    return burn->rate * burn_power(pressure * 1e-11, burn->power) *
           burn_power(maximum(1.0 - burnt, 0.0), burn->depletion);
}

BOLIDE_INLINE double burn_pressure_power_rate(const struct burn_pressure_power *burn,
                                              const struct reacting *point)
{
    return pressure_power_rate(burn, point->burnt, point->pressure);
}

BOLIDE_INLINE void burn_pressure_power_ends(const struct burn_pressure_power *burn,
                                            double end[BURN_ENDS])
{
    (void)burn;
    (void)end;
}

BOLIDE_INLINE struct burn_traits burn_pressure_power_traits(const struct burn_pressure_power *burn)
{
    struct burn_traits traits = burn_default_traits();
    (void)burn;
    traits.kinetic = true;
    return traits;
}

#endif
