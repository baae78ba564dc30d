/* front: the place where a field first crosses a value, seen from one end. The field is linear
 * between particles sorted along the axis, or, in a plane or in space, between the means of
 * slabs. The value is given, or half the jump, by which the speed of a shock in porous matter is
 * measured: U_s0 = (x_2 - x_1)/(t_2 - t_1) (3.4), and in the frame of the matter ahead, which moves with
 * U_0, U_s = U_0 - U_s0 (3.5). Source: Parshikov (2013), chapter 3. */
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
     .standard = PARAMETER_OPTIONAL,
     .help = "value of the field at the front"},
    {.key = "half",
     .kind = PARAMETER_FLAG,
     .offset = offsetof(struct measure_front, half),
     .standard = "no",
     .help = "instead of `value`: halfway between the field ahead of the front and the mean of all "
             "that is beyond this"},
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
    {.key = "frame",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct measure_front, frame),
     .unit = "m/s",
     .standard = "0 m/s",
     .help = "velocity along the axis of the frame in which the place is told; that of the matter "
             "ahead gives the speed of a shock relative to it"},
    PARAMETER_END,
};

struct error *front_check(const struct measure_front *front, const char *unit)
{
    struct unit parsed;
    TRY(unit_parse(unit, &parsed));
    if (isnan(front->value.value) != front->half)
        return error_new(ERROR_INPUT, "a front wants `value` or `half: yes`, one of them");
    if (!front->half && !dimension_equal(parsed.dimension, front->value.dimension))
        return error_new(ERROR_INPUT, "`value` must be in %s, as %s is",
                         unit[0] ? unit : "plain numbers", front->field);
    return NULL;
}

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    const char *field_unit;
    TRY(measure_field_unit(measurement, &field_unit));
    *unit = "m";
    return measure_located(measurement, front_check(measurement->check->measure.value, field_unit));
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

/* Sample INDEX, counted from the end at which the search begins. */
static const struct sample *seen(const struct samples *samples, const struct measure_front *front,
                                 int64_t index)
{
    bool high = front->from == FRONT_FROM_HIGH;
    return &samples->at[high ? samples->count - 1 - index : index];
}

static double crossing(const struct samples *samples, const struct measure_front *front,
                       double level)
{
    for (int64_t k = 1; k < samples->count; k++) {
        const struct sample *a = seen(samples, front, k - 1), *b = seen(samples, front, k);
        double before = a->value - level, after = b->value - level;
        if (before == 0.0)
            return a->at;
        if ((before < 0.0) != (after < 0.0))
            return a->at + (b->at - a->at) * (before / (before - after));
    }
    return NAN;
}

/* The mean distance from AHEAD of the values that lie half of JUMP or more beyond it. */
static double mean_beyond(const struct samples *samples, double ahead, double jump)
{
    double sum = 0.0;
    int64_t count = 0;
    for (int64_t k = 0; k < samples->count; k++) {
        double beyond = samples->at[k].value - ahead - 0.5 * jump;
        if (jump > 0.0 ? beyond < 0.0 : beyond > 0.0)
            continue;
        sum += samples->at[k].value - ahead;
        count++;
    }
    return sum / (double)count;
}

/* Half the jump: halfway between the field ahead, that of the first sample seen, and the mean of all
 * that is beyond this level. The level rises from half the mean of all to the first that is so: a few
 * high peaks do not hold it up, nor does what is at rest behind the wave draw it down. */
static double half_jump(const struct samples *samples, const struct measure_front *front)
{
    double ahead = samples->count ? seen(samples, front, 0)->value : NAN, jump = 0.0;
    for (int64_t k = 0; k < samples->count; k++)
        jump += (samples->at[k].value - ahead) / (double)samples->count;
    for (double before = 0.0; fabs(jump) > fabs(before);) {
        before = jump;
        jump = mean_beyond(samples, ahead, jump);
    }
    return jump == 0.0 ? NAN : ahead + 0.5 * jump;
}

double front_place(struct samples *samples, const struct measure_front *front, double time,
                   double *level)
{
    samples_sort(samples);
    if (front->slab > 0.0)
        average_slabs(samples, front->slab);
    *level = front->half ? half_jump(samples, front) : front->value.value;
    return isnan(*level) ? NAN : crossing(samples, front, *level) - front->frame * time;
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    double level;
    struct samples samples;
    TRY(samples_take(measurement, &samples));
    *value = front_place(&samples, measurement->check->measure.value, measurement->simulation->time,
                         &level);
    samples_free(&samples);
    return NULL;
}

const struct measure_class measure_front = {
    .at_once = true, .of_field = true, .unit = unit, .measure = measure};
