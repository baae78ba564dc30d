/* The step of particles by themselves: one of any material, or a batch of one that batches take. It
 * compiles as CUDA device code too. */
#ifndef BOLIDE_MPM_POINT_BODY_H
#define BOLIDE_MPM_POINT_BODY_H

#include "material/batch.h"
#include "mpm/point_kernel.h"
#include "mpm/transfer.h"

/* The norm of the velocity gradient. */
BOLIDE_INLINE double norm_of(struct sym3 strain, struct vec3 spin)
{
    return sqrt(sym3_square(strain) + 2.0 * vec3_dot(spin, spin));
}

/* Half of what a step of MOTION takes by the stress at its begin, with VISCOSITY of then. */
BOLIDE_INLINE double work_at_begin(const struct point *point, const struct motion *motion,
                                   double viscosity)
{
    struct motion half = *motion;
    half.dt *= 0.5;
    half.viscous_pressure = 0.5 * viscosity;
    return material_work(point, &half, point->deviator);
}

/* Brings particle I, number K of its bin, of any material to the next level. LENGTH is its size
 * at the start. */
BOLIDE_INLINE void point_advance(const struct point_loop *loop, const struct material *material,
                                 int32_t i, int32_t k, double length)
{
    double *s = loop->deviator[i], rate[RATES];
    struct motion motion;
    struct point point;
    for (int c = 0; c < RATES; c++)
        rate[c] = loop->rate[(size_t)c * loop->rate_stride + (size_t)k];
    const bool solid = material_has_strength(material);
    const double filtered = point_unresolved(loop, point_filter(material), rate[RATE_UNRESOLVED],
                                             loop->sound[i]),
                 divergence = rate[0] + rate[1] + rate[2] - filtered;
    motion.dt = loop->dt;
    motion.time = loop->time;
    motion.length = length;
    motion.strain_rate = sym3_make(rate);
    const struct vec3 spin = vec3_make(rate[6], rate[7], rate[8]);
    motion.spin = spin;
    motion.density = loop->density[i] / (1.0 + loop->dt * divergence); /* (2-20) */
    motion.energy = motion.compaction = motion.pressure = 0.0;
    motion.damage_gradient = loop->damage_gradient ? loop->damage_gradient[i] : 0.0;
    point.density = loop->density[i];
    point.energy = loop->energy[i];
    point.pressure = loop->pressure[i];
    point.deviator = sym3_make(s);
    for (int slot = 0; slot < POINT_HISTORY; slot++)
        point.history[slot] = loop->history[slot] ? loop->history[slot][i] : 0.0;
    /* an explosive that has yet to burn has no viscosity */
    const bool inert = material_is_lit(material) && point.history[HISTORY_burnt] == 0.0;
    /* the shock that lights an explosive overshoots as that in a solid does */
    const bool stiff = solid || burn_is_kinetic(&material->burn);
    const struct point_flow flow = {stiff, motion.density, loop->sound[i], divergence, filtered};
    const double viscosity = inert ? 0.0 : point_viscosity(loop, &flow);
    motion.viscous_pressure = 0.5 * (loop->viscosity[i] + viscosity);
    if (loop->jaumann) {
        point.deviator = jaumann_turn(point.deviator, vec3_scale(loop->dt, motion.spin));
        motion.spin = vec3_make(0.0, 0.0, 0.0);
    }
    if (loop->at_state)
        point.energy -= work_at_begin(&point, &motion, loop->viscosity[i]);
    const struct response r = material_step_by_work(material, &point, &motion);
    loop->density[i] = point.density;
    *(loop->at_state ? &loop->at_state[i] : &loop->energy[i]) = point.energy;
    loop->pressure[i] = point.pressure;
    for (int slot = 0; slot < POINT_HISTORY; slot++)
        if (loop->history[slot])
            loop->history[slot][i] = point.history[slot];
    loop->viscosity[i] = viscosity;
    if (loop->shock)
        loop->shock[i] = maximum(
            point_shock(viscosity, point.density, loop->sound[i], divergence,
                        norm_of(motion.strain_rate, spin)),
            point_overdrawn(
                burn_is_kinetic(&material->burn) || (solid && !material_burns(material)),
                point.energy + point.history[HISTORY_burnt] * material_reaction_heat(material),
                loop->sound[i]));
    loop->sound[i] = r.sound_long;
    sym3_store(point.deviator, s);
}

/* COUNT particles at LIST and RATE become a batch; what is behind the last one is that one
 * again, with other rates. */
