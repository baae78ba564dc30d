/* mean: the mean of a field over particles, each counting once. The sum is exact, so that the mean
 * is the same for any order of the particles. */
#include "measure/measure.h"

static struct error *measure(const struct measurement *measurement, double *value)
{
    struct samples samples;
    TRY(samples_take(measurement, &samples));
    struct exact_sum sum = {0};
    for (int64_t i = 0; i < samples.count; i++)
        exact_sum_add(&sum, samples.at[i].value);
    const struct ranks *ranks = measurement->simulation->ranks;
    int64_t count = ranks_sum(ranks, samples.count);
    ranks_sum_exact(ranks, &sum, 1);
    *value = count > 0 ? exact_sum_value(&sum) / (double)count
                       : measure_nothing(measurement, NOTHING_NO_MEMBER);
    samples_free(&samples);
    return NULL;
}

const struct measure_class measure_mean = {
    .of_field = true, .unit = measure_field_unit, .measure = measure};
