/* Forecasts by a pilot: the case with coarser particles and cells, run without output. Steps are
 * proportional to 1/h, updates to 1/h^(dimension + 1). See forecast.h. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/memory.h"
#include "model/solver.h"
#include "run/forecast.h"

/* INPUT with coarser particles and cells; its own are the bodies and the parameters of the
 * solver. */
struct coarse {
    struct simulation_case input;
    struct estimate estimate;
    double factor;
};

/* How many first steps are run at both resolutions: more of few members, whose clock is coarse; in
 * at most so many seconds each and with at most so many members. The costs of their updates differ
 * by no more than a factor. */
enum { FIRST_STEPS = 20, FIRST_STEPS_MOST = 100 };
static const double FIRST_UPDATES = 1e5, FIRST_SECONDS = 1.0, FIRST_MEMBERS = 2e6,
                    FIRST_FACTOR = 1.5;

static void free_coarse(struct coarse *coarse)
{
    estimate_free(&coarse->estimate);
    free(coarse->input.bodies.items);
    free(coarse->input.solver.value);
}

static void *copy_of(const void *from, size_t size)
{
    void *copy = memory_allocate(size + 1);
    if (copy)
        memcpy(copy, from, size);
    return copy;
}

/* Nothing is recorded, measured or judged. */
static void leave_out_output(struct simulation_case *input)
{
    input->output = (struct output_input){.every = NAN, .history = input->run.until};
    input->checks = input->fits = input->probes = input->profiles = (struct named_map){0};
    input->expected = (struct named_map){0};
    input->run.energy_drift = 0.0;
}

/* Makes *COARSE of INPUT with lengths of particles and cells times FACTOR. False where that is no
 * case that runs: faces that lie on no plane of the coarser grid, bodies without a particle. */
static bool make_coarse(const struct simulation_case *input, double factor, struct coarse *coarse)
{
    const struct solver_class *class = input->solver.choice->thing;
    *coarse = (struct coarse){.input = *input, .factor = factor};
    coarse->input.bodies.items =
        copy_of(input->bodies.items, (size_t)input->bodies.count * sizeof(struct body_input));
    coarse->input.solver.value = copy_of(input->solver.value, input->solver.choice->size);
    bool made = coarse->input.bodies.items && coarse->input.solver.value;
    if (made) {
        coarse->input.resolution *= factor;
        for (int i = 0; i < input->bodies.count; i++)
            case_body(&coarse->input, i)->resolution *= factor;
        if (class->coarsen)
            class->coarsen(coarse->input.solver.value, factor);
        coarse->input.run.max_steps = (int64_t)ceil((double)input->run.max_steps / factor);
        leave_out_output(&coarse->input);
        struct error *error = estimate_run(&coarse->input, &coarse->estimate);
        made = !error;
        error_free(error);
    }
    if (!made)
        free_coarse(coarse);
    return made;
}

static double members_of(const struct estimate *estimate)
{
    return (double)estimate->particles + estimate->cells;
}

/* The steps of a pilot that was stopped with RESULT, had it gone on: as forecast_steps has it, from
 * the last step on. */
static double steps_left(const struct coarse *coarse, const struct run_result *result)
{
    static const double PIECE = 0.01;
    const struct simulation_case *input = &coarse->input;
    const double left = input->run.until - result->time;
    if (result->finished || !(left > 0.0))
        return 0.0;
    const double all = forecast_steps(input, &coarse->estimate, result->time);
    const double later = forecast_steps(input, &coarse->estimate, result->time + PIECE * left);
    const double step = PIECE * left / (all - later);
    return all * step / result->step;
}

/* What follows for the whole run from RESULT of the pilot COARSE. */
static void extrapolate(const struct simulation_case *input, const struct estimate *estimate,
                        const struct coarse *coarse, const struct run_result *result, int ranks,
                        struct forecast *forecast)
{
    const double done = (double)result->steps, most = (double)input->run.max_steps;
    double steps = done + steps_left(coarse, result);
    steps *= coarse->factor;
    if (most > 0.0)
        steps = minimum(steps, most);
    const double members = members_of(estimate) / members_of(&coarse->estimate);
    const double stepping = (double)result->updates / result->undisturbed_rate;
    forecast->seconds =
        stepping * (steps / done) * members * ranks * result->threads / forecast->threads;
    forecast->steps = ceil(steps);
    forecast->rate = RATE_OF_PILOT;
    forecast->pilot_resolution = coarse->input.resolution;
}

