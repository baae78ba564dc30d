/* mean: the mean of a field over particles, by number, mass or volume. The sums are exact, so that
 * the mean is the same for any order of the particles. */
#include "measure/measure.h"

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_weighted *weighted = measurement->check->measure.value;
    const struct ranks *ranks = measurement->simulation->ranks;
    struct samples samples;
    TRY(samples_take(measurement, &samples));
    struct exact_sum sums[2] = {{{0}, 0, false}}; /* of the values, of the weights */
    for (int64_t i = 0; i < samples.count; i++) {
        const double weight = sample_weight(&samples.at[i], weighted->weight);
        exact_sum_add(&sums[0], weight * samples.at[i].value);
        exact_sum_add(&sums[1], weight);
    }
    ranks_sum_exact(ranks, sums, 2);
    const double total = exact_sum_value(&sums[1]);
    *value = total > 0.0 ? exact_sum_value(&sums[0]) / total
                         : measure_nothing(measurement, NOTHING_NO_MEMBER);
    samples_free(&samples);
    return NULL;
}

const struct measure_class measure_mean = {
    .of_field = true, .unit = measure_field_unit, .measure = measure};
