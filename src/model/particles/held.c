/* The particles of bodies that something outside holds, and what it takes to stop them. */
#include "model/particles/held.h"

#include "model/particles/population.h"
#include "particle/particles.h"

void act_on_particles(struct simulation *simulation, const struct particles *p,
                      bool (*is)(const struct simulation *, int), particle_act *act, const void *of)
{
    if (is && !any_body(simulation, is))
        return;
#pragma omp parallel num_threads(simulation->threads)
    {
        struct ledger own = {0};
#pragma omp for schedule(static)
        for (int32_t i = 0; i < p->count; i++)
            if (!is || is(simulation, p->body[i]))
                act(simulation, p, of, i, &own);
#pragma omp critical(bolide_act)
        ledger_join(&simulation->ledger, &own);
    }
}

static void stop_particle(const struct simulation *simulation, const struct particles *p,
                          const void *of, int32_t i, struct ledger *ledger)
{
    const struct vec3 velocity = vector_at(p->velocity[i]);
    (void)simulation, (void)of;
    ledger_book(ledger, LEDGER_PISTONS, 0.0, vec3_scale(-p->mass[i], velocity),
                vector_at(p->position[i]), -0.5 * p->mass[i] * vec3_dot(velocity, velocity));
    p->velocity[i][0] = p->velocity[i][1] = p->velocity[i][2] = 0.0;
}

void stop_bodies(struct simulation *simulation, const struct particles *particles)
{
    act_on_particles(simulation, particles, body_stands, stop_particle, NULL);
}

static void remove_body(struct simulation *simulation, struct particles *p, int body)
{
    for (int32_t i = 0; i < p->count; i++) {
        if (p->body[i] != body)
            continue;
        const double m = p->mass[i];
        const struct vec3 velocity = vector_at(p->velocity[i]);
        ledger_book(&simulation->ledger, LEDGER_REMOVED, -m, vec3_scale(-m, velocity),
                    vector_at(p->position[i]),
                    -m * (p->energy[i] + 0.5 * vec3_dot(velocity, velocity)));
        particles_delete(p, i);
    }
}

bool remove_bodies(struct simulation *simulation, double since)
{
    const struct simulation_case *input = simulation->problem->input;
    bool any = false;
    for (int body = 0; body < input->bodies.count; body++) {
        const double at = case_body(input, body)->remove_at;
        if (!(at > since && at <= simulation->time))
            continue;
        any = true;
        for (int k = 0; k < simulation->populations; k++)
            if (simulation->population[k].type == &particle_population)
                remove_body(simulation, particles_in(&simulation->population[k]), body);
    }
    return any;
}

int64_t body_members(const struct simulation *simulation, int body)
{
    int64_t members = 0;
    for (int k = 0; k < simulation->populations; k++) {
        if (simulation->population[k].type != &particle_population)
            continue;
        const struct particles *p = particles_in(&simulation->population[k]);
        for (int32_t i = 0; i < p->count; i++)
            members += p->body[i] == body;
    }
    return ranks_sum(simulation->ranks, members);
}

static bool body_is_damped(const struct simulation *simulation, int body)
{
    const struct body_input *input = case_body(simulation->problem->input, body);
    return input->damping > 0.0 && simulation->time > input->damped_from &&
           !body_stands(simulation, body);
}

static void damp_particle(const struct simulation *simulation, const struct particles *p,
                          const void *of, int32_t i, struct ledger *ledger)
{
    const struct body_input *body = case_body(simulation->problem->input, p->body[i]);
    const double *since = of, begin = maximum(*since, body->damped_from);
    const double kept = exp(-body->damping * (simulation->time - begin));
    const struct vec3 velocity = vector_at(p->velocity[i]);
    ledger_book(ledger, LEDGER_DAMPING, 0.0, vec3_scale((kept - 1.0) * p->mass[i], velocity),
                vector_at(p->position[i]),
                0.5 * (kept * kept - 1.0) * p->mass[i] * vec3_dot(velocity, velocity));
    for (int axis = 0; axis < 3; axis++)
        p->velocity[i][axis] *= kept;
}

void damp_bodies(struct simulation *simulation, double since)
{
    for (int k = 0; k < simulation->populations; k++)
        if (simulation->population[k].type == &particle_population)
            act_on_particles(simulation, particles_in(&simulation->population[k]), body_is_damped,
                             damp_particle, &since);
}

/* A body, and its new velocity after a step; NAN: the component stays. */
struct drive {
    int body;
    double dt, velocity[3];
};

/* The place in the middle of the step is where the impulse has the moment that the particle
 * gains. */
static void drive_particle(const struct simulation *simulation, const struct particles *p,
                           const void *of, int32_t i, struct ledger *ledger)
{
    (void)simulation;
    const struct drive *drive = of;
    const struct vec3 before = vector_at(p->velocity[i]), place = vector_at(p->position[i]);
    if (p->body[i] != drive->body)
        return;
    for (int axis = 0; axis < 3; axis++)
        if (!isnan(drive->velocity[axis])) {
            const double change = drive->velocity[axis] - p->velocity[i][axis];
            p->position[i][axis] += 0.5 * drive->dt * change;
            p->velocity[i][axis] = drive->velocity[axis];
        }
    const struct vec3 after = vector_at(p->velocity[i]);
    const struct vec3 impulse = vec3_scale(p->mass[i], vec3_sub(after, before));
    ledger_book(ledger, LEDGER_PISTONS, 0.0, impulse,
                vec3_sub(place, vec3_scale(0.5 * drive->dt, before)),
                0.5 * vec3_dot(impulse, vec3_add(before, after)));
}

static bool follows_time(const struct simulation *simulation, int body)
{
    const struct field_list *velocity = &case_body(simulation->problem->input, body)->velocity;
    for (int k = 0; k < velocity->count; k++)
        if (field_is_of_time(&velocity->at[k]))
            return !body_stands(simulation, body);
    return false;
}

struct error *drive_bodies(struct simulation *simulation, const struct particles *particles,
                           double dt)
{
    static const char *const keys[] = {"velocity.1", "velocity.2", "velocity.3"};
    const struct simulation_case *input = simulation->problem->input;
    for (int b = 0; b < input->bodies.count; b++) {
        struct drive drive = {b, dt, {NAN, NAN, NAN}};
        const struct field_list *velocity = &case_body(input, b)->velocity;
        if (!follows_time(simulation, b))
            continue;
        assert(velocity->count <= 3);
        for (int k = 0; k < velocity->count; k++)
            if (field_is_of_time(&velocity->at[k]))
                TRY(simulation_value_at(simulation, simulation->time + dt, &velocity->at[k],
                                        input->bodies.names[b], keys[k], &drive.velocity[k]));
        act_on_particles(simulation, particles, follows_time, drive_particle, &drive);
    }
    return NULL;
}
