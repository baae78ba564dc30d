/* Calibration; see calibrate.h. */
#include "study/calibrate.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "base/memory.h"
#include "base/results.h"

/* Two keys that correlate more are not told apart. */
static const double NOT_APART = 0.95;
/* Of its range, so near to a bound a key is at it. */
static const double AT_BOUND = 1e-6;

struct calibrating {
    struct calibration *calibration;
    const struct verify_options *options;
    calibrate_ended *ended;
    void *context;
    struct error *error; /* that ends it */
};

const char *calibrated_unit(const struct calibration *c, int k, char *buffer)
{
    return dimension_text(case_calibrated(c->input, k)->from.dimension, buffer);
}

/* The value of key K at U, from 0 to 1 in its range, and the reverse. */
static double key_at(const struct calibrated_key *key, double u)
{
    const double from = key->from.value, to = key->to.value;
    const double value =
        key->scale == KEY_LOG ? exp(log(from) + u * (log(to) - log(from))) : from + u * (to - from);
    char text[32]; /* as the case will read it */
    snprintf(text, sizeof text, "%.10g", value);
    return minimum(maximum(strtod(text, NULL), from), to);
}

static double place_of(const struct calibrated_key *key, double value)
{
    const double from = key->from.value, to = key->to.value;
    return key->scale == KEY_LOG ? log(value / from) / log(to / from)
                                 : (value - from) / (to - from);
}

/* The change of key K with its place in the range. */
static double slope_of(const struct calibrated_key *key, double value)
{
    const double from = key->from.value, to = key->to.value;
    return key->scale == KEY_LOG ? value * log(to / from) : to - from;
}

/* A new run with KEYS, the last of the calibration. */
static struct error *add_run(struct calibration *c, const double *keys)
{
    struct calibrated_run *grown = realloc(c->run, ((size_t)c->runs + 1) * sizeof *grown);
    if (!grown)
        return out_of_memory();
    c->run = grown;
    struct calibrated_run *run = &c->run[c->runs++];
    *run = (struct calibrated_run){.sum = INFINITY};
    memcpy(run->key, keys, (size_t)c->input->calibrate.keys.count * sizeof *keys);
    run->measured = memory_allocate((size_t)(c->values + 1) * sizeof(double));
    run->residual = memory_allocate((size_t)(c->residuals + 1) * sizeof(double));
    return run->measured && run->residual ? NULL : out_of_memory();
}

static int find_run(const struct calibration *c, const double *keys)
{
    for (int i = 0; i < c->runs; i++)
        if (!memcmp(c->run[i].key, keys, (size_t)c->input->calibrate.keys.count * sizeof *keys))
            return i;
    return -1;
}

static bool is_there(const char *folder, const char *name)
{
    char *path = path_join(folder, name);
    const bool there = path && access(path, F_OK) == 0;
    free(path);
    return there;
}

/* A run that could not begin, or had no place on the disc, ends the calibration; of one that came
 * to an impossible state the reason is kept. */
static struct error *take_failure(struct verify_case *item, struct calibrated_run *run)
{
    if (!item->error || error_kind(item->error) != ERROR_STATE) {
        struct error *error = item->error;
        item->error = NULL;
        return error;
    }
    if (!run->failure)
        run->failure = text_copy(error_message(item->error, 0));
    return run->failure ? NULL : out_of_memory();
}

/* Takes what the computation AT, which went as ITEM, measured. */
static struct error *take_values(const struct calibration *c, int at,
                                 const struct verify_case *item, struct calibrated_run *run)
{
    char *own = calibrate_computation_folder(c, c->runs - 1, at);
    struct error *error = own ? NULL : out_of_memory();
    for (int v = 0; v < c->values && !error; v++) {
        const struct calibrated_value *value = &c->value[v];
        const char *check = case_target(c->input, value->target)->check;
        if (value->computation != at)
            continue;
        const struct check_result *result = check ? verify_find_check(item, check) : NULL;
        if (result) {
            error = calibrate_check_unit(c, v, result);
            run->measured[v] = result->measured;
        }
        if (!error)
            error = calibrate_residuals(c, v, own, run);
        if (!error && !isfinite(run->measured[v]) && !run->failure)
            run->failure = text_format("%s: nothing was measured%s%s", value->name,
                                       result && result->nothing ? ": " : "",
                                       result && result->nothing ? result->nothing : "");
    }
    free(own);
    return error;
}

