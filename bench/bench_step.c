/* The speed of whole steps, neighbour rows built as they fall: particle updates a second,
 * nanoseconds a pair, bytes a particle, and what share each phase takes. First order beside second,
 * one thread beside two; the median of repeats that take turns, so that what disturbs the machine
 * disturbs all alike.
 *
 * Usage: bench_step [--quick] [--csv FILE] [line|plane|space|size|sparse|NAME OF A CASE]...
 *        bench_step CASE.yaml [let.n=VALUE [STEPS [THREADS]]] */
#include "bench.h"

#include "model/particles/population.h"
#include "sph/lanes.h"
#include "sph/scheme.h"

enum { VARIANTS = 4, PHASES = 6, STEPS = 50 };

static const struct bench_phase phases[PHASES] = {{"neighbour search", "neighbours"},
                                                  {"gather", "records"},
                                                  {"pairs", "pairs"},
                                                  {"pair sums", "sums"},
                                                  {"time step", "limit"},
                                                  {"state update", "points"}};

struct measured_sph {
    struct measured all;
    double pairs, seconds_a_pair;   /* neighbours within support of one particle; wall-clock */
    double state_bytes, list_bytes; /* a particle */
    double steps_a_build;
};

/* Neighbours within support, summed over all particles. */
static int64_t count_pairs(const struct sph *sph, const struct simulation *simulation)
{
    const double *place = sph->places ? sph->place : sph->record;
    const size_t stride = sph->places ? PLACE_STRIDE : sph->stride;
    const int d = record_diameter(simulation->problem->dimension);
    int64_t pairs = 0;
    for (int32_t i = 0; i < sph->particles->count; i++) {
        const uint32_t *entry = neighbours_row(&sph->neighbours, i);
        const double *own = place + (size_t)i * stride;
        for (uint32_t k = 0; k < sph->neighbours.row[i].count; k++) {
            const double *other = place + (size_t)(entry[k] & ENTRY_INDEX) * stride;
            double sum = 0.0;
            for (int axis = 0; axis < simulation->problem->dimension; axis++)
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

static struct measured_sph measure(const struct run *run)
{
    struct started s = start(run); /* the first build is not counted */
    const struct sph *sph = s.solver;
    const int64_t builds = sph->neighbours.builds;
    const double seconds = take_steps(&s, run->steps),
                 count = (double)simulation_members(s.simulation);
    const double pairs = (double)count_pairs(sph, s.simulation);
    const struct measured_sph m = {
        .all = measured_of(&s, run->steps, seconds, phases, PHASES),
        .pairs = pairs / count,
        .seconds_a_pair = seconds / (pairs * run->steps),
        .state_bytes = state_bytes(sph, sph->particles),
        .list_bytes = (double)neighbours_bytes(&sph->neighbours) / count,
        .steps_a_build = (double)run->steps / (double)(sph->neighbours.builds - builds),
    };
    finish(&s);
    return m;
}

/* Prints what stands in every row; RATIO in words, of this row to another. */
static void print_row(const char *name, const char *order, int threads,
                      const struct measured_sph *m, const char *ratio)
{
    printf("%-22s %-6s %8d %7d %8.3f %-15s %7.1f %7.2f %6.0f %6.0f %7.1f ", name, order,
           m->all.particles, threads, 1e-6 * m->all.rate, ratio, m->pairs, 1e9 * m->seconds_a_pair,
           m->state_bytes, m->list_bytes, m->steps_a_build);
    print_shares(&m->all, PHASES, 6);
}

static void print_head(void)
{
    printf("%-22s %-6s %8s %7s %8s %-15s %7s %7s %6s %6s %7s ", "", "", "", "", "M upd.", "",
           "neigh-", "ns a", "bytes:", "", "steps");
    printf("%6s %6s %6s %6s %6s %6s\n", "neigh-", "", "", "", "", "");
    printf("%-22s %-6s %8s %7s %8s %-15s %7s %7s %6s %6s %7s ", "case", "order", "partic.",
           "threads", "a second", "ratio", "bours", "pair", "state", "list", "a build");
    printf("%6s %6s %6s %6s %6s %6s\n", "bours", "records", "pairs", "sums", "limit", "points");
}

/* Cases side by side: the two orders of one, or the two of group "sparse", which compares two cases
 * of one order. */
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
    struct measured_sph m[VARIANTS][REPEATS];
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
        const struct measured_sph *median = &m[v][repeats / 2];
        const double base = m[v - v % 2][repeats / 2].all.rate,
                     alone = m[v % 2][repeats / 2].all.rate;
        const char *name = bench->name[orders ? 0 : v % 2];
        const char *order = orders && v % 2 == 0 ? "first" : "second";
        char ratio[32] = "", both[32] = "", labels[64], numbers[128];
        if (v % 2)
            snprintf(ratio, sizeof ratio, "%.2f %s", median->all.rate / base,
                     orders ? "x first" : "x together");
        if (v / 2)
            snprintf(both, sizeof both, "%.2f x 1 thread", median->all.rate / alone);
        print_row(name, order, run[v].threads, median, v / 2 ? both : ratio);
        snprintf(labels, sizeof labels, "%s,%s", name, order);
        snprintf(numbers, sizeof numbers, "%.2f,%.3f,%.0f,%.0f,%.1f", median->pairs,
                 1e9 * median->seconds_a_pair, median->state_bytes, median->list_bytes,
                 median->steps_a_build);
        write_csv(csv, labels, &run[v], repeats, &median->all, m[v][0].all.rate,
                  m[v][repeats - 1].all.rate, numbers, PHASES);
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
    const struct wishes wishes = wishes_of(argc, argv);
    struct run run = {.steps = STEPS};
    print_head();
    if (own_case(argc - wishes.next, argv + wishes.next, &run)) {
        const struct measured_sph m = measure(&run);
        print_row(name_of(run.path), "", run.threads, &m, "");
        printf("hash %016llx\n", (unsigned long long)m.all.hash);
        return 0;
    }
    FILE *csv = wishes.csv ? open_csv(wishes.csv, "case,order",
                                      "neighbours,ns_per_pair,bytes_state,bytes_list,"
                                      "steps_per_build",
                                      phases, PHASES)
                           : NULL;
    for (size_t k = 0; k < COUNT_OF(benches); k++)
        if (wanted(&benches[k], wishes.quick, argv + wishes.next, argc - wishes.next))
            run_bench(&benches[k], wishes.quick ? 1 : benches[k].repeats, csv);
    if (csv)
        fclose(csv);
    return 0;
}
