/* The Riemann problem of two ideal gases, each with its own gamma: two uniform gases meet at a
 * plane. Exact for any strength of the waves; a vacuum between the gases is refused. */
#ifndef BOLIDE_EXACT_GAS_RIEMANN_H
#define BOLIDE_EXACT_GAS_RIEMANN_H

#include "base/parameter.h"
#include "exact/exact.h"

struct exact_gas {
    double density, velocity, pressure, gamma;
};

struct exact_gas_riemann {
    struct exact_gas gas[2]; /* by enum exact_side */
    double at;
};

extern const struct parameter exact_gas_riemann_table[];
extern const struct exact_class exact_gas_riemann_class;

#endif
