/* Verification of cases; see verify.h. */
#include "study/verify.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "base/memory.h"
#include "base/results.h"
#include "study/fits.h"
#include "study/record.h"
#include "study/sweep.h"

/* True where a component of PATH says where something is and not what it is called. */
static bool has_dots(const char *path)
{
    for (const char *at = path; *at;) {
        size_t length = strcspn(at, "/");
        if ((length == 1 || length == 2) && !strncmp(at, "..", length))
            return true;
        at += length + (at[length] == '/');
    }
    return false;
}

/* Names of results are made of it, which must not lead out of their folder. */
char *verify_name(const char *path)
{
    char *whole = has_dots(path) ? realpath(path, NULL) : NULL;
    const char *from = whole ? whole : path;
    const char *end = from + strlen(from);
    if (end - from > 10 && !strcmp(end - 10, "/case.yaml"))
        end -= 10;
    const char *start = end;
    for (int slashes = 0; start > from; start--)
        if (start[-1] == '/' && ++slashes == 2)
            break;
    char *name = text_copy_part(start, (size_t)(end - start));
    free(whole);
    return name;
}

const struct ranks *verify_ranks(const struct verify_options *options)
{
    static const struct ranks alone = {0, 1, false};
    return options->running.ranks ? options->running.ranks : &alone;
}

bool verify_stop_requested(const struct verify_options *options)
{
    const bool stop = options->running.stop && *options->running.stop;
    return ranks_maximum(verify_ranks(options), stop) > 0.0;
}

/* Collective: no rank reads a case that another cannot read. */
static struct error *read_case(const char *path, const struct case_options *reading,
                               const struct verify_options *options, struct simulation_case **input)
{
    struct error *error =
        ranks_agree(verify_ranks(options), case_read(path, reading, options->catalogue, input));
    if (error) {
        case_free(*input);
        *input = NULL;
    }
    return error;
}

static bool is_there(const char *folder, const char *name)
{
    char *path = folder ? path_join(folder, name) : NULL;
    bool there = path && access(path, F_OK) == 0;
    free(path);
    return there;
}

/* A new item of RESULT, called NAME (taken); NULL when memory is out. */
static struct verify_case *add_case(struct verify_result *result, const char *path, char *name)
{
    struct verify_case *grown =
        name ? realloc(result->item, ((size_t)result->count + 1) * sizeof *grown) : NULL;
    if (!grown) {
        free(name);
        return NULL;
    }
    result->item = grown;
    grown[result->count] = (struct verify_case){.name = name, .path = path};
    return &grown[result->count++];
}

static void report_end(const struct verify_options *options, const struct verify_case *verified)
{
    if (options->ended)
        options->ended(options->context, verified);
}

static void run_input(const struct simulation_case *input, const char *folder,
                      const struct verify_options *options, const struct run_options *how,
                      struct verify_case *verified)
{
    struct run_options running = *how;
    const bool judged = !options->reading.convergence;
    running.output = folder;
    verified->form = input->form;
    verified->error = run_case(input, &running, &verified->result);
    verified->warned = options->warnings_fail && verified->result.warnings.unexpected;
    verified->passed = !verified->error && verified->result.finished &&
                       !(judged && verified->result.checks.failed) && !verified->warned;
    if (!verified->error && !verified->result.finished)
        verified->error = error_new(ERROR_SYSTEM, "stopped before its end");
}

/* Runs INPUT, a run of a sweep, as an item of RESULT. */
static struct error *run_of_sweep(struct simulation_case *input, const char *path, const char *name,
                                  const char *folder, const struct verify_options *options,
                                  struct verify_result *result)
{
    char *own_name = sweep_run_name(input->sweep, input->sweep_values);
    char *own_folder = own_name && folder ? path_join(folder, own_name) : NULL;
    struct verify_case *verified =
        own_name ? add_case(result, path, text_format("%s/%s", name, own_name)) : NULL;
    struct error *error = verified && (own_folder || !folder) ? NULL : out_of_memory();
    if (!error) {
        assert(verified);
        verified->resolution = input->resolution;
        struct run_options running = options->running;
        if (running.resume && !is_there(own_folder, "checkpoint.h5")) {
            running.resume = false;
            running.overwrite = true;
        }
        const struct listener *listener = running.listener;
        if (listener && listener->line)
            listener->line(listener->context, verified->name);
        run_input(input, own_folder, options, &running, verified);
        verified->sweep = input->sweep;
        verified->sweep_values = input->sweep_values;
        input->sweep = NULL;
        input->sweep_values = 0;
        report_end(options, verified);
    }
    free(own_folder);
    free(own_name);
    return error;
}

