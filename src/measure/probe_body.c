/* body: how a body moves as a whole. Its centre of mass c, the velocity of that, U; about the
 * centre the angular momentum L = sum m (x - c) x (u - U), the angular velocity w that gives it, J
 * w = L with J the moment of inertia, and the kinetic energy sum m (u - U)^2/2. Sums are exact. */
#include <stdio.h>
#include <string.h>

#include "measure/probes.h"
#include "measure/spin.h"

const struct parameter probe_body_table[] = {
    PARAMETER(TEXT, struct probe_body, name, REQUIRED, "name of the body"),
    PARAMETER_END,
};

static const char axis_names[] = "xyz";

/* A column for each of COUNT axes from FIRST. */
static void add_vector(struct probe *probe, const char *name, const char *unit, int first,
                       int count)
{
    for (int i = first; i < first + count; i++) {
        char text[64];
        snprintf(text, sizeof text, "%s.%c", name, axis_names[i]);
        probe_add_column(probe, text, unit);
    }
}

static struct error *prepare(struct probe *probe, const struct simulation *simulation,
                             const struct population *population)
{
    const struct probe_body *body = probe->input->probe.value;
    const struct named_map *bodies = &simulation->problem->input->bodies;
    const int dimension = simulation->problem->dimension, first = spin_first(dimension);
    const char *joule =
        ledger_unit(LEDGER_ENERGY, simulation->problem->dimension, simulation->problem->geometry);
    (void)population;
    probe->selection.body = case_find_body(simulation->problem->input, body->name);
    if (probe->selection.body < 0) {
        const char *near =
            nearest_name(body->name, (const char *const *)bodies->names, bodies->count);
        return probe_error(probe, simulation, "body", "there is no body \"%s\"%s%s%s", body->name,
                           near ? " (did you mean \"" : "", near ? near : "", near ? "\"?)" : "");
    }
    probe_add_column(
        probe, "mass",
        ledger_unit(LEDGER_MASS, simulation->problem->dimension, simulation->problem->geometry));
    add_vector(probe, "centre", "m", 0, dimension);
    add_vector(probe, "velocity", "m/s", 0, dimension);
    add_vector(probe, "angular_momentum",
               ledger_unit(LEDGER_ANGULAR_Z, simulation->problem->dimension,
                           simulation->problem->geometry),
               first, spin_count(dimension));
    add_vector(probe, "angular_velocity", "rad/s", first, spin_count(dimension));
    probe_add_column(probe, "kinetic_energy", joule);
    probe_add_column(probe, "kinetic_energy_about_centre", joule);
    probe_add_column(probe, "internal_energy", joule);
    add_vector(probe, "low", "m", 0, dimension);
    add_vector(probe, "high", "m", 0, dimension);
    add_vector(probe, "width", "m", 0, dimension);
    return NULL;
}

/* Sums about the origin, and with them known about the centre. */
enum { MASS, PLACE, MOTION = PLACE + 3, KINETIC = MOTION + 3, INTERNAL, WHOLE_SUMS };
enum { ANGULAR, INERTIA = ANGULAR + 3, SPREAD = INERTIA + 6, CENTRE_SUMS };

static void add_to(struct exact_sum *sums, double scale, struct vec3 value)
{
    exact_sum_add(&sums[0], scale * value.x);
    exact_sum_add(&sums[1], scale * value.y);
    exact_sum_add(&sums[2], scale * value.z);
}

static struct vec3 mean_of(const struct exact_sum *sums, double mass)
{
    return vec3_make(exact_sum_value(&sums[0]) / mass, exact_sum_value(&sums[1]) / mass,
                     exact_sum_value(&sums[2]) / mass);
}

/* What a row says. */
struct body_motion {
    double mass, kinetic, internal, spread;
    struct vec3 centre, velocity, angular, low, high;
    struct sym3 inertia;
};

