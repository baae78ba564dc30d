/* recorded: a number from what a probe has recorded. Between rows a column is linear, so that a
 * window of time begins and ends where it says. `slope` is the line of least squares, `speed` that
 * without its sign; `maxima` and `period` count the peaks from which it falls by more than
 * `noise` on either side. */
#include <stdlib.h>
#include <string.h>

#include "base/curve.h"
#include "base/memory.h"
#include "measure/probes.h"

enum take {
    TAKE_LAST,
    TAKE_MINIMUM,
    TAKE_MAXIMUM,
    TAKE_MEAN,
    TAKE_RMS,
    TAKE_RANGE,
    TAKE_TIME_OF_MINIMUM,
    TAKE_TIME_OF_MAXIMUM,
    TAKE_SLOPE,
    TAKE_SPEED,
    TAKE_MAXIMA,
    TAKE_PERIOD
};
static const char *const take_names[] = {
    "last",  "minimum", "maximum", "mean",   "rms", "range", "time_of_minimum", "time_of_maximum",
    "slope", "speed",   "maxima",  "period", NULL};

const struct parameter measure_recorded_table[] = {
    PARAMETER(TEXT, struct measure_recorded, probe, REQUIRED, "name of the probe"),
    PARAMETER(TEXT, struct measure_recorded, column, REQUIRED,
              "a column of its table, without the unit: pressure, velocity.x, position"),
    PARAMETER(
        CHOICE, struct measure_recorded, take, "last",
        "last, smallest, largest or mean value (over time); rms: the root of the mean square; "
        "range: largest less smallest; "
        "time of the minimum or maximum; slope: by least squares; speed: its absolute value; "
        "maxima: their number; period: the mean time between them",
        .names = take_names),
    PARAMETER(NUMBER, struct measure_recorded, after, OPTIONAL, "start of the time window",
              .unit = "s"),
    PARAMETER(NUMBER, struct measure_recorded, before, OPTIONAL, "end of the time window",
              .unit = "s"),
    PARAMETER(TEXT, struct measure_recorded, when, OPTIONAL,
              "another column of the table: the value at the time at which that first rises to "
              "`reaches`; with `take: last`"),
    PARAMETER(QUANTITY, struct measure_recorded, reaches, OPTIONAL,
              "the value that the column `when` rises to"),
    PARAMETER(FLAG, struct measure_recorded, absolute, "no",
              "whether to take absolute values, of what is left after `less` and `less_mean`"),
    PARAMETER(TEXT, struct measure_recorded, less, OPTIONAL,
              "another probe, whose `column` at the same times is subtracted"),
    PARAMETER(NUMBER, struct measure_recorded, less_mean, OPTIONAL,
              "subtracts the mean over so much time around each moment", .unit = "s",
              .below = INFINITY),
    PARAMETER(QUANTITY, struct measure_recorded, noise, OPTIONAL,
              "how far the curve must fall on both sides of a maximum; default: a hundredth of its "
              "range"),
    PARAMETER_END,
};

struct error *measure_find_record(const struct measurement *measurement, const char *name,
                                  const char *wanted, struct probe **probe, int *column)
{
    const struct named_map *probes = &measurement->simulation->problem->input->probes;
    const char *names[PROBE_COLUMNS];
    *probe = measurement->probes ? probes_find(measurement->probes, name) : NULL;
    const char *near = nearest_name(name, (const char *const *)probes->names, probes->count);
    if (!*probe)
        return measure_error(measurement, "there is no probe \"%s\"%s%s%s", name,
                             near ? " (did you mean \"" : "", near ? near : "", near ? "\"?)" : "");
    for (*column = 0; *column < (*probe)->columns; ++*column) {
        names[*column] = (*probe)->column[*column].name;
        if (!strcmp(names[*column], wanted))
            return NULL;
    }
    /* A probe with a mistake of its own, which is reported, has no columns behind the time. */
    if ((*probe)->columns < 2)
        return NULL;
    near = nearest_name(wanted, names, (*probe)->columns);
    char known[1024] = "";
    for (int i = 0; i < (*probe)->columns && !near; i++) {
        size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", names[i]);
    }
    return measure_error(measurement, "the probe \"%s\" has no column \"%s\" (%s%s%s)", name,
                         wanted, near ? "did you mean \"" : "known: ", near ? near : known,
                         near ? "\"?" : "");
}

