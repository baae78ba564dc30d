/* The ledger and the totals that it is compared with: exact sums, so that a balance does not depend
 * on the order of particles, threads or ranks. Blocks of cells are the same on any number of ranks:
 * what their cells have is summed by halves, and only the sums of blocks exactly. */
#include "model/ledger.h"

#include <string.h>

#include "grid/cell_blocks.h"
#include "parallel/exact_block.h"

static const char *const cause_names[LEDGER_CAUSES] = {
    [LEDGER_WALLS] = "walls",      [LEDGER_AXIS] = "axis",       [LEDGER_PISTONS] = "pistons",
    [LEDGER_GRAVITY] = "gravity",  [LEDGER_LOADS] = "loads",     [LEDGER_OUTFLOWS] = "outflows",
    [LEDGER_REMOVED] = "removed",  [LEDGER_DAMPING] = "damping", [LEDGER_AFTERBURN] = "afterburn",
    [LEDGER_EXCHANGE] = "exchange"};

/* Behind the entries of the ledger, what else population_totals sums. */
enum { TOTAL_KINETIC = LEDGER_ENTRIES, TOTAL_INTERNAL, TOTAL_MOMENTUM_SCALE, TOTALS };

const char *ledger_cause_name(enum ledger_cause cause) { return cause_names[cause]; }

/* Names of the entries, and their units in 1-D, 2-D and 3-D, then by geometry. */
static const struct {
    const char *name, *unit[6];
} entries[LEDGER_ENTRIES] = {
    [LEDGER_MASS] = {"mass", {"kg/m^2", "kg/m", "kg", "kg/rad", "kg/(m*rad)", "kg/sr"}},
    [LEDGER_MOMENTUM_X] = {"momentum.x",
                           {"kg/(m*s)", "kg/s", "kg*m/s", "kg*m/(rad*s)", "kg/(rad*s)",
                            "kg*m/(s*sr)"}},
    [LEDGER_MOMENTUM_Y] = {"momentum.y",
                           {"kg/(m*s)", "kg/s", "kg*m/s", "kg*m/(rad*s)", "kg/(rad*s)",
                            "kg*m/(s*sr)"}},
    [LEDGER_MOMENTUM_Z] = {"momentum.z",
                           {"kg/(m*s)", "kg/s", "kg*m/s", "kg*m/(rad*s)", "kg/(rad*s)",
                            "kg*m/(s*sr)"}},
    [LEDGER_ANGULAR_X] = {"angular_momentum.x",
                          {"kg/s", "kg*m/s", "kg*m^2/s", "kg*m^2/(rad*s)", "kg*m/(rad*s)",
                           "kg*m^2/(s*sr)"}},
    [LEDGER_ANGULAR_Y] = {"angular_momentum.y",
                          {"kg/s", "kg*m/s", "kg*m^2/s", "kg*m^2/(rad*s)", "kg*m/(rad*s)",
                           "kg*m^2/(s*sr)"}},
    [LEDGER_ANGULAR_Z] = {"angular_momentum.z",
                          {"kg/s", "kg*m/s", "kg*m^2/s", "kg*m^2/(rad*s)", "kg*m/(rad*s)",
                           "kg*m^2/(s*sr)"}},
    [LEDGER_ENERGY] = {"energy", {"J/m^2", "J/m", "J", "J/rad", "J/(m*rad)", "J/sr"}},
};

const char *ledger_entry_name(enum ledger_entry entry) { return entries[entry].name; }

const char *ledger_unit(enum ledger_entry entry, int dimension, enum case_geometry geometry)
{
    const int round = geometry - GEOMETRY_AXISYMMETRIC; /* at least 0 where x is a radius */
    return entries[entry].unit[round >= 0 ? 3 + round : dimension - 1];
}

static void add_vector(struct exact_sum *sums, struct vec3 value)
{
    exact_sum_add(&sums[0], value.x);
    exact_sum_add(&sums[1], value.y);
    exact_sum_add(&sums[2], value.z);
}