/* Computes the case FILE with the keys of RUN. */
static struct error *compute_file(const struct calibration *c, int file, const char *folder,
                                  const struct verify_options *how, struct calibrated_run *run)
{
    struct verify_options own_options = *how, *options = &own_options;
    const struct calibrated_file *of = &c->file[file];
    struct verify_result result = {0};
    struct calibrate_settings settings;
    char *own = of->folder ? path_join(folder, of->folder) : text_copy(folder);
    if (!own)
        return out_of_memory();
    struct error *error = calibrate_settings(c, file, run->key, &how->reading, &settings);
    options->reading.settings = settings.text;
    options->reading.setting_count = settings.count;
    const bool sweeps = c->computation[of->first].name != NULL;
    options->running.resume =
        how->running.resume && is_there(own, sweeps ? "sweep.csv" : "checkpoint.h5");
    options->running.overwrite = !options->running.resume;
    if (!error)
        error = verify_case(of->path, c->input->name, own, options, &result);
    if (result.count) { /* that checks fail is no error here */
        error_free(error);
        error = NULL;
    }
    for (int k = 0; k < result.count && !error && !verify_stop_requested(options); k++) {
        run->seconds += result.item[k].result.seconds;
        error = take_failure(&result.item[k], run);
        if (!error && k < of->count && !run->failure)
            error = take_values(c, of->first + k, &result.item[k], run);
    }
    verify_result_free(&result);
    calibrate_settings_free(&settings);
    free(own);
    return error;
}

static double sum_of(const struct calibration *c, const struct calibrated_run *run)
{
    double sum = 0.0;
    for (int i = 0; i < c->residuals && !run->failure; i++)
        sum += square(run->residual[i]);
    return run->failure ? (double)INFINITY : sum;
}

/* Computes all cases with KEYS as a new run. */
static struct error *compute(struct calibrating *calibrating, const double *keys)
{
    struct calibration *c = calibrating->calibration;
    char *folder = calibrate_run_folder(c, c->runs);
    struct error *error = folder ? add_run(c, keys) : out_of_memory();
    struct calibrated_run *run = c->run + c->runs - 1;
    for (int f = 0; f < c->files && !error && !run->failure; f++)
        error = compute_file(c, f, folder, calibrating->options, run);
    if (!error)
        run->sum = sum_of(c, run);
    free(folder);
    return ranks_agree(verify_ranks(calibrating->options), error);
}

static enum residuals_end ends(struct calibrating *calibrating, struct error *error)
{
    calibrating->error = error;
    return RESIDUALS_STOP;
}

/* The residuals at U: of a run that has been computed, else of a new one. */
static enum residuals_end evaluate(void *context, const double *u, double *r)
{
    struct calibrating *calibrating = context;
    struct calibration *c = calibrating->calibration;
    double keys[CALIBRATED_KEYS_MAX] = {0.0};
    for (int k = 0; k < c->input->calibrate.keys.count; k++)
        keys[k] = key_at(case_calibrated(c->input, k), u[k]);
    int index = find_run(c, keys);
    if (index < 0) {
        struct error *error = compute(calibrating, keys);
        if (error)
            return ends(calibrating, error);
        if (verify_stop_requested(calibrating->options))
            return RESIDUALS_STOP;
        index = c->runs - 1;
        const bool first = verify_ranks(calibrating->options)->rank == 0;
        error =
            ranks_agree(verify_ranks(calibrating->options), first ? calibrate_write_runs(c) : NULL);
        if (error)
            return ends(calibrating, error);
        if (calibrating->ended)
            calibrating->ended(calibrating->context, c);
    }
    const struct calibrated_run *run = &c->run[index];
    if (c->best < 0 || run->sum < c->run[c->best].sum)
        c->best = run->failure ? c->best : index;
    memcpy(r, run->residual, (size_t)c->residuals * sizeof *r);
    return run->failure ? RESIDUALS_FAILED : RESIDUALS_DONE;
}

static struct error *find_paths(struct calibration *c)
{
    const struct named_map *keys = &c->input->calibrate.keys;
    c->path = memory_allocate((size_t)(keys->count + 1) * sizeof *c->path);
    if (!c->path)
        return out_of_memory();
    for (int k = 0; k < keys->count; k++)
        TRY(case_find_key(c->input, "calibrate.keys", keys->names[k], &c->path[k]));
    return NULL;
}

/* Results that are there already give way to nobody who does not ask for it. */
static struct error *check_folder(const char *folder, const struct run_options *options)
{
    if (options->overwrite || options->resume)
        return NULL;
    if (!is_there(folder, calibrate_table_name))
        return results_check(folder, false);
    return error_new(ERROR_INPUT,
                     "%s: already contains the results of a calibration (--overwrite replaces "
                     "them, --resume continues it)",
                     folder);
}

static struct error *fit(struct calibrating *calibrating)
{
    struct calibration *c = calibrating->calibration;
    const struct calibrate_input *calibrate = &c->input->calibrate;
    const int n = calibrate->keys.count;
    double start[CALIBRATED_KEYS_MAX];
    for (int k = 0; k < n; k++) {
        const struct calibrated_key *key = case_calibrated(c->input, k);
        start[k] = isnan(key->start.value) ? 0.5 : place_of(key, key->start.value);
    }
    const struct least_squares problem = {
        .unknowns = n,
        .residuals = c->residuals,
        .start = start,
        .within = calibrate->within * c->values,
        .most = (int)calibrate->runs,
        .evaluate = evaluate,
        .context = calibrating,
    };
    struct error *error = least_squares(&problem, &c->fit);
    error = error_join(calibrating->error, error);
    if (!error && c->fit.differentiated)
        least_squares_covariance(c->residuals, n, c->fit.jacobian, c->covariance);
    return error;
}

