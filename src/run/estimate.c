/* Estimates of a run from its case alone; see estimate.h. */
#include "run/estimate.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "material/any.h"
#include "material/material.h"
#include "model/place.h"
#include "model/solver.h"
#include "run/run.h"

static void add_body(const struct simulation_case *input, int index, struct estimate *estimate)
{
    const struct solver_class *class = input->solver.choice->thing;
    const struct body_input *body = case_body(input, index);
    struct body_estimate *of = &estimate->body[index];
    struct point point = of->summary.fastest;
    const struct material *material = case_material(input, body->material_index)->material;
    struct response response = any_material_evaluate(material, &point);
    of->sound_long = response.sound_long;
    of->sound_shear = response.sound_shear;
    double step = class->step(input->solver.value, input, material, &point, of->summary.diameter);
    of->step = step;
    if (index == 0 || step < estimate->step) {
        estimate->step = step;
        estimate->step_body = index;
    }
    estimate->particles += of->summary.counted;
    estimate->mass += of->summary.mass;
    estimate->material_mass[body->material_index] += of->summary.mass;
}

/* Of a particle: what the materials of the case remember. */
static double history_bytes(const struct simulation_case *input)
{
    unsigned needed = 0;
    double bytes = 0.0;
    for (int m = 0; m < input->materials.count; m++)
        needed |= material_history(case_material(input, m)->material);
    for (int slot = 0; slot < POINT_HISTORY; slot++)
        bytes += needed & 1u << slot ? sizeof(double) : 0.0;
    return bytes;
}

/* A mesostructure between walls stands for an infinite one: there the walls bound it. */
static void find_mean_density(const struct simulation_case *input, struct estimate *estimate)
{
    struct bounds box = body_bounds(input, 0);
    for (int i = 1; i < input->bodies.count; i++)
        box = bounds_around(box, body_bounds(input, i));
    double low[3] = {box.low.x, box.low.y, box.low.z};
    double high[3] = {box.high.x, box.high.y, box.high.z};
    const double power = 1.0 + geometry_power(input->geometry);
    double volume = 1.0;
    const struct place whole = place_whole(input);
    assert(input->dimension <= 3);
    for (int axis = 0; axis < input->dimension; axis++) {
        const struct face *ends = whole.face[axis];
        const bool axial = axis == 0 && power > 1.0;
        if (!axial && face_closes(&ends[0]) && face_closes(&ends[1])) {
            low[axis] = ends[0].at;
            high[axis] = ends[1].at;
        }
        volume *=
            axis == 0 ? (pow(high[0], power) - pow(low[0], power)) / power : high[axis] - low[axis];
    }
    estimate->box.low = vec3_make(low[0], low[1], low[2]);
    estimate->box.high = vec3_make(high[0], high[1], high[2]);
    estimate->mean_density = estimate->mass / volume;
}

/* How fast BODY runs into a wall, m/s. */
static double speed_into_wall(const struct simulation_case *input, struct vec3 velocity)
{
    const double component[3] = {velocity.x, velocity.y, velocity.z};
    double speed = 0.0;
    const struct place whole = place_whole(input);
    for (int axis = 0; axis < 3; axis++)
        for (int side = axis == 0 && geometry_power(input->geometry) > 0; side < 2; side++)
            if (face_closes(&whole.face[axis][side]))
                speed = maximum(speed, component[axis] * (side ? 1.0 : -1.0));
    return speed;
}

/* The fastest approach of two bodies, or of one to a wall, over the lower of their speeds of
 * sound. */
static double fastest_impact(const struct simulation_case *input, const struct estimate *estimate)
{
    double fastest = 0.0;
    for (int a = 0; a < input->bodies.count; a++) {
        const struct body_estimate *one = &estimate->body[a];
        fastest = maximum(fastest, speed_into_wall(input, one->velocity) / one->sound_long);
        for (int b = 0; b < a; b++) {
            const struct body_estimate *other = &estimate->body[b];
            const struct vec3 apart = vec3_sub(other->middle, one->middle),
                              moves = vec3_sub(other->velocity, one->velocity);
            if (vec3_dot(apart, moves) < 0.0)
                fastest = maximum(fastest, sqrt(vec3_dot(moves, moves)) /
                                               minimum(one->sound_long, other->sound_long));
        }
    }
    return fastest;
}

/* As estimate_run, with FOUND, the mistakes that are known already, taken. */
static struct error *estimate_with(const struct simulation_case *input, struct error *found,
                                   struct estimate *estimate)
{
    int bodies = input->bodies.count;
    memset(estimate, 0, sizeof *estimate);
    estimate->bodies = bodies;
    estimate->body = memory_allocate(((size_t)bodies + 1) * sizeof *estimate->body);
    estimate->material_mass =
        memory_allocate(((size_t)input->materials.count + 1) * sizeof *estimate->material_mass);
    struct body_summary *summary = memory_allocate(((size_t)bodies + 1) * sizeof *summary);
    const struct solver_class *class = input->solver.choice->thing;
    struct counted counted = {.cells = 0.0};
    if (class->count)
        class->count(input->solver.value, input, &counted);
    struct error *error = estimate->body && estimate->material_mass && summary
                              ? generate_summary(input, class->count ? &counted.box : NULL, summary)
                              : out_of_memory();
    error = error_join(error, found);
    for (int i = 0; i < bodies && !error; i++) {
        estimate->body[i].summary = summary[i];
        estimate->body[i].middle = body_middle(input, i);
        estimate->body[i].velocity = body_velocity(input, i);
        add_body(input, i, estimate);
    }
    if (counted.part > 0.0)
        estimate->particles = (int64_t)((double)estimate->particles * counted.part + 0.5);
    free(summary);
    if (error) {
        estimate_free(estimate);
        return error;
    }
    find_mean_density(input, estimate);
    estimate->cells = counted.cells;
    estimate->bytes =
        (double)estimate->particles *
            (class->bytes(input->solver.value, (int)input->dimension) + history_bytes(input)) +
        counted.cells * counted.bytes;
    estimate->impact = fastest_impact(input, estimate);
    return NULL;
}

struct error *estimate_run(const struct simulation_case *input, struct estimate *estimate)
{
    return estimate_with(input, run_validate(input), estimate);
}

struct error *estimate_size(const struct simulation_case *input, struct estimate *estimate)
{
    return estimate_with(input, NULL, estimate);
}

void estimate_free(struct estimate *estimate)
{
    free(estimate->body);
    free(estimate->material_mass);
    memset(estimate, 0, sizeof *estimate);
}
