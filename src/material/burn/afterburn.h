/* Afterburn: products that lack oxygen burn on in the air that they meet. Of their mass the
 * fraction l has, which grows as
 *
 *   dl/dt = a (1 - l)^m (p/p_0)^n,   p_0 = 0.1 MPa
 *
 * and each kg of it gives the heat Q to the products. With m = n = 0 the rate is constant. Source:
 * P. J. Miller, Mater. Res. Soc. Symp. Proc. 418 (1996) 413. */
#ifndef BOLIDE_BURN_AFTERBURN_H
#define BOLIDE_BURN_AFTERBURN_H

#include "base/exponential.h"
#include "material/point.h"

struct afterburn {
    double energy; /* Q, J/kg; 0: there is none */
    double rate;   /* a, 1/s */
    double depletion, power;
};

/* What l, at BURNT, grows by at PRESSURE (Pa) in DT. */
BOLIDE_INLINE double afterburn_gain(const struct afterburn *afterburn, double burnt,
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

#endif
