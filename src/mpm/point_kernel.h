/* The step of particles of one material, in batches: what it takes and gives. Compiled once an instruction set
 * (point_kernel.c). */
#ifndef BOLIDE_MPM_POINT_KERNEL_H
#define BOLIDE_MPM_POINT_KERNEL_H

#include "material/point.h"

struct material;

/* The fields of the particles, and their rates: component c of the k-th of the bin is rate[c * rate_stride + k]. */
struct point_loop {
    double *density, *energy, *pressure, (*deviator)[6];
    double *history[POINT_HISTORY]; /* by slot, NULL where the store has none */
    double *sound, *viscosity;
    const double (*position)[3], (*velocity)[3];
    const double *rate;
    size_t rate_stride;
    double dt, time, edge, viscosity_quadratic, viscosity_linear; /* time: at the end of the step */
    bool jaumann;
};

/* S + S Om^T + Om S for Om_ij = w_ij dt of the ANGLE w dt (2-21). */
BOLIDE_INLINE struct sym3 jaumann_turn(struct sym3 s, struct vec3 angle)
{
    const double xy = -angle.z, zx = -angle.y, yz = -angle.x; /* Om_xy, -Om_xz, Om_yz */
    const double xz = -zx;
    struct sym3 r = s;
    r.xx += 2.0 * (xy * s.xy + xz * s.zx);
    r.yy += 2.0 * (-xy * s.xy + yz * s.yz);
    r.zz += 2.0 * (-xz * s.zx - yz * s.yz);
    r.xy += xy * (s.yy - s.xx) + xz * s.yz + yz * s.zx;
    r.yz += yz * (s.zz - s.yy) - xy * s.zx - xz * s.xy;
    r.zx += xz * (s.zz - s.xx) + xy * s.yz - yz * s.xy;
    return r;
}

/* q = rho h (b2 h d^2 - b1 c d) in compression. */
BOLIDE_INLINE double point_viscosity(const struct point_loop *loop, double density, double sound,
                                     double divergence)
{
    const double d = minimum(divergence, 0.0), h = loop->edge;
    return density * h *
           (loop->viscosity_quadratic * h * square(d) - loop->viscosity_linear * sound * d);
}

/* Brings particles BEGIN .. END - 1 of the bin at LIST, of MATERIAL, which batches must take, to the next level. False when
 * the new state of one is impossible. */
bool point_loop_run(const struct point_loop *loop, const struct material *material,
                    const int32_t *list, int32_t begin, int32_t end);

#endif
