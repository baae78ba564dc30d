/* The speed of whole steps of the material point method: particle updates a second of processor time in one thread, the
 * best step and the mean, and what share each phase takes.
 *
 * Usage: bench_mpm [STEPS [CASE.yaml [PATH=VALUE]...]] */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "model/generate.h"
#include "model/solver.h"
#include "run/catalogue.h"

#define CASES BOLIDE_SOURCE_DIR "/bench/cases/"

static void stop_on(struct error *error)
{
    for (int i = 0; error && i < error_count(error); i++)
        fprintf(stderr, "%s\n", error_message(error, i));
    if (error)
        exit(error_kind(error));
}

static double processor_seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }

static void measure(const char *path, int steps, char **settings, int count)
{
    const char *const library[] = {BOLIDE_SOURCE_DIR "/materials"};
    const struct case_options options = {.settings = (const char *const *)settings,
                                         .setting_count = count,
                                         .library_paths = library,
                                         .library_count = 1};
    const struct ranks alone = ranks_alone();
    struct simulation_case *input;
    struct simulation *simulation = calloc(1, sizeof *simulation);
    struct limit limit;
    stop_on(case_read(path, &options, &bolide_catalogue, &input));
    stop_on(simulation_create(input, &alone, 1, simulation));
    const struct solver_class *class = input->solver.choice->thing;
    void *solver = calloc(1, class->size);
    stop_on(class->create(solver, simulation, input->solver.value));
    stop_on(generate_particles(simulation));
    stop_on(class->start(solver, simulation));
    double best = INFINITY, first = 0.0;
    for (int k = -2; k < steps; k++) { /* two to warm up */
        const double begin = processor_seconds();
        if (k == 0) {
            first = begin;
            simulation->phases = 0;
        }
        stop_on(class->prepare(solver, simulation, &limit));
        stop_on(class->advance(solver, simulation, limit.dt));
        simulation->time += limit.dt;
        simulation->step++;
        if (k >= 0)
            best = minimum(best, processor_seconds() - begin);
    }
    const double particles = simulation->particles.count,
                 mean = (processor_seconds() - first) / steps;
    double all = 0.0;
    for (int k = 0; k < simulation->phases; k++)
        all += simulation->phase[k].seconds;
    printf("%s\n  %.0f particles, %.2f M updates/s, at best %.2f;", input->title, particles,
           1e-6 * particles / mean, 1e-6 * particles / best);
    for (int k = 0; k < simulation->phases; k++)
        printf(" %s %.0f %%", simulation->phase[k].name,
               100.0 * simulation->phase[k].seconds / all);
    printf("\n");
    class->destroy(solver);
    free(solver);
    simulation_destroy(simulation);
    free(simulation);
    case_free(input);
}

int main(int count, char **arguments)
{
    static const char *const cases[] = {"mpm-solid.yaml", "mpm-sparse.yaml", "mpm-quadratic.yaml"};
    const int steps = count > 1 ? atoi(arguments[1]) : 20;
    if (count > 2) {
        measure(arguments[2], steps, arguments + 3, count - 3);
        return 0;
    }
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        char path[512];
        snprintf(path, sizeof path, "%s%s", CASES, cases[k]);
        measure(path, steps, NULL, 0);
    }
    return 0;
}
