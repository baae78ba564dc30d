/* bolide calibrate: keys of a case are fitted to measured values. */
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "cli/cli.h"
#include "study/calibrate.h"

enum { VALUE_TEXT = 64 };

static void print_key(const struct calibration *c, int k, double value, int digits)
{
    char unit[DIMENSION_TEXT], text[VALUE_TEXT];
    readable_digits(value, calibrated_unit(c, k, unit), digits, text, sizeof text);
    printf("%s = %s", c->input->calibrate.keys.names[k], text);
}

/* "run 3: A = 312 MPa, n = 0.31: misfit 2.31 (best 1.2), 3.1 s" */
static void run_ended(void *context, const struct calibration *c)
{
    const struct calibrated_run *run = &c->run[c->runs - 1];
    (void)context;
    terminal_clear_line();
    printf("run %d: ", c->runs);
    for (int k = 0; k < c->input->calibrate.keys.count; k++) {
        fputs(k ? ", " : "", stdout);
        print_key(c, k, run->key[k], 5);
    }
    if (run->failure)
        printf(": %sfailed%s: %s", colour(COLOUR_BAD), colour(COLOUR_NONE), run->failure);
    else
        printf(": misfit %.4g", sqrt(run->sum / c->values));
    printf(", %.1f s\n", run->seconds);
    fflush(stdout);
}

static void print_targets(const struct calibration *c)
{
    const struct calibrated_run *best = &c->run[c->best];
    for (int v = 0; v < c->values; v++) {
        const struct calibrated_value *value = &c->value[v];
        char computed[VALUE_TEXT], is[VALUE_TEXT], deviation[VALUE_TEXT];
        readable_digits(best->measured[v], value->unit, 5, computed, sizeof computed);
        readable_digits(value->is, value->unit, 5, is, sizeof is);
        readable(value->deviation, value->unit, deviation, sizeof deviation);
        if (isnan(value->is))
            printf("  %s: root mean square difference %s, deviation %s", value->name, computed,
                   deviation);
        else
            printf("  %s: %s, measured %s +- %s", value->name, computed, is, deviation);
        printf(": misfit %.3g\n", calibrated_misfit(c, v, best));
    }
}

static struct error *print_keys(const struct calibration *c)
{
    const int n = c->input->calibrate.keys.count;
    for (int k = 0; k < n; k++) {
        char unit[DIMENSION_TEXT], deviation[VALUE_TEXT], *note = calibrated_note(c, k);
        if (!note)
            return out_of_memory();
        const struct calibrated_key *key = case_calibrated(c->input, k);
        if (calibrated_deviation(c, k) <= key->to.value - key->from.value)
            readable(calibrated_deviation(c, k), calibrated_unit(c, k, unit), deviation,
                     sizeof deviation);
        else
            snprintf(deviation, sizeof deviation, "more than its range");
        fputs(colour(COLOUR_STRONG), stdout);
        print_key(c, k, calibrated_value_of(c, k), 5);
        printf("%s +- %s\n", colour(COLOUR_NONE), deviation);
        if (*note)
            printf("  %swarning%s: %s\n", colour(COLOUR_WARN), colour(COLOUR_NONE), note);
        free(note);
    }
    for (int k = 0; k < n; k++)
        for (int other = 0; other < k; other++)
            printf("correlation of %s and %s: %.3f\n", c->input->calibrate.keys.names[other],
                   c->input->calibrate.keys.names[k], calibrated_correlation(c, k, other));
    return NULL;
}

/* What the end means; ERROR_CHECK where it is not the fit that was asked for. */
static struct error *judge(const struct calibration *c)
{
    static const char next[] = "the run was the first, with the keys at their start: choose others";
    switch (c->fit.end) {
    case LEAST_SQUARES_NEAREST:
        printf("no step makes the fit better: the targets and the model differ by this much\n");
        return NULL;
    case LEAST_SQUARES_MOST_RUNS:
        return error_new(ERROR_CHECK,
                         "the misfit is not within its limit after %d runs; continue with --resume "
                         "--set calibrate.runs=%d",
                         c->runs, 2 * c->runs);
    case LEAST_SQUARES_NO_START:
        return error_new(ERROR_CHECK, "%s; %s", c->run[c->runs - 1].failure, next);
    case LEAST_SQUARES_NO_NEIGHBOUR:
        return error_new(ERROR_CHECK,
                         "runs with one key a little changed failed (the last: %s): choose other "
                         "values for the start",
                         c->run[c->runs - 1].failure);
    case LEAST_SQUARES_WITHIN:
    case LEAST_SQUARES_STOPPED:
        break;
    }
    return NULL;
}

static struct error *print_result(const struct calibration *c)
{
    if (c->fit.end == LEAST_SQUARES_STOPPED)
        return NULL;
    struct error *error = NULL;
    if (c->fit.differentiated) {
        error = print_keys(c);
        printf("misfit %.4g of deviations (root mean square of %d target%s), %d runs:\n",
               sqrt(c->run[c->best].sum / c->values), c->values, c->values == 1 ? "" : "s",
               c->runs);
        print_targets(c);
        printf("runs in %s/calibrate.csv, keys in %s/calibrated.yaml, report: %s/report.html\n",
               c->folder, c->folder, c->folder);
    }
    return error_join(error, judge(c));
}

static int calibrate_case(const struct simulation_case *input, const struct cli_options *options)
{
    const char *path = options->names.text[0];
    char *folder = NULL, *name = text_format("%s-calibrate", input->name);
    struct calibration calibration = {0};
    struct many_runs many;
    struct verify_options *verifying = many_runs_begin(&many, options, NULL);
    struct error *error = name ? results_folder(options, path, name, &folder) : out_of_memory();
    if (!error)
        error = calibrate(input, path, folder, verifying, run_ended, NULL, &calibration);
    if (!error)
        error = print_result(&calibration);
    int status;
    if (many_runs_end(&many, error, &status))
        printf("continue with --resume\n");
    calibration_free(&calibration);
    free(folder);
    free(name);
    return status;
}

int command_calibrate(const struct cli_options *options)
{
    struct simulation_case *input = NULL;
    struct error *error =
        ranks_agree(options->ranks, read_case(options->names.text[0], options, &input));
    int status = error ? report_error(error) : calibrate_case(input, options);
    case_free(input);
    return status;
}
