/* The values that a calibration compares with measured ones; see calibrate.h. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/file.h"
#include "base/memory.h"
#include "model/problem.h"
#include "study/calibrate.h"

static const struct calibration_target *target_of(const struct calibration *c, int v)
{
    return case_target(c->input, c->value[v].target);
}

/* The path of FROM, as seen from the folder of the case at PATH. */
static char *path_beside(const char *path, const char *from)
{
    const char *slash = strrchr(path, '/');
    struct stat status;
    char *joined = from[0] == '/' || !slash
                       ? text_copy(from)
                       : text_format("%.*s/%s", (int)(slash - path), path, from);
    if (joined && !stat(joined, &status) && S_ISDIR(status.st_mode)) {
        char *inside = path_join(joined, "case.yaml");
        free(joined);
        joined = inside;
    }
    return joined;
}

/* The folder of the results of the case FROM: its name without what a file has. */
static char *folder_of(const char *from)
{
    const size_t length = strlen(from);
    const bool ends = length > 5 && !strcmp(from + length - 5, ".yaml");
    char *name = text_copy_part(from, ends ? length - 5 : length);
    for (char *c = name; c && *c; c++)
        *c = *c == '/' ? '_' : *c;
    return name;
}

char *calibrate_computation_folder(const struct calibration *c, int run, int at)
{
    const struct computation *computation = &c->computation[at];
    const char *own = c->file[computation->file].folder, *name = computation->name;
    char *folder = calibrate_run_folder(c, run), *inside = NULL;
    if (folder)
        inside = text_format("%s%s%s%s%s", folder, own ? "/" : "", own ? own : "", name ? "/" : "",
                             name ? name : "");
    free(folder);
    return inside;
}

static struct error *add_value(struct calibration *c, struct calibrated_value value)
{
    struct calibrated_value *grown = realloc(c->value, ((size_t)c->values + 1) * sizeof *c->value);
    if (grown)
        c->value = grown;
    if (!grown || !value.name) {
        free(value.name);
        free(value.data.time);
        return out_of_memory();
    }
    value.first = c->residuals;
    c->residuals += value.count;
    c->value[c->values++] = value;
    return NULL;
}

/* What DEVIATION comes to beside IS. */
static struct error *find_deviation(const struct simulation_case *input, const char *name,
                                    const struct quantity *deviation, const struct quantity *is,
                                    double *result)
{
    static const struct dimension none;
    const bool fraction = dimension_equal(deviation->dimension, none) && is->value != 0.0;
    if (!fraction && !dimension_equal(deviation->dimension, is->dimension))
        return input_error(input, "calibrate.targets", name,
                           "`deviation` is neither a fraction nor a quantity like `is`");
    *result = fraction ? deviation->value * fabs(is->value) : deviation->value;
    return *result > 0.0
               ? NULL
               : input_error(input, "calibrate.targets", name, "the deviation must be above 0");
}

/* A target that a check of HERE measures, the case of a computation. */
static struct error *add_check(struct calibration *c, const struct simulation_case *here,
                               struct calibrated_value value)
{
    const struct calibration_target *target = case_target(c->input, value.target);
    const int found = named_map_find(&here->checks, target->check);
    const char *name = c->input->calibrate.targets.names[value.target];
    if (found < 0) {
        free(value.name);
        return input_error(c->input, "calibrate.targets", name, "%s has no check \"%s\"",
                           target->of, target->check);
    }
    const struct check_input *check = case_check(here, found);
    const struct quantity is = isnan(target->is.value) ? check->is : target->is;
    const struct quantity deviation =
        isnan(target->deviation.value) ? check->within : target->deviation;
    if (isnan(is.value) || isnan(deviation.value)) {
        free(value.name);
        return input_error(c->input, "calibrate.targets", name,
                           "`is` or `deviation` is missing, here and in the check");
    }
    value.is = is.value;
    value.count = 1;
    dimension_text(is.dimension, value.unit);
    struct error *error = find_deviation(c->input, name, &deviation, &is, &value.deviation);
    if (!error)
        return add_value(c, value);
    free(value.name);
    return error;
}

static struct error *add_trace(struct calibration *c, const struct simulation_case *here,
                               struct calibrated_value value)
{
    struct error *error = calibrate_prepare_trace(c, here, &value);
    if (!error)
        return add_value(c, value);
    free(value.name);
    free(value.data.time);
    return error;
}

/* Adds the targets of FILE for computation AT, whose case is HERE. */
static struct error *add_targets(struct calibration *c, int file, int at,
                                 const struct simulation_case *here)
{
    const struct calibrate_input *calibrate = &c->input->calibrate;
    const char *run = c->computation[at].label;
    struct error *error = NULL;
    for (int t = 0; t < calibrate->targets.count; t++) {
        const struct calibration_target *target = case_target(c->input, t);
        const char *of = target->of, *own = file ? calibrate->cases.names[file - 1] : NULL;
        if (of && own ? strcmp(of, own) != 0 : of || own)
            continue;
        const char *name = calibrate->targets.names[t];
        struct calibrated_value value = {.target = t, .computation = at};
        value.name = run ? text_format("%s, %s", name, run) : text_copy(name);
        error = error_join(error,
                           target->check ? add_check(c, here, value) : add_trace(c, here, value));
    }
    return error;
}