static struct error *find(const struct measurement *measurement, const char *wanted,
                          struct probe **probe, int *column)
{
    const struct measure_recorded *recorded = measurement->check->measure.value;
    return measure_find_record(measurement, recorded->probe, wanted, probe, column);
}

static struct error *check_keys(const struct measurement *measurement, const char *unit)
{
    const struct measure_recorded *recorded = measurement->check->measure.value;
    struct unit parsed;
    if (recorded->after > measurement->simulation->problem->input->run.until)
        return measure_error(measurement, "`after`: the run ends before, at %.9g s",
                             measurement->simulation->problem->input->run.until);
    if (recorded->after >= recorded->before)
        return measure_error(measurement, "`after` must be earlier than `before`");
    if (recorded->when && !isnan(recorded->less_mean))
        return measure_error(measurement, "`less_mean` has no meaning with `when`");
    if (isnan(recorded->noise.value))
        return NULL;
    if (recorded->take != TAKE_MAXIMA && recorded->take != TAKE_PERIOD)
        return measure_error(measurement, "`noise` has no meaning for `take: %s`",
                             take_names[recorded->take]);
    TRY(unit_parse(unit, &parsed));
    if (!dimension_equal(parsed.dimension, recorded->noise.dimension))
        return measure_error(measurement, "`noise` must be in %s, as %s is",
                             *unit ? unit : "plain numbers", recorded->column);
    return NULL;
}

/* What is wrong with `when` and `reaches`. */
static struct error *check_when(const struct measurement *measurement)
{
    const struct measure_recorded *recorded = measurement->check->measure.value;
    struct probe *probe;
    struct unit parsed;
    int column;
    if (!recorded->when != isnan(recorded->reaches.value))
        return measure_error(measurement, "`when` and `reaches` need each other");
    if (!recorded->when)
        return NULL;
    if (recorded->take != TAKE_LAST)
        return measure_error(measurement, "`when` has no meaning for `take: %s`",
                             take_names[recorded->take]);
    TRY(find(measurement, recorded->when, &probe, &column));
    const char *const unit = probe->column[column].unit;
    TRY(unit_parse(unit, &parsed));
    if (!dimension_equal(parsed.dimension, recorded->reaches.dimension))
        return measure_error(measurement, "`reaches` must be in %s, as %s is",
                             *unit ? unit : "plain numbers", recorded->when);
    return NULL;
}

/* What is wrong with `less`; else its probe is kept, too. */
static struct error *check_less(const struct measurement *measurement, const char *unit)
{
    const struct measure_recorded *recorded = measurement->check->measure.value;
    struct probe *probe;
    int column;
    if (!recorded->less)
        return NULL;
    TRY(measure_find_record(measurement, recorded->less, recorded->column, &probe, &column));
    if (column == probe->columns)
        return NULL;
    probe->kept = true;
    if (strcmp(probe->column[column].unit, unit))
        return measure_error(measurement, "%s of \"%s\" is in %s, that of \"%s\" in %s",
                             recorded->column, recorded->probe, unit, recorded->less,
                             probe->column[column].unit);
    return NULL;
}

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_recorded *recorded = measurement->check->measure.value;
    struct probe *probe;
    int column;
    *unit = NULL;
    TRY(find(measurement, recorded->column, &probe, &column));
    if (column == probe->columns)
        return NULL;
    *unit = "";
    probe->kept = true;
    TRY(check_when(measurement));
    TRY(check_less(measurement, probe->column[column].unit));
    switch ((enum take)recorded->take) {
    case TAKE_LAST:
    case TAKE_MINIMUM:
    case TAKE_MAXIMUM:
    case TAKE_MEAN:
    case TAKE_RMS:
    case TAKE_RANGE:
        *unit = probe->column[column].unit;
        break;
    case TAKE_TIME_OF_MINIMUM:
    case TAKE_TIME_OF_MAXIMUM:
    case TAKE_PERIOD:
        *unit = "s";
        break;
    case TAKE_SLOPE:
    case TAKE_SPEED:
        *unit = probe->column[column].rate;
        break;
    case TAKE_MAXIMA:
        break;
    }
    return check_keys(measurement, probe->column[column].unit);
}

