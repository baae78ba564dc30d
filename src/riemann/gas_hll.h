/* HLL (Harten, Lax and van Leer, SIAM Review 25 (1983) 35): two waves and one state between them,
 * which smears contacts and shear. */
#ifndef BOLIDE_RIEMANN_GAS_HLL_H
#define BOLIDE_RIEMANN_GAS_HLL_H

#include "riemann/gas_side.h"

#define GAS_RIEMANN_hll_HELP "two waves alone, which smear contacts and shear"

/* The flux is from_low f_low + from_high f_high + spread (U_high - U_low). */
struct gas_hll_weights {
    double from_low, from_high, spread;
};

BOLIDE_INLINE struct gas_hll_weights gas_hll_weights_of(const struct gas_side *low,
                                                        const struct gas_side *high)
{
    const struct gas_waves waves = gas_waves_of(low, high);
    const double slow = minimum(waves.slow, 0.0), fast = maximum(waves.fast, 0.0);
    const struct gas_hll_weights weights = {fast / (fast - slow), -slow / (fast - slow),
                                            slow * fast / (fast - slow)};
    return weights;
}

BOLIDE_INLINE struct gas_flow gas_riemann_hll(struct gas_side low, struct gas_side high)
{
    const struct gas_hll_weights w = gas_hll_weights_of(&low, &high);
    const double energy[2] = {gas_side_energy(&low), gas_side_energy(&high)};
    const double ml = low.density * low.normal, mh = high.density * high.normal;
    struct gas_flow flow;
    flow.mass = w.from_low * ml + w.from_high * mh + w.spread * (high.density - low.density);
    flow.normal = w.from_low * (ml * low.normal + low.pressure) +
                  w.from_high * (mh * high.normal + high.pressure) + w.spread * (mh - ml);
    for (int n = 0; n < 2; n++)
        flow.across[n] = w.from_low * ml * low.across[n] + w.from_high * mh * high.across[n] +
                         w.spread * (high.density * high.across[n] - low.density * low.across[n]);
    flow.energy = w.from_low * low.normal * (energy[0] + low.pressure) +
                  w.from_high * high.normal * (energy[1] + high.pressure) +
                  w.spread * (energy[1] - energy[0]);
    return flow;
}

#endif
