/* What happens to a particle on its own: its state from the strain of the step. Source: Cui, dissertation (2014), (2-18)
 * to (2-21); the energy of a step as the public codes of the same group have it. */
#include "mpm/mpm_internal.h"

struct point_fields {
    double *sound, *viscosity;
};

void mpm_evaluate(struct simulation *simulation)
{
    struct particles *p = &simulation->particles;
    double *sound = particles_field(p, "sound_long");
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++) {
        struct point point = {.density = p->density[i], .energy = p->energy[i]};
        point.history[0] = p->plastic_strain[i];
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

static double contract(struct sym3 a, struct sym3 b)
{
    return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz +
           2.0 * (a.xy * b.xy + a.yz * b.yz + a.zx * b.zx);
}

/* Brings particle I to the next level; false when its new state is impossible. */
static bool update_point(const struct mpm *mpm, struct particles *p,
                         const struct material *material, const struct point_fields *f, int32_t i,
                         double dt, const double *rate)
{
    const struct mpm_parameters *parameters = &mpm->parameters;
    double *s = p->deviator[i];
    const struct sym3 strain = {rate[0], rate[1], rate[2], rate[3], rate[4], rate[5]};
    struct vec3 spin = vec3_make(rate[RATE_SPIN], rate[RATE_SPIN + 1], rate[RATE_SPIN + 2]);
    const double divergence = sym3_trace(strain);
    const double density = p->density[i] / (1.0 + dt * divergence);
    const struct sym3 before = {s[0], s[1], s[2], s[3], s[4], s[5]};
    struct point point = {
        .density = density, .deviator = before, .history = {p->plastic_strain[i]}};
    /* in compression only (2.8 of the source's companion codes) */
    const double edge = mpm->edge,
                 viscosity =
                     divergence < 0.0
                         ? density * edge *
                               (parameters->viscosity_quadratic * edge * square(divergence) -
                                parameters->viscosity_linear * f->sound[i] * divergence)
                         : 0.0;
    const double v0 = 1.0 / p->density[i], v1 = 1.0 / density, swelling = v1 - v0;
    double energy = p->energy[i] - 0.5 * swelling * (p->pressure[i] + f->viscosity[i] + viscosity);
    if (material_has_strength(material)) {
        if (parameters->rotation == MPM_JAUMANN) {
            point.deviator = jaumann_turn(before, vec3_scale(dt, spin));
            spin = vec3_make(0.0, 0.0, 0.0);
        }
        strength_step(&material->strength, dt, strain, spin, &point.deviator, point.history);
        energy += 0.25 * dt * (v0 + v1) * contract(sym3_add(before, point.deviator), strain);
    }
    /* p = p* + p_e (e - e*), e = e* - dv p/2 */
    const struct eos_value value = eos_evaluate(&material->eos, density, energy, point.history);
    point.energy = energy - 0.5 * swelling * value.pressure / (1.0 + 0.5 * swelling * value.dp_de);
    const struct response r = material_evaluate(material, &point);
    p->density[i] = point.density;
    p->energy[i] = point.energy;
    p->pressure[i] = point.pressure;
    p->plastic_strain[i] = point.history[0];
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
        if (!update_point(mpm, p, &simulation->material[p->material[i]], &f, i, dt,
                          rate + (size_t)k * RATE_STRIDE) &&
            (impossible < 0 || p->id[i] < p->id[impossible]))
            impossible = i;
    }
    return impossible;
}
