/* total: a sum over the particles of a body or of all.
 * decay: the rate at which a total falls, ln(Q(0)/Q(t))/t: that of an exponential through both. */
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
    {.key = "quantity",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct measure_total, quantity),
     .standard = PARAMETER_REQUIRED,
     .names = quantity_names,
     .help = "the quantity that is summed; angular momentum is about the origin, volume is mass "
             "over density"},
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

static struct error *total(const struct measurement *measurement, double *value)
{
    const struct measure_total *parameters = measurement->check->measure.value;
    const struct simulation *simulation = measurement->simulation;
    const struct totals totals =
        population_totals(*measurement->population, simulation->ranks, measure_body(measurement));
    *value = parameters->quantity == TOTAL_KINETIC    ? totals.kinetic
             : parameters->quantity == TOTAL_INTERNAL ? totals.internal
             : parameters->quantity == TOTAL_VOLUME
                 ? volume_of(simulation->ranks, measurement->population, measure_body(measurement))
                 : totals.entry[parameters->quantity];
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

const struct measure_class measure_total = {
    .unit = total_unit, .measure = total, .of_bodies = true};
const struct measure_class measure_decay = {
    .unit = decay_unit, .measure = decay, .of_bodies = true, .start = total};
