/* Heun's second-order step of SPH with corrected gradients: to n + 1 with the rates of level n,
 * then from level n with the mean of these and the rates found there; each stage is a step of the
 * material, return to yield included. */
#include <string.h>

#include "base/clock.h"
#include "material/any.h"
#include "material/material.h"
#include "sph/hllc/hllc.h"

static struct hllc_derivative derivative_of(const struct hllc_fields *f, int32_t i)
{
    const struct pair_rates *rates = &f->sph.rates;
    struct hllc_derivative d = {.density = f->sph.density_rate[i], .power = rates->power[i]};
    memcpy(d.acceleration, rates->acceleration[i], sizeof d.acceleration);
    memcpy(d.strain_rate, rates->strain_rate[i], sizeof d.strain_rate);
    memcpy(d.spin, rates->spin[i], sizeof d.spin);
    return d;
}

static struct hllc_derivative mean_of(struct hllc_derivative a, struct hllc_derivative b)
{
    a.density = 0.5 * (a.density + b.density);
    a.power = 0.5 * (a.power + b.power);
    for (int k = 0; k < 3; k++) {
        a.acceleration[k] = 0.5 * (a.acceleration[k] + b.acceleration[k]);
        a.spin[k] = 0.5 * (a.spin[k] + b.spin[k]);
    }
    for (int k = 0; k < 6; k++)
        a.strain_rate[k] = 0.5 * (a.strain_rate[k] + b.strain_rate[k]);
    return a;
}

static void keep_level(const struct particles *p, struct hllc_level *level, int32_t i)
{
    level->density = p->density[i];
    level->energy = p->energy[i];
    level->plastic_strain = p->plastic_strain[i];
    memcpy(level->position, p->position[i], sizeof level->position);
    memcpy(level->velocity, p->velocity[i], sizeof level->velocity);
    memcpy(level->deviator, p->deviator[i], sizeof level->deviator);
}

/* One particle of one stage: from level n by RATE, moved with VELOCITY. */
struct stage {
    const struct hllc_fields *fields;
    struct hllc_derivative rate;
    double velocity[3], dt;
};

/* False when the new state of particle I is impossible. PLAIN: its MATERIAL remembers no more than
 * its plastic strain. */
BOLIDE_INLINE bool step_from_level(const struct simulation *simulation,
                                   const struct material *material, bool plain,
                                   const struct stage *stage, int32_t i)
{
    const struct hllc_fields *f = stage->fields;
    const struct hllc_derivative *rate = &stage->rate;
    const double dt = stage->dt;
    const struct particles *p = f->sph.particles;
    const struct hllc_level *n = &f->own.level[i];
    for (int axis = 0; axis < simulation->problem->dimension; axis++) {
        p->position[i][axis] = n->position[axis] + dt * stage->velocity[axis];
        p->velocity[i][axis] = n->velocity[axis] + dt * rate->acceleration[axis];
    }
    const double *gradient = f->sph.damage_gradient;
    struct motion motion = {.dt = dt,
                            .damage_gradient = gradient ? gradient[i] : 0.0,
                            .density = n->density + dt * rate->density,
                            .energy = n->energy + dt * rate->power,
                            .spin = {rate->spin[0], rate->spin[1], rate->spin[2]},
                            .time = simulation->time + dt,
                            .length = f->sph.diameter[i]};
    memcpy(&motion.strain_rate, rate->strain_rate, sizeof motion.strain_rate);
    struct point point = {.density = n->density, .history = {n->plastic_strain}};
    if (!plain && f->own.level_history)
        memcpy(point.history, f->own.level_history[i], sizeof point.history);
    memcpy(&point.deviator, n->deviator, sizeof point.deviator);
    struct response r = plain ? material_step(material, &point, &motion)
                              : any_material_step(material, &point, &motion);
    p->density[i] = point.density;
    p->energy[i] = point.energy;
    p->pressure[i] = point.pressure;
    p->plastic_strain[i] = point.history[HISTORY_plastic_strain];
    if (!plain && f->own.level_history)
        particle_keep_history(p, i, point.history);
    memcpy(p->deviator[i], &point.deviator, sizeof point.deviator);
    f->sph.sound_long[i] = r.sound_long;
    f->sph.sound_shear[i] = r.sound_shear;
    f->own.dp_drho[i] = r.dp_drho;
    f->own.dp_de[i] = r.dp_de;
    double speed = fabs(p->velocity[i][0]) + fabs(p->velocity[i][1]) + fabs(p->velocity[i][2]);
    return point.density > 0.0 && isfinite(point.density) && isfinite(point.pressure) &&
           isfinite(point.energy) && isfinite(speed) && !(r.status & POINT_NO_SOUND);
}

