/* What happens to a particle on its own: its state from the strain of the step. Source: Cui,
 * dissertation (2014), (2-18) to (2-21); the energy of a step as the public codes of the same group
 * have it. */
#include <string.h>

#include "material/any.h"
#include "material/material.h"
#include "mpm/mpm_internal.h"
#include "mpm/point_body.h"

void mpm_evaluate(const struct mpm *mpm, struct simulation *simulation)
{
    struct particles *p = mpm->particles;
    const struct mpm_fields fields = mpm_fields_of(mpm);
    const double *energy = fields.at_state ? fields.at_state : p->energy;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++) {
        struct point point = {.density = p->density[i], .energy = energy[i]};
        particle_load_history(p, i, point.history);
        struct response r =
            any_material_evaluate(&simulation->problem->material[p->material[i]], &point);
        p->pressure[i] = point.pressure;
        fields.sound_long[i] = r.sound_long;
    }
}

void mpm_keep_before_walls(const struct simulation *simulation, double x[3])
{
    for (int axis = 0; axis < simulation->problem->dimension; axis++) {
        const struct face *low = &simulation->problem->place.face[axis][0], *high = low + 1;
        if (face_closes(low) && x[axis] < low->at)
            x[axis] = 2.0 * low->at - x[axis];
        if (face_closes(high) && x[axis] > high->at)
            x[axis] = 2.0 * high->at - x[axis];
    }
}

static struct point_loop loop_of(const struct mpm *mpm, const struct simulation *simulation,
                                 double dt, const double *rate)
{
    const struct particles *p = mpm->particles;
    const struct mpm_fields fields = mpm_fields_of(mpm);
    const double linear = mpm->parameters.viscosity_linear;
    struct point_loop loop = {.density = p->density,
                              .energy = p->energy,
                              .at_state = fields.at_state,
                              .pressure = p->pressure,
                              .deviator = p->deviator,
                              .sound = fields.sound_long,
                              .viscosity = fields.viscosity,
                              .shock = fields.shock,
                              .position = (const double(*)[3])p->position,
                              .velocity = (const double(*)[3])p->velocity,
                              .damage_gradient = fields.damage_gradient,
                              .rate = rate,
                              .rate_stride = (size_t)mpm->rate_capacity,
                              .dt = dt,
                              .time = simulation->time + dt,
                              .edge = mpm->edge,
                              .body = p->body,
                              .half_size = mpm->half_size,
                              .viscosity_quadratic = mpm->parameters.viscosity_quadratic,
                              .viscosity_linear = isnan(linear) ? 0.06 : linear,
                              .viscosity_shock = isnan(linear) ? 0.14 : 0.0,
                              .viscosity_unresolved = mpm->parameters.viscosity_unresolved,
                              .jaumann = mpm->parameters.rotation == MPM_JAUMANN};
    memcpy(loop.history, p->history, sizeof loop.history);
    return loop;
}

static bool is_possible(const struct particles *p, const struct point_loop *loop, int32_t i)
{
    const double *x = p->position[i], *u = p->velocity[i];
    return p->density[i] > 0.0 && loop->sound[i] > 0.0 &&
           isfinite(p->density[i] + p->pressure[i] + p->energy[i]) &&
           isfinite(x[0] + x[1] + x[2]) && isfinite(u[0] + u[1] + u[2]);
}

/* A gas that expands into vacuum converts all of its internal energy to kinetic energy, and a
 * little more: the work of the stresses uses the energy of half a step earlier. Such a particle
 * gets a small positive pressure in its state, and the deficit stays in its conserved energy. */
static void restore_overdrawn(const struct mpm *mpm, const struct simulation *simulation,
                              const struct point_loop *loop, int32_t i)
{
    const double little = 0.1, least = 1e-3, *u = loop->velocity[i];
    const double motion = 0.5 * (square(u[0]) + square(u[1]) + square(u[2]));
    struct particles *p = mpm->particles;
    const struct material *material = &simulation->problem->material[p->material[i]];
    struct point point = {.density = p->density[i]};
    if (!loop->at_state || !(point.density > 0.0))
        return;
    particle_load_history(p, i, point.history);
    const struct eos_value value =
        eos_evaluate(&material->eos, point.density, loop->at_state[i], point.history);
    const double deficit = -value.pressure / value.dp_de;
    if (!(deficit > 0.0 && deficit < little * motion))
        return;
    point.energy = loop->at_state[i] + (1.0 + least) * deficit;
    const struct response r = any_material_evaluate(material, &point);
    loop->at_state[i] = point.energy;
    loop->pressure[i] = point.pressure;
    loop->sound[i] = r.sound_long;
}

/* Particles BEGIN .. END - 1 of the bin at LIST, which are of one material; false when one has
 * become impossible. */
static bool update_run(const struct mpm *mpm, const struct simulation *simulation,
                       const struct point_loop *loop, const int32_t *list, int32_t begin,
                       int32_t end)
{
    const struct particles *p = mpm->particles;
    const struct material *material = &simulation->problem->material[p->material[list[begin]]];
    if (batch_takes(material))
        return point_loop_run(loop, material, list, begin, end);
    bool possible = true;
    for (int32_t k = begin; k < end; k++) {
        const int32_t i = list[k];
        point_advance(loop, material, i, k, 2.0 * mpm->half_size[p->body[i]] * mpm->edge);
        possible &= is_possible(p, loop, i);
    }
    return possible;
}

int32_t mpm_update_points(const struct mpm *mpm, struct simulation *simulation,
                          const struct layer *layer, int32_t bin, double dt, const double *rate)
{
    struct particles *p = mpm->particles;
    const struct point_loop loop = loop_of(mpm, simulation, dt, rate);
    const int32_t *list = layer->bins.list + layer->bins.bin[bin].first;
    const int32_t count = layer->bins.bin[bin].cell[BLOCK_CELLS];
    bool possible = true;
    int32_t impossible = -1;
    if (place_has_face(&simulation->problem->place, face_closes))
        for (int32_t k = 0; k < count; k++)
            mpm_keep_before_walls(simulation, p->position[list[k]]);
    for (int32_t begin = 0, end; begin < count; begin = end) {
        const uint16_t material = p->material[list[begin]];
        for (end = begin + 1; end < count && p->material[list[end]] == material;)
            end++;
        possible &= update_run(mpm, simulation, &loop, list, begin, end);
    }
    for (int32_t k = 0; k < count && !possible; k++) {
        if (!is_possible(p, &loop, list[k]))
            restore_overdrawn(mpm, simulation, &loop, list[k]);
        if (!is_possible(p, &loop, list[k]) &&
            (impossible < 0 || p->id[list[k]] < p->id[impossible]))
            impossible = list[k];
    }
    return impossible;
}
