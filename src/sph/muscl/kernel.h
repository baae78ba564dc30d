/* The pair loop of the second-order contact method.
 *
 * It differs from contact/kernel.h in three things. Velocity and stress are carried to the middle
 * of a pair with limited slopes before they meet. A pair has an area vector a = (L_i + L_j)/2 e,
 * with the inverse L of the kernel's second moment, which makes sums exact for linear fields;
 * contacts are solved along n = a/|a|. And impedances are those of shocks. A neighbour is seen
 * through its record:
 *   x [y [z]]  diameter  volume  u [v [w]]  stress  Z_long [Z_across] shock_slope material
 *   compression [packing closure] [elastic credit pull] [depth] L (as a stress)
 *   dq/dx [dq/dy [dq/dz]]  q'
 * with stress as in record.h, velocity and stress half a step ahead, q' both of them a whole step,
 * and `shock_slope` rho times the slope of the shock adiabat (riemann/shock_slope.h). Z_across is
 * the shear impedance; of a material that has none, minus the fraction of compression in its
 * velocity gradient. `compression` is rho over that of the start, in 1-D one; negative where the
 * particle touches no body that it may be apart from (touch.c). In 2-D and 3-D `packing` is what
 * volumes filled too much of the space a step before (muscl_limit_excess), and `closure` the
 * displacement that would have closed the areas of the particle (find_closure). Where there are
 * solids, `elastic` is 0 for fluids, what flows plastically and what has failed, and up to 1 for
 * other solids (record.c), `credit` the work that these may still give (find_credit), and `pull`
 * the tensile part of the stress.
 *
 * Of q, the first four or eight values (the most that there are) stand at the end of the record, a
 * row for dq/dx, one for dq/dy, ..., one for q': the kernel takes these a neighbour at a time, a
 * row in a register. All else stands in front of them and is taken eight neighbours at a time. */
#ifndef BOLIDE_SPH_MUSCL_KERNEL_H
#define BOLIDE_SPH_MUSCL_KERNEL_H

#include "sph/contact/kernel.h"

/* Marks a material that carries no tension; larger than any index of a material. */
enum { MUSCL_GAS = 1 << 16, MUSCL_FAILED = 2 << 16 };

struct muscl_kind {
    int dimension;
    bool shear, depth; /* as in pair_kind */
};

/* Components of a symmetric tensor in DIMENSION dimensions. */
BOLIDE_INLINE int tensor_components(int dimension) { return record_stresses(dimension, true); }

/* Offsets in a record; up to the stress they are those of contact/kernel.h. */
BOLIDE_INLINE int muscl_stresses(struct muscl_kind kind)
{
    return record_stresses(kind.dimension, kind.shear);
}
BOLIDE_INLINE int muscl_impedance(struct muscl_kind kind)
{
    return record_stress(kind.dimension) + muscl_stresses(kind);
}
BOLIDE_INLINE int muscl_shock_slope(struct muscl_kind kind)
{
    return muscl_impedance(kind) + 1 + (kind.dimension > 1);
}
/* The index of the material, plus MUSCL_GAS for a gas and MUSCL_FAILED for what has failed; for a
 * particle with prescribed motion -2 minus that. */
BOLIDE_INLINE int muscl_material(struct muscl_kind kind) { return muscl_shock_slope(kind) + 1; }
BOLIDE_INLINE bool muscl_driven(double material) { return material < -1.5; }
BOLIDE_INLINE double muscl_index(double material) { return maximum(material, -2.0 - material); }
BOLIDE_INLINE double muscl_mark(int material, bool gas)
{
    return gas ? material + MUSCL_GAS : material;
}
BOLIDE_INLINE double muscl_failed_mark(int material) { return material + MUSCL_FAILED; }
BOLIDE_INLINE int muscl_compression(struct muscl_kind kind) { return muscl_shock_slope(kind) + 2; }
/* Whether bodies under a contact law see each other at two particles of these compressions. */
BOLIDE_INLINE bool muscl_meet(double first, double second) { return maximum(first, second) > 0.0; }
BOLIDE_INLINE int muscl_packing(struct muscl_kind kind) { return muscl_compression(kind) + 1; }
/* The excess of packing as it enters means over neighbours. At a surface, and in a lattice
 * compressed along one axis, it is far below zero, which must not count in full. */
