/* The Riemann problem between two gases of any equation of state at the face of a cell: its sides,
 * what flows through the face, and the speeds of the fastest waves (Einfeldt, SIAM J. Numer. Anal.
 * 25 (1988) 294). What the solvers of gas_solvers.h have in common. */
#ifndef BOLIDE_RIEMANN_GAS_SIDE_H
#define BOLIDE_RIEMANN_GAS_SIDE_H

#include <math.h>

#include "base/vector.h"

/* Velocities: normal to the face, then across. What flows is denser than what waves run in by
 * `surplus`, where a cell of two materials has another part of them at its face; else zero, which
 * compilers leave out. */
struct gas_side {
    double density, normal, across[2], pressure, energy, sound, surplus;
};

/* The density in which waves run. */
BOLIDE_INLINE double gas_side_inertia(const struct gas_side *side)
{
    return side->density - side->surplus;
}

/* What flows through a face: mass, momentum normal to it and across, energy. */
struct gas_flow {
    double mass, normal, across[2], energy;
};

struct gas_waves {
    double slow, fast;
};

BOLIDE_INLINE struct gas_waves gas_waves_of(const struct gas_side *low, const struct gas_side *high)
{
    const double a = sqrt(gas_side_inertia(low)), b = sqrt(gas_side_inertia(high)),
                 part = b / (a + b);
    const double apart = high->normal - low->normal, mean = low->normal + part * apart,
                 sound =
                     sqrt(square(low->sound) + part * (square(high->sound) - square(low->sound)) +
                          0.5 * part * (1.0 - part) * square(apart));
    const struct gas_waves waves = {minimum(low->normal - low->sound, mean - sound),
                                    maximum(high->normal + high->sound, mean + sound)};
    return waves;
}

/* Energy per volume of a side, that of its motion included. */
BOLIDE_INLINE double gas_side_energy(const struct gas_side *side)
{
    return side->density * (side->energy + 0.5 * (square(side->normal) + square(side->across[0]) +
                                                  square(side->across[1])));
}

#endif
