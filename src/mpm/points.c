/* What happens to a particle on its own: its state from the strain of the step. Source: Cui, dissertation (2014), (2-18)
 * to (2-21); the energy of a step as the public codes of the same group have it. */
#include "material/batch.h"
#include "mpm/mpm_internal.h"
#include "mpm/point_kernel.h"

void mpm_evaluate(const struct mpm *mpm, struct simulation *simulation)
{
    struct particles *p = &simulation->particles;
    double *sound = mpm_fields_of(mpm, simulation).sound_long;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++) {
        struct point point = {.density = p->density[i], .energy = p->energy[i]};
        particle_load_history(p, i, point.history);
        struct response r = material_evaluate(&simulation->material[p->material[i]], &point);
        p->pressure[i] = point.pressure;
        sound[i] = r.sound_long;
    }
}

/* Brings particle I, number K of its bin, of a material that batches do not know to the next level. LENGTH is its size at
 * the start. */
static void update_point(const struct point_loop *loop, const struct simulation *simulation,
                         const struct material *material, int32_t i, int32_t k, double length)
{
    const struct particles *p = &simulation->particles;
    double *s = p->deviator[i], rate[RATES];
    for (int c = 0; c < RATES; c++)
        rate[c] = loop->rate[(size_t)c * loop->rate_stride + (size_t)k];
    struct motion motion = {
        .dt = loop->dt,
        .time = simulation->time + loop->dt,
        .length = length,
        .strain_rate = {rate[0], rate[1], rate[2], rate[3], rate[4], rate[5]},
        .spin = vec3_make(rate[RATE_SPIN], rate[RATE_SPIN + 1], rate[RATE_SPIN + 2])};
    const double divergence = rate[0] + rate[1] + rate[2];
    motion.density = p->density[i] / (1.0 + loop->dt * divergence); /* (2-20) */
    struct point point = {.density = p->density[i],
                          .energy = p->energy[i],
                          .pressure = p->pressure[i],
                          .deviator = {s[0], s[1], s[2], s[3], s[4], s[5]}};
    particle_load_history(p, i, point.history);
    /* an explosive that has yet to burn has no viscosity */
    const bool inert = material_burns(material) && point.history[HISTORY_burnt] == 0.0;
    const double viscosity =
        inert ? 0.0 : point_viscosity(loop, motion.density, loop->sound[i], divergence);
    motion.viscous_pressure = 0.5 * (loop->viscosity[i] + viscosity);
    if (loop->jaumann) {
        point.deviator = jaumann_turn(point.deviator, vec3_scale(loop->dt, motion.spin));
        motion.spin = vec3_make(0.0, 0.0, 0.0);
    }
    const struct response r = material_step_by_work(material, &point, &motion);
    p->density[i] = point.density;
    p->energy[i] = point.energy;
    p->pressure[i] = point.pressure;
    particle_keep_history(p, i, point.history);
    loop->viscosity[i] = viscosity;
    loop->sound[i] = r.sound_long;
    s[0] = point.deviator.xx;
    s[1] = point.deviator.yy;
    s[2] = point.deviator.zz;
    s[3] = point.deviator.xy;
    s[4] = point.deviator.yz;
    s[5] = point.deviator.zx;
}

void mpm_keep_before_walls(const struct simulation *simulation, double x[3])
{
    for (int axis = 0; axis < simulation->dimension; axis++) {
        const double low = simulation->mirrors.low[axis], high = simulation->mirrors.high[axis];
        if (x[axis] < low)
            x[axis] = 2.0 * low - x[axis];
        if (x[axis] > high)
            x[axis] = 2.0 * high - x[axis];
    }
}

static struct point_loop loop_of(const struct mpm *mpm, const struct simulation *simulation,
                                 double dt, const double *rate)
{
    const struct particles *p = &simulation->particles;
    const struct mpm_fields fields = mpm_fields_of(mpm, simulation);
    return (struct point_loop){.density = p->density,
                               .energy = p->energy,
                               .pressure = p->pressure,
                               .deviator = p->deviator,
                               .plastic_strain = p->plastic_strain,
                               .plastic_heating = p->history[HISTORY_plastic_heating],
                               .sound = fields.sound_long,
                               .viscosity = fields.viscosity,
                               .position = (const double(*)[3])p->position,
                               .velocity = (const double(*)[3])p->velocity,
                               .rate = rate,
                               .rate_stride = (size_t)mpm->rate_capacity,
                               .dt = dt,
                               .edge = mpm->edge,
                               .viscosity_quadratic = mpm->parameters.viscosity_quadratic,
                               .viscosity_linear = mpm->parameters.viscosity_linear,
                               .jaumann = mpm->parameters.rotation == MPM_JAUMANN};
}

static bool is_possible(const struct particles *p, const struct point_loop *loop, int32_t i)
{
    const double *x = p->position[i], *u = p->velocity[i];
    return p->density[i] > 0.0 && loop->sound[i] > 0.0 &&
           isfinite(p->density[i] + p->pressure[i] + p->energy[i]) &&
           isfinite(x[0] + x[1] + x[2]) && isfinite(u[0] + u[1] + u[2]);
}

/* Particles BEGIN .. END - 1 of the bin at LIST, which are of one material; false when one has become impossible. */
static bool update_run(const struct mpm *mpm, const struct simulation *simulation,
                       const struct point_loop *loop, const int32_t *list, int32_t begin,
                       int32_t end)
{
    const struct particles *p = &simulation->particles;
    const struct material *material = &simulation->material[p->material[list[begin]]];
    if (batch_takes(material))
        return point_loop_run(loop, material, list, begin, end);
    bool possible = true;
    for (int32_t k = begin; k < end; k++) {
        const int32_t i = list[k];
        update_point(loop, simulation, material, i, k,
                     2.0 * mpm->half_size[p->body[i]] * mpm->edge);
        possible &= is_possible(p, loop, i);
    }
    return possible;
}

int32_t mpm_update_points(const struct mpm *mpm, struct simulation *simulation,
                          const struct layer *layer, int32_t bin, double dt, const double *rate)
{
    struct particles *p = &simulation->particles;
    const struct point_loop loop = loop_of(mpm, simulation, dt, rate);
    const int32_t *list = layer->bins.list + layer->bins.bin[bin].first;
    const int32_t count = layer->bins.bin[bin].cell[BLOCK_CELLS];
    bool possible = true;
    int32_t impossible = -1;
    if (simulation->input->walls.count > 0 || simulation->geometry == GEOMETRY_AXISYMMETRIC)
        for (int32_t k = 0; k < count; k++)
            mpm_keep_before_walls(simulation, p->position[list[k]]);
    for (int32_t begin = 0, end; begin < count; begin = end) {
        const uint16_t material = p->material[list[begin]];
        for (end = begin + 1; end < count && p->material[list[end]] == material;)
            end++;
        possible &= update_run(mpm, simulation, &loop, list, begin, end);
    }
    for (int32_t k = 0; k < count && !possible; k++)
        if (!is_possible(p, &loop, list[k]) &&
            (impossible < 0 || p->id[list[k]] < p->id[impossible]))
            impossible = list[k];
    return impossible;
}
