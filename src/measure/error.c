/* l1, rms, max_error: how far a field is from the exact solution, over a scale f:
 *   l1 = sum V_i |f_i - f_exact(x_i)| / (V f),
 *   rms = sqrt(sum V_i (f_i - f_exact(x_i))^2 / V) / f,
 * with V_i = m_i/rho_i and V their sum, the length of the sample in 1-D. The exact state is that of
 * the member's own side of the contact (measure_side). Without `scale`, f is the range of the exact
 * values. */
#include "measure/measure.h"

struct distance {
    double l1, rms, largest;
};

/* Exact value for a sample, NAN outside the solution's fields. */
static double exact_value(const struct measurement *measurement, const struct sample *sample)
{
    const struct measure_field *parameters = measurement->check->measure.value;
    struct exact_state state =
        measurement->exact->sample(measurement->solved, measure_side(measurement, sample),
                                   sample->at, measurement->simulation->time);
    return exact_field(&state, parameters->field);
}

static struct error *measure_distance(const struct measurement *measurement,
                                      struct distance *distance)
{
    struct samples samples;
    TRY(samples_take(measurement, &samples));
    struct exact_sum sums[3] = {{{0}, 0, false}};
    double largest = 0.0, low = INFINITY, high = -INFINITY;
    for (int64_t i = 0; i < samples.count; i++) {
        const struct sample *sample = &samples.at[i];
        double exact = exact_value(measurement, sample), off = fabs(sample->value - exact);
        exact_sum_add(&sums[0], sample->volume);
        exact_sum_add(&sums[1], sample->volume * off);
        exact_sum_add(&sums[2], sample->volume * off * off);
        largest = maximum(largest, off);
        low = minimum(low, exact);
        high = maximum(high, exact);
    }
    samples_free(&samples);
    const struct ranks *ranks = measurement->simulation->ranks;
    ranks_sum_exact(ranks, sums, 3);
    largest = ranks_maximum(ranks, largest);
    double range = ranks_maximum(ranks, high) - ranks_minimum(ranks, low);
    double given = measurement->check->scale.value;
    double scale = isnan(given) ? range : fabs(given);
    double volume = exact_sum_value(&sums[0]), l1 = exact_sum_value(&sums[1]) / volume;
    distance->l1 = l1 / scale;
    distance->rms = sqrt(exact_sum_value(&sums[2]) / volume) / scale;
    distance->largest = isnan(l1) ? NAN : largest / scale;
    if (volume == 0.0)
        measure_nothing(measurement, NOTHING_NO_MEMBER);
    else if (scale == 0.0)
        measure_nothing(measurement, NOTHING_NO_RANGE);
    return NULL;
}

static struct error *l1(const struct measurement *measurement, double *value)
{
    struct distance distance;
    TRY(measure_distance(measurement, &distance));
    *value = distance.l1;
    return NULL;
}

static struct error *rms(const struct measurement *measurement, double *value)
{
    struct distance distance;
    TRY(measure_distance(measurement, &distance));
    *value = distance.rms;
    return NULL;
}

static struct error *max_error(const struct measurement *measurement, double *value)
{
    struct distance distance;
    TRY(measure_distance(measurement, &distance));
    *value = distance.largest;
    return NULL;
}

const struct measure_class measure_l1 = {
    .needs_exact = true, .of_field = true, .unit = measure_no_unit, .measure = l1};
const struct measure_class measure_rms = {
    .needs_exact = true, .of_field = true, .unit = measure_no_unit, .measure = rms};
const struct measure_class measure_max_error = {
    .needs_exact = true, .of_field = true, .unit = measure_no_unit, .measure = max_error};
