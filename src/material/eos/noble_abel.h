/* Noble-Abel stiffened gas: a gas or liquid whose molecules take the volume b and, where p_inf is
 * not zero, attract each other; v = 1/rho:
 *
 *   p = (gamma - 1) (e - q)/(v - b) - gamma p_inf
 *   T = [e - q - p_inf (v - b)]/C_V
 *
 * With b = p_inf = q = 0 it is the ideal gas, with b = 0 the stiffened gas.
 * Source: Le Metayer and Saurel, Phys. Fluids 28 (2016) 046102; the sample is their water. */
#ifndef BOLIDE_EOS_NOBLE_ABEL_H
#define BOLIDE_EOS_NOBLE_ABEL_H

#include "material/eos/common.h"

struct eos_noble_abel {
    double density;  /* kg/m^3, of the initial state where a case gives none */
    double gamma;    /* ratio of specific heats */
    double covolume; /* b, m^3/kg */
    double pressure; /* p_inf, Pa */
    double energy;   /* q, J/kg */
};

#define EOS_noble_abel_NAME "noble-abel"
#define EOS_noble_abel_HELP \
    "Noble-Abel stiffened gas: dense gases, and liquids between melting and boiling"
#define EOS_noble_abel_SAMPLE                     \
    {                                             \
        1000.0, 1.19, 6.61e-4, 7028e5, -1177788.0 \
    } /* water */
#define EOS_noble_abel_PARAMETERS(T)                                                      \
    NUMBER(T, density, "kg/m^3", REQUIRED, POSITIVE,                                      \
           "initial density of bodies that do not set one")                               \
    NUMBER(T, gamma, "", REQUIRED, ABOVE_ONE, "ratio of the specific heats")              \
    NUMBER(T, covolume, "m^3/kg", "0 m^3/kg", NOT_NEGATIVE, "b: volume of the molecules") \
    NUMBER(T, pressure, "Pa", "0 Pa", NOT_NEGATIVE,                                       \
           "p_inf: attraction of the molecules; 0 in a gas")                              \
    NUMBER(T, energy, "J/kg", "0 J/kg", ANY, "q: reference energy")

BOLIDE_INLINE struct eos_value eos_noble_abel(const struct eos_noble_abel *gas, double density,
                                              double energy, const double *history)
{
    (void)history;
    struct eos_value value;
    double heat = (gas->gamma - 1.0) * (energy - gas->energy);
    /* where the molecules fill 0.95 of the volume 1/(v - b) continues linearly in rho */
    const double within = minimum(density, 0.95 / gas->covolume);
    const double free = 1.0 - gas->covolume * within, over = density - within; /* (v - b)/v */
    value.status = over > 0.0 ? POINT_OUT_OF_RANGE : 0;
    value.dp_drho = heat / square(free);
    value.dp_de = (gas->gamma - 1.0) * (within / free + over / square(free));
    value.pressure = heat * within / free + over * value.dp_drho - gas->gamma * gas->pressure;
    eos_hold_sound(&value, density,
                   0.01 * gas->gamma * gas->pressure * density / square(gas->density));
    return value;
}

/* A shock is that of the ideal gas in v - b. */
BOLIDE_INLINE struct eos_traits eos_noble_abel_traits(const struct eos_noble_abel *gas)
{
    struct eos_traits traits = eos_default_traits();
    traits.gas = gas->pressure == 0.0;
    traits.stiffened = !traits.gas;
    traits.largest_compression = INFINITY;
    double free = 1.0 - gas->covolume * gas->density;
    /* the limit of strong shocks in a gas, that of weak ones in a liquid, which is stiff */
    double limit = gas->pressure > 0.0 ? 0.25 : 0.5;
    traits.shock_slope = limit * (gas->gamma + 1.0) / free;
    if (gas->covolume == 0.0 && gas->pressure == 0.0)
        traits.ratio_of_heats = gas->gamma;
    if (!(free > 0.05)) {
        traits.wrong = "the molecules take 95 % of the volume or more at `density`";
        traits.wrong_key = "covolume";
    }
    return traits;
}

/* The state of T = 0. */
BOLIDE_INLINE struct heat_curve eos_noble_abel_curve(const struct eos_noble_abel *gas,
                                                     const struct heat *heat, double density)
{
    struct heat_curve curve = {0.0, gas->energy + gas->pressure * (1.0 / density - gas->covolume)};
    (void)heat;
    return curve;
}

#endif
