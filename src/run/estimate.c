/* Estimates of a run from its case alone; see estimate.h. */
#include "run/estimate.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "material/any.h"
#include "material/material.h"
#include "model/solver.h"
#include "run/run.h"

/* Updates a second that one thread is expected to make. */
static const double expected_rate = 1e6;

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
    double step = class->step(input->solver.value, (int)input->dimension, material, &point,
                              of->summary.diameter);
    if (index == 0 || step < estimate->step) {
        estimate->step = step;
        estimate->step_body = index;
    }
    estimate->particles += of->summary.particles;
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
    const bool axisymmetric = input->geometry == GEOMETRY_AXISYMMETRIC;
    double wall[3][2] = {{NAN, NAN}, {NAN, NAN}, {NAN, NAN}}, volume = 1.0;
    for (int i = 0; i < input->walls.count; i++)
        wall[case_wall(input, i)->axis][case_wall(input, i)->side] = case_wall(input, i)->at;
    assert(input->dimension <= 3);
    for (int axis = 0; axis < input->dimension; axis++) {
        if (wall[axis][WALL_LOW] < wall[axis][WALL_HIGH]) {
            low[axis] = wall[axis][WALL_LOW];
            high[axis] = wall[axis][WALL_HIGH];
        }
        volume *= axis == 0 && axisymmetric ? 0.5 * (square(high[0]) - square(low[0]))
                                            : high[axis] - low[axis];
    }
    estimate->box.low = vec3_make(low[0], low[1], low[2]);
    estimate->box.high = vec3_make(high[0], high[1], high[2]);
    estimate->mean_density = estimate->mass / volume;
}

struct error *estimate_run(const struct simulation_case *input, int threads,
                           struct estimate *estimate)
{
    int bodies = input->bodies.count;
    memset(estimate, 0, sizeof *estimate);
    estimate->bodies = bodies;
    estimate->body = memory_allocate(((size_t)bodies + 1) * sizeof *estimate->body);
    estimate->material_mass =
        memory_allocate(((size_t)input->materials.count + 1) * sizeof *estimate->material_mass);
    struct body_summary *summary = memory_allocate(((size_t)bodies + 1) * sizeof *summary);
    struct error *error = estimate->body && estimate->material_mass && summary
                              ? generate_summary(input, summary)
                              : error_new(ERROR_SYSTEM, "out of memory");
    error = error_join(error, run_validate(input));
    for (int i = 0; i < bodies && !error; i++) {
        estimate->body[i].summary = summary[i];
        add_body(input, i, estimate);
    }
    free(summary);
    if (error) {
        estimate_free(estimate);
        return error;
    }
    find_mean_density(input, estimate);
    const struct solver_class *class = input->solver.choice->thing;
    estimate->bytes =
        (double)estimate->particles *
        (class->bytes(input->solver.value, (int)input->dimension) + history_bytes(input));
    double steps = ceil(input->run.until / estimate->step);
    int64_t most = input->run.max_steps;
    estimate->steps = most > 0 && steps > (double)most ? most : (int64_t)minimum(steps, 1e18);
    estimate->seconds = (double)estimate->steps * (double)estimate->particles /
                        (expected_rate * maximum(threads, 1));
    return NULL;
}

void estimate_free(struct estimate *estimate)
{
    free(estimate->body);
    free(estimate->material_mass);
    memset(estimate, 0, sizeof *estimate);
}
