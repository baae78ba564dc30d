/* Targets that are measured traces, compared with columns of probes; see calibrate.h. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/probes.h"
#include "model/problem.h"
#include "output/report.h"
#include "page/measured.h"
#include "run/run.h"
#include "study/calibrate.h"

static const struct calibration_target *target_of(const struct calibration *c, int v)
{
    return case_target(c->input, c->value[v].target);
}

/* Whether HEAD, with its unit or without, is FIELD. */
static bool is_field(const char *head, const char *field)
{
    const size_t length = strlen(field);
    return !strncmp(head, field, length) && (!head[length] || !strncmp(head + length, " [", 2));
}

/* The unit of the column FIELD that a probe will have. */
struct looked_for {
    const char *field;
    char unit[DIMENSION_TEXT];
    bool found;
    char *known; /* the columns, where none is found */
};

static struct error *look_for_unit(const struct probe *probe, void *context)
{
    struct looked_for *looked_for = context;
    looked_for->known = text_copy("");
    for (int i = 1; i < probe->columns && looked_for->known; i++) {
        const struct probe_column *column = &probe->column[i];
        char *head = text_format("%s [%s]", column->name, column->unit);
        if (head && (is_field(head, looked_for->field))) {
            snprintf(looked_for->unit, sizeof looked_for->unit, "%s", column->unit);
            looked_for->found = true;
        }
        char *longer =
            head ? text_format("%s%s%s", looked_for->known, i > 1 ? ", " : "", column->name) : NULL;
        free(head);
        free(looked_for->known);
        looked_for->known = longer;
    }
    return looked_for->known ? NULL : out_of_memory();
}

/* UNIT: that of the column of the probe of TARGET in HERE, which does not run yet. */
static struct error *find_unit(const struct calibration *c, const struct simulation_case *here,
                               const struct calibration_target *target, const char *name,
                               char *unit)
{
    struct looked_for looked_for = {.field = target->field};
    struct error *error = run_prepare_probe(here, target->probe, look_for_unit, &looked_for);
    if (!error && !looked_for.found)
        error = input_error(c->input, "calibrate.targets", name,
                            "the probe has no column \"%s\" (known: %s)", target->field,
                            looked_for.known);
    snprintf(unit, DIMENSION_TEXT, "%s", looked_for.unit);
    free(looked_for.known);
    return error;
}

/* The deviation of a trace must be like its column, unless it is a fraction. */
static struct error *check_deviation(const struct calibration *c,
                                     const struct calibration_target *target, const char *name,
                                     const char *unit)
{
    static const struct dimension none;
    struct unit own;
    char text[DIMENSION_TEXT];
    TRY(unit_parse(unit, &own));
    if (dimension_equal(target->deviation.dimension, none) ||
        dimension_equal(target->deviation.dimension, own.dimension))
        return NULL;
    return input_error(c->input, "calibrate.targets", name,
                       "`deviation` is in %s, but the column is `%s [%s]`",
                       dimension_text(target->deviation.dimension, text), target->field, unit);
}

/* Keeps of DATA what is between the times of the target, before its shift. */
static void cut(const struct calibration_target *target, struct curve *data)
{
    const double shift = isnan(target->shift_time) ? 0.0 : target->shift_time;
    int64_t kept = 0;
    for (int64_t i = 0; i < data->count && target->between.count; i++) {
        const double time = data->time[i] - shift;
        if (time < target->between.at[0] || time > target->between.at[1])
            continue;
        data->time[kept] = data->time[i];
        data->value[kept++] = data->value[i];
    }
    if (target->between.count)
        data->count = kept;
}

/* Why DATA is not compared with what a probe recorded from BEGIN to END, in fresh memory. */
static char *no_overlap(const struct curve *data, double shift, double begin, double end)
{
    enum { TIME_TEXT = 48 };
    char first[TIME_TEXT], last[TIME_TEXT], from[TIME_TEXT], to[TIME_TEXT];
    const double start = data->time[0] + shift, stop = data->time[data->count - 1] + shift;
    readable(start, "s", first, sizeof first);
    readable(stop, "s", last, sizeof last);
    readable(begin, "s", from, sizeof from);
    readable(end, "s", to, sizeof to);
    return text_format("the trace (%s to %s) does not overlap the probe (%s to %s)%s: give a "
                       "`shift`",
                       first, last, from, to,
                       start < end && stop > begin ? " by half of the shorter" : "");
}

