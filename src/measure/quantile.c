/* quantile: the value that a fraction of the particles does not exceed, by number, mass or volume.
 * Unlike the maximum it converges where single particles are thrown out. */
#include <string.h>

#include "measure/measure.h"

const struct parameter measure_quantile_table[] = {
    PARAMETER_AS(
        "field", TEXT, struct measure_quantile, of.field, REQUIRED,
        "a field of the particles, or one component of it: pressure, velocity.x, stress.xx"),
    PARAMETER(NUMBER, struct measure_quantile, fraction, REQUIRED,
              "the fraction of the particles whose values are at most the result; 0.5: the median",
              .below = 1.0, .closed = true),
    PARAMETER(CHOICE, struct measure_quantile, weight, "number",
              "what each particle or cell counts by", .names = weight_names),
    PARAMETER_END,
};

/* Numbers in the order of the values, and back; no two values have the same. */
static uint64_t rank_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits >> 63 ? ~bits : bits | UINT64_C(1) << 63;
}

static double value_of(uint64_t rank)
{
    const uint64_t bits = rank >> 63 ? rank & ~(UINT64_C(1) << 63) : ~rank;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Collective: the weight of the samples that are LIMIT at most. */
static double weight_within(const struct ranks *ranks, const struct samples *samples, int weight,
                            double limit)
{
    struct exact_sum sum = {0};
    for (int64_t i = 0; i < samples->count; i++)
        if (samples->at[i].value <= limit)
            exact_sum_add(&sum, sample_weight(&samples->at[i], weight));
    ranks_sum_exact(ranks, &sum, 1);
    return exact_sum_value(&sum);
}

/* Bisects: the least value that enough samples do not exceed is one of theirs. */
static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_quantile *quantile = measurement->check->measure.value;
    const struct ranks *ranks = measurement->simulation->ranks;
    struct samples samples;
    TRY(samples_take(measurement, &samples));
    int64_t lost = 0;
    for (int64_t i = 0; i < samples.count; i++)
        lost += !isfinite(samples.at[i].value);
    lost = ranks_sum(ranks, lost);
    const int64_t count = ranks_sum(ranks, samples.count);
    const double all = weight_within(ranks, &samples, quantile->weight, INFINITY);
    uint64_t low = rank_of(-INFINITY), high = rank_of(INFINITY);
    while (low < high) {
        const uint64_t middle = low + (high - low) / 2;
        if (weight_within(ranks, &samples, quantile->weight, value_of(middle)) >=
            quantile->fraction * all)
            high = middle;
        else
            low = middle + 1;
    }
    *value = count == 0  ? measure_nothing(measurement, NOTHING_NO_MEMBER)
             : lost == 0 ? value_of(low)
                         : measure_nothing(measurement, NOTHING_NOT_FINITE);
    samples_free(&samples);
    return NULL;
}

const struct measure_class measure_quantile = {
    .of_field = true, .unit = measure_field_unit, .measure = measure};
