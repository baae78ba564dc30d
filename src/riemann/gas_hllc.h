/* HLLC (Toro, Spruce and Speares, Shock Waves 4 (1994) 25): two waves and a contact between them,
 *
 *   u* = (p_r - p_l + m_l u_l - m_r u_r)/(m_l - m_r)    m = (rho - surplus) (S - u)
 *   p* = p + m (u* - u)                                 rho* = rho (S - u)/(S - u*)
 *
 * on either side, with S the speed of its wave and the surplus of gas_side.h. */
#ifndef BOLIDE_RIEMANN_GAS_HLLC_H
#define BOLIDE_RIEMANN_GAS_HLLC_H

#include "riemann/gas_side.h"

#define GAS_RIEMANN_hllc_HELP "two waves and the contact"

/* Without branches: loops over faces call it. */
BOLIDE_INLINE struct gas_flow gas_riemann_hllc(struct gas_side low, struct gas_side high)
{
    const struct gas_waves waves = gas_waves_of(&low, &high);
    const double slow = waves.slow, fast = waves.fast;
    const double ml = gas_side_inertia(&low) * (slow - low.normal),
                 mh = gas_side_inertia(&high) * (fast - high.normal);
    const double contact =
        (high.pressure - low.pressure + ml * low.normal - mh * high.normal) / (ml - mh);
    const bool from_low = contact >= 0.0;
    const double density = from_low ? low.density : high.density,
                 u = from_low ? low.normal : high.normal,
                 first = from_low ? low.across[0] : high.across[0],
                 second = from_low ? low.across[1] : high.across[1],
                 pressure = from_low ? low.pressure : high.pressure,
                 energy = from_low ? low.energy : high.energy, speed = from_low ? slow : fast;
    /* outside the wave of that side the flux is that between the wave and the contact */
    const double jump = from_low ? minimum(speed, 0.0) : maximum(speed, 0.0);
    const double total = energy + 0.5 * (square(u) + square(first) + square(second));
    /* in this order the flux between equal gases at rest is exactly their pressure */
    const double star = density * ((speed - u) / (speed - contact)),
                 gain = (contact - u) * (contact + pressure / (density * (speed - u)));
    const double more = jump * (star - density), mass = density * u + more;
    const double surplus = from_low ? low.surplus : high.surplus;
    const double inside = fabs(jump) > 0.0 ? 1.0 : 0.0; /* of the waves */
    const double less = surplus != 0.0 ? inside * surplus * (speed - u) * (contact - u) : 0.0,
                 of_work = surplus != 0.0 ? contact * less : 0.0; /* by which p* is less */
    struct gas_flow flow;
    flow.mass = mass;
    flow.normal = density * u * u + pressure + jump * (star * contact - density * u) - less;
    flow.across[0] = mass * first;
    flow.across[1] = mass * second;
    flow.energy = u * (density * total + pressure) +
                  jump * (star * (total + gain) - density * total) - of_work;
    return flow;
}

#endif