/* Reads every one of the RUNS, so that all mistakes are reported before the first begins. */
static struct error *check_sweep(const char *path, int runs, const struct verify_options *options)
{
    struct error *error = NULL;
    struct case_options reading = options->reading;
    char **names = calloc((size_t)runs, sizeof *names);
    if (!names)
        return out_of_memory();
    for (int run = 0; run < runs; run++) {
        struct simulation_case *input = NULL;
        reading.sweep_run = run + 1;
        struct error *wrong = case_read(path, &reading, options->catalogue, &input);
        names[run] = wrong ? NULL : sweep_run_name(input->sweep, input->sweep_values);
        for (int other = 0; other < run && names[run]; other++)
            if (names[other] && !strcmp(names[other], names[run]))
                wrong = document_error(input->document, "",
                                       "two runs of the sweep would be called %s", names[run]);
        case_free(input);
        error = error_join(error, wrong);
    }
    for (int run = 0; run < runs; run++)
        free(names[run]);
    free(names);
    return error;
}

/* Results that are there already give way to nobody who does not ask for it. */
static struct error *check_folder(const char *folder, const struct run_options *options)
{
    if (!folder || options->overwrite || options->resume)
        return NULL;
    if (!is_there(folder, sweep_table_name))
        return results_check(folder, false);
    return error_new(ERROR_INPUT,
                     "%s: already contains the results of a sweep (--overwrite replaces them, "
                     "--resume continues it)",
                     folder);
}

/* What the COUNT runs of the sweep of the case at PATH come to together, into FOLDER (NULL:
 * nowhere). There are no fits where a run stopped. */
static struct error *evaluate_sweep(const char *path, const char *folder,
                                    const struct verify_options *options,
                                    const struct verify_case *runs, int count,
                                    struct check_results *fits)
{
    struct simulation_case *input = NULL;
    struct case_options reading = options->reading;
    bool is_whole = true;
    for (int i = 0; i < count; i++)
        is_whole = is_whole && !runs[i].error; /* told already */
    reading.sweep_run = 1;
    TRY(read_case(path, &reading, options, &input));
    struct error *error = is_whole ? fits_evaluate(input, runs, count, fits) : NULL;
    const struct repetitions repetitions = {runs, count, input->repetitions};
    if (!error && folder && verify_ranks(options)->rank == 0)
        error = sweep_write(folder, &repetitions, fits);
    case_free(input);
    return error;
}

/* An item "NAME/fits" with the results FITS (taken), if there are any. */
static struct error *add_fits(struct verify_result *result, const char *path, const char *name,
                              struct check_results *fits)
{
    if (fits->count == 0) {
        check_results_free(fits);
        return NULL;
    }
    struct verify_case *item = add_case(result, path, text_format("%s/fits", name));
    if (!item) {
        check_results_free(fits);
        return out_of_memory();
    }
    item->fits = true;
    item->form = item > result->item ? item[-1].form : NULL;
    item->result.checks = *fits;
    item->passed = fits->failed == 0;
    return NULL;
}

static struct error *run_all(const char *path, const char *name, const char *folder, int runs,
                             const struct verify_options *options, struct verify_result *result)
{
    int first = result->count;
    struct case_options reading = options->reading;
    for (int run = 1; run <= runs && !verify_stop_requested(options); run++) {
        struct simulation_case *input = NULL;
        reading.sweep_run = run;
        TRY(read_case(path, &reading, options, &input));
        struct error *error = run_of_sweep(input, path, name, folder, options, result);
        case_free(input);
        TRY(error);
    }
    if (options->reading.convergence)
        return NULL;
    struct check_results fits = {0};
    struct error *error =
        evaluate_sweep(path, folder, options, result->item + first, result->count - first, &fits);
    return error_join(error, add_fits(result, path, name, &fits));
}

