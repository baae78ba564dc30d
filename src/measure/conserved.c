/* conserved: how far the total of the particles, less what the ledger booked, has moved from its
 * value at the start. Totals are exact sums. */
#include "measure/measure.h"

static const char *const total_names[] = {"mass", "momentum", "angular_momentum", "energy", NULL};

const struct parameter measure_conserved_table[] = {
    PARAMETER(CHOICE, struct measure_conserved, total, REQUIRED,
              "mass, momentum, angular_momentum or energy", .names = total_names),
    PARAMETER_END,
};

/* Length of the change of COUNT entries from FIRST. */
static double change_of(const struct totals *now, const struct totals *booked,
                        const struct totals *start, int first, int count)
{
    double sum = 0.0;
    for (int i = first; i < first + count; i++)
        sum += square(now->entry[i] - booked->entry[i] - start->entry[i]);
    return sqrt(sum);
}

/* Largest distance of a particle from the origin of space. */
static double reach(const struct simulation *simulation)
{
    const struct population population = simulation_population(simulation),
                            *particles = &population;
    double largest = 0.0;
    for (int32_t i = 0; i < particles->count; i++) {
        const double *x = particles->position[i];
        largest = maximum(largest, square(x[0]) + square(x[1]) + square(x[2]));
    }
    return ranks_maximum(simulation->ranks, sqrt(largest));
}

/* A change of nothing is no change, even where there is nothing to measure it by. */
static double relative(double change, double scale) { return change == 0.0 ? 0.0 : change / scale; }

double conserved_change(const struct simulation *simulation, const struct totals *start,
                        enum conserved_total total)
{
    struct totals now = simulation_totals(simulation);
    struct totals booked = ledger_totals(&simulation->ledger, simulation->ranks, LEDGER_CAUSES);
    double motion = maximum(now.momentum_scale, start->momentum_scale), scale;
    switch (total) {
    case CONSERVED_MASS:
        return relative(change_of(&now, &booked, start, LEDGER_MASS, 1),
                        fabs(start->entry[LEDGER_MASS]));
    case CONSERVED_MOMENTUM:
        return relative(change_of(&now, &booked, start, LEDGER_MOMENTUM_X, 3), motion);
    case CONSERVED_ANGULAR_MOMENTUM:
        return relative(change_of(&now, &booked, start, LEDGER_ANGULAR_X, 3),
                        motion * reach(simulation));
    case CONSERVED_ENERGY:
        scale = maximum(fabs(start->entry[LEDGER_ENERGY]), fabs(now.entry[LEDGER_ENERGY]));
        scale = maximum(scale, maximum(start->kinetic, now.kinetic));
        scale = maximum(scale, maximum(fabs(start->internal), fabs(now.internal)));
        return relative(change_of(&now, &booked, start, LEDGER_ENERGY, 1), scale);
    }
    return NAN;
}

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    (void)measurement;
    *unit = "";
    return NULL;
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_conserved *parameters = measurement->check->measure.value;
    *value = conserved_change(measurement->simulation, measurement->start, parameters->total);
    return NULL;
}

const struct measure_class measure_conserved = {.unit = unit, .measure = measure, .of_run = true};
