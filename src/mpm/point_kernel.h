/* The step of particles of one material, in batches: what it takes and gives. Compiled once an
 * instruction set (point_kernel.c). */
#ifndef BOLIDE_MPM_POINT_KERNEL_H
#define BOLIDE_MPM_POINT_KERNEL_H

#include "material/material.h"

/* The fields of the particles, and their rates: component c of the k-th of the bin is rate[c *
 * rate_stride + k], as transfer.h has them.
 *
 * With AT_STATE `energy` is that of the end of the step, half a step behind the state, when the
 * velocities are of that time: stresses work between the one middle of a step and the next. What
 * the state has is then `at_state`, and `energy` is not changed. */
struct point_loop {
    double *density, *energy, *at_state, *pressure, (*deviator)[6];
    double *history[POINT_HISTORY];    /* by slot, NULL where the store has none */
    double *sound, *viscosity, *shock; /* shock: NULL where none is mixed */
    const double (*position)[3], (*velocity)[3];
    const double *damage_gradient; /* NULL where no damage spreads */
    const double *rate;
    size_t rate_stride;
    double dt, time, edge; /* time: at the end of the step */
    const uint16_t *body;
    const double *half_size; /* of a particle, by body, in cells */
    double viscosity_quadratic, viscosity_unresolved;
    double viscosity_linear, viscosity_shock; /* and how much more of it in shocks in solids */
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

/* The h |w|/c above which all of w, what nodes do not resolve of the divergence, is filtered in
 * MATERIAL, as behind shocks; below it is so in proportion, so that what is elastic rings on. Of
 * gases and explosives without strength nothing is: at the edge of a gas that expands into nothing
 * few particles share a node, and a detonation would lose its peak. */
BOLIDE_INLINE double point_filter(const struct material *material)
{
    const double solid = 1e-3, liquid = 1e-2;
    return material_has_strength(material)   ? solid
           : material_is_condensed(material) ? liquid
                                             : INFINITY;
}

/* What is filtered of W from FULL, point_filter(), on. */
BOLIDE_INLINE double point_unresolved(const struct point_loop *loop, double full, double w,
                                      double sound)
{
    return w * minimum(1.0, loop->edge * fabs(w) / (full * sound));
}

/* What the viscosity of a particle follows from: whether it is a solid or an explosive; its new
 * density; the sound speed before; the divergence that changes its volume, and what is filtered
 * of it. */
struct point_flow {
    bool solid;
    double density, sound, divergence, filtered;
};

/* q = rho h (b2 h d^2 - b1 c d) in compression, d < 0, and -rho h b3 c w of what is filtered, w. In
 * solids, and in explosives that burn by a rate or a threshold, b1 grows with h |d|/c up to 0.001,
 * so that a shock is without overshoot and sound goes on. */
BOLIDE_INLINE double point_viscosity(const struct point_loop *loop, const struct point_flow *flow)
{
    const double d = minimum(flow->divergence, 0.0), h = loop->edge, c = flow->sound;
    const double full = 1e-3, shock = flow->solid ? minimum(1.0, -h * d / (full * c)) : 0.0,
                 linear = loop->viscosity_linear + loop->viscosity_shock * shock;
    return flow->density * h *
           (loop->viscosity_quadratic * h * square(d) - linear * c * d -
            loop->viscosity_unresolved * c * flow->filtered);
}

/* How much of a shock a particle is in: 0 where the artificial viscosity q is less than 0.002 rho
 * c^2, as in sound, 1 from twice as much on; less where it is sheared more than compressed, by the
 * square of the part of DIVERGENCE in the velocity gradient of norm GRADIENT. */
BOLIDE_INLINE double point_shock(double viscosity, double density, double sound, double divergence,
                                 double gradient)
{
    const double soft = 2e-3, strength = viscosity / (density * square(sound));
    const double part = divergence < 0.0 ? minimum(1.0, -divergence / gradient) : 0.0;
    return square(part) * minimum(1.0, maximum(0.0, strength / soft - 1.0));
}

/* The same of a solid that has given more ENERGY than it had, as a particle may that shares nodes
 * with much heavier ones: so that these give some back. From -0.01 c^2 on, all of it at twice that.
 * Of an explosive that burns by a rate or a threshold ENERGY has the heat that was freed; other
 * explosives have less energy than at the start, and fluids may count theirs from elsewhere. */
BOLIDE_INLINE double point_overdrawn(bool solid, double energy, double sound)
{
    const double soft = 1e-2;
    return solid ? minimum(1.0, maximum(0.0, -energy / (soft * square(sound)) - 1.0)) : 0.0;
}

/* Brings particles BEGIN .. END - 1 of the bin at LIST, of MATERIAL, which batches must take, to
 * the next level. False when the new state of one is impossible. */
bool point_loop_run(const struct point_loop *loop, const struct material *material,
                    const int32_t *list, int32_t begin, int32_t end);

#endif
