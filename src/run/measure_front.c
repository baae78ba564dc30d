/* front: the place where a field first crosses a value, seen from one end. The field is linear
 * between particles sorted along the axis, or, in a plane or in space, between the means of
 * slabs. */
#include "run/measure.h"

const struct parameter measure_front_table[] = {
    {.key = "field",
     .kind = PARAMETER_TEXT,
     .offset = offsetof(struct measure_front, field),
     .standard = PARAMETER_REQUIRED,
     .help = "the field whose front is sought: pressure, stress.xx"},
    {.key = "value",
     .kind = PARAMETER_QUANTITY,
     .offset = offsetof(struct measure_front, value),
     .standard = PARAMETER_REQUIRED,
     .help = "value of the field at the front"},
    {.key = "from",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct measure_front, from),
     .standard = "high",
     .names = (const char *const[]){"low", "high", NULL},
     .help = "the end of the axis from which the front is sought"},
    {.key = "slab",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct measure_front, slab),
     .unit = "m",
     .standard = "0 m",
     .below = INFINITY,
     .closed = true,
     .help = "thickness of the slabs over which particles are averaged first; 0: none"},
    PARAMETER_END,
};

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_front *front = measurement->check->measure.value;
    const char *field_unit;
    struct unit parsed;
    TRY(measure_field_unit(measurement, &field_unit));
    TRY(unit_parse(field_unit, &parsed));
    if (!dimension_equal(parsed.dimension, front->value.dimension))
        return measure_error(measurement, "`value` must be in %s, as %s is",
                             field_unit[0] ? field_unit : "plain numbers", front->field);
    *unit = "m";
    return NULL;
}

/* Replaces the sorted samples by one a slab, at the mean place with the mean value. */
static void average_slabs(struct samples *samples, double thickness)
{
    int64_t slabs = 0;
    for (int64_t i = 0; i < samples->count;) {
        double slab = floor(samples->at[i].at / thickness), at = 0.0, value = 0.0;
        int64_t first = i;
        for (; i < samples->count && floor(samples->at[i].at / thickness) == slab; i++) {
            at += samples->at[i].at;
            value += samples->at[i].value;
        }
        samples->at[slabs].at = at / (double)(i - first);
        samples->at[slabs++].value = value / (double)(i - first);
    }
    samples->count = slabs;
}

static double crossing(const struct samples *samples, const struct measure_front *front)
{
    int64_t n = samples->count;
    bool high = front->from == FRONT_FROM_HIGH;
    for (int64_t k = 1; k < n; k++) {
        const struct sample *a = &samples->at[high ? n - k : k - 1];
        const struct sample *b = &samples->at[high ? n - k - 1 : k];
        double before = a->value - front->value.value, after = b->value - front->value.value;
        if (before == 0.0)
            return a->at;
        if ((before < 0.0) != (after < 0.0))
            return a->at + (b->at - a->at) * (before / (before - after));
    }
    return NAN;
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_front *front = measurement->check->measure.value;
    struct samples samples;
    TRY(samples_take(measurement, &samples));
    samples_sort(&samples);
    if (front->slab > 0.0)
        average_slabs(&samples, front->slab);
    *value = crossing(&samples, front);
    samples_free(&samples);
    return NULL;
}

const struct measure_class measure_front = {.of_field = true, .unit = unit, .measure = measure};
