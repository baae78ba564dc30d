/* spread: the standard deviation of a field over particles, each counting once. */
#include "measure/measure.h"

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct ranks *ranks = measurement->simulation->ranks;
    struct samples samples;
    TRY(samples_take(measurement, &samples));
    struct exact_sum sum = {0}, squares = {0};
    for (int64_t i = 0; i < samples.count; i++)
        exact_sum_add(&sum, samples.at[i].value);
    ranks_sum_exact(ranks, &sum, 1);
    const double count = (double)ranks_sum(ranks, samples.count);
    const double mean = exact_sum_value(&sum) / count;
    for (int64_t i = 0; i < samples.count; i++)
        exact_sum_add(&squares, square(samples.at[i].value - mean));
    ranks_sum_exact(ranks, &squares, 1);
    *value = count > 0.0 ? sqrt(exact_sum_value(&squares) / count)
                         : measure_nothing(measurement, NOTHING_NO_MEMBER);
    samples_free(&samples);
    return NULL;
}

const struct measure_class measure_spread = {
    .of_field = true, .unit = measure_field_unit, .measure = measure};