struct error *calibrate_settings(const struct calibration *c, int file, const double *keys,
                                 const struct case_options *user,
                                 struct calibrate_settings *settings)
{
    static const char section[] = "calibrate";
    const size_t length = strlen(section);
    const int own = keys ? c->input->calibrate.keys.count : 0;
    settings->count = settings->first = 0;
    settings->text =
        memory_allocate((size_t)(user->setting_count + own + 1) * sizeof *settings->text);
    if (!settings->text)
        return out_of_memory();
    for (int i = 0; i < user->setting_count; i++) {
        const char *text = user->settings[i];
        if (!file || strncmp(text, section, length) != 0 || !strchr(".=", text[length]))
            settings->text[settings->count++] = text;
    }
    settings->first = settings->count;
    for (int k = 0; k < own; k++) {
        char unit[DIMENSION_TEXT];
        calibrated_unit(c, k, unit);
        char *text = text_format("%s=%.10g%s%s", c->path[k], keys[k], *unit ? " " : "", unit);
        if (!text)
            return out_of_memory();
        settings->text[settings->count++] = text;
    }
    return NULL;
}

void calibrate_settings_free(struct calibrate_settings *settings)
{
    for (int i = settings->first; settings->text && i < settings->count; i++)
        free((void *)settings->text[i]);
    free(settings->text);
}

/* The first value of each entry of the sweep of HERE, or all where another computation of FILE has
 * the same. */
static char *label_of(const struct calibration *c, int file, const struct simulation_case *here)
{
    char *label = text_copy("");
    for (int k = 0; k < here->sweep_values && label; k++) {
        const struct sweep_value *value = &here->sweep[k];
        if (k > 0 && value->entry == value[-1].entry)
            continue;
        char *longer = text_format("%s%s%s=%s", label, *label ? ", " : "", value->key, value->text);
        free(label);
        label = longer;
    }
    for (int i = c->file[file].first; i < c->computations && label; i++)
        if (!strcmp(c->computation[i].label, label)) {
            free(label);
            return sweep_run_name(here->sweep, here->sweep_values);
        }
    return label;
}

/* Reads the case in FILE as its computation RUN, of its sweep, or 0 where it has none, and adds
 * what it computes. */
static struct error *add_computation(struct calibration *c, int file, int run,
                                     const struct verify_options *options, int *runs)
{
    struct calibrated_file *of = &c->file[file];
    struct simulation_case *here = NULL;
    struct case_options reading = options->reading;
    struct calibrate_settings settings;
    reading.sweep_run = run;
    struct error *error = calibrate_settings(c, file, NULL, &options->reading, &settings);
    reading.settings = settings.text;
    reading.setting_count = settings.count;
    if (!error)
        error = case_read(of->path, &reading, options->catalogue, &here);
    calibrate_settings_free(&settings);
    TRY(error);
    *runs = here->sweep_runs;
    for (int k = 0; k < c->input->calibrate.keys.count && file && run < 2; k++) {
        char *path = NULL;
        error = error_join(
            error, case_find_key(here, "calibrate.keys", c->input->calibrate.keys.names[k], &path));
        free(path);
    }
    if (!error && (run > 0 || !here->sweep_runs)) {
        char *name = run ? sweep_run_name(here->sweep, here->sweep_values) : NULL;
        char *label = run ? label_of(c, file, here) : NULL;
        struct computation *grown =
            realloc(c->computation, ((size_t)c->computations + 1) * sizeof *grown);
        if (grown)
            c->computation = grown;
        if (grown && (!run || (name && label))) {
            grown[c->computations++] = (struct computation){file, name, label};
            of->count++;
            error = add_targets(c, file, c->computations - 1, here);
        } else {
            free(label);
            free(name);
            error = out_of_memory();
        }
    }
    case_free(here);
    return error;
}

struct error *calibrate_prepare(struct calibration *c, const char *path,
                                const struct verify_options *options)
{
    const struct name_list *cases = &c->input->calibrate.cases;
    c->file = memory_allocate((size_t)(cases->count + 1) * sizeof *c->file);
    if (!c->file)
        return out_of_memory();
    for (c->files = 0; c->files <= cases->count; c->files++) {
        const int f = c->files;
        const char *from = f ? cases->names[f - 1] : NULL;
        c->file[f].path = f ? path_beside(path, from) : text_copy(path);
        c->file[f].folder = f ? folder_of(from) : cases->count ? text_copy("case") : NULL;
        if (!c->file[f].path || (cases->count && !c->file[f].folder))
            return out_of_memory();
    }
    for (int f = 0; f < c->files; f++) {
        int runs = 0, none;
        c->file[f].first = c->computations;
        TRY(add_computation(c, f, 0, options, &runs));
        for (int run = 1; run <= runs; run++)
            TRY(add_computation(c, f, run, options, &none));
    }
    return c->values ? NULL : error_new(ERROR_INPUT, "%s: there are no targets", path);
}

struct error *calibrate_check_unit(const struct calibration *c, int v,
                                   const struct check_result *check)
{
    struct unit own, other;
    const struct calibrated_value *value = &c->value[v];
    TRY(unit_parse(value->unit, &own));
    TRY(unit_parse(check->unit, &other));
    if (dimension_equal(own.dimension, other.dimension))
        return NULL;
    return input_error(c->input, "calibrate.targets",
                       c->input->calibrate.targets.names[value->target],
                       "`is` is in %s, but the check measures in %s",
                       value->unit[0] ? value->unit : "plain numbers",
                       check->unit[0] ? check->unit : "plain numbers");
}

struct error *calibrate_residuals(const struct calibration *c, int v, const char *folder,
                                  struct calibrated_run *run)
{
    const struct calibrated_value *value = &c->value[v];
    const struct calibration_target *target = target_of(c, v);
    if (target->check) {
        run->residual[value->first] = (run->measured[v] - value->is) / value->deviation;
        return NULL;
    }
    return calibrate_trace_residuals(c, v, folder, run);
}
