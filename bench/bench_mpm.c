/* The speed of whole steps of the material point method, all of it counted: particle updates a
 * second, bytes a particle, and what share each phase takes. One thread beside two; the median of
 * repeats that take turns.
 *
 * Usage: bench_mpm [--quick] [--csv FILE] [mpm]
 *        bench_mpm CASE.yaml [let.n=VALUE [STEPS [THREADS]]] */
#include "bench.h"

enum { STEPS = 20, FIRST_STEPS = 2, PHASES = 6 }; /* in the first steps memory is touched */

static const struct bench_phase phases[PHASES] = {
    {"cell search", "cells"}, {"particles to grid", "scatter"},    {"time step", "limit"},
    {"grid update", "nodes"}, {"grid to particles", "velocities"}, {"stresses", "states"},
};

struct measured_mpm {
    struct measured all;
    double bytes; /* a particle */
};

static struct measured_mpm measure(const struct run *run)
{
    struct started s = start(run);
    take_steps(&s, FIRST_STEPS);
    const double seconds = take_steps(&s, run->steps);
    const struct measured_mpm m = {
        measured_of(&s, run->steps, seconds, phases, PHASES),
        s.class->bytes(s.input->solver.value, s.simulation->problem->dimension)};
    finish(&s);
    return m;
}

static void print_head(void)
{
    printf("%-26s %8s %7s %8s %-16s %6s ", "", "", "", "M upd.", "", "");
    printf("\n%-26s %8s %7s %8s %-16s %6s ", "mpm", "partic.", "threads", "a second", "", "bytes");
    for (int k = 0; k < PHASES; k++)
        printf(" %10s", phases[k].column);
    printf("\n");
}

static void print_row(const char *name, int threads, const struct measured_mpm *m,
                      const char *ratio)
{
    printf("%-26s %8d %7d %8.2f %-16s %6.0f ", name, m->all.particles, threads, 1e-6 * m->all.rate,
           ratio, m->bytes);
    print_shares(&m->all, PHASES, 10);
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
    struct measured_mpm m[2][REPEATS];
    struct run run[2];
    for (int v = 0; v < 2; v++)
        run[v] = (struct run){bench->path, NULL, STEPS, 1 + v};
    for (int repeat = 0; repeat < repeats; repeat++)
        for (int v = 0; v < 2; v++)
            m[v][repeat] = measure(&run[v]);
    for (int v = 0; v < 2; v++) {
        qsort(m[v], (size_t)repeats, sizeof m[v][0], by_rate);
        const struct measured_mpm *median = &m[v][repeats / 2];
        char ratio[32] = "", bytes[32];
        if (v)
            snprintf(ratio, sizeof ratio, "%.2f x 1 thread",
                     median->all.rate / m[0][repeats / 2].all.rate);
        print_row(bench->name, 1 + v, median, ratio);
        snprintf(bytes, sizeof bytes, "%.0f", median->bytes);
        write_csv(csv, bench->name, &run[v], repeats, &median->all, m[v][0].all.rate,
                  m[v][repeats - 1].all.rate, bytes, PHASES);
    }
}

int main(int count, char **arguments)
{
    const struct wishes wishes = wishes_of(count, arguments);
    struct run run = {.steps = STEPS};
    print_head();
    if (own_case(count - wishes.next, arguments + wishes.next, &run)) {
        const struct measured_mpm m = measure(&run);
        print_row(name_of(run.path), run.threads, &m, "");
        printf("hash %016llx\n", (unsigned long long)m.all.hash);
        return 0;
    }
    FILE *csv = wishes.csv ? open_csv(wishes.csv, "case", "bytes", phases, PHASES) : NULL;
    bool wanted = wishes.next == count;
    for (int k = wishes.next; k < count; k++)
        wanted |= !strcmp(arguments[k], "mpm");
    for (size_t k = 0; wanted && k < COUNT_OF(benches); k++)
        run_bench(&benches[k], wishes.quick ? 1 : REPEATS, csv);
    if (csv)
        fclose(csv);
    return 0;
}