/* The folder of a sweep holds no run itself, but its table and its plots. */
static struct error *lock_folder(const char *folder, const struct verify_options *options,
                                 struct results_lock *lock)
{
    if (!folder || verify_ranks(options)->rank != 0)
        return NULL;
    TRY(folder_make(folder));
    return results_lock(folder, lock);
}

static struct error *run_sweep(const char *path, const char *name, const char *folder, int runs,
                               const struct verify_options *options, struct verify_result *result)
{
    struct results_lock lock = {0};
    struct error *error = check_folder(folder, &options->running);
    if (!error)
        error = check_sweep(path, runs, options);
    if (!error)
        error = lock_folder(folder, options, &lock);
    error = ranks_agree(verify_ranks(options), error);
    if (!error)
        error = run_all(path, name, folder, runs, options, result);
    results_unlock(&lock);
    return error;
}

static struct error *run_path(const char *path, const char *name, const char *folder,
                              const struct verify_options *options, struct verify_result *result)
{
    struct simulation_case *input = NULL;
    TRY(read_case(path, &options->reading, options, &input));
    int runs = input->sweep_runs;
    struct verify_case *verified = runs ? NULL : add_case(result, path, text_copy(name));
    struct error *error = runs || verified ? NULL : out_of_memory();
    if (verified) {
        run_input(input, folder, options, &options->running, verified);
        report_end(options, verified);
    }
    case_free(input);
    return runs && !error ? run_sweep(path, name, folder, runs, options, result) : error;
}

/* The messages of a case that did not run, each with the case in front, unless it begins with the
 * path. */
static struct error *named_error(const struct verify_case *verified)
{
    struct error *all = NULL;
    for (int i = 0; i < error_count(verified->error); i++) {
        const char *text = error_message(verified->error, i);
        bool told = !strncmp(text, verified->path, strlen(verified->path));
        all = error_join(all, error_new(error_kind(verified->error), "%s%s%s",
                                        told ? "" : verified->name, told ? "" : ": ", text));
    }
    return all;
}

/* Why a run that came to its end has not passed. */
static struct error *failure(const struct verify_case *verified)
{
    const struct check_results *checks = &verified->result.checks;
    const struct warning_results *warnings = &verified->result.warnings;
    struct error *error = NULL;
    if (checks->failed)
        error = error_new(ERROR_CHECK, "%s: %d of %d checks failed", verified->name, checks->failed,
                          checks->count);
    for (int i = 0; i < warnings->count && verified->warned; i++)
        if (!warnings->item[i].expected)
            error = error_join(error,
                               error_new(ERROR_CHECK,
                                         "%s: warning of %s, which `expected_warnings` of the case "
                                         "does not list",
                                         verified->name, warnings->item[i].name));
    return error;
}

/* What the results come to as one error. */
static struct error *sum_up(struct verify_result *result)
{
    struct error *error = NULL;
    result->cases = result->passed = result->checks = result->checks_passed = 0;
    result->regression_bounds = result->known_deviations = result->measured_only = 0;
    result->warnings = result->unexpected = 0;
    for (int i = 0; i < result->count; i++) {
        const struct verify_case *verified = &result->item[i];
        const struct check_results *checks = &verified->result.checks;
        result->cases += !verified->fits;
        result->passed += verified->passed && !verified->fits;
        result->checks += checks->count;
        result->checks_passed += checks->count - checks->failed - checks->known_deviations -
                                 checks->regression_bounds - checks->measured_only;
        result->regression_bounds += checks->regression_bounds;
        result->known_deviations += checks->known_deviations;
        result->measured_only += checks->measured_only;
        result->warnings += verified->result.warnings.count;
        result->unexpected += verified->result.warnings.unexpected;
        if (verified->error)
            error = error_join(error, named_error(verified));
        else if (!verified->passed)
            error = error_join(error, failure(verified));
    }
    return error;
}

