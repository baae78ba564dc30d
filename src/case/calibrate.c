/* The keys of `calibrate`, and what the table cannot say of them. */
#include <stdlib.h>
#include <string.h>

#include "case/checking.h"
#include "document/nodes.h"

static const char *const scale_names[] = {"linear", "log", NULL};

static const struct parameter key_table[] = {
    PARAMETER(QUANTITY, struct calibrated_key, from, REQUIRED, "the smallest value allowed"),
    PARAMETER(QUANTITY, struct calibrated_key, to, REQUIRED, "the largest value allowed"),
    PARAMETER(QUANTITY, struct calibrated_key, start, OPTIONAL,
              "the value of the first run; default: the middle"),
    PARAMETER(CHOICE, struct calibrated_key, scale, "linear",
              "linear, or log for a key whose order of magnitude is not known",
              .names = scale_names),
    PARAMETER_END,
};

static const struct parameter target_table[] = {
    PARAMETER(TEXT, struct calibration_target, check, OPTIONAL,
              "the check whose measured value is the target, in every run of a sweep"),
    PARAMETER(TEXT, struct calibration_target, probe, OPTIONAL,
              "in place of a check: the probe whose record is compared with `data`"),
    PARAMETER_AS("case", TEXT, struct calibration_target, of, OPTIONAL,
                 "the case of the target, one of `cases`; default: the case itself"),
    PARAMETER(QUANTITY, struct calibration_target, is, OPTIONAL,
              "the measured value; default: `is` of the check"),
    PARAMETER(QUANTITY, struct calibration_target, deviation, OPTIONAL,
              "standard deviation of the measurement, which weighs the target: a fraction of `is` "
              "(of the largest measured value of a trace) or a quantity like it; default: `within` "
              "of the check"),
    PARAMETER(TEXT, struct calibration_target, field, OPTIONAL,
              "the column of the probe, without its unit: pressure"),
    PARAMETER(TEXT, struct calibration_target, data, OPTIONAL,
              "the measured trace, a CSV file with a line of names above", .is_path = true),
    PARAMETER(TEXT, struct calibration_target, time, OPTIONAL,
              "the column of times, `t_us:us` with a unit that its name lacks; default: the first"),
    PARAMETER(
        TEXT, struct calibration_target, value, OPTIONAL,
        "the column of values, in the same way; default: that called as `field`, else the second"),
    PARAMETER(VECTOR, struct calibration_target, between, OPTIONAL,
              "two times: what was measured before or after does not count", .unit = "s"),
    PARAMETER(TEXT, struct calibration_target, shift, "0 s",
              "time by which the trace is shifted, or fit: by what fits best in each run"),
    PARAMETER_END,
};

const struct parameter case_calibrate_table[] = {
    PARAMETER(MAP, struct calibrate_input, keys, OPTIONAL,
              "what is fitted: names of let or paths, materials.copper.strength.johnson-cook.a",
              .table = key_table, .size = sizeof(struct calibrated_key)),
    PARAMETER(MAP, struct calibrate_input, targets, OPTIONAL, "what it is fitted to, by name",
              .table = target_table, .size = sizeof(struct calibration_target)),
    PARAMETER(NAMES, struct calibrate_input, cases, OPTIONAL,
              "further cases that run with the same keys, as files seen from this one"),
    PARAMETER(INTEGER, struct calibrate_input, runs, "40", "largest number of runs", .above = 1,
              .below = 1000, .closed = true),
    PARAMETER(NUMBER, struct calibrate_input, within, "0.5",
              "it ends when the mean square of the misfits, each over its deviation, is below this",
              .below = INFINITY),
    PARAMETER_END,
};

struct error *case_find_key(const struct simulation_case *input, const char *told, const char *key,
                            char **path)
{
    const struct node *calibrate = node_entry(input->document->root, "calibrate");
    const struct node *keys = calibrate ? node_entry(calibrate, "keys") : NULL;
    const struct node *entry = keys ? node_entry(keys, key) : NULL;
    return case_find_target(input->document, key, entry ? entry->key_place : (struct mark){0}, told,
                            path);
}

static bool is_given(const struct quantity *quantity) { return !isnan(quantity->value); }

static bool same(const struct quantity *a, const struct quantity *b)
{
    return dimension_equal(a->dimension, b->dimension);
}

static void check_key(struct checking *checking, int index)
{
    const struct calibrated_key *key = case_calibrated(checking->input, index);
    char *path = NULL;
    struct error *error = case_find_key(checking->input, "calibrate.keys", checking->name, &path);
    checking->error = error_join(checking->error, error);
    free(path);
    if (case_is_wrong(checking, "") || !is_given(&key->from) || !is_given(&key->to))
        return;
    if (!same(&key->from, &key->to)) {
        case_wrong(checking, "to", "`from` and `to` have different dimensions");
        return;
    }
    if (key->from.value >= key->to.value)
        case_wrong(checking, "to", "this must be larger than `from`");
    if (key->scale == KEY_LOG && !(key->from.value > 0.0))
        case_wrong(checking, "from", "on a logarithmic scale this must be above 0");
    if (!is_given(&key->start))
        return;
    if (!same(&key->start, &key->from))
        case_wrong(checking, "start", "`from` and `start` have different dimensions");
    else if (key->start.value < key->from.value || key->start.value > key->to.value)
        case_wrong(checking, "start", "this is not between `from` and `to`");
}