void ledger_book(struct ledger *ledger, enum ledger_cause cause, double mass, struct vec3 momentum,
                 struct vec3 position, double energy)
{
    struct exact_sum *sums = ledger->sum[cause];
    exact_sum_add(&sums[LEDGER_MASS], mass);
    add_vector(&sums[LEDGER_MOMENTUM_X], momentum);
    add_vector(&sums[LEDGER_ANGULAR_X], vec3_cross(position, momentum));
    exact_sum_add(&sums[LEDGER_ENERGY], energy);
}

void ledger_join(struct ledger *ledger, const struct ledger *other)
{
    for (int cause = 0; cause < LEDGER_CAUSES; cause++)
        for (int entry = 0; entry < LEDGER_ENTRIES; entry++)
            exact_sum_join(&ledger->sum[cause][entry], &other->sum[cause][entry]);
}

struct totals ledger_totals(const struct ledger *ledger, const struct ranks *ranks,
                            enum ledger_cause cause)
{
    struct exact_sum sums[LEDGER_ENTRIES] = {0};
    for (int each = 0; each < LEDGER_CAUSES; each++)
        for (int entry = 0;
             entry < LEDGER_ENTRIES && (cause == LEDGER_CAUSES || (int)cause == each); entry++)
            exact_sum_join(&sums[entry], &ledger->sum[each][entry]);
    ranks_sum_exact(ranks, sums, LEDGER_ENTRIES);
    struct totals totals = {0};
    for (int entry = 0; entry < LEDGER_ENTRIES; entry++)
        totals.entry[entry] = exact_sum_value(&sums[entry]);
    return totals;
}

/* What members have, MEMBERS of them at a time. */
enum { MEMBERS = 256 };
struct own_totals {
    int count;
    bool move; /* some do; else only mass and internal energy are computed, the rest is zero */
    int32_t member[MEMBERS];
    double of[TOTALS][MEMBERS];
};

static void take_motion(const struct population *population, struct own_totals *own)
{
    for (int k = 0; k < own->count; k++) {
        const int32_t i = own->member[k];
        const double *x = population->position[i], *u = population->velocity[i];
        const struct vec3 velocity = vec3_make(u[0], u[1], u[2]);
        const struct vec3 momentum = vec3_scale(population->mass[i], velocity);
        const struct vec3 angular = vec3_cross(vec3_make(x[0], x[1], x[2]), momentum);
        const double speed_square = vec3_dot(velocity, velocity);
        own->of[LEDGER_MOMENTUM_X][k] = momentum.x;
        own->of[LEDGER_MOMENTUM_Y][k] = momentum.y;
        own->of[LEDGER_MOMENTUM_Z][k] = momentum.z;
        own->of[LEDGER_ANGULAR_X][k] = angular.x;
        own->of[LEDGER_ANGULAR_Y][k] = angular.y;
        own->of[LEDGER_ANGULAR_Z][k] = angular.z;
        own->of[TOTAL_KINETIC][k] = 0.5 * population->mass[i] * speed_square;
        own->of[TOTAL_MOMENTUM_SCALE][k] = population->mass[i] * sqrt(speed_square);
    }
}

/* Those FIRST to END - 1 of one BODY, or with -1 of all. */
static void take_members(const struct population *population, int32_t first, int32_t end, int body,
                         struct own_totals *own)
{
    int count = 0;
    own->move = false;
    for (int32_t i = first; i < end; i++) {
        if (body >= 0 && population->body[i] != body)
            continue;
        const double *u = population->velocity[i];
        own->move |= u[0] != 0.0 || u[1] != 0.0 || u[2] != 0.0;
        own->member[count] = i;
        own->of[LEDGER_MASS][count] = population->mass[i];
        own->of[TOTAL_INTERNAL][count++] = population->mass[i] * population->energy[i];
    }
    own->count = count;
    if (own->move)
        take_motion(population, own);
}

/* Whether members have something of an ENTRY to sum. */
static bool has_entry(const struct own_totals *own, int entry)
{
    return own->count && entry != LEDGER_ENERGY &&
           (own->move || entry == LEDGER_MASS || entry == TOTAL_INTERNAL);
}

static int32_t end_of(int32_t first, int32_t end)
{
    return end - first < MEMBERS ? end : first + MEMBERS;
}

