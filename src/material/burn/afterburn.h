/* Afterburn: products that lack oxygen burn on in the air that they meet. The fraction l of their
 * mass has, and each kg of it gives the heat of a first and a second stage to the products. In the
 * first stage, which gives the heat Q,
 *
 *   dk/dt = a (1 - k)^m (p/p_0)^n,   p_0 = 0.1 MPa,   k = l (Q + Q_s)/Q
 *
 * With m = n = 0 the rate is constant. Source: P. J. Miller, Mater. Res. Soc. Symp. Proc. 418
 * (1996) 413. The second stage, with the heat Q_s, begins when the first has ended in a place. It
 * represents the slow mixing with the air of a room:
 *
 *   dl/dt = a_s (1 - l)
 *
 * l ends where the air of the whole domain is used up, of which a kg of products takes a given
 * mass.
 *
 * In place of the second stage products whose first has ended may mix with the air of the room,
 *
 *   dm/dt = -a_m m
 *
 * to a gas of the pressure that chemical equilibrium gives the room (equilibrium.h): the mass
 * becomes air, with the heat after which all of it has that pressure. */
#ifndef BOLIDE_BURN_AFTERBURN_H
#define BOLIDE_BURN_AFTERBURN_H

#include "base/exponential.h"
#include "material/point.h"

struct afterburn {
    double energy; /* Q, J/kg; 0: there is none */
    double rate;   /* a, 1/s */
    double depletion, power;
    double slow_energy, slow_rate; /* Q_s, J/kg, 0: one stage; a_s, 1/s */
    double air;                    /* kg that a kg of products takes; 0: it does not matter */
    double mixing;                 /* a_m, 1/s; 0: products stay what they are */
    double load; /* kg/m^3, mass of products over the volume of the room; 0: of the domain */
};

/* The heat of both stages, J/kg. */
BOLIDE_INLINE double afterburn_heat(const struct afterburn *afterburn)
{
    return afterburn->energy + afterburn->slow_energy;
}

/* What k, at BURNT, grows by at PRESSURE (Pa) in DT. */
BOLIDE_INLINE double afterburn_first(const struct afterburn *afterburn, double burnt,
                                     double pressure, double dt)
{
    static const double normal = 1e5;
    const double left = maximum(1.0 - burnt, 0.0);
    double rate = afterburn->rate;
    if (afterburn->depletion > 0.0)
        rate *= left > 0.0 ? power(left, afterburn->depletion) : 0.0;
    if (afterburn->power > 0.0)
        rate *= pressure > 0.0 ? power(pressure / normal, afterburn->power) : 0.0;
    return minimum(rate * dt, left);
}

/* What l, at BURNT, grows by at PRESSURE (Pa) in DT, where it may reach END at most. */
BOLIDE_INLINE double afterburn_gain(const struct afterburn *afterburn, double burnt,
                                    double pressure, double end, double dt)
{
    static const double done = 1.0 - 1e-9; /* what rounding leaves of the first stage */
    const double first = afterburn->energy / afterburn_heat(afterburn);
    const double gain =
        burnt < first * done || !(afterburn->slow_energy > 0.0)
            ? first * afterburn_first(afterburn, burnt / first, pressure, dt)
            : maximum(1.0 - burnt, 0.0) * (1.0 - exponential(-afterburn->slow_rate * dt));
    return minimum(gain, maximum(end - burnt, 0.0));
}

#endif