/* The next row of PROBE from ROW on with a number in COLUMN; the count of rows where there is
 * none. */
static int64_t next_number(const struct probe *probe, int column, int64_t row)
{
    while (row < probe->rows && isnan(probe->value[row * probe->columns + column]))
        row++;
    return row;
}

/* The rows of the window that have numbers, and where the window cuts between two, what is
 * there. */
static void fill_curve(struct curve *curve, const struct probe *probe, int column,
                       const struct measure_recorded *recorded)
{
    const double ends[2] = {recorded->after, recorded->before};
    double earlier = NAN, before = NAN;
    for (int64_t row = next_number(probe, column, 0); row < probe->rows;
         row = next_number(probe, column, row + 1)) {
        double time = probe->value[row * probe->columns];
        const double value = probe->value[row * probe->columns + column];
        for (int i = 0; i < 2; i++)
            if (earlier < ends[i] && ends[i] < time)
                curve_add(curve, ends[i],
                          before + (value - before) * (ends[i] - earlier) / (time - earlier));
        if (!(time < ends[0]) && !(time > ends[1]))
            curve_add(curve, time, value);
        earlier = time;
        before = value;
    }
}

/* The time in the window of RECORDED at which COLUMN of PROBE first rises to what it reaches; NAN
 * where it does not. */
static double time_when(const struct probe *probe, int column,
                        const struct measure_recorded *recorded)
{
    double earlier = NAN, before = NAN;
    for (int64_t row = next_number(probe, column, 0); row < probe->rows;
         row = next_number(probe, column, row + 1)) {
        const double time = probe->value[row * probe->columns];
        const double value = probe->value[row * probe->columns + column];
        const double wanted = recorded->reaches.value;
        if (before < wanted && value >= wanted && isfinite(value - before)) {
            const double at = earlier + (time - earlier) * (wanted - before) / (value - before);
            if (!(at < recorded->after) && !(at > recorded->before))
                return at;
        }
        earlier = time;
        before = value;
    }
    return NAN;
}

static bool is_finite(const struct curve *curve)
{
    for (int64_t i = 0; i < curve->count; i++)
        if (!isfinite(curve->value[i]))
            return false;
    return true;
}

/* Why TAKE of CURVE, which has finite values, is not a number. */
static enum nothing why_not(const struct curve *curve, int take)
{
    return !curve->count         ? NOTHING_NOT_RECORDED
           : take == TAKE_PERIOD ? NOTHING_NO_PEAKS
           : curve->count < 2    ? NOTHING_ONE_ROW
                                 : NOTHING_SAID;
}

