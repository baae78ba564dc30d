/* Gas and material points in one run, and material points alone: a blast on a slab with both side
 * by side, and a round blast with one after the other. The time of the whole case on one thread,
 * what share each phase takes, and the memory of the process; the median of repeats that take
 * turns.
 *
 * Usage: bench_coupled [--quick] [--csv FILE] [coupled] */
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench.h"

enum { PHASES = 9 };

static const struct bench_phase phases[PHASES] = {
    {"coupling", "coupling"},         {"sweeps", "sweeps"},
    {"states", "gas_states"},         {"cell search", "cells"},
    {"particles to grid", "scatter"}, {"time step", "limit"},
    {"grid update", "nodes"},         {"grid to particles", "velocities"},
    {"stresses", "stresses"},
};

static const struct bench {
    const char *name, *path;
    int mpm; /* which of them computes the same with material points alone */
} benches[] = {
    {"blast mpm", CASES "coupled-blast-mpm.yaml", 0},
    {"blast cfdmp", CASES "coupled-blast-cfdmp.yaml", 0},
    {"round mpm", CASES "coupled-round-mpm.yaml", 2},
    {"round afdmp", CASES "coupled-round.yaml", 2},
};
enum { BENCHES = COUNT_OF(benches) };

struct measured_case {
    struct measured all;
    double seconds, megabytes;
    int steps;
};

/* The case to its end, as a run takes its steps. */
static struct measured_case measure(const char *path)
{
    const struct run run = {path, NULL, 0, 1};
    struct started s = start(&run);
    struct simulation *simulation = s.simulation;
    const double until = s.input->run.until;
    int64_t updates = 0;
    simulation->phases = 0;
    const double begin = clock_seconds();
    while (simulation->time < until) {
        const double event = fmin(s.limit.event, until), left = event - simulation->time;
        const double dt = left <= s.limit.dt ? left : fmin(s.limit.dt, 0.5 * left);
        stop_on(s.class->advance(s.solver, simulation, dt));
        if (simulation_changed(simulation))
            stop_on(simulation_commit(simulation));
        simulation->time = dt == left ? event : simulation->time + dt;
        simulation->step++;
        updates += simulation_members(simulation);
        stop_on(s.class->prepare(s.solver, simulation, &s.limit));
    }
    struct measured_case m = {.seconds = clock_seconds() - begin, .steps = (int)simulation->step};
    m.all = measured_of(&s, m.steps, m.seconds, phases, PHASES);
    m.all.rate = (double)updates / m.seconds;
    finish(&s);
    return m;
}

/* The same in a process of its own, which tells how much memory it took. */
static struct measured_case measure_apart(const char *path)
{
    int ends[2];
    struct measured_case m = {.seconds = 0.0};
    struct rusage usage = {0};
    if (pipe(ends)) {
        perror("pipe");
        exit(ERROR_SYSTEM);
    }
    const pid_t child = fork();
    if (child == 0) {
        m = measure(path);
        _exit(write(ends[1], &m, sizeof m) == (ssize_t)sizeof m ? 0 : ERROR_SYSTEM);
    }
    close(ends[1]);
    int status = ERROR_SYSTEM;
    const bool whole = child > 0 && read(ends[0], &m, sizeof m) == (ssize_t)sizeof m;
    close(ends[0]);
    if (child < 0 || wait4(child, &status, 0, &usage) != child || status != 0 || !whole) {
        fprintf(stderr, "%s: its process failed\n", path);
        exit(ERROR_SYSTEM);
    }
    m.megabytes = (double)usage.ru_maxrss * 1024e-6;
    return m;
}

static void print_row(const char *name, const struct measured_case *m, const char *ratio)
{
    printf("%-14s %8d %6d %8.2f %8.2f %8.1f %-14s", name, m->all.particles, m->steps,
           1e-6 * m->all.rate, m->seconds, m->megabytes, ratio);
    print_shares(&m->all, PHASES, 11);
}

static void run_all(int repeats, FILE *csv)
{
    struct measured_case m[BENCHES][REPEATS];
    printf("%-14s %8s %6s %8s\n%-14s %8s %6s %8s %8s %8s %-14s", "", "", "", "M upd.", "coupled",
           "members", "steps", "a second", "seconds", "MB", "");
    for (int k = 0; k < PHASES; k++)
        printf(" %11s", phases[k].column);
    printf("\n");
    for (int repeat = 0; repeat < repeats; repeat++)
        for (int k = 0; k < (int)BENCHES; k++)
            m[k][repeat] = measure_apart(benches[k].path);
    for (int k = 0; k < (int)BENCHES; k++) {
        char ratio[32] = "", numbers[48];
        qsort(m[k], (size_t)repeats, sizeof m[k][0], by_rate);
        const struct measured_case *median = &m[k][repeats / 2];
        const int mpm = benches[k].mpm;
        if (k != mpm)
            snprintf(ratio, sizeof ratio, "%.2f x mpm",
                     median->seconds / m[mpm][repeats / 2].seconds);
        print_row(benches[k].name, median, ratio);
        const struct run run = {benches[k].path, NULL, median->steps, 1};
        snprintf(numbers, sizeof numbers, "%.3f,%.1f", median->seconds, median->megabytes);
        write_csv(csv, benches[k].name, &run, repeats, &median->all, m[k][0].all.rate,
                  m[k][repeats - 1].all.rate, numbers, PHASES);
    }
}

int main(int count, char **arguments)
{
    const struct wishes wishes = wishes_of(count, arguments);
    FILE *csv =
        wishes.csv ? open_csv(wishes.csv, "case", "seconds,megabytes", phases, PHASES) : NULL;
    bool wanted = wishes.next == count;
    for (int k = wishes.next; k < count; k++)
        wanted |= !strcmp(arguments[k], "coupled");
    if (wanted)
        run_all(wishes.quick ? 1 : REPEATS, csv);
    if (csv)
        fclose(csv);
    return 0;
}