/* A trace whose times, shifted already, are not in the run. */
static struct error *check_times(const struct calibration *c, const struct simulation_case *here,
                                 const char *name, const struct curve *data)
{
    double time[] = {0.0, here->run.until}, value[] = {0.0, 0.0};
    const struct curve run = {.count = 2, .time = time, .value = value};
    if (!(here->run.until > 0.0) || curve_overlaps(&run, data, 0.0))
        return NULL;
    char *why = no_overlap(data, 0.0, 0.0, here->run.until);
    struct error *error =
        why ? input_error(c->input, "calibrate.targets", name, "%s", why) : out_of_memory();
    free(why);
    return error;
}

/* Reads the measured trace of TARGET, whose column of the probe has UNIT, into VALUE. */
static struct error *read_trace(const struct calibration *c,
                                const struct calibration_target *target, const char *name,
                                const char *unit, struct calibrated_value *value)
{
    static const struct dimension none;
    const struct compare_data data = {
        .path = target->data,
        .time = target->time,
        .value = target->value,
        .field = target->field,
        .shift = isnan(target->shift_time) ? 0.0 : target->shift_time,
        .in_case = true,
    };
    struct error *error = compare_data_curve(&data, unit, &value->data), *told = NULL;
    for (int i = 0; error && i < error_count(error); i++)
        told = error_join(
            told, input_error(c->input, "calibrate.targets", name, "%s", error_message(error, i)));
    error_free(error);
    TRY(told);
    const double largest = maximum(fabs(curve_largest(&value->data)), 1e-300);
    cut(target, &value->data);
    if (value->data.count < 2)
        return input_error(c->input, "calibrate.targets", name,
                           "fewer than two measured values are left of %s", target->data);
    value->is = NAN;
    value->count = (int)value->data.count;
    value->deviation = target->deviation.value;
    if (dimension_equal(target->deviation.dimension, none))
        value->deviation *= largest;
    snprintf(value->unit, sizeof value->unit, "%s", unit);
    return NULL;
}

struct error *calibrate_prepare_trace(const struct calibration *c,
                                      const struct simulation_case *here,
                                      struct calibrated_value *value)
{
    const struct calibration_target *target = case_target(c->input, value->target);
    const char *name = c->input->calibrate.targets.names[value->target];
    char unit[DIMENSION_TEXT];
    if (named_map_find(&here->probes, target->probe) < 0)
        return input_error(c->input, "calibrate.targets", name, "%s has no probe \"%s\"",
                           target->of, target->probe);
    TRY(find_unit(c, here, target, name, unit));
    struct error *error = check_deviation(c, target, name, unit);
    error = error_join(error, read_trace(c, target, name, unit, value));
    if (!error && !isnan(target->shift_time))
        error = check_times(c, here, name, &value->data);
    return error;
}

/* The column of the probe that the target compares; -1: it has none. */
static int find_field(const struct csv *csv, const char *field)
{
    for (int i = 1; i < csv->columns; i++)
        if (is_field(csv_head(csv, i), field))
            return i;
    return -1;
}

/* Each of N residuals is divided by the root of N, so that a trace weighs as much as a check. */
static struct error *compare_trace(const struct calibration *c, int v, const struct curve *computed,
                                   struct calibrated_run *run)
{
    const struct calibrated_value *value = &c->value[v];
    const struct curve *data = &value->data;
    const double shift = isnan(target_of(c, v)->shift_time) ? curve_shift(computed, data) : 0.0;
    const double rms = curve_rms(computed, data, shift);
    int64_t covered = 0;
    double *residual = run->residual + value->first;
    run->measured[v] = rms;
    if (isnan(rms)) {
        run->failure =
            no_overlap(data, shift, computed->time[0], computed->time[computed->count - 1]);
        return run->failure ? NULL : out_of_memory();
    }
    for (int64_t i = 0; i < data->count; i++) {
        const double off = curve_at(computed, data->time[i] + shift) - data->value[i];
        residual[i] = isfinite(off) ? off / value->deviation : 0.0;
        covered += isfinite(off);
    }
    for (int64_t i = 0; i < data->count; i++)
        residual[i] /= sqrt((double)covered);
    return NULL;
}

struct error *calibrate_trace_residuals(const struct calibration *c, int v, const char *folder,
                                        struct calibrated_run *run)
{
    const struct calibration_target *target = target_of(c, v);
    struct csv csv = {0};
    struct curve computed = {0};
    char *path = text_format("%s/probes/%s.csv", folder, target->probe);
    struct error *error = path ? csv_read(path, &csv) : out_of_memory();
    free(path);
    run->measured[v] = NAN;
    const int column = error ? -1 : find_field(&csv, target->field);
    if (!error && column > 0)
        error = curve_make(&csv, 0, column, 1.0, 1.0, 0.0, &computed);
    if (!error && computed.count > 1 && !run->failure)
        error = compare_trace(c, v, &computed, run);
    free(computed.time);
    csv_free(&csv);
    return error;
}
