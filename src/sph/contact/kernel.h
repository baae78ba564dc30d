/* The pair loop: sums over neighbours of what the Riemann problems between particles give.
 *
 * A neighbour is seen through its record alone, a few doubles packed once a stage:
 *   x [y [z]]  diameter  volume  u [v [w]]  stress  Z_long [Z_shear]  [density shock_slope]
 *   [depth]  [spin]  [tension shear]
 * where stress is sigma_xx alone for fluids and in 1-D, (xx, yy, xy) in 2-D, (xx, yy, zz, xy, yz,
 * zx) in 3-D, spin one component in 2-D, three in 3-D, and the last two the stresses at which a
 * contact breaks. With a depth d, the volume is the area A
 * = m/(rho d) of a section of the plane. The loop is compiled for several instruction sets with the
 * same result to the last bit. */
#ifndef BOLIDE_SPH_PAIR_KERNEL_H
#define BOLIDE_SPH_PAIR_KERNEL_H

#include "particle/neighbours.h"
#include "riemann/contact_pair.h"
#include "sph/layout.h"

/* What instantiates a kernel. `star`: means, or one of the Riemann problems but STAR_SHOCK.
 * `shear`: stress is a tensor and shear impedances count. `drift`: the mean of contact velocities
 * is wanted too. `depth`: particles of the plane have a depth, the radius r of axisymmetry (-r
 * behind the axis) or the thickness of a plate. `turn`: velocities are those at the contact point
 * (acoustic, with shear). `breaks`: contacts break. */
struct pair_kind {
    int dimension;
    bool shear;
    enum pair_star star;
    bool drift, depth, turn, breaks;
};

/* Offsets in a record; up to the stress those of sph/layout.h. */
BOLIDE_INLINE int record_impedance(int dimension, bool shear)
{
    return record_stress(dimension) + record_stresses(dimension, shear);
}
/* Solvers of strong shocks also see density and shock_slope (riemann/side.h). */
BOLIDE_INLINE bool record_has_shock_slope(struct pair_kind kind)
{
    return kind.star == STAR_DUKOWICZ || kind.star == STAR_EXACT_GAS;
}
BOLIDE_INLINE int record_shock_slope(int dimension, bool shear)
{
    return record_impedance(dimension, shear) + 1 + (shear && dimension > 1);
}
BOLIDE_INLINE int record_depth(struct pair_kind kind)
{
    return record_shock_slope(kind.dimension, kind.shear) + (record_has_shock_slope(kind) ? 2 : 0);
}
BOLIDE_INLINE int record_spin(struct pair_kind kind) { return record_depth(kind) + kind.depth; }
/* The tension along a pair and the shear stress across it at which contacts break; the smaller of
 * both sides counts. */
BOLIDE_INLINE int record_breaking(struct pair_kind kind)
{
    return record_spin(kind) + (!kind.turn ? 0 : kind.dimension == 2 ? 1 : 3);
}
/* Doubles from one record to the next: whole cache lines. */
BOLIDE_INLINE int record_stride(struct pair_kind kind)
{
    const int used = record_breaking(kind) + (kind.breaks ? 2 : 0);
    return (used + 7) / 8 * 8;
}

struct pair_loop {
    struct pair_kind kind;
    const double *record; /* owned, ghosts, and one of zeros behind them */
    int32_t empty;        /* index of the record of zeros */
    double smoothing;     /* alpha: h = alpha (D_i + D_j)/2 (1.19) */
    const struct neighbours *neighbours;
    const struct contact_groups *groups;
    const uint16_t *body; /* of owned particles */
    const double *density;
    struct pair_rates rates;
};

/* Fills the rates of particles begin .. end - 1 with the best instruction set of this processor. */
void pair_loop_run(const struct pair_loop *loop, int32_t begin, int32_t end);

#endif
