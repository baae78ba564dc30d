/* Estimates of a run from its case alone; see estimate.h. */
#include "run/estimate.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "model/solver.h"

/* Updates a second that one thread is expected to make, and the Courant number of a solver that has
 * none among its parameters. */
static const double expected_rate = 1e6, usual_courant = 0.4;

/* The solver's parameter `courant`. */
static double courant_of(const struct one_of *solver)
{
    const struct parameter *p = solver->choice->table;
    for (; p && !PARAMETER_IS_END(p); p++)
        if (p->kind == PARAMETER_NUMBER && !strcmp(p->key, "courant"))
            return *(const double *)(const void *)((const char *)solver->value + p->offset);
    return usual_courant;
}

static void add_body(const struct simulation_case *input, int index, double courant,
                     struct estimate *estimate)
{
    const struct body_input *body = case_body(input, index);
    struct body_estimate *of = &estimate->body[index];
    struct point point = body->start;
    struct response response =
        material_evaluate(&case_material(input, body->material_index)->material, &point);
    of->sound_long = response.sound_long;
    of->sound_shear = response.sound_shear;
    double step = courant * of->summary.diameter / response.sound_long;
    if (index == 0 || step < estimate->step) {
        estimate->step = step;
        estimate->step_body = index;
    }
    estimate->particles += of->summary.particles;
    estimate->mass += of->summary.mass;
}

struct error *estimate_run(const struct simulation_case *input, int threads,
                           struct estimate *estimate)
{
    int bodies = input->bodies.count;
    memset(estimate, 0, sizeof *estimate);
    estimate->bodies = bodies;
    estimate->body = memory_allocate(((size_t)bodies + 1) * sizeof *estimate->body);
    struct body_summary *summary = memory_allocate(((size_t)bodies + 1) * sizeof *summary);
    struct error *error = estimate->body && summary ? generate_summary(input, summary)
                                                    : error_new(ERROR_SYSTEM, "out of memory");
    for (int i = 0; i < bodies && !error; i++) {
        estimate->body[i].summary = summary[i];
        add_body(input, i, courant_of(&input->solver), estimate);
    }
    free(summary);
    if (error) {
        estimate_free(estimate);
        return error;
    }
    const struct solver_class *class = input->solver.choice->thing;
    estimate->bytes =
        (double)estimate->particles * class->bytes(input->solver.value, (int)input->dimension);
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
    memset(estimate, 0, sizeof *estimate);
}
