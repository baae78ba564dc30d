/* The spread loop: |grad D| of damage that spreads through a material.
 *
 *   grad D_i = M^-1 sum w (D_j - D_i) (x_j - x_i),  M = sum w (x_j - x_i) (x_j - x_i)^T
 *   w = -V_j W'_ij/r_ij
 *
 * over the neighbours of the same body. Without M the sums are 3 to 6 % low: the gradient of a
 * linear D would not be exact. A neighbour is seen through its record alone:
 *   x [y [z]]  diameter  volume  damage  body */
#ifndef BOLIDE_SPH_SPREAD_KERNEL_H
#define BOLIDE_SPH_SPREAD_KERNEL_H

#include "particle/neighbours.h"

/* Doubles from one record to the next: a cache line. */
enum { SPREAD_STRIDE = 8 };

/* Offsets in a record, behind position and diameter. */
BOLIDE_INLINE int spread_record_volume(int dimension) { return dimension + 1; }
BOLIDE_INLINE int spread_record_damage(int dimension) { return dimension + 2; }
BOLIDE_INLINE int spread_record_body(int dimension) { return dimension + 3; }

struct spread_loop {
    int dimension;
    const double *record; /* owned, ghosts, and one of zeros behind them */
    int32_t empty;        /* index of the record of zeros */
    double smoothing;     /* h = smoothing (D_i + D_j)/2 */
    const struct neighbours *neighbours;
    const bool *spreads; /* by material */
    const uint16_t *material;
    double *gradient; /* |grad D|, 1/m */
};

/* Fills the gradients of particles begin .. end - 1 with the best instruction set of this
 * processor. */
void spread_loop_run(const struct spread_loop *loop, int32_t begin, int32_t end);

#endif