const struct check_result *verify_find_check(const struct verify_case *run, const char *name)
{
    for (int i = 0; i < run->result.checks.count; i++)
        if (!strcmp(run->result.checks.item[i].name, name))
            return &run->result.checks.item[i];
    return NULL;
}

char *verify_checks_text(const struct verify_result *result)
{
    const int passed = result->checks_passed, bounds = result->regression_bounds,
              deviations = result->known_deviations, unlimited = result->measured_only,
              failed = result->checks - passed - bounds - deviations - unlimited;
    char parts[4][64] = {"", "", "", ""};
    char *warnings = warnings_count_text(result->warnings, result->unexpected);
    if (bounds)
        snprintf(parts[0], sizeof parts[0], ", %d within regression bounds", bounds);
    if (deviations)
        snprintf(parts[1], sizeof parts[1], ", %d known deviation%s", deviations,
                 deviations == 1 ? "" : "s");
    if (failed)
        snprintf(parts[2], sizeof parts[2], ", %d failed", failed);
    if (unlimited)
        snprintf(parts[3], sizeof parts[3], ", %d measured only", unlimited);
    char *text = text_format("; %d check%s: %d passed%s%s%s%s%s", result->checks,
                             result->checks == 1 ? "" : "s", passed, parts[0], parts[1], parts[2],
                             parts[3], warnings ? warnings : "");
    free(warnings);
    return text;
}

/* Runs the case at PATH; what keeps it from running becomes an item of its own. */
static struct error *run_or_note(const char *path, const char *name, const char *folder,
                                 const struct verify_options *options, struct verify_result *result)
{
    struct error *error = run_path(path, name, folder, options, result);
    struct verify_case *verified = error ? add_case(result, path, text_copy(name)) : NULL;
    if (!verified)
        return error;
    verified->error = error;
    report_end(options, verified);
    return NULL;
}

struct error *verify_case(const char *path, const char *name, const char *folder,
                          const struct verify_options *options, struct verify_result *result)
{
    TRY(run_or_note(path, name, folder, options, result));
    return sum_up(result);
}

/* Runs the case at PATH, and records what it measured or compares it with the record where that is
 * wanted; what differs is added to MOVED. */
static struct error *run_and_record(const char *path, const char *name, const char *folder,
                                    const struct verify_options *options,
                                    struct verify_result *result, struct error **moved)
{
    const int first = result->count;
    const struct ranks *ranks = verify_ranks(options);
    const bool first_rank = ranks->rank == 0;
    if (options->record)
        TRY(ranks_agree(ranks, first_rank ? record_check(path) : NULL));
    TRY(run_or_note(path, name, folder, options, result));
    if (verify_stop_requested(options) || !(options->record || options->compare))
        return NULL;
    const struct verify_case *runs = result->item + first;
    const int count = result->count - first;
    if (options->record)
        return ranks_agree(
            ranks, first_rank ? record_store(path, name, &options->reading, runs, count) : NULL);
    struct error *error = ranks_agree(
        ranks, first_rank ? record_compare(path, name, &options->reading, runs, count) : NULL);
    *moved = error_join(*moved, error);
    return NULL;
}

struct error *verify_cases(const char *const *paths, int count,
                           const struct verify_options *options, struct verify_result *result)
{
    *result = (struct verify_result){0};
    const char *output = options->running.output;
    struct error *moved = NULL;
    for (int i = 0; i < count && !verify_stop_requested(options); i++) {
        char *name = verify_name(paths[i]);
        char *folder = name && output ? path_join(output, name) : NULL;
        struct error *error = name && (folder || !output)
                                  ? run_and_record(paths[i], name, folder, options, result, &moved)
                                  : out_of_memory();
        free(folder);
        free(name);
        if (error)
            return error_join(error, moved);
    }
    return error_join(sum_up(result), moved);
}

void verify_result_free(struct verify_result *result)
{
    for (int i = 0; i < result->count; i++) {
        struct verify_case *verified = &result->item[i];
        free(verified->name);
        error_free(verified->error);
        run_result_free(&verified->result);
        sweep_values_free(verified->sweep, verified->sweep_values);
    }
    free(result->item);
    *result = (struct verify_result){0};
}
