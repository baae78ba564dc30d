/* What happens to a particle on its own: its state from the strain of the step. Source: Cui, dissertation (2014), (2-18)
 * to (2-21); the energy of a step as the public codes of the same group have it. */
#include "mpm/mpm_internal.h"

struct point_fields {
    double *sound, *viscosity;
};

/* What a step is for a particle; LENGTH is its size at the start. */
struct advance {
    double dt, time, length; /* time at the end */
};

void mpm_evaluate(struct simulation *simulation)
{
    struct particles *p = &simulation->particles;
    double *sound = particles_field(p, "sound_long");
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++) {
        struct point point = {.density = p->density[i], .energy = p->energy[i]};
        particle_load_history(p, i, point.history);
        struct response r = material_evaluate(&simulation->material[p->material[i]], &point);
        p->pressure[i] = point.pressure;
        sound[i] = r.sound_long;
    }
}

/* S + S Om^T + Om S for Om_ij = w_ij dt of the SPIN w (2-21). */
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

/* Brings particle I to the next level; false when its new state is impossible. */
static bool update_point(const struct mpm *mpm, struct particles *p,
                         const struct material *material, const struct point_fields *f, int32_t i,
                         struct advance step, const double *rate)
{
    const struct mpm_parameters *parameters = &mpm->parameters;
    const double dt = step.dt;
    double *s = p->deviator[i];
    struct motion motion = {
        .dt = dt,
        .time = step.time,
        .length = step.length,
        .strain_rate = {rate[0], rate[1], rate[2], rate[3], rate[4], rate[5]},
        .spin = vec3_make(rate[RATE_SPIN], rate[RATE_SPIN + 1], rate[RATE_SPIN + 2])};
    const double divergence = sym3_trace(motion.strain_rate), edge = mpm->edge;
    motion.density = p->density[i] / (1.0 + dt * divergence); /* (2-20) */
    struct point point = {.density = p->density[i],
                          .energy = p->energy[i],
                          .pressure = p->pressure[i],
                          .deviator = {s[0], s[1], s[2], s[3], s[4], s[5]}};
    particle_load_history(p, i, point.history);
    /* q = rho h (b2 h d^2 - b1 c d) in compression, but not of an explosive that has yet to burn */
    double viscosity = 0.0;
    const bool inert = material_burns(material) && point.history[HISTORY_burnt] == 0.0;
    if (divergence < 0.0 && !inert)
        viscosity = motion.density * edge *
                    (parameters->viscosity_quadratic * edge * square(divergence) -
                     parameters->viscosity_linear * f->sound[i] * divergence);
    motion.viscous_pressure = 0.5 * (f->viscosity[i] + viscosity);
    if (parameters->rotation == MPM_JAUMANN) {
        point.deviator = jaumann_turn(point.deviator, vec3_scale(dt, motion.spin));
        motion.spin = vec3_make(0.0, 0.0, 0.0);
    }
    const struct response r = material_step_by_work(material, &point, &motion);
    p->density[i] = point.density;
    p->energy[i] = point.energy;
    p->pressure[i] = point.pressure;
    particle_keep_history(p, i, point.history);
    f->viscosity[i] = viscosity;
    f->sound[i] = r.sound_long;
    s[0] = point.deviator.xx;
    s[1] = point.deviator.yy;
    s[2] = point.deviator.zz;
    s[3] = point.deviator.xy;
    s[4] = point.deviator.yz;
    s[5] = point.deviator.zx;
    const double *x = p->position[i], *u = p->velocity[i];
    return point.density > 0.0 && isfinite(point.density) && isfinite(point.pressure) &&
           isfinite(point.energy) && isfinite(x[0] + x[1] + x[2]) && isfinite(u[0] + u[1] + u[2]) &&
           !(r.status & POINT_NO_SOUND);
}

/* Rounding must not take a particle through a wall. */
static void keep_before_walls(const struct simulation *simulation, double x[3])
{
    for (int axis = 0; axis < simulation->dimension; axis++) {
        const double low = simulation->mirrors.low[axis], high = simulation->mirrors.high[axis];
        if (x[axis] < low)
            x[axis] = 2.0 * low - x[axis];
        if (x[axis] > high)
            x[axis] = 2.0 * high - x[axis];
    }
}

int32_t mpm_update_points(const struct mpm *mpm, struct simulation *simulation,
                          const struct layer *layer, int32_t bin, double dt, const double *rate)
{
    struct particles *p = &simulation->particles;
    const struct point_fields f = {particles_field(p, "sound_long"),
                                   particles_field(p, "viscosity")};
    const int32_t *list = layer->bins.list + layer->bins.bin[bin].first;
    const int32_t count = layer->bins.bin[bin].cell[BLOCK_CELLS];
    int32_t impossible = -1;
    for (int32_t k = 0; k < count; k++) {
        const int32_t i = list[k];
        keep_before_walls(simulation, p->position[i]);
        const struct advance step = {dt, simulation->time + dt,
                                     2.0 * mpm->half_size[p->body[i]] * mpm->edge};
        if (!update_point(mpm, p, &simulation->material[p->material[i]], &f, i, step,
                          rate + (size_t)k * RATE_STRIDE) &&
            (impossible < 0 || p->id[i] < p->id[impossible]))
            impossible = i;
    }
    return impossible;
}
