/* What acts on particles from outside, as the ledger books it: walls, the axis of symmetry, what
 * holds bodies, pistons that keep their velocity whatever pushes back, strikers that stop, and ends
 * that keep all their state; gravity. */
#include <assert.h>
#include <stdio.h>
#include <string.h>

#include "sph/scheme.h"

/* Refuses options of a contact that only the solver mpm has. */
static void refuse_contact(struct findings *findings, int c)
{
    const struct simulation_case *input = findings->input;
    const struct contact_input *contact = case_contact(input, c);
    const char *key = contact->friction > 0.0          ? "friction"
                      : contact->touch >= 0            ? "touch"
                      : contact->normal != NORMAL_MEAN ? "normal"
                                                       : NULL;
    char path[128];
    if (!key)
        return;
    snprintf(path, sizeof path, "%.100s.%s", input->contacts.names[c], key);

    finding_add(findings, FINDING_WRONG, "contacts", path,
                "not available with the solver sph, where bodies slip or stick; use mpm");
}

void sph_refuse(const struct simulation *simulation, struct findings *findings)
{
    problem_refuse_gas_keys(simulation->problem, findings);
    for (int c = 0; c < findings->input->contacts.count; c++)
        refuse_contact(findings, c);
}

/* The fields of a step of DT, or of a part of it; gravity acts where particles are AHEAD of time n.
 */
struct act {
    const struct sph_fields *fields;
    double dt, ahead;
};

/* The images behind the axis push as walls do; a particle sees those of the nearer of axis and
 * wall. */
static void book_of_axis(const struct simulation *simulation, const struct act *act,
                         struct ledger *ledger, int32_t i, struct vec3 *push)
{
    const struct particles *p = act->fields->particles;
    double radius = p->position[i][0], gap = simulation->problem->images.high[0] - radius;
    double pull = act->fields->rates.hoop_pull[i];
    if (!(gap < radius)) {
        pull += push->x;
        push->x = 0.0;
    }
    ledger_book(ledger, LEDGER_AXIS, 0.0, vec3_make(act->dt * p->mass[i] * pull, 0.0, 0.0),
                vector_at(p->position[i]), 0.0);
}

/* The work of a slip wall at rest is zero, and so is that of the hoop stress on the total energy.
 */
static void book_images(const struct simulation *simulation, const struct particles *p,
                        const void *of, int32_t i, struct ledger *ledger)
{
    const struct act *act = of;
    struct vec3 push = vector_at(act->fields->rates.wall[i]);
    if (act->fields->rates.hoop_pull)
        book_of_axis(simulation, act, ledger, i, &push);
    if (push.x != 0.0 || push.y != 0.0 || push.z != 0.0)
        ledger_book(ledger, LEDGER_WALLS, 0.0, vec3_scale(act->dt * p->mass[i], push),
                    vector_at(p->position[i]), 0.0);
}

void sph_book_walls(struct simulation *simulation, const struct sph_fields *f, double dt)
{
    act_on_particles(simulation, f->particles, NULL, book_images, &(struct act){f, dt, 0.0});
}

/* Replaces particle I by its image in the mirror across AXIS at PLACE. */
static void reflect_particle(const struct particles *p, int32_t i, int axis, double place)
{
    static const int shear[3][2] = {{3, 5}, {3, 4}, {4, 5}}; /* xy, yz, zx of those with the axis */
    assert(axis >= 0 && axis < 3);
    p->position[i][axis] = 2.0 * place - p->position[i][axis];
    p->velocity[i][axis] = -p->velocity[i][axis];
    for (int k = 0; k < 2; k++)
        p->deviator[i][shear[axis][k]] = -p->deviator[i][shear[axis][k]];
}

/* Books the momentum at the old position as outgoing and at the new one as incoming, so that the
 * angular momentum closes too. */
static void return_stray(const struct simulation *simulation, const struct particles *p,
                         const void *of, int32_t i, struct ledger *ledger)
{
    (void)of;
    if (body_is_frozen(simulation, p->body[i]) || body_is_prescribed(simulation, p->body[i]))
        return;
    for (int axis = 0; axis < simulation->problem->dimension; axis++) {
        const double x = p->position[i][axis], low = simulation->problem->images.low[axis],
                     high = simulation->problem->images.high[axis];
        if (!(x < low || x > high)) /* nearly all, and all where there is no wall */
            continue;
        if (images_repeat(&simulation->problem->images, axis))
            continue;
        const bool at_axis = sph_axisymmetric(simulation) && axis == 0 && x < low;
        const enum ledger_cause cause = at_axis ? LEDGER_AXIS : LEDGER_WALLS;
        ledger_book(ledger, cause, 0.0, vec3_scale(-p->mass[i], vector_at(p->velocity[i])),
                    vector_at(p->position[i]), 0.0);
        reflect_particle(p, i, axis, x < low ? low : high);
        ledger_book(ledger, cause, 0.0, vec3_scale(p->mass[i], vector_at(p->velocity[i])),
                    vector_at(p->position[i]), 0.0);
    }
}