BOLIDE_INLINE void points_load(const struct point_loop *loop, const int32_t *list,
                               const double *rate, int count, struct batch *b)
{
    b->dt = loop->dt;
    b->count = (count + LANES - 1) / LANES * LANES;
    for (int c = 0; c < 9; c++)
        memcpy(c < 6 ? b->strain_rate[c] : b->spin[c - 6], rate + (size_t)c * loop->rate_stride,
               (size_t)b->count * sizeof *rate);
    for (int k = 0; k < b->count; k++) {
        const int32_t i = list[k < count ? k : count - 1];
        for (int c = 0; c < 6; c++)
            b->deviator[c][k] = loop->deviator[i][c];
        b->density[k] = loop->density[i];
        b->energy[k] = loop->energy[i];
        b->pressure[k] = loop->pressure[i];
        batch_load_history(b, k, loop->history, i);
        b->damage_gradient[k] = loop->damage_gradient ? loop->damage_gradient[i] : 0.0;
        b->viscous_pressure[k] = loop->viscosity[i];
        b->sound_long[k] = loop->sound[i];
        b->length[k] = 2.0 * loop->half_size[loop->body[i]] * loop->edge;
    }
}

/* What a batch has beside its states: whether it has strength; point_filter(); the new
 * viscosity, and how much of a shock a particle is in. */
struct batch_flow {
    bool solid;
    double filter, viscosity[BATCH], shock[BATCH];
};

/* What the rates do to density and viscosity. UNRESOLVED is what nodes do not resolve of the
 * divergence. */
BOLIDE_INLINE void points_start(const struct point_loop *loop, struct batch *b,
                                const double *unresolved, struct batch_flow *of)
{
    double before[BATCH], divergence[BATCH];
    for (int k = 0; k < b->count; k++) {
        const double filtered = point_unresolved(loop, of->filter, unresolved[k], b->sound_long[k]);
        divergence[k] =
            b->strain_rate[0][k] + b->strain_rate[1][k] + b->strain_rate[2][k] - filtered;
        b->new_density[k] = b->density[k] / (1.0 + b->dt * divergence[k]); /* (2-20) */
        const struct point_flow flow = {of->solid, b->new_density[k], b->sound_long[k],
                                        divergence[k], filtered};
        of->viscosity[k] = point_viscosity(loop, &flow);
        before[k] = b->viscous_pressure[k];
        b->viscous_pressure[k] = 0.5 * (before[k] + of->viscosity[k]);
    }
    for (int k = 0; k < b->count && loop->shock; k++) {
        const struct motion motion = batch_motion(b, k);
        of->shock[k] = point_shock(of->viscosity[k], b->new_density[k], b->sound_long[k],
                                   divergence[k], norm_of(motion.strain_rate, motion.spin));
    }
    for (int k = 0; k < b->count && loop->jaumann; k++) {
        const struct vec3 angle =
            vec3_make(b->dt * b->spin[0][k], b->dt * b->spin[1][k], b->dt * b->spin[2][k]);
        batch_keep_tensor(b->deviator, k, jaumann_turn(batch_tensor(b->deviator, k), angle));
        for (int c = 0; c < 3; c++)
            b->spin[c][k] = 0.0;
    }
    for (int k = 0; k < b->count && loop->at_state; k++) {
        const struct motion motion = batch_motion(b, k);
        const struct point point = {.density = b->density[k],
                                    .pressure = b->pressure[k],
                                    .deviator = batch_tensor(b->deviator, k)};
        b->energy[k] -= work_at_begin(&point, &motion, before[k]);
    }
}

BOLIDE_INLINE bool points_keep(const struct point_loop *loop, const int32_t *list, int count,
                               const struct batch *b, const struct batch_flow *of)
{
    double *energy = loop->at_state ? loop->at_state : loop->energy;
    int64_t wrong = 0;
    double zero = 0.0; /* unless a place or velocity is not finite */
    for (int k = 0; k < b->count; k++) {
        const double all = b->energy[k] + b->pressure[k] + b->new_density[k];
        wrong += !(minimum(b->new_density[k], b->sound_long[k]) > 0.0 * all);
    }
    for (int k = 0; k < count; k++) {
        const int32_t i = list[k];
        const double *x = loop->position[i], *u = loop->velocity[i];
        double *s = loop->deviator[i];
        for (int c = 0; c < 6; c++)
            s[c] = b->new_deviator[c][k];
        loop->density[i] = b->new_density[k];
        energy[i] = b->energy[k];
        loop->pressure[i] = b->pressure[k];
        batch_keep_history(b, k, loop->history, i);
        loop->viscosity[i] = of->viscosity[k];
        if (loop->shock)
            loop->shock[i] =
                maximum(of->shock[k], point_overdrawn(of->solid, b->energy[k], b->sound_long[k]));
        loop->sound[i] = b->sound_long[k];
        zero += 0.0 * ((x[0] + x[1]) + (x[2] + u[0]) + (u[1] + u[2]));
    }
    return !wrong && zero == 0.0;
}

#endif
