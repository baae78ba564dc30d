/* What acts on particles from outside, as the ledger books it: walls, the axis of symmetry, what holds bodies,
 * pistons that keep their velocity whatever pushes back, strikers that stop, and ends that keep all their state; gravity. */
#include <stdio.h>
#include <string.h>

#include "sph/sph_internal.h"

/* What of a contact only the solver mpm knows. */
static struct error *refuse_contact(const struct simulation_case *input, int c)
{
    const struct contact_input *contact = case_contact(input, c);
    const char *key = contact->friction > 0.0          ? "friction"
                      : contact->touch != TOUCH_NODES  ? "touch"
                      : contact->normal != NORMAL_MEAN ? "normal"
                                                       : NULL;
    char path[128];
    if (!key)
        return NULL;
    snprintf(path, sizeof path, "%.100s.%s", input->contacts.names[c], key);
    return input_error(input, "contacts", path,
                       "the solver sph knows none: bodies slip or stick where they meet; use mpm");
}

struct error *sph_refuse(const struct simulation *simulation)
{
    static const char text[] = "the solver sph has none: use mpm";
    const struct simulation_case *input = simulation->input;
    struct error *error = NULL;
    for (int c = 0; c < input->contacts.count; c++)
        error = error_join(error, refuse_contact(input, c));
    if (input->loads.count)
        error = error_join(error, input_error(input, "loads", NULL, "%s", text));
    if (input->outflows.count)
        error = error_join(error, input_error(input, "outflows", NULL, "%s", text));
    return error;
}

static struct vec3 vector_of(const double v[3]) { return vec3_make(v[0], v[1], v[2]); }

/* The images behind the axis push as walls do; a particle sees those of the nearer of axis and wall. */
static void book_of_axis(const struct simulation *simulation, const struct sph_fields *f,
                         struct ledger *ledger, double dt, int32_t i, struct vec3 *push)
{
    const struct particles *p = &simulation->particles;
    double radius = p->position[i][0], gap = simulation->mirrors.high[0] - radius;
    double pull = f->rates.hoop_pull[i];
    if (!(gap < radius)) {
        pull += push->x;
        push->x = 0.0;
    }
    ledger_book(ledger, LEDGER_AXIS, 0.0, vec3_make(dt * p->mass[i] * pull, 0.0, 0.0),
                vector_of(p->position[i]), 0.0);
}

/* The work of a slip wall at rest is zero, and so is that of the hoop stress on the total energy. */
void sph_book_walls(struct simulation *simulation, const struct sph_fields *f, double dt)
{
    const struct particles *p = &simulation->particles;
#pragma omp parallel num_threads(simulation->threads)
    {
        struct ledger own = {0};
#pragma omp for schedule(static)
        for (int32_t i = 0; i < p->count; i++) {
            struct vec3 push = vector_of(f->rates.wall[i]);
            if (f->rates.hoop_pull)
                book_of_axis(simulation, f, &own, dt, i, &push);
            if (push.x != 0.0 || push.y != 0.0 || push.z != 0.0)
                ledger_book(&own, LEDGER_WALLS, 0.0, vec3_scale(dt * p->mass[i], push),
                            vector_of(p->position[i]), 0.0);
        }
#pragma omp critical(bolide_sph_walls)
        ledger_join(&simulation->ledger, &own);
    }
}

/* Calls ACT for every particle whose body IS says so of; each thread books in a ledger of its own. */
typedef void act_on(struct simulation *simulation, const struct sph_fields *f, double dt, int32_t i,
                    struct ledger *ledger);
static void act_where(struct simulation *simulation, const struct sph_fields *f, double dt,
                      bool (*is)(const struct simulation *, int), act_on *act)
{
    const struct particles *p = &simulation->particles;
    if (!any_body(simulation, is))
        return;
#pragma omp parallel num_threads(simulation->threads)
    {
        struct ledger own = {0};
#pragma omp for schedule(static)
        for (int32_t i = 0; i < p->count; i++)
            if (is(simulation, p->body[i]))
                act(simulation, f, dt, i, &own);
#pragma omp critical(bolide_sph_bodies)
        ledger_join(&simulation->ledger, &own);
    }
}

/* Particles of frozen bodies get no rates: they move as they are. */
static void freeze_particle(struct simulation *simulation, const struct sph_fields *f, double dt,
                            int32_t i, struct ledger *ledger)
{
    const struct particles *p = &simulation->particles;
    const struct pair_rates *rates = &f->rates;
    struct vec3 impulse = vec3_scale(-dt * p->mass[i], vector_of(rates->acceleration[i]));
    double heat = rates->power[i] + (f->heat_rate ? f->heat_rate[i] : 0.0);
    double work = vec3_dot(impulse, vector_of(p->velocity[i]));
    ledger_book(ledger, LEDGER_PISTONS, 0.0, impulse, vector_of(p->position[i]),
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
        f->packing[i][1] = 0.0;
}

static void hold_particle(struct simulation *simulation, const struct sph_fields *f, double dt,
                          int32_t i, struct ledger *ledger)
{
    const struct particles *p = &simulation->particles;
    double *a = f->rates.acceleration[i];
    struct vec3 impulse = vec3_scale(-dt * p->mass[i], vector_of(a));
    ledger_book(ledger, LEDGER_PISTONS, 0.0, impulse, vector_of(p->position[i]),
                vec3_dot(impulse, vector_of(p->velocity[i])));
    for (int axis = 0; axis < 3; axis++) {
        a[axis] = 0.0;
        if (f->rates.drift)
            f->rates.drift[i][axis] = 0.0;
    }
}

void sph_hold_bodies(struct simulation *simulation, const struct sph_fields *f, double dt)
{
    act_where(simulation, f, dt, body_is_frozen, freeze_particle);
    act_where(simulation, f, dt, body_is_held, hold_particle);
}

/* Its work goes with the mean velocity of the step, so that free fall keeps its energy to rounding. */
void sph_add_gravity(struct simulation *simulation, const struct sph_fields *f, double dt,
                     double ahead)
{
    const struct particles *p = &simulation->particles;
    const struct vec3 gravity = vector_of(simulation->gravity);
    if (!simulation_has_gravity(simulation))
        return;
#pragma omp parallel num_threads(simulation->threads)
    {
        struct ledger own = {0};
#pragma omp for schedule(static)
        for (int32_t i = 0; i < p->count; i++) {
            if (body_is_held(simulation, p->body[i]))
                continue;
            double *a = f->rates.acceleration[i];
            for (int axis = 0; axis < 3; axis++)
                a[axis] += simulation->gravity[axis];
            const struct vec3 u = vector_of(p->velocity[i]);
            const struct vec3 impulse = vec3_scale(dt * p->mass[i], gravity);
            ledger_book(&own, LEDGER_GRAVITY, 0.0, impulse,
                        vec3_add(vector_of(p->position[i]), vec3_scale(ahead, u)),
                        vec3_dot(impulse, vec3_add(u, vec3_scale(ahead, vector_of(a)))));
        }
#pragma omp critical(bolide_sph_gravity)
        ledger_join(&simulation->ledger, &own);
    }
}
