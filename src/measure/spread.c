/* spread: the standard deviation of a field over particles, by number, mass or volume. */
#include "measure/measure.h"

/* The mean of the values, or of the squares of their distances from ABOUT unless that is not a
 * number; not a number where there is no sample. */
static double mean_of(const struct ranks *ranks, const struct samples *samples, int kind,
                      double about)
{
    struct exact_sum sums[2] = {{{0}, 0, false}};
    for (int64_t i = 0; i < samples->count; i++) {
        const double weight = sample_weight(&samples->at[i], kind), value = samples->at[i].value;
        exact_sum_add(&sums[0], weight * (isnan(about) ? value : square(value - about)));
        exact_sum_add(&sums[1], weight);
    }
    ranks_sum_exact(ranks, sums, 2);
    const double total = exact_sum_value(&sums[1]);
    return total > 0.0 ? exact_sum_value(&sums[0]) / total : (double)NAN;
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_weighted *weighted = measurement->check->measure.value;
    const struct ranks *ranks = measurement->simulation->ranks;
    struct samples samples;
    TRY(samples_take(measurement, &samples));
    const int64_t count = ranks_sum(ranks, samples.count);
    const double mean = mean_of(ranks, &samples, weighted->weight, NAN);
    *value = count > 0 ? sqrt(mean_of(ranks, &samples, weighted->weight, mean))
                       : measure_nothing(measurement, NOTHING_NO_MEMBER);
    samples_free(&samples);
    return NULL;
}

const struct measure_class measure_spread = {
    .of_field = true, .unit = measure_field_unit, .measure = measure};
