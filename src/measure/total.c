/* total: a sum over the particles of a body or of all, or of those among them that are `between`.
 * decay: the rate at which a total falls, ln(Q(0)/Q(t))/t: that of an exponential through both. */
#include <stdlib.h>

#include "base/memory.h"
#include "measure/measure.h"

/* The order of enum ledger_entry, then what is no entry of the ledger. */
enum { TOTAL_KINETIC = LEDGER_ENTRIES, TOTAL_INTERNAL, TOTAL_VOLUME };
static const char *const quantity_names[] = {"mass",
                                             "momentum.x",
                                             "momentum.y",
                                             "momentum.z",
                                             "angular_momentum.x",
                                             "angular_momentum.y",
                                             "angular_momentum.z",
                                             "energy",
                                             "kinetic_energy",
                                             "internal_energy",
                                             "volume",
                                             NULL};

const struct parameter measure_total_table[] = {
    PARAMETER(CHOICE, struct measure_total, quantity, REQUIRED,
              "the quantity that is summed; angular momentum is about the origin, volume is mass "
              "over density",
              .names = quantity_names),
    PARAMETER_END,
};

static struct error *total_unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_total *parameters = measurement->check->measure.value;
    const int entry = parameters->quantity;
    static const char *const volumes[] = {"m", "m^2", "m^3"};
    const struct simulation *simulation = measurement->simulation;
    const int dimension =
        simulation->problem->dimension + geometry_power(simulation->problem->geometry);
    *unit = entry == TOTAL_VOLUME
                ? volumes[dimension - 1]
                : ledger_unit(entry < LEDGER_ENTRIES ? (enum ledger_entry)entry : LEDGER_ENERGY,
                              measurement->simulation->problem->dimension,
                              measurement->simulation->problem->geometry);
    return NULL;
}

/* The sum is exact, so that it is the same for any order of the particles. */
static double volume_of(const struct ranks *ranks, const struct population *p, int body)
{
    struct exact_sum sum = {0};
    for (int32_t i = 0; i < p->count; i++)
        if (population_has(p, i) && (body < 0 || p->body[i] == body))
            exact_sum_add(&sum, p->mass[i] / p->density[i]);
    ranks_sum_exact(ranks, &sum, 1);
    return exact_sum_value(&sum);
}

/* Of the members of BODY in POPULATION. */
static double sum_of(const struct measurement *measurement, const struct population *population,
                     int body)
{
    const struct measure_total *parameters = measurement->check->measure.value;
    const struct ranks *ranks = measurement->simulation->ranks;
    const struct totals totals = population_totals(*population, ranks, body);
    return parameters->quantity == TOTAL_KINETIC    ? totals.kinetic
           : parameters->quantity == TOTAL_INTERNAL ? totals.internal
           : parameters->quantity == TOTAL_VOLUME   ? volume_of(ranks, population, body)
                                                    : totals.entry[parameters->quantity];
}

static struct error *total(const struct measurement *measurement, double *value)
{
    const int body = measure_body(measurement);
    struct population population = *measurement->population;
    *value = NAN;
    if (!measurement->check->between.count) {
        *value = sum_of(measurement, &population, body);
        return NULL;
    }
    uint16_t *other = memory_allocate(((size_t)population.count + 1) * sizeof *other);
    TRY(ranks_agree(measurement->simulation->ranks, other ? NULL : out_of_memory_for("a total")));
    assert(other);
    for (int32_t i = 0; i < population.count; i++)
        other[i] = !measure_takes(measurement, body, i);
    population.body = other;
    *value = sum_of(measurement, &population, 0);
    free(other);
    return NULL;
}

static struct error *decay_unit(const struct measurement *measurement, const char **unit)
{
    (void)measurement;
    *unit = "1/s";
    return NULL;
}

static struct error *decay(const struct measurement *measurement, double *value)
{
    double now;
    TRY(total(measurement, &now));
    *value = log(measurement->at_start / now) / measurement->simulation->time;
    return NULL;
}

const struct measure_class measure_total = {.unit = total_unit, .measure = total};
const struct measure_class measure_decay = {
    .unit = decay_unit, .measure = decay, .of_bodies = true, .start = total};