void sph_return_strays(struct simulation *simulation, const struct particles *particles)
{
    act_on_particles(simulation, particles, NULL, return_stray, NULL);
}

/* Particles of frozen bodies get no rates: they move as they are. */
static void freeze_particle(const struct simulation *simulation, const struct particles *p,
                            const void *of, int32_t i, struct ledger *ledger)
{
    (void)simulation;
    const struct act *act = of;
    const struct sph_fields *f = act->fields;
    const double dt = act->dt;
    const struct pair_rates *rates = &f->rates;
    struct vec3 impulse = vec3_scale(-dt * p->mass[i], vector_at(rates->acceleration[i]));
    double heat = rates->power[i] + (f->heat_rate ? f->heat_rate[i] : 0.0);
    double work = vec3_dot(impulse, vector_at(p->velocity[i]));
    ledger_book(ledger, LEDGER_PISTONS, 0.0, impulse, vector_at(p->position[i]),
                work - dt * p->mass[i] * heat);
    memset(rates->acceleration[i], 0, sizeof *rates->acceleration);
    memset(rates->strain_rate[i], 0, sizeof *rates->strain_rate);
    memset(rates->spin[i], 0, sizeof *rates->spin);
    rates->power[i] = 0.0;
    if (rates->drift)
        memset(rates->drift[i], 0, sizeof *rates->drift);
    if (f->heat_rate)
        f->heat_rate[i] = 0.0;
    if (f->density_rate)
        f->density_rate[i] = 0.0;
    if (f->packing)
        f->packing[i][PACKING_MEAN] = 0.0;
    if (f->volume)
        memset(f->volume[i], 0, sizeof *f->volume);
}

static void hold_particle(const struct simulation *simulation, const struct particles *p,
                          const void *of, int32_t i, struct ledger *ledger)
{
    (void)simulation;
    const struct act *act = of;
    const struct pair_rates *rates = &act->fields->rates;
    double *a = rates->acceleration[i];
    struct vec3 impulse = vec3_scale(-act->dt * p->mass[i], vector_at(a));
    ledger_book(ledger, LEDGER_PISTONS, 0.0, impulse, vector_at(p->position[i]),
                vec3_dot(impulse, vector_at(p->velocity[i])));
    for (int axis = 0; axis < 3; axis++) {
        a[axis] = 0.0;
        if (rates->drift)
            rates->drift[i][axis] = 0.0;
    }
}

void sph_hold_bodies(struct simulation *simulation, const struct sph_fields *f, double dt)
{
    const struct act act = {f, dt, 0.0};
    act_on_particles(simulation, f->particles, body_is_frozen, freeze_particle, &act);
    act_on_particles(simulation, f->particles, body_is_prescribed, hold_particle, &act);
}

/* Its work goes with the mean velocity of the step, so that free fall keeps its energy to rounding.
 */
static void pull_particle(const struct simulation *simulation, const struct particles *p,
                          const void *of, int32_t i, struct ledger *ledger)
{
    const struct act *act = of;
    double *a = act->fields->rates.acceleration[i];
    for (int axis = 0; axis < 3; axis++)
        a[axis] += simulation->problem->gravity[axis];
    const struct vec3 u = vector_at(p->velocity[i]);
    const struct vec3 impulse =
        vec3_scale(act->dt * p->mass[i], vector_at(simulation->problem->gravity));
    ledger_book(ledger, LEDGER_GRAVITY, 0.0, impulse,
                vec3_add(vector_at(p->position[i]), vec3_scale(act->ahead, u)),
                vec3_dot(impulse, vec3_add(u, vec3_scale(act->ahead, vector_at(a)))));
}

void sph_add_gravity(struct simulation *simulation, const struct sph_fields *f, double dt,
                     double ahead)
{
    act_on_particles(simulation, f->particles, body_is_heavy, pull_particle,
                     &(struct act){f, dt, ahead});
}
