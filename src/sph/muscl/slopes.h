/* What slopes change values by over a pair, and which share of that a limiter leaves: van Leer's
 * (J. Comput. Phys. 14 (1974) 361). For the files that are compiled once an instruction set. */
#ifndef BOLIDE_SPH_MUSCL_SLOPES_H
#define BOLIDE_SPH_MUSCL_SLOPES_H

#include "base/vector.h"
#include "sph/lanes.h"
#include "sph/muscl/kernel.h"

/* The shares of the change D between two particles that limited slopes carry from each to the
 * middle: b/(D + b) with b = 2 C - D, the change that lies on the other side when the slope changes
 * by C over the pair; nothing where b turns against D. A change is D^2 and twice the two D C. */
struct shares {
    double own, other;
};

struct change {
    double square, own, other;
};

/* Those of two quantities, with one division. */
BOLIDE_INLINE void limited_shares(struct change first, struct change second,
                                  struct shares *of_first, struct shares *of_second)
{
    const double tiny = 1e-70;
    double a = maximum(first.own - first.square, 0.0);
    double b = maximum(first.other - first.square, 0.0);
    double c = maximum(second.own - second.square, 0.0);
    double d = maximum(second.other - second.square, 0.0);
    first.square += tiny;
    second.square += tiny;
    double whole_a = first.square + a, whole_b = first.square + b;
    double whole_c = second.square + c, whole_d = second.square + d;
    double ab = whole_a * whole_b, cd = whole_c * whole_d, inverse = 1.0 / (ab * cd);
    double inverse_ab = inverse * cd, inverse_cd = inverse * ab;
    of_first->own = a * whole_b * inverse_ab;
    of_first->other = b * whole_a * inverse_ab;
    of_second->own = c * whole_d * inverse_cd;
    of_second->other = d * whole_c * inverse_cd;
}

/* What value F changes by over X by the slopes of RECORD, whose fields stand STEP doubles apart. */
BOLIDE_INLINE double change_of(struct muscl_kind kind, const double *record, int step, int f,
                               struct vec3 x)
{
    const double *g = record + muscl_slope(kind, f) * step;
    step *= muscl_slope_step(kind, f);
    if (kind.dimension == 1)
        return g[0] * x.x;
    if (kind.dimension == 2)
        return g[0] * x.x + g[step] * x.y;
    return g[0] * x.x + g[step] * x.y + g[2 * step] * x.z;
}

/* Slopes of one particle as a kernel sees them: fields STEP doubles apart, and what values in rows
 * change by. */
struct slopes {
    const double *record, *wide;
    int step;
};

BOLIDE_INLINE double changed(struct muscl_kind kind, struct slopes by, int f, struct vec3 x)
{
    return by.wide && f < muscl_wide(kind) ? by.wide[f * LANES]
                                           : change_of(kind, by.record, by.step, f, x);
}

BOLIDE_INLINE struct vec3 change_of_velocity(struct muscl_kind kind, struct slopes by,
                                             struct vec3 x)
{
    return vec3_make(changed(kind, by, 0, x), kind.dimension > 1 ? changed(kind, by, 1, x) : 0.0,
                     kind.dimension > 2 ? changed(kind, by, 2, x) : 0.0);
}

BOLIDE_INLINE struct sym3 change_of_stress(struct muscl_kind kind, struct slopes by, struct vec3 x)
{
    const int first = kind.dimension;
    struct sym3 change = {changed(kind, by, first, x), 0.0, 0.0, 0.0, 0.0, 0.0};
    if (muscl_stresses(kind) == 3) {
        change.yy = changed(kind, by, first + 1, x);
        change.xy = changed(kind, by, first + 2, x);
    }
    if (muscl_stresses(kind) == 6) {
        change.yy = changed(kind, by, first + 1, x);
        change.zz = changed(kind, by, first + 2, x);
        change.xy = changed(kind, by, first + 3, x);
        change.yz = changed(kind, by, first + 4, x);
        change.zx = changed(kind, by, first + 5, x);
    }
    return change;
}

#endif