BOLIDE_INLINE double muscl_limit_excess(double excess)
{
    return minimum(0.1, maximum(-0.05, excess));
}
/* 1 for solids but soft ones, whose shear waves are slower than a third of their sound: these are
 * held by their jumps of stress, and come apart in tension. */
BOLIDE_INLINE double muscl_firmness(double sound_long, double sound_shear)
{
    return minimum(1.0, 10.0 * square(sound_shear / sound_long));
}
BOLIDE_INLINE int muscl_closure(struct muscl_kind kind)
{
    return muscl_packing(kind) + (kind.dimension > 1);
}
BOLIDE_INLINE int muscl_elasticity(struct muscl_kind kind)
{
    return muscl_closure(kind) + (kind.dimension > 1 ? kind.dimension : 0);
}
BOLIDE_INLINE int muscl_credit(struct muscl_kind kind) { return muscl_elasticity(kind) + 1; }
BOLIDE_INLINE int muscl_pull(struct muscl_kind kind) { return muscl_credit(kind) + 1; }
BOLIDE_INLINE int muscl_depth(struct muscl_kind kind)
{
    return kind.dimension > 1 && kind.shear ? muscl_pull(kind) + muscl_stresses(kind)
                                            : muscl_elasticity(kind);
}
BOLIDE_INLINE int muscl_correction(struct muscl_kind kind)
{
    return muscl_depth(kind) + kind.depth;
}
/* The number of values of q (velocity, then stress), of those in rows, and of those before the
 * rows. */
BOLIDE_INLINE int muscl_values(struct muscl_kind kind)
{
    return kind.dimension + muscl_stresses(kind);
}
BOLIDE_INLINE int muscl_wide(struct muscl_kind kind) { return muscl_values(kind) / 4 * 4; }
BOLIDE_INLINE int muscl_narrow(struct muscl_kind kind)
{
    return muscl_values(kind) - muscl_wide(kind);
}
BOLIDE_INLINE int muscl_narrow_rows(struct muscl_kind kind)
{
    return muscl_correction(kind) + tensor_components(kind.dimension);
}
/* Fields in front of the rows, a multiple of four. */
BOLIDE_INLINE int muscl_fields(struct muscl_kind kind)
{
    return (muscl_narrow_rows(kind) + (kind.dimension + 1) * muscl_narrow(kind) + 3) / 4 * 4;
}
BOLIDE_INLINE int muscl_wide_rows(struct muscl_kind kind)
{
    return muscl_wide(kind) == 8 ? (muscl_fields(kind) + 7) / 8 * 8 : muscl_fields(kind);
}
/* The offset of dq/dx of value F; those of the other axes and of q' follow, a step each. */
BOLIDE_INLINE int muscl_slope(struct muscl_kind kind, int f)
{
    return f < muscl_wide(kind) ? muscl_wide_rows(kind) + f
                                : muscl_narrow_rows(kind) + f - muscl_wide(kind);
}
BOLIDE_INLINE int muscl_slope_step(struct muscl_kind kind, int f)
{
    return f < muscl_wide(kind) ? muscl_wide(kind) : muscl_narrow(kind);
}
BOLIDE_INLINE int muscl_next(struct muscl_kind kind, int f)
{
    return muscl_slope(kind, f) + kind.dimension * muscl_slope_step(kind, f);
}
BOLIDE_INLINE int muscl_stride(struct muscl_kind kind)
{
    int used = muscl_wide_rows(kind) + (kind.dimension + 1) * muscl_wide(kind);
    return (used + 7) / 8 * 8;
}

/* Sums for particle i as in contact/kernel.h, with a in place of W' e, and L_i W' e in gradients.
 * In addition: */
struct muscl_rates {
    struct pair_rates sums;
    double *correction; /* L, 1, 3, 6 components */
    /* For the next step, of what its values will be: dU^a/dx^b by rows, 1/s; of the record's
     * stresses by direction, Pa/m */
    double *velocity_gradient, *stress_gradient;
    double (*force)[3];                 /* likewise, on a unit of volume, N/m^3 */
    double (*packing)[PACKING_NUMBERS]; /* NULL in 1-D */
    double (*volume)[VOLUME_NUMBERS];   /* NULL in 1-D */
    double (*closure)[3];               /* see find_closure, m; NULL in 1-D */
    double *credit;                     /* see find_credit, J/kg; NULL without solids */
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