static void add_particles(const struct population *population, int32_t first, int body,
                          struct exact_sum sum[TOTALS])
{
    struct own_totals own;
    take_members(population, first, end_of(first, population->count), body, &own);
    for (int entry = 0; entry < TOTALS; entry++)
        if (has_entry(&own, entry))
            exact_sum_add_all(&sum[entry], own.of[entry], own.count);
}

/* The sum of COUNT values, at most MEMBERS, which it overwrites. Its rounding is that of the
 * logarithm of COUNT additions, and what mirrored halves of a block have cancels exactly. */
static double sum_by_halves(double value[MEMBERS], int count)
{
    int half = 1;
    while (half < count)
        half *= 2;
    memset(value + count, 0, (size_t)(half - count) * sizeof *value);
    for (half /= 2; half > 0; half /= 2) {
        double *restrict low = value;
        const double *restrict high = value + half;
        for (int k = 0; k < half; k++)
            low[k] += high[k];
    }
    return value[0];
}

static void add_block(const struct population *population, const struct cell_block *block, int body,
                      struct exact_sum sum[TOTALS])
{
    const int32_t end = block->first + cell_block_cells(block);
    for (int32_t first = block->first; first < end; first += MEMBERS) {
        struct own_totals own;
        take_members(population, first, end_of(first, end), body, &own);
        for (int entry = 0; entry < TOTALS; entry++)
            if (has_entry(&own, entry))
                exact_sum_add(&sum[entry], sum_by_halves(own.of[entry], own.count));
    }
}

struct totals population_totals(struct population population, const struct ranks *ranks, int body)
{
    struct exact_sum sums[TOTALS] = {0};
#pragma omp parallel num_threads(population.threads)
    {
        struct exact_sum sum[TOTALS] = {0};
#pragma omp for schedule(static) nowait
        for (int32_t b = 0; b < population.blocks; b++)
            add_block(&population, &population.block[b], body, sum);
        const int32_t particles = population.block ? 0 : population.count;
#pragma omp for schedule(static)
        for (int32_t first = 0; first < particles; first += MEMBERS)
            add_particles(&population, first, body, sum);
#pragma omp critical(bolide_totals)
        for (int entry = 0; entry < TOTALS; entry++)
            exact_sum_join(&sums[entry], &sum[entry]);
    }
    exact_sum_join(&sums[LEDGER_ENERGY], &sums[TOTAL_KINETIC]);
    exact_sum_join(&sums[LEDGER_ENERGY], &sums[TOTAL_INTERNAL]);
    ranks_sum_exact(ranks, sums, TOTALS);
    struct totals totals = {0};
    for (int entry = 0; entry < LEDGER_ENTRIES; entry++)
        totals.entry[entry] = exact_sum_value(&sums[entry]);
    totals.kinetic = exact_sum_value(&sums[TOTAL_KINETIC]);
    totals.internal = exact_sum_value(&sums[TOTAL_INTERNAL]);
    totals.momentum_scale = exact_sum_value(&sums[TOTAL_MOMENTUM_SCALE]);
    return totals;
}

static double largest_energy(const struct totals *totals)
{
    double parts = maximum(totals->kinetic, fabs(totals->internal));
    return maximum(fabs(totals->entry[LEDGER_ENERGY]), parts);
}

double energy_drift(const struct totals *now, const struct totals *booked,
                    const struct totals *start)
{
    double lost =
        now->entry[LEDGER_ENERGY] - booked->entry[LEDGER_ENERGY] - start->entry[LEDGER_ENERGY];
    double scale = maximum(largest_energy(start), largest_energy(now));
    return lost == 0.0 ? 0.0 : lost / maximum(scale, start->released);
}

/* All ranks show the sum of their ledgers; rank 0 keeps it, or what is loaded. */
struct error *ledger_visit(struct ledger *ledger, const struct ranks *ranks,
                           struct visitor *visitor)
{
    enum { SUMS = LEDGER_CAUSES * LEDGER_ENTRIES };
    ranks_sum_exact(ranks, &ledger->sum[0][0], SUMS);
    TRY(exact_sums_visit(&ledger->sum[0][0], SUMS, "ledger", visitor));
    if (ranks->rank != 0)
        memset(ledger, 0, sizeof *ledger);
    return NULL;
}