/* Materials of the rarer kinds, whose physics would be in the way of the others'. */
static __attribute__((noinline)) bool step_rare(const struct simulation *simulation,
                                                const struct material *material,
                                                const struct stage *stage, int32_t i)
{
    return step_from_level(simulation, material, false, stage, i);
}

static bool step_particle(const struct simulation *simulation, const struct stage *stage, int32_t i)
{
    const struct material *material =
        &simulation->problem->material[stage->fields->sph.particles->material[i]];
    if (!material_is_plain(material))
        return step_rare(simulation, material, stage, i);
    return step_from_level(simulation, material, true, stage, i);
}

/* One stage of a step of DT: what pushes from outside acts for half of it with the rates of each.
 */
static struct error *take_stage(const struct sph *sph, struct simulation *simulation,
                                const struct hllc_fields *f, bool second, double dt)
{
    const struct particles *p = f->sph.particles;
    int32_t failed = -1;
    if (f->sph.rates.wall)
        sph_book_walls(simulation, &f->sph, 0.5 * dt);
    sph_hold_bodies(simulation, &f->sph, 0.5 * dt);
    TRY(sph_add_loads(sph, simulation, &f->sph, simulation->time + (second ? 0.5 * dt : 0.0),
                      0.5 * dt));
    sph_add_gravity(simulation, &f->sph, 0.5 * dt, 0.0);
    sph_book_loads(sph, simulation, &f->sph, 0.5 * dt, 0.0);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++) {
        struct hllc_level *level = &f->own.level[i];
        const struct hllc_derivative rate = derivative_of(f, i);
        struct stage stage = {.fields = f, .dt = dt};
        if (!second) {
            keep_level(p, level, i);
            if (f->own.level_history)
                particle_load_history(p, i, f->own.level_history[i]);
            level->rate = rate;
        }
        stage.rate = mean_of(level->rate, rate);
        for (int axis = 0; axis < 3; axis++)
            stage.velocity[axis] = 0.5 * (level->velocity[axis] + p->velocity[i][axis]);
        if (!step_particle(simulation, &stage, i)) {
#pragma omp critical(bolide_hllc_failure)
            if (failed < 0 || p->id[i] < p->id[failed])
                failed = i;
        }
    }
    simulation_end_phase(simulation, PHASE_BLOCKS, "state update");
    return failed < 0 ? NULL : simulation_impossible(simulation, failed);
}

struct error *hllc_advance(struct sph *sph, struct simulation *simulation, double dt)
{
    struct hllc_fields f = hllc_fields_of(sph, simulation);
    bool rebuilt;
    TRY(ranks_agree(simulation->ranks, take_stage(sph, simulation, &f, false, dt)));
    TRY(sph_refresh_lists(sph, simulation, &rebuilt));
    f = hllc_fields_of(sph, simulation);
    hllc_find_rates(sph, simulation, &f);
    TRY(take_stage(sph, simulation, &f, true, dt));
    if (f.sph.rates.wall)
        sph_return_strays(simulation, sph->particles);
    return NULL;
}
