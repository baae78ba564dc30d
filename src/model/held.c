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

bool any_body(const struct simulation *simulation, bool (*is)(const struct simulation *, int))
{
    for (int body = 0; body < simulation->input->bodies.count; body++)
        if (is(simulation, body))
            return true;
    return false;
}

void stop_bodies(struct simulation *simulation)
{
    struct particles *p = &simulation->particles;
    if (!any_body(simulation, body_stands))
        return;
#pragma omp parallel num_threads(simulation->threads)
    {
        struct ledger own = {0};
#pragma omp for schedule(static)
        for (int32_t i = 0; i < p->count; i++) {
            double *u = p->velocity[i];
            const double *x = p->position[i];
            if (!body_stands(simulation, p->body[i]))
                continue;
            const struct vec3 velocity = vec3_make(u[0], u[1], u[2]);
            ledger_book(&own, LEDGER_PISTONS, 0.0, vec3_scale(-p->mass[i], velocity),
                        vec3_make(x[0], x[1], x[2]),
                        -0.5 * p->mass[i] * vec3_dot(velocity, velocity));
            u[0] = u[1] = u[2] = 0.0;
        }
#pragma omp critical(bolide_stop)
        ledger_join(&simulation->ledger, &own);
    }
}