static bool is_listed(const struct name_list *list, const char *name)
{
    for (int i = 0; i < list->count; i++)
        if (!strcmp(list->names[i], name))
            return true;
    return false;
}

static void check_of_check(struct checking *checking, const struct calibration_target *target)
{
    const struct simulation_case *input = checking->input;
    const char *const names[] = {"field", "data", "time", "value"};
    const char *const texts[] = {target->field, target->data, target->time, target->value};
    for (size_t k = 0; k < COUNT_OF(names); k++)
        if (texts[k])
            case_wrong(checking, names[k], "this is a key of a probe's record: leave it out");
    if (target->between.count)
        case_wrong(checking, "between", "this is a key of a probe's record: leave it out");
    const int found =
        target->of ? -1 : case_find_name(checking, &input->checks, "check", target->check, "check");
    if (found < 0)
        return;
    const struct check_input *check = case_check(input, found);
    if (!is_given(&target->is) && !is_given(&check->is))
        case_wrong(checking, "", "`is` is missing, and the check has none either");
    if (!is_given(&target->deviation) && (!is_given(&check->is) || !is_given(&check->within)))
        case_wrong(checking, "", "`deviation` is missing, and the check has no `within` either");
}

static void check_of_probe(struct checking *checking, const struct calibration_target *target)
{
    if (!target->of)
        case_find_name(checking, &checking->input->probes, "probe", target->probe, "probe");
    if (!target->field)
        case_wrong(checking, "", "`field` is missing: the column of the probe");
    if (!target->data)
        case_wrong(checking, "", "`data` is missing: the file of the measured trace");
    if (!is_given(&target->deviation))
        case_wrong(checking, "", "`deviation` is missing: that of the measured values");
    if (is_given(&target->is))
        case_wrong(checking, "is", "a trace has no single value: leave it out");
    if (target->between.count &&
        !(target->between.count == 2 && target->between.at[0] < target->between.at[1]))
        case_wrong(checking, "between", "expected two times, the earlier first");
}

static void check_shift(struct checking *checking, struct calibration_target *target)
{
    static const struct dimension seconds = {.time = 1};
    struct quantity shift = {.value = NAN};
    target->shift_time = NAN;
    if (!target->shift || !strcmp(target->shift, "fit"))
        return;
    struct error *error = document_evaluate(checking->input->document, target->shift, &shift);
    if (!document_is_wrong(checking->input->document, "let") &&
        (error || !dimension_equal(shift.dimension, seconds)))
        case_wrong(checking, "shift", "\"%s\" is neither a time nor fit", target->shift);
    error_free(error);
    target->shift_time = shift.value;
}

static void check_target(struct checking *checking, int index)
{
    struct calibration_target *target = case_target(checking->input, index);
    if (case_is_wrong(checking, ""))
        return;
    if (!target->check == !target->probe)
        case_wrong(checking, "", "expected either `check` or `probe`");
    else if (target->check)
        check_of_check(checking, target);
    else
        check_of_probe(checking, target);
    check_shift(checking, target);
    if (target->of && !is_listed(&checking->input->calibrate.cases, target->of))
        case_wrong(checking, "case", "\"%s\" is not one of `cases`", target->of);
    if (is_given(&target->deviation) && !(target->deviation.value > 0.0))
        case_wrong(checking, "deviation", "this must be above 0");
}

void case_check_calibrate(struct checking *checking)
{
    const struct calibrate_input *calibrate = &checking->input->calibrate;
    checking->map = "calibrate";
    checking->name = NULL;
    if (calibrate->keys.count > CALIBRATED_KEYS_MAX)
        case_wrong(checking, "keys", "these are more than %d keys", CALIBRATED_KEYS_MAX);
    const bool wrong = case_is_wrong(checking, "");
    if (!wrong && calibrate->keys.count && !calibrate->targets.count)
        case_wrong(checking, "", "`targets` is missing: what the keys are fitted to");
    if (!wrong && calibrate->targets.count && !calibrate->keys.count)
        case_wrong(checking, "", "`keys` is missing: what is fitted");
    checking->map = "calibrate.keys";
    for (int i = 0; i < calibrate->keys.count; i++) {
        checking->name = calibrate->keys.names[i];
        check_key(checking, i);
    }
    checking->map = "calibrate.targets";
    for (int i = 0; i < calibrate->targets.count; i++) {
        checking->name = calibrate->targets.names[i];
        check_target(checking, i);
    }
    checking->name = NULL;
}
