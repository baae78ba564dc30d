/* Bodies that something outside holds, and what it takes to stop them. */
#include "model/held.h"

bool body_stands(const struct simulation *simulation, int body)
{
    return simulation->time >= case_body(simulation->input, body)->stop;
}

bool body_is_frozen(const struct simulation *simulation, int body)
{
    return case_body(simulation->input, body)->frozen;
}

bool body_is_held(const struct simulation *simulation, int body)
{
    const struct body_input *input = case_body(simulation->input, body);
    return body_stands(simulation, body) || input->driven || input->frozen;
}

bool body_is_heavy(const struct simulation *simulation, int body)
{
    return simulation_has_gravity(simulation) && !body_is_held(simulation, body);
}

bool any_body(const struct simulation *simulation, bool (*is)(const struct simulation *, int))
{
    for (int body = 0; body < simulation->input->bodies.count; body++)
        if (is(simulation, body))
            return true;
    return false;
}

void act_on_particles(struct simulation *simulation, bool (*is)(const struct simulation *, int),
                      particle_act *act, const void *of)
{
    const struct particles *p = &simulation->particles;
    if (is && !any_body(simulation, is))
        return;
#pragma omp parallel num_threads(simulation->threads)
    {
        struct ledger own = {0};
#pragma omp for schedule(static)
        for (int32_t i = 0; i < p->count; i++)
            if (!is || is(simulation, p->body[i]))
                act(simulation, of, i, &own);
#pragma omp critical(bolide_act)
        ledger_join(&simulation->ledger, &own);
    }
}

static void stop_particle(struct simulation *simulation, const void *of, int32_t i,
                          struct ledger *ledger)
{
    const struct particles *p = &simulation->particles;
    const struct vec3 velocity = vector_at(p->velocity[i]);
    (void)of;
    ledger_book(ledger, LEDGER_PISTONS, 0.0, vec3_scale(-p->mass[i], velocity),
                vector_at(p->position[i]), -0.5 * p->mass[i] * vec3_dot(velocity, velocity));
    p->velocity[i][0] = p->velocity[i][1] = p->velocity[i][2] = 0.0;
}

void stop_bodies(struct simulation *simulation)
{
    act_on_particles(simulation, body_stands, stop_particle, NULL);
}