static void sum_whole(const struct ranks *ranks, const struct population *particles, int body,
                      struct body_motion *motion)
{
    struct exact_sum sums[WHOLE_SUMS] = {0};
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int32_t i = 0; i < particles->count; i++) {
        if (particles->body[i] != body)
            continue;
        struct vec3 u = vector_at(particles->velocity[i]);
        double mass = particles->mass[i];
        exact_sum_add(&sums[MASS], mass);
        add_to(&sums[PLACE], mass, vector_at(particles->position[i]));
        add_to(&sums[MOTION], mass, u);
        exact_sum_add(&sums[KINETIC], 0.5 * mass * vec3_dot(u, u));
        exact_sum_add(&sums[INTERNAL], mass * particles->energy[i]);
        for (int k = 0; k < 3; k++) {
            low[k] = minimum(low[k], particles->position[i][k]);
            high[k] = maximum(high[k], particles->position[i][k]);
        }
    }
    ranks_sum_exact(ranks, sums, WHOLE_SUMS);
    for (int k = 0; k < 3; k++) {
        low[k] = ranks_minimum(ranks, low[k]);
        high[k] = ranks_maximum(ranks, high[k]);
    }
    motion->mass = exact_sum_value(&sums[MASS]);
    motion->centre = mean_of(&sums[PLACE], motion->mass);
    motion->velocity = mean_of(&sums[MOTION], motion->mass);
    motion->kinetic = exact_sum_value(&sums[KINETIC]);
    motion->internal = exact_sum_value(&sums[INTERNAL]);
    motion->low = vector_at(low);
    motion->high = vector_at(high);
}

static void add_inertia(struct exact_sum *sums, double mass, struct vec3 x)
{
    exact_sum_add(&sums[0], mass * (x.y * x.y + x.z * x.z));
    exact_sum_add(&sums[1], mass * (x.z * x.z + x.x * x.x));
    exact_sum_add(&sums[2], mass * (x.x * x.x + x.y * x.y));
    exact_sum_add(&sums[3], -mass * x.x * x.y);
    exact_sum_add(&sums[4], -mass * x.y * x.z);
    exact_sum_add(&sums[5], -mass * x.z * x.x);
}

static void sum_about_centre(const struct ranks *ranks, const struct population *particles,
                             int body, struct body_motion *motion)
{
    struct exact_sum sums[CENTRE_SUMS] = {0};
    double inertia[6];
    for (int32_t i = 0; i < particles->count; i++) {
        if (particles->body[i] != body)
            continue;
        struct vec3 x = vec3_sub(vector_at(particles->position[i]), motion->centre);
        struct vec3 u = vec3_sub(vector_at(particles->velocity[i]), motion->velocity);
        double mass = particles->mass[i];
        add_to(&sums[ANGULAR], mass, vec3_cross(x, u));
        add_inertia(&sums[INERTIA], mass, x);
        exact_sum_add(&sums[SPREAD], 0.5 * mass * vec3_dot(u, u));
    }
    ranks_sum_exact(ranks, sums, CENTRE_SUMS);
    for (int k = 0; k < 6; k++)
        inertia[k] = exact_sum_value(&sums[INERTIA + k]);
    motion->angular = mean_of(&sums[ANGULAR], 1.0);
    memcpy(&motion->inertia, inertia, sizeof inertia);
    motion->spread = exact_sum_value(&sums[SPREAD]);
}

static double *put_vector(double *row, struct vec3 value, int first, int count)
{
    const double at[3] = {value.x, value.y, value.z};
    memcpy(row, at + first, (size_t)count * sizeof *row);
    return row + count;
}

static struct error *sample(struct probe *probe, const struct simulation *simulation,
                            const struct population *population, double *row)
{
    const int dimension = simulation->problem->dimension, first = spin_first(dimension);
    struct body_motion motion;
    sum_whole(simulation->ranks, population, probe->selection.body, &motion);
    sum_about_centre(simulation->ranks, population, probe->selection.body, &motion);
    *row++ = motion.mass;
    row = put_vector(row, motion.centre, 0, dimension);
    row = put_vector(row, motion.velocity, 0, dimension);
    row = put_vector(row, motion.angular, first, spin_count(dimension));
    row = put_vector(row, spin_of(motion.inertia, motion.angular, dimension), first,
                     spin_count(dimension));
    *row++ = motion.kinetic;
    *row++ = motion.spread;
    *row++ = motion.internal;
    row = put_vector(row, motion.low, 0, dimension);
    row = put_vector(row, motion.high, 0, dimension);
    put_vector(row, vec3_sub(motion.high, motion.low), 0, dimension);
    return NULL;
}

const struct probe_class probe_body = {0, prepare, sample};
