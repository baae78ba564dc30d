/* The speed of whole steps, neighbour rows built as they fall: particle updates a second, nanoseconds a pair, bytes a
 * particle, and what share each phase takes. First order beside second, one thread beside two; the median of repeats that
 * take turns, so that what disturbs the machine disturbs all alike.
 *
 * Usage: bench_step [--quick] [--csv FILE] [line|plane|space|size|sparse|NAME OF A CASE]...
 *        bench_step CASE.yaml [let.n=VALUE [STEPS [THREADS]]] */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "model/generate.h"
#include "run/catalogue.h"
#include "sph/lanes.h"
#include "sph/sph_internal.h"

#define CASES BOLIDE_SOURCE_DIR "/bench/cases/"

enum { REPEATS = 3, VARIANTS = 4, PHASES = 4 };

static const char *const phase_names[PHASES] = {"neighbours", "records", "pairs", "points"};

struct run {
    const char *path, *setting;
    int steps, threads;
};

struct measured {
    int32_t particles;
    int ranks;
    double rate, pairs,
        seconds_a_pair; /* updates/s; neighbours within support of one particle; wall-clock */
    double state_bytes, list_bytes; /* a particle */
    double steps_a_build;
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

/* Of the store, the records, which stand in its scratch, and the places beside them. */
static double state_bytes(const struct sph *sph, const struct particles *p)
{
    return (double)particles_bytes(p) +
           ((double)p->scratch.size + (double)sph->place_capacity * PLACE_STRIDE * sizeof(double)) /
               p->count;
}

static struct measured measure(const struct run *run)
{
    const char *const library[] = {BOLIDE_SOURCE_DIR "/materials"};
    struct case_options options = {.settings = &run->setting,
                                   .setting_count = run->setting != NULL,
                                   .library_paths = library,
                                   .library_count = 1};
    struct simulation_case *input;
    stop_on(case_read(run->path, &options, &bolide_catalogue, &input));
    struct ranks alone = ranks_alone();
    struct simulation *simulation = calloc(1, sizeof *simulation);
    struct sph *sph = calloc(1, sizeof *sph);
    if (!simulation || !sph)
        exit(ERROR_SYSTEM);
    const struct solver_class *solver = input->solver.choice->thing;
    stop_on(simulation_create(input, &alone, run->threads, simulation));
    stop_on(solver->create(sph, simulation, input->solver.value));
    stop_on(generate_particles(simulation));
    stop_on(solver->start(sph, simulation));
    struct limit limit;
    stop_on(solver->prepare(sph, simulation, &limit)); /* the first build is not counted */
    simulation->phases = 0;
    int64_t builds = sph->neighbours.builds;
    double begin = clock_seconds();
    for (int k = 0; k < run->steps; k++) {
        stop_on(solver->advance(sph, simulation, limit.dt));
        simulation->time += limit.dt;
        simulation->step++;
        stop_on(solver->prepare(sph, simulation, &limit));
    }
    const double seconds = clock_seconds() - begin, count = simulation->particles.count;
    const double pairs = (double)count_pairs(sph, simulation);
    struct measured m = {
        .particles = simulation->particles.count,
        .ranks = alone.size,
        .rate = count * run->steps / seconds,
        .pairs = pairs / count,
        .seconds_a_pair = seconds / (pairs * run->steps),
        .state_bytes = state_bytes(sph, &simulation->particles),
        .list_bytes = (double)neighbours_bytes(&sph->neighbours) / count,
        .steps_a_build = (double)run->steps / (double)(sph->neighbours.builds - builds),
        .hash = particles_hash(&simulation->particles),
    };
    for (int k = 0; k < simulation->phases; k++)
        for (int name = 0; name < PHASES; name++)
            if (!strcmp(simulation->phase[k].name, phase_names[name]))
                m.share[name] = simulation->phase[k].seconds / seconds;
    solver->destroy(sph);
    simulation_destroy(simulation);
    case_free(input);
    free(simulation);
    free(sph);
    return m;
}

static int by_rate(const void *a, const void *b)
{
    const struct measured *first = a, *second = b;
    return (first->rate > second->rate) - (first->rate < second->rate);
}

/* Prints what stands in every row; RATIO in words, of this row to another. */
static void print_row(const char *name, const char *order, int threads, const struct measured *m,
                      const char *ratio)
{
    printf("%-22s %-6s %8d %7d %8.3f %-15s %7.1f %7.2f %6.0f %6.0f %7.1f ", name, order,
           m->particles, threads, 1e-6 * m->rate, ratio, m->pairs, 1e9 * m->seconds_a_pair,
           m->state_bytes, m->list_bytes, m->steps_a_build);
    for (int k = 0; k < PHASES; k++)
        printf(" %5.0f%%", 100.0 * m->share[k]);
    printf("\n");
    fflush(stdout);
}

static void print_head(void)
{
    printf("%-22s %-6s %8s %7s %8s %-15s %7s %7s %6s %6s %7s ", "", "", "", "", "M upd.", "",
           "neigh-", "ns a", "bytes:", "", "steps");
    printf("%6s %6s %6s %6s\n", "neigh-", "", "", "");
    printf("%-22s %-6s %8s %7s %8s %-15s %7s %7s %6s %6s %7s ", "case", "order", "partic.",
           "threads", "a second", "ratio", "bours", "pair", "state", "list", "a build");
    printf("%6s %6s %6s %6s\n", "bours", "records", "pairs", "points");
}

/* M is sorted by rate. */
static void write_csv(FILE *csv, const char *name, const char *order, const struct run *run,
                      const struct measured *m, int repeats)
{
    const struct measured *median = &m[repeats / 2];
    if (!csv)
        return;
#if defined(__clang__)
    const char *const compiler = __VERSION__;
#else
    const char *const compiler = "gcc " __VERSION__;
#endif
    fprintf(csv, "%s,%s,%s,%d,%d,%d,%d,%d,%.0f,%.0f,%.0f,%.2f,%.3f,%.0f,%.0f,%.1f", compiler, name,
            order, median->particles, run->threads, median->ranks, run->steps, repeats,
            median->rate, m[0].rate, m[repeats - 1].rate, median->pairs,
            1e9 * median->seconds_a_pair, median->state_bytes, median->list_bytes,
            median->steps_a_build);
    for (int k = 0; k < PHASES; k++)
        fprintf(csv, ",%.3f", median->share[k]);
    fprintf(csv, ",%016llx\n", (unsigned long long)median->hash);
    fflush(csv);
}

/* Empty files get a line of names. */
static FILE *open_csv(const char *path)
{
    FILE *csv = fopen(path, "a");
    if (!csv) {
        perror(path);
        exit(ERROR_SYSTEM);
    }
    if (ftell(csv) == 0) {
        fprintf(csv,
                "compiler,case,order,particles,threads,ranks,steps,repeats,updates_per_second,"
                "slowest,fastest,neighbours,ns_per_pair,bytes_state,bytes_list,steps_per_build");
        for (int k = 0; k < PHASES; k++)
            fprintf(csv, ",share_%s", phase_names[k]);
        fprintf(csv, ",hash\n");
    }
    return csv;
}

/* Cases side by side: the two orders of one, or the two of group "sparse", which compares two cases of one order. */
struct bench {
    const char *group, *name[2], *path[2], *setting;
    int steps, repeats;
    bool quick;
};

#define ORDERS(file)                                        \
    {                                                       \
        CASES file ".yaml", CASES file "-second-order.yaml" \
    }
static const struct bench benches[] = {
    {"line", {"1-D fluid"}, ORDERS("line-fluid"), NULL, 60, REPEATS, true},
    {"line", {"1-D solid"}, ORDERS("line-solid"), NULL, 150, REPEATS, true},
    {"plane", {"2-D fluid"}, ORDERS("plane-fluid"), NULL, 60, REPEATS, true},
    {"plane", {"2-D solid"}, ORDERS("plane-solid"), NULL, 60, REPEATS, true},
    {"space", {"3-D fluid"}, ORDERS("space-fluid"), NULL, 30, REPEATS, true},
    {"space", {"3-D solid"}, ORDERS("space-solid"), NULL, 30, REPEATS, true},
    {"size", {"3-D solid 1e4"}, ORDERS("space-solid"), "let.n=22", 120, REPEATS, true},
    {"size", {"3-D solid 1e6"}, ORDERS("space-solid"), "let.n=100", 30, 1, false},
    {"size", {"3-D solid, 4e6"}, ORDERS("space-solid"), "let.n=158", 30, 1, false},
    {"sparse",
     {"two cubes together", "two cubes far apart"},
     {CASES "sparse-together.yaml", CASES "sparse.yaml"},
     NULL,
     20,
     REPEATS,
     true},
};

/* Both cases of BENCH with one thread and with two, REPEATS times. */
static void run_bench(const struct bench *bench, int repeats, FILE *csv)
{
    struct measured m[VARIANTS][REPEATS];
    struct run run[VARIANTS];
    for (int v = 0; v < VARIANTS; v++)
        run[v] = (struct run){bench->path[v % 2], bench->setting, bench->steps, 1 + v / 2};
    for (int repeat = 0; repeat < repeats; repeat++)
        for (int v = 0; v < VARIANTS; v++)
            m[v][repeat] = measure(&run[v]);
    for (int v = 0; v < VARIANTS; v++)
        qsort(m[v], (size_t)repeats, sizeof m[v][0], by_rate);
    const bool orders = !bench->name[1];
    for (int v = 0; v < VARIANTS; v++) {
        const struct measured *median = &m[v][repeats / 2];
        const double base = m[v - v % 2][repeats / 2].rate, alone = m[v % 2][repeats / 2].rate;
        const char *name = bench->name[orders ? 0 : v % 2];
        const char *order = orders && v % 2 == 0 ? "first" : "second";
        char ratio[32] = "", both[32] = "";
        if (v % 2)
            snprintf(ratio, sizeof ratio, "%.2f %s", median->rate / base,
                     orders ? "x first" : "x together");
        if (v / 2)
            snprintf(both, sizeof both, "%.2f x 1 thread", median->rate / alone);
        print_row(name, order, run[v].threads, median, v / 2 ? both : ratio);
        write_csv(csv, name, order, &run[v], m[v], repeats);
    }
}

static bool wanted(const struct bench *bench, bool quick, char **groups, int count)
{
    for (int k = 0; k < count; k++)
        if (!strcmp(groups[k], bench->group) || !strcmp(groups[k], bench->name[0]))
            return true;
    return count == 0 && (bench->quick || !quick);
}

int main(int argc, char **argv)
{
    bool quick = false;
    FILE *csv = NULL;
    int next = 1;
    for (; next < argc && argv[next][0] == '-'; next++) {
        if (!strcmp(argv[next], "--quick"))
            quick = true;
        else if (!strcmp(argv[next], "--csv") && next + 1 < argc)
            csv = open_csv(argv[++next]);
        else {
            fprintf(stderr, "bench_step: what is %s?\n", argv[next]);
            return ERROR_INPUT;
        }
    }
    print_head();
    if (next < argc && strstr(argv[next], ".yaml")) {
        const char *slash = strrchr(argv[next], '/');
        struct run run = {argv[next], argc > next + 1 ? argv[next + 1] : NULL,
                          argc > next + 2 ? atoi(argv[next + 2]) : 50,
                          argc > next + 3 ? atoi(argv[next + 3]) : 1};
        struct measured m = measure(&run);
        print_row(slash ? slash + 1 : argv[next], "", run.threads, &m, "");
        printf("hash %016llx\n", (unsigned long long)m.hash);
        return 0;
    }
    for (size_t k = 0; k < COUNT_OF(benches); k++)
        if (wanted(&benches[k], quick, argv + next, argc - next))
            run_bench(&benches[k], quick ? 1 : benches[k].repeats, csv);
    if (csv)
        fclose(csv);
    return 0;
}
