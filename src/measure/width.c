/* width: how many particles stand in a front, between 10 and 90 % of its jump. Source of the
 * measure: the comparison of schemes by their widths in Wang, Chen and Huang (2024). */
#include "measure/measure.h"

const struct parameter measure_width_table[] = {
    PARAMETER(TEXT, struct measure_width, field, REQUIRED,
              "the field that jumps: pressure, stress.xx"),
    PARAMETER(QUANTITY, struct measure_width, ahead, REQUIRED, "its value ahead of the front"),
    PARAMETER(QUANTITY, struct measure_width, behind, REQUIRED, "its value behind the front"),
    PARAMETER_END,
};

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_width *width = measurement->check->measure.value;
    struct unit parsed;
    TRY(measure_field_unit(measurement, unit));
    TRY(unit_parse(*unit, &parsed));
    if (!dimension_equal(parsed.dimension, width->ahead.dimension) ||
        !dimension_equal(parsed.dimension, width->behind.dimension))
        return measure_error(measurement, "`ahead` and `behind` must be in %s, as %s is",
                             **unit ? *unit : "plain numbers", width->field);
    if (width->ahead.value == width->behind.value)
        return measure_error(measurement, "`ahead` and `behind` are the same: there is no front");
    *unit = "";
    return NULL;
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_width *width = measurement->check->measure.value;
    double jump = width->behind.value - width->ahead.value;
    struct samples samples;
    TRY(samples_take(measurement, &samples));
    int64_t inside = 0, lost = 0;
    for (int64_t i = 0; i < samples.count; i++) {
        double share = (samples.at[i].value - width->ahead.value) / jump;
        inside += share > 0.1 && share < 0.9;
        lost += !isfinite(share);
    }
    const struct ranks *ranks = measurement->simulation->ranks;
    inside = ranks_sum(ranks, inside);
    *value =
        ranks_sum(ranks, lost) ? measure_nothing(measurement, NOTHING_NOT_FINITE) : (double)inside;
    samples_free(&samples);
    return NULL;
}

const struct measure_class measure_width = {.of_field = true, .unit = unit, .measure = measure};
