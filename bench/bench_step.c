/* The speed of whole steps, neighbour rebuilds as they fall: particle updates a second, nanoseconds a pair,
 * bytes a particle, and what share each phase takes; 1-D, 2-D and 3-D, one thread and two.
 *
 * Usage: bench_step [CASE.yaml [let.n=VALUE [STEPS [THREADS]]]] */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "model/generate.h"
#include "run/catalogue.h"
#include "sph/lanes.h"
#include "sph/sph_internal.h"

static void stop_on(struct error *error)
{
    for (int i = 0; error && i < error_count(error); i++)
        fprintf(stderr, "%s\n", error_message(error, i));
    if (error)
        exit(error_kind(error));
}

/* Neighbours within support, summed over all particles. */
static int64_t count_pairs(const struct sph *sph, const struct simulation *simulation)
{
    const bool second = sph_second_order(sph);
    const double *place = second ? sph->place : sph->record;
    const size_t stride = second ? PLACE_STRIDE : (size_t)record_stride(sph->kind);
    const int d = record_diameter(simulation->dimension);
    int64_t pairs = 0;
    for (int32_t i = 0; i < simulation->particles.count; i++) {
        const uint32_t *entry = neighbours_row(&sph->neighbours, i);
        const double *own = place + (size_t)i * stride;
        for (uint32_t k = 0; k < sph->neighbours.row[i].count; k++) {
            const double *other = place + (size_t)(entry[k] & ENTRY_INDEX) * stride;
            double sum = 0.0;
            for (int axis = 0; axis < simulation->dimension; axis++)
                sum += square(other[axis] - own[axis]);
            pairs += sum < square(sph->parameters.smoothing * (own[d] + other[d]));
        }
    }
    return pairs;
}

static void bench(const char *path, const char *setting, int steps, int threads)
{
    const char *const library[] = {BOLIDE_SOURCE_DIR "/materials"};
    struct case_options options = {.settings = &setting,
                                   .setting_count = setting != NULL,
                                   .library_paths = library,
                                   .library_count = 1};
    struct simulation_case *input;
    stop_on(case_read(path, &options, &bolide_catalogue, &input));
    struct ranks alone = ranks_alone();
    struct simulation *simulation = calloc(1, sizeof *simulation);
    struct sph *sph = calloc(1, sizeof *sph);
    if (!simulation || !sph)
        exit(ERROR_SYSTEM);
    const struct solver_class *solver = input->solver.choice->thing;
    stop_on(simulation_create(input, &alone, threads, simulation));
    stop_on(solver->create(sph, simulation, input->solver.value));
    stop_on(generate_particles(simulation));
    stop_on(solver->start(sph, simulation));
    struct limit limit;
    stop_on(solver->prepare(sph, simulation, &limit)); /* the first build is not counted */
    simulation->phases = 0;
    int64_t builds = sph->neighbours.builds;
    double begin = clock_seconds();
    for (int k = 0; k < steps; k++) {
        stop_on(solver->advance(sph, simulation, limit.dt));
        simulation->time += limit.dt;
        simulation->step++;
        stop_on(solver->prepare(sph, simulation, &limit));
    }
    double seconds = clock_seconds() - begin;
    double updates = (double)simulation->particles.count * steps;
    double pairs = (double)count_pairs(sph, simulation);
    double bytes = (double)particles_bytes(&simulation->particles) +
                   (double)(neighbours_bytes(&sph->neighbours) +
                            (size_t)sph->record_capacity * sizeof(double) *
                                (size_t)(sph_second_order(sph)
                                             ? muscl_stride(muscl_kind_of(sph)) + PLACE_STRIDE
                                             : record_stride(sph->kind))) /
                       simulation->particles.count;
    const char *name = strrchr(path, '/');
    printf("%-25s %9d %7d %10.3f %10.1f %8.2f %8.0f %7.1f ", name ? name + 1 : path,
           simulation->particles.count, threads, 1e-6 * updates / seconds,
           pairs / simulation->particles.count, 1e9 * seconds / (pairs * steps), bytes,
           (double)steps / (double)(sph->neighbours.builds - builds));
    for (int k = 0; k < simulation->phases; k++)
        printf(" %s %.0f%%", simulation->phase[k].name,
               100.0 * simulation->phase[k].seconds / seconds);
    printf("  %016llx\n", (unsigned long long)particles_hash(&simulation->particles));
    fflush(stdout);
    solver->destroy(sph);
    simulation_destroy(simulation);
    case_free(input);
    free(simulation);
    free(sph);
}

int main(int argc, char **argv)
{
    printf("%-25s %9s %7s %10s %10s %8s %8s %7s  phases\n", "case", "particles", "threads",
           "M upd/s", "neighbours", "ns/pair", "B/part", "steps/b");
    if (argc > 1) {
        bench(argv[1], argc > 2 ? argv[2] : NULL, argc > 3 ? atoi(argv[3]) : 50,
              argc > 4 ? atoi(argv[4]) : 1);
        return 0;
    }
    static const struct {
        const char *path;
        int steps;
    } cases[] = {{BOLIDE_SOURCE_DIR "/bench/cases/line-solid.yaml", 200},
                 {BOLIDE_SOURCE_DIR "/bench/cases/line-solid-second-order.yaml", 200},
                 {BOLIDE_SOURCE_DIR "/bench/cases/plane-solid.yaml", 100},
                 {BOLIDE_SOURCE_DIR "/bench/cases/plane-solid-second-order.yaml", 100},
                 {BOLIDE_SOURCE_DIR "/bench/cases/space-fluid.yaml", 50},
                 {BOLIDE_SOURCE_DIR "/bench/cases/space-fluid-second-order.yaml", 50},
                 {BOLIDE_SOURCE_DIR "/bench/cases/space-solid.yaml", 50},
                 {BOLIDE_SOURCE_DIR "/bench/cases/space-solid-second-order.yaml", 50}};
    for (size_t k = 0; k < COUNT_OF(cases); k++)
        for (int threads = 1; threads <= 2; threads++)
            bench(cases[k].path, NULL, cases[k].steps, threads);
    return 0;
}
