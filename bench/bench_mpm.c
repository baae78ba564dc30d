/* The speed of whole steps of the material point method, all of it counted: particle updates a second, bytes a particle, and
 * what share each phase takes. One thread beside two; the median of repeats that take turns.
 *
 * Usage: bench_mpm [--quick] [--csv FILE] [mpm]
 *        bench_mpm CASE.yaml [let.n=VALUE [STEPS [THREADS]]] */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "model/generate.h"
#include "model/solver.h"
#include "run/catalogue.h"

#define CASES BOLIDE_SOURCE_DIR "/bench/cases/"

enum { REPEATS = 3, STEPS = 20, PHASES = 6 };

static const char *const phase_names[PHASES] = {"cells", "scatter",    "limit",
                                                "nodes", "velocities", "states"};

struct run {
    const char *path, *setting;
    int steps, threads;
};

struct measured {
    int32_t particles;
    double rate, bytes; /* updates/s; a particle */
    double share[PHASES];
    uint64_t hash;
};

static void stop_on(struct error *error)
{
    for (int i = 0; error && i < error_count(error); i++)
        fprintf(stderr, "%s\n", error_message(error, i));
    if (error)
        exit(error_kind(error));
}

static void step(const struct solver_class *class, void *solver, struct simulation *simulation)
{
    struct limit limit;
    stop_on(class->prepare(solver, simulation, &limit));
    stop_on(class->advance(solver, simulation, limit.dt));
    simulation->time += limit.dt;
    simulation->step++;
}

static struct measured measure(const struct run *run)
{
    const char *const library[] = {BOLIDE_SOURCE_DIR "/materials"};
    const struct case_options options = {.settings = &run->setting,
                                         .setting_count = run->setting != NULL,
                                         .library_paths = library,
                                         .library_count = 1};
    const struct ranks alone = ranks_alone();
    struct simulation_case *input;
    struct simulation *simulation = calloc(1, sizeof *simulation);
    stop_on(case_read(run->path, &options, &bolide_catalogue, &input));
    stop_on(simulation_create(input, &alone, run->threads, simulation));
    const struct solver_class *class = input->solver.choice->thing;
    void *solver = calloc(1, class->size);
    stop_on(class->create(solver, simulation, input->solver.value));
    stop_on(generate_particles(simulation));
    stop_on(class->start(solver, simulation));
    for (int k = 0; k < 2; k++) /* in which memory is first touched */
        step(class, solver, simulation);
    simulation->phases = 0;
    const double begin = clock_seconds();
    for (int k = 0; k < run->steps; k++)
        step(class, solver, simulation);
    const double seconds = clock_seconds() - begin;
    struct measured m = {.particles = simulation->particles.count,
                         .rate = simulation->particles.count * run->steps / seconds,
                         .bytes = class->bytes(input->solver.value, simulation->dimension),
                         .hash = particles_hash(&simulation->particles)};
    for (int k = 0; k < simulation->phases; k++)
        for (int name = 0; name < PHASES; name++)
            if (!strcmp(simulation->phase[k].name, phase_names[name]))
                m.share[name] = simulation->phase[k].seconds / seconds;
    class->destroy(solver);
    free(solver);
    simulation_destroy(simulation);
    free(simulation);
    case_free(input);
    return m;
}

static int by_rate(const void *a, const void *b)
{
    const struct measured *first = a, *second = b;
    return (first->rate > second->rate) - (first->rate < second->rate);
}

static void print_head(void)
{
    printf("%-26s %8s %7s %8s %-16s %6s ", "", "", "", "M upd.", "", "");
    printf("\n%-26s %8s %7s %8s %-16s %6s ", "mpm", "partic.", "threads", "a second", "", "bytes");
    for (int k = 0; k < PHASES; k++)
        printf(" %10s", phase_names[k]);
    printf("\n");
}

static void print_row(const char *name, int threads, const struct measured *m, const char *ratio)
{
    printf("%-26s %8d %7d %8.2f %-16s %6.0f ", name, m->particles, threads, 1e-6 * m->rate, ratio,
           m->bytes);
    for (int k = 0; k < PHASES; k++)
        printf(" %9.0f%%", 100.0 * m->share[k]);
    printf("\n");
    fflush(stdout);
}

