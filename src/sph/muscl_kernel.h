/* The pair loop of the second-order contact method.
 *
 * It differs from pair_kernel.h in three things. Velocity and stress are carried to the middle of a pair with limited
 * slopes before they meet. A pair has an area vector a = (L_i + L_j)/2 e, with the inverse L of the kernel's second
 * moment, which makes sums exact for linear fields; contacts are solved along n = a/|a|. And impedances are those of
 * shocks. A neighbour is seen through its record:
 *   x [y [z]]  diameter  volume  u [v [w]]  stress  Z_long [Z_across] bend material [depth]
 *   L (as a stress)  du/dx (by rows)  dstress/dx [dstress/dy [dstress/dz]]  u' [v' [w']]  stress'
 * with stress as in record.h, velocity and stress half a step ahead, u' and stress' a whole step, and `bend` rho times
 * the slope of the shock curve (riemann/bend.h). Z_across is the shear impedance; of matter that has none, minus the
 * share of compression in its velocity gradient. */
#ifndef BOLIDE_SPH_MUSCL_KERNEL_H
#define BOLIDE_SPH_MUSCL_KERNEL_H

#include "sph/pair_kernel.h"

struct muscl_kind {
    int dimension;
    bool shear, depth; /* as in pair_kind */
};

/* Components of a symmetric tensor in DIMENSION dimensions. */
BOLIDE_INLINE int tensor_components(int dimension) { return record_stresses(dimension, true); }

/* Offsets in a record; up to the stress they are those of pair_kernel.h. */
BOLIDE_INLINE int muscl_stresses(struct muscl_kind kind)
{
    return record_stresses(kind.dimension, kind.shear);
}
BOLIDE_INLINE int muscl_impedance(struct muscl_kind kind)
{
    return record_stress(kind.dimension) + muscl_stresses(kind);
}
BOLIDE_INLINE int muscl_bend(struct muscl_kind kind)
{
    return muscl_impedance(kind) + 1 + (kind.dimension > 1);
}
BOLIDE_INLINE int muscl_material(struct muscl_kind kind) { return muscl_bend(kind) + 1; }
BOLIDE_INLINE int muscl_depth(struct muscl_kind kind) { return muscl_bend(kind) + 2; }
BOLIDE_INLINE int muscl_correction(struct muscl_kind kind)
{
    return muscl_depth(kind) + kind.depth;
}
BOLIDE_INLINE int muscl_velocity_gradient(struct muscl_kind kind)
{
    return muscl_correction(kind) + tensor_components(kind.dimension);
}
BOLIDE_INLINE int muscl_stress_gradient(struct muscl_kind kind)
{
    return muscl_velocity_gradient(kind) + kind.dimension * kind.dimension;
}
BOLIDE_INLINE int muscl_next(struct muscl_kind kind)
{
    return muscl_stress_gradient(kind) + kind.dimension * muscl_stresses(kind);
}
BOLIDE_INLINE int muscl_stride(struct muscl_kind kind)
{
    int used = muscl_next(kind) + kind.dimension + muscl_stresses(kind);
    return (used + 7) / 8 * 8;
}

/* Sums for particle i, as pair_kernel.h has them, with a for W' e and L_i W' e in gradients. Beyond them: */
struct muscl_rates {
    struct pair_rates sums;
    double *correction; /* L, 1, 3, 6 components */
    /* For the next step, of what its values will be: dU^a/dx^b by rows, 1/s; of the record's stresses by direction, Pa/m */
    double *velocity_gradient, *stress_gradient;
    double (*force)[3]; /* likewise, on a unit of volume, N/m^3 */
    /* Not on a line: what volumes fill of the space there is at the start, one at least, and what they do beyond. */
    double (*packing)[2];
};

struct muscl_loop {
    struct muscl_kind kind;
    const double *record; /* owned, ghosts, and one of zeros behind them */
    int32_t empty;        /* index of the record of zeros */
    const double *place;  /* of the same particles, as lanes.h has it */
    double smoothing;
    const struct neighbours *neighbours;
    const struct contact_groups *groups;
    const uint16_t *body;        /* of owned particles */
    const double *density;       /* at level n */
    const double (*velocity)[3]; /* at level n */
    struct muscl_rates rates;
};

/* Fills the rates of particles begin .. end - 1 with the best instruction set of this processor. */
void muscl_loop_run(const struct muscl_loop *loop, int32_t begin, int32_t end);

#endif