/* Updates a second of the first steps of INPUT, of MEMBERS; NAN where it takes none. */
static double first_rate(const struct simulation_case *input, double members,
                         const struct run_options *options)
{
    struct run_options few = *options;
    struct run_result result;
    few.max_steps =
        (int64_t)maximum(FIRST_STEPS, minimum(FIRST_STEPS_MOST, FIRST_UPDATES / members));
    few.max_seconds = minimum(few.max_seconds, FIRST_SECONDS);
    struct error *error = run_case(input, &few, &result);
    const double rate = !error && result.updates > 0 ? result.undisturbed_rate : NAN;
    error_free(error);
    run_result_free(&result);
    return rate;
}

/* How much longer an update takes than in the pilot COARSE, by the first steps of both: the thin
 * bodies of a pilot have fewer neighbours. */
static double cost_of_update(const struct simulation_case *input, const struct estimate *estimate,
                             const struct coarse *coarse, const struct run_options *options)
{
    struct simulation_case plain = *input;
    leave_out_output(&plain);
    if (members_of(estimate) > FIRST_MEMBERS)
        return 1.0;
    const double cost = first_rate(&coarse->input, members_of(&coarse->estimate), options) /
                        first_rate(&plain, members_of(estimate), options);
    return isnan(cost) ? 1.0 : minimum(FIRST_FACTOR, maximum(1.0 / FIRST_FACTOR, cost));
}

/* Runs COARSE; true where it came to its end. */
static bool run_pilot(const struct simulation_case *input, const struct estimate *estimate,
                      const struct coarse *coarse, const struct run_options *options,
                      struct forecast *forecast)
{
    struct run_result result;
    struct error *error = run_case(&coarse->input, options, &result);
    const bool finished = !error && result.finished;
    if (result.steps > 0 && result.updates > 0 && result.step > 0.0) {
        extrapolate(input, estimate, coarse, &result, options->ranks->size, forecast);
        forecast->seconds *= cost_of_update(input, estimate, coarse, options);
    }
    error_free(error);
    run_result_free(&result);
    return finished;
}

/* Runs the first of COUNT pilots with FACTORS that is a case; false where it did not come to its
 * end, or there was none. */
static bool try_factors(const struct simulation_case *input, const struct estimate *estimate,
                        const double *factors, int count, const struct run_options *options,
                        struct forecast *forecast)
{
    struct coarse coarse;
    int tried = 0;
    while (tried < count && !make_coarse(input, factors[tried], &coarse))
        tried++;
    if (tried == count)
        return false;
    const bool finished = run_pilot(input, estimate, &coarse, options, forecast);
    free_coarse(&coarse);
    return finished;
}

void forecast_by_pilot(const struct simulation_case *input, const struct estimate *estimate,
                       const struct run_options *options, double seconds, struct forecast *forecast)
{
    static const double half[] = {2.0, 1.5, 2.5, 3.0}, quarter[] = {4.0, 5.0, 6.0, 3.0, 8.0},
                        whole[] = {1.0};
    const struct ranks alone = ranks_alone(), *ranks = options->ranks ? options->ranks : &alone;
    struct run_options running = {.ranks = ranks,
                                  .force = true,
                                  .threads = options->threads,
                                  .fixed_threads = options->fixed_threads,
                                  .max_seconds = seconds,
                                  .stop = options->stop,
                                  .alarm = options->alarm};
    const double expected =
        ranks_maximum(ranks, forecast->seconds) / pow(2.0, (double)input->dimension + 1.0);
    const double began = clock_seconds();
    bool finished = expected < 2.0 * seconds &&
                    try_factors(input, estimate, half, COUNT_OF(half), &running, forecast);
    if (!finished)
        finished = try_factors(input, estimate, quarter, COUNT_OF(quarter), &running, forecast);
    if (!finished && forecast->rate != RATE_OF_PILOT)
        try_factors(input, estimate, whole, COUNT_OF(whole), &running, forecast);
    forecast->pilot_seconds = clock_seconds() - began;
    forecast->output = forecast_output(input, estimate, forecast);
}