struct error *calibrate(const struct simulation_case *input, const char *path, const char *folder,
                        const struct verify_options *options, calibrate_ended *ended, void *context,
                        struct calibration *c)
{
    struct calibrating calibrating = {c, options, ended, context, NULL};
    struct results_lock lock = {0};
    const bool first = verify_ranks(options)->rank == 0;
    *c = (struct calibration){.input = input, .folder = folder, .best = -1};
    if (!input->calibrate.keys.count)
        return error_new(ERROR_INPUT, "%s: there is no `calibrate`, which names keys and targets",
                         path);
    struct error *error = find_paths(c);
    if (!error)
        error = calibrate_prepare(c, path, options);
    if (!error)
        error = check_folder(folder, &options->running);
    if (!error && options->running.resume)
        error = calibrate_read_runs(c);
    if (!error && first)
        error = folder_make(folder);
    if (!error && first)
        error = results_lock(folder, &lock);
    error = ranks_agree(verify_ranks(options), error);
    if (!error)
        error = fit(&calibrating);
    if (!error && c->fit.differentiated && c->fit.end != LEAST_SQUARES_STOPPED)
        error = ranks_agree(verify_ranks(options), first ? calibrate_write_result(c) : NULL);
    results_unlock(&lock);
    return error;
}

struct error *calibrate_validate(const struct simulation_case *input, const char *path,
                                 const struct verify_options *options)
{
    struct calibration calibration = {.input = input, .best = -1};
    struct error *error = calibrate_prepare(&calibration, path, options);
    calibration_free(&calibration);
    return error;
}

double calibrated_value_of(const struct calibration *c, int k)
{
    return c->best < 0 ? (double)NAN : c->run[c->best].key[k];
}

double calibrated_deviation(const struct calibration *c, int k)
{
    const int n = c->input->calibrate.keys.count;
    return sqrt(c->covariance[k * n + k]) *
           slope_of(case_calibrated(c->input, k), calibrated_value_of(c, k));
}

double calibrated_correlation(const struct calibration *c, int k, int other)
{
    const int n = c->input->calibrate.keys.count;
    const double scale = sqrt(c->covariance[k * n + k] * c->covariance[other * n + other]);
    return scale > 0.0 && isfinite(scale) ? c->covariance[k * n + other] / scale : 0.0;
}

double calibrated_misfit(const struct calibration *c, int v, const struct calibrated_run *run)
{
    const struct calibrated_value *value = &c->value[v];
    double sum = 0.0;
    for (int i = 0; i < value->count; i++)
        sum += square(run->residual[value->first + i]);
    return run->failure ? (double)NAN : sqrt(sum);
}

/* NOTE (taken) with more behind it. */
static char *add_note(char *note, const char *more)
{
    char *longer = note ? text_format("%s%s%s", note, *note ? "; " : "", more) : NULL;
    free(note);
    return longer;
}

char *calibrated_note(const struct calibration *c, int k)
{
    const struct named_map *keys = &c->input->calibrate.keys;
    const double place = place_of(case_calibrated(c->input, k), calibrated_value_of(c, k));
    char *note = text_copy("");
    if (place < AT_BOUND)
        note = add_note(note, "at its lower bound");
    if (place > 1.0 - AT_BOUND)
        note = add_note(note, "at its upper bound");
    if (isinf(c->covariance[k * keys->count + k]))
        note = add_note(note, "without influence on any target");
    for (int other = 0; other < keys->count; other++) {
        if (other == k || fabs(calibrated_correlation(c, k, other)) <= NOT_APART)
            continue;
        char *text = text_format("the targets do not tell it apart from %s (correlation %.3f)",
                                 keys->names[other], calibrated_correlation(c, k, other));
        note = text ? add_note(note, text) : NULL;
        free(text);
    }
    return note;
}

void calibration_free(struct calibration *c)
{
    for (int f = 0; c->file && f <= c->input->calibrate.cases.count; f++) {
        free(c->file[f].path);
        free(c->file[f].folder);
    }
    for (int i = 0; i < c->computations; i++) {
        free(c->computation[i].name);
        free(c->computation[i].label);
    }
    for (int v = 0; v < c->values; v++) {
        free(c->value[v].name);
        free(c->value[v].data.time);
    }
    for (int i = 0; i < c->runs; i++) {
        free(c->run[i].measured);
        free(c->run[i].residual);
        free(c->run[i].failure);
    }
    for (int k = 0; c->path && k < c->input->calibrate.keys.count; k++)
        free(c->path[k]);
    least_squares_free(&c->fit);
    free(c->file);
    free(c->computation);
    free(c->value);
    free(c->run);
    free(c->path);
    *c = (struct calibration){0};
}