static double take(const struct curve *curve, const struct measure_recorded *recorded)
{
    int64_t lowest = curve_extreme(curve, -1.0), highest = curve_extreme(curve, 1.0);
    double range = curve->value[highest] - curve->value[lowest];
    double noise = isnan(recorded->noise.value) ? 0.01 * range : recorded->noise.value;
    struct curve_peaks peaks = curve_peaks(curve, noise);
    switch ((enum take)recorded->take) {
    case TAKE_LAST:
        return curve->value[curve->count - 1];
    case TAKE_MINIMUM:
        return curve->value[lowest];
    case TAKE_MAXIMUM:
        return curve->value[highest];
    case TAKE_MEAN:
        return curve_mean(curve);
    case TAKE_RMS:
        return curve_root_mean_square(curve);
    case TAKE_RANGE:
        return range;
    case TAKE_TIME_OF_MINIMUM:
        return curve->time[lowest];
    case TAKE_TIME_OF_MAXIMUM:
        return curve->time[highest];
    case TAKE_SLOPE:
        return curve_slope(curve);
    case TAKE_SPEED:
        return fabs(curve_slope(curve));
    case TAKE_MAXIMA:
        return (double)peaks.count;
    case TAKE_PERIOD:
        return (peaks.last - peaks.first) / (double)(peaks.count - 1);
    }
    return NAN;
}

static struct error *fill_from(const struct measurement *measurement, const char *name,
                               const struct measure_recorded *recorded, struct curve *curve)
{
    struct probe *probe;
    int column;
    TRY(measure_find_record(measurement, name, recorded->column, &probe, &column));
    assert(probe);
    if (!curve_reserve(curve, probe->rows + 2))
        return out_of_memory_for("a check");
    fill_curve(curve, probe, column, recorded);
    return NULL;
}

/* The curve that RECORDED asks for, less what it subtracts; CURVE is to be released in any case. */
static struct error *make_curve(const struct measurement *measurement,
                                const struct measure_recorded *recorded, struct curve *curve)
{
    TRY(fill_from(measurement, recorded->probe, recorded, curve));
    struct curve other = {0, NULL, NULL};
    struct error *error = NULL;
    if (recorded->less) {
        error = fill_from(measurement, recorded->less, recorded, &other);
        curve_subtract(curve, &other);
        curve_release(&other);
    }
    if (!error && !isnan(recorded->less_mean)) {
        if (!curve_reserve(&other, curve->count))
            error = out_of_memory_for("a check");
        else
            curve_moving_mean(curve, recorded->less_mean, &other);
        for (int64_t i = 0; i < other.count; i++)
            curve->value[i] -= other.value[i];
        curve_release(&other);
    }
    for (int64_t i = 0; i < curve->count && recorded->absolute; i++)
        curve->value[i] = fabs(curve->value[i]);
    return error;
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    struct measure_recorded recorded =
        *(const struct measure_recorded *)measurement->check->measure.value;
    struct probe *probe;
    int column;
    if (recorded.when) {
        TRY(find(measurement, recorded.when, &probe, &column));
        recorded.after = recorded.before = time_when(probe, column, &recorded);
        *value = measure_nothing(measurement, NOTHING_NOT_REACHED);
        if (isnan(recorded.after))
            return NULL;
    }
    struct curve curve = {0, NULL, NULL};
    struct error *error = make_curve(measurement, &recorded, &curve);
    if (!error) {
        *value = curve.count ? take(&curve, &recorded) : NAN;
        if (!isfinite(*value))
            *value = measure_nothing(measurement, why_not(&curve, recorded.take));
        if (!is_finite(&curve))
            *value = measure_nothing(measurement, NOTHING_NOT_FINITE);
    }
    curve_release(&curve);
    return error;
}

/* A pressure that the exact solution has everywhere and always. */
static double expected(const struct measurement *measurement)
{
    const struct measure_recorded *recorded = measurement->check->measure.value;
    const struct exact_class *exact = measurement->exact;
    const bool is_level = recorded->take == TAKE_LAST || recorded->take == TAKE_MEAN ||
                          recorded->take == TAKE_MINIMUM || recorded->take == TAKE_MAXIMUM;
    if (exact->known != EXACT_PRESSURE || exact->blast || strcmp(recorded->column, "pressure") ||
        !is_level)
        return NAN;
    return exact->sample(measurement->solved, SIDE_LEFT, 0.0, 0.0).pressure;
}

const struct measure_class measure_recorded = {
    .unit = unit, .measure = measure, .of_run = true, .expected = expected};
