/* Bodies that something outside holds, and the next event of bodies and loads. */
#include "model/bodies.h"

bool body_stands(const struct simulation *simulation, int body)
{
    return simulation->time >= case_body(simulation->problem->input, body)->stop;
}

bool body_is_frozen(const struct simulation *simulation, int body)
{
    return case_body(simulation->problem->input, body)->frozen;
}

bool body_is_prescribed(const struct simulation *simulation, int body)
{
    const struct body_input *input = case_body(simulation->problem->input, body);
    return body_stands(simulation, body) || input->driven || input->frozen;
}

bool body_is_heavy(const struct simulation *simulation, int body)
{
    return problem_has_gravity(simulation->problem) && !body_is_prescribed(simulation, body);
}

bool any_body(const struct simulation *simulation, bool (*is)(const struct simulation *, int))
{
    for (int body = 0; body < simulation->problem->input->bodies.count; body++)
        if (is(simulation, body))
            return true;
    return false;
}

/* The earlier of an EVENT and one at TIME, NAN never, if that has yet to come. */
static double earlier(const struct simulation *simulation, double event, double time)
{
    return time > simulation->time && time < event ? time : event;
}

double next_event(const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    double event = INFINITY;
    for (int i = 0; i < input->bodies.count; i++) {
        event = earlier(simulation, event, case_body(input, i)->stop);
        event = earlier(simulation, event, case_body(input, i)->remove_at);
        if (case_body(input, i)->damping > 0.0)
            event = earlier(simulation, event, case_body(input, i)->damped_from);
    }
    for (int i = 0; i < input->loads.count; i++) {
        event = earlier(simulation, event, case_load(input, i)->after);
        event = earlier(simulation, event, case_load(input, i)->before);
    }
    return event;
}