/* M is sorted by rate. */
static void write_csv(FILE *csv, const char *name, const struct run *run, const struct measured *m,
                      int repeats)
{
    const struct measured *median = &m[repeats / 2];
    if (!csv)
        return;
#if defined(__clang__)
    const char *const compiler = __VERSION__;
#else
    const char *const compiler = "gcc " __VERSION__;
#endif
    fprintf(csv, "%s,%s,%d,%d,%d,%d,%.0f,%.0f,%.0f,%.0f", compiler, name, median->particles,
            run->threads, run->steps, repeats, median->rate, m[0].rate, m[repeats - 1].rate,
            median->bytes);
    for (int k = 0; k < PHASES; k++)
        fprintf(csv, ",%.3f", median->share[k]);
    fprintf(csv, ",%016llx\n", (unsigned long long)median->hash);
}

/* An empty file gets a line of names. */
static FILE *open_csv(const char *path)
{
    FILE *csv = fopen(path, "a");
    if (!csv) {
        perror(path);
        exit(ERROR_SYSTEM);
    }
    if (ftell(csv) == 0) {
        fprintf(csv, "compiler,case,particles,threads,steps,repeats,updates_per_second,slowest,"
                     "fastest,bytes");
        for (int k = 0; k < PHASES; k++)
            fprintf(csv, ",share_%s", phase_names[k]);
        fprintf(csv, ",hash\n");
    }
    return csv;
}

static const struct bench {
    const char *name, *path;
} benches[] = {
    {"steel linear", CASES "mpm-solid.yaml"},
    {"steel linear far apart", CASES "mpm-sparse.yaml"},
    {"steel quadratic", CASES "mpm-quadratic.yaml"},
};

/* A case with one thread and with two. */
static void run_bench(const struct bench *bench, int repeats, FILE *csv)
{
    struct measured m[2][REPEATS];
    for (int repeat = 0; repeat < repeats; repeat++)
        for (int v = 0; v < 2; v++)
            m[v][repeat] = measure(&(struct run){bench->path, NULL, STEPS, 1 + v});
    for (int v = 0; v < 2; v++) {
        qsort(m[v], (size_t)repeats, sizeof m[v][0], by_rate);
        char ratio[32] = "";
        if (v)
            snprintf(ratio, sizeof ratio, "%.2f x 1 thread",
                     m[1][repeats / 2].rate / m[0][repeats / 2].rate);
        print_row(bench->name, 1 + v, &m[v][repeats / 2], ratio);
        write_csv(csv, bench->name, &(struct run){bench->path, NULL, STEPS, 1 + v}, m[v], repeats);
    }
}

int main(int count, char **arguments)
{
    int repeats = REPEATS, next = 1;
    FILE *csv = NULL;
    for (; next < count && arguments[next][0] == '-'; next++) {
        if (!strcmp(arguments[next], "--quick")) {
            repeats = 1;
        } else if (!strcmp(arguments[next], "--csv") && next + 1 < count) {
            csv = open_csv(arguments[++next]);
        } else {
            fprintf(stderr, "bench_mpm: what is %s?\n", arguments[next]);
            return ERROR_INPUT;
        }
    }
    bool wanted = next == count;
    for (int k = next; k < count; k++)
        wanted |= !strcmp(arguments[k], "mpm");
    print_head();
    if (next < count && strstr(arguments[next], ".yaml")) {
        const char *slash = strrchr(arguments[next], '/');
        const struct run run = {arguments[next], count > next + 1 ? arguments[next + 1] : NULL,
                                count > next + 2 ? atoi(arguments[next + 2]) : STEPS,
                                count > next + 3 ? atoi(arguments[next + 3]) : 1};
        const struct measured m = measure(&run);
        print_row(slash ? slash + 1 : arguments[next], run.threads, &m, "");
        printf("hash %016llx\n", (unsigned long long)m.hash);
        return 0;
    }
    for (size_t k = 0; wanted && k < COUNT_OF(benches); k++)
        run_bench(&benches[k], repeats, csv);
    if (csv)
        fclose(csv);
    return 0;
}
