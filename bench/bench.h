/* What the benches of solvers share: a case run for so many steps, what is measured of any solver,
 * and the rows of the CSV file. */
#ifndef BOLIDE_BENCH_H
#define BOLIDE_BENCH_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "model/generate.h"
#include "model/solver.h"
#include "run/catalogue.h"

#define CASES BOLIDE_SOURCE_DIR "/bench/cases/"

enum { REPEATS = 3 };

struct run {
    const char *path, *setting;
    int steps, threads;
};

/* A case between its steps: ready for the next. */
struct started {
    struct simulation_case *input;
    struct simulation *simulation;
    const struct solver_class *class;
    void *solver;
    struct limit limit;
};

struct measured {
    int32_t particles;
    double rate;              /* updates/s */
    double share[PHASES_MAX]; /* of the time, by phase */
    uint64_t hash;
};

static inline void stop_on(struct error *error)
{
    for (int i = 0; error && i < error_count(error); i++)
        fprintf(stderr, "%s\n", error_message(error, i));
    if (error)
        exit(error_kind(error));
}

/* The case at PATH with COUNT SETTINGS, as of --set, ready for its first step. */
static inline struct started start_with(const char *path, const char *const *settings, int count,
                                        int threads)
{
    const char *const library[] = {BOLIDE_SOURCE_DIR "/materials"};
    const struct case_options options = {
        .settings = settings, .setting_count = count, .library_paths = library, .library_count = 1};
    static struct ranks alone; /* outlives the simulation */
    alone = ranks_alone();
    struct started s = {.simulation = calloc(1, sizeof *s.simulation)};
    stop_on(case_read(path, &options, &bolide_catalogue, &s.input));
    s.class = s.input->solver.choice->thing;
    s.solver = calloc(1, s.class->size);
    if (!s.simulation || !s.solver)
        exit(ERROR_SYSTEM);
    stop_on(simulation_create(s.input, &alone, threads, s.simulation));
    stop_on(s.class->create(s.solver, s.simulation, s.input->solver.value));
    stop_on(s.class->fill(s.solver, s.simulation));
    stop_on(s.class->start(s.solver, s.simulation));
    stop_on(s.class->prepare(s.solver, s.simulation, &s.limit));
    return s;
}

static inline struct started start(const struct run *run)
{
    return start_with(run->path, &run->setting, run->setting != NULL, run->threads);
}

/* Returns how many seconds so many steps took. */
static inline double take_steps(struct started *s, int steps)
{
    s->simulation->phases = 0;
    const double begin = clock_seconds();
    for (int k = 0; k < steps; k++) {
        stop_on(s->class->advance(s->solver, s->simulation, s->limit.dt));
        s->simulation->time += s->limit.dt;
        s->simulation->step++;
        stop_on(s->class->prepare(s->solver, s->simulation, &s->limit));
    }
    return clock_seconds() - begin;
}

/* A phase of the step, and its name in the columns of the tables. */
struct bench_phase {
    const char *name, *column;
};

static inline struct measured measured_of(const struct started *s, int steps, double seconds,
                                          const struct bench_phase *phases, int count)
{
    const struct simulation *simulation = s->simulation;
    const int64_t members = simulation_members(simulation);
    struct measured m = {.particles = (int32_t)members,
                         .rate = (double)members * steps / seconds,
                         .hash = simulation_hash(simulation)};
    for (int k = 0; k < simulation->phases; k++)
        for (int name = 0; name < count; name++)
            if (!strcmp(simulation->phase[k].name, phases[name].name))
                m.share[name] = simulation->phase[k].seconds / seconds;
    return m;
}

static inline void finish(struct started *s)
{
    s->class->destroy(s->solver);
    free(s->solver);
    simulation_destroy(s->simulation);
    free(s->simulation);
    case_free(s->input);
}

/* For qsort of what begins with a struct measured. */
static inline int by_rate(const void *a, const void *b)
{
    const struct measured *first = a, *second = b;
    return (first->rate > second->rate) - (first->rate < second->rate);
}

static inline void print_shares(const struct measured *m, int count, int width)
{
    for (int k = 0; k < count; k++)
        printf(" %*.0f%%", width - 1, 100.0 * m->share[k]);
    printf("\n");
    fflush(stdout);
}

/* An empty file gets a line of names, in the order of write_csv: NAME and NUMBERS are those of the
 * bench's own columns. */
static inline FILE *open_csv(const char *path, const char *name, const char *numbers,
                             const struct bench_phase *phases, int count)
{
    FILE *csv = fopen(path, "a");
    if (!csv) {
        perror(path);
        exit(ERROR_SYSTEM);
    }
    if (ftell(csv) == 0) {
        fprintf(csv,
                "compiler,%s,particles,threads,steps,repeats,updates_per_second,slowest,fastest,%s",
                name, numbers);
        for (int k = 0; k < count; k++)
            fprintf(csv, ",share_%s", phases[k].column);
        fprintf(csv, ",hash\n");
    }
    return csv;
}

/* The MEDIAN of repeats, whose rates go from SLOWEST to FASTEST; without a file nothing is
 * written. */
static inline void write_csv(FILE *csv, const char *name, const struct run *run, int repeats,
                             const struct measured *median, double slowest, double fastest,
                             const char *numbers, int count)
{
#if defined(__clang__)
    const char *const compiler = __VERSION__;
#else
    const char *const compiler = "gcc " __VERSION__;
#endif
    if (!csv)
        return;
    fprintf(csv, "%s,%s,%d,%d,%d,%d,%.0f,%.0f,%.0f,%s", compiler, name, median->particles,
            run->threads, run->steps, repeats, median->rate, slowest, fastest, numbers);
    for (int k = 0; k < count; k++)
        fprintf(csv, ",%.3f", median->share[k]);
    fprintf(csv, ",%016llx\n", (unsigned long long)median->hash);
    fflush(csv);
}

/* What both are called with: [--quick] [--csv FILE], then names of groups or a case of one's
 * own. */
struct wishes {
    bool quick;
    const char *csv;
    int next; /* of the arguments */
};

static inline struct wishes wishes_of(int count, char **arguments)
{
    struct wishes wishes = {.next = 1};
    for (; wishes.next < count && arguments[wishes.next][0] == '-'; wishes.next++) {
        const char *argument = arguments[wishes.next];
        if (!strcmp(argument, "--quick")) {
            wishes.quick = true;
        } else if (!strcmp(argument, "--csv") && wishes.next + 1 < count) {
            wishes.csv = arguments[++wishes.next];
        } else {
            fprintf(stderr, "%s: what is %s?\n", arguments[0], argument);
            exit(ERROR_INPUT);
        }
    }
    return wishes;
}

/* CASE.yaml [let.n=VALUE [STEPS [THREADS]]]; false where there are groups instead. */
static inline bool own_case(int count, char **arguments, struct run *run)
{
    if (count == 0 || !strstr(arguments[0], ".yaml"))
        return false;
    run->path = arguments[0];
    run->setting = count > 1 ? arguments[1] : NULL;
    run->steps = count > 2 ? atoi(arguments[2]) : run->steps;
    run->threads = count > 3 ? atoi(arguments[3]) : 1;
    return true;
}

static inline const char *name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

#endif
