/* minimum, maximum: the extremes of a field; they have none where a value is not finite.
 * finite: how many values are not finite numbers. */
#include "measure/measure.h"

static struct error *extreme(const struct measurement *measurement, double sign, double *value)
{
    struct samples samples;
    TRY(samples_take(measurement, &samples));
    double largest = -INFINITY;
    int64_t lost = 0;
    for (int64_t i = 0; i < samples.count; i++) {
        largest = maximum(largest, sign * samples.at[i].value);
        lost += !isfinite(samples.at[i].value);
    }
    const struct ranks *ranks = measurement->simulation->ranks;
    int64_t count = ranks_sum(ranks, samples.count);
    lost = ranks_sum(ranks, lost);
    largest = ranks_maximum(ranks, largest);
    *value = count == 0  ? measure_nothing(measurement, NOTHING_NO_MEMBER)
             : lost == 0 ? sign * largest
                         : measure_nothing(measurement, NOTHING_NOT_FINITE);
    samples_free(&samples);
    return NULL;
}

static struct error *smallest(const struct measurement *measurement, double *value)
{
    return extreme(measurement, -1.0, value);
}

static struct error *largest(const struct measurement *measurement, double *value)
{
    return extreme(measurement, 1.0, value);
}

static struct error *not_finite(const struct measurement *measurement, double *value)
{
    struct samples samples;
    TRY(samples_take(measurement, &samples));
    int64_t lost = 0;
    for (int64_t i = 0; i < samples.count; i++)
        lost += !isfinite(samples.at[i].value);
    *value = (double)ranks_sum(measurement->simulation->ranks, lost);
    samples_free(&samples);
    return NULL;
}

const struct measure_class measure_minimum = {
    .of_field = true, .unit = measure_field_unit, .measure = smallest};
const struct measure_class measure_maximum = {
    .of_field = true, .unit = measure_field_unit, .measure = largest};
const struct measure_class measure_finite = {
    .of_field = true, .unit = measure_no_unit, .measure = not_finite};
