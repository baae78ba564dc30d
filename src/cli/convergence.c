/* bolide verify --convergence: errors and orders of cases as tables. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "base/memory.h"
#include "cli/cli.h"
#include "study/convergence.h"

static void run_ended(void *context, const struct verify_case *verified)
{
    (void)context;
    terminal_clear_line();
    printf("%s: %s, %.1f s\n", verified->name, verified->error ? "could not run" : "done",
           verified->result.seconds);
    fflush(stdout);
}

enum { NAME_MIN = 9, COLUMN = 12 };

/* Numbers of the runs, each at the right of its column, by FORMAT; a blank where there is none. */
static void put_numbers(const struct study *study, const double *value, const char *format)
{
    for (int i = 0; i < study->runs; i++) {
        char text[64] = "";
        if (isfinite(value[i]))
            snprintf(text, sizeof text, format, value[i]);
        printf("  %*s", COLUMN, text);
    }
}

/* "shock front [m]" */
static int name_text(const struct study_quantity *quantity, char *buffer, size_t size)
{
    return snprintf(buffer, size, *quantity->unit ? "%s [%s]" : "%s", quantity->name,
                    quantity->unit);
}

static void put_verdict(const struct study_quantity *quantity)
{
    static const enum colour colours[] = {COLOUR_NONE, COLOUR_GOOD, COLOUR_WARN, COLOUR_BAD};
    if (quantity->verdict == STUDY_NOT_JUDGED)
        return;
    if (isfinite(quantity->low))
        printf("  at least %.4g", quantity->low);
    if (isfinite(quantity->high))
        printf("  at most %.4g", quantity->high);
    printf("  %s%s%s", colour(colours[quantity->verdict]), quantity->verdict_text,
           colour(COLOUR_NONE));
}

static void print_quantity(const struct study *study, const struct study_quantity *quantity,
                           int width)
{
    char name[200];
    name_text(quantity, name, sizeof name);
    printf("%-*s", width, name);
    if (quantity->kind == STUDY_ESTIMATE) {
        put_numbers(study, quantity->measured, "%.5g");
        printf("\n%-*s", width, "  error");
    }
    put_numbers(study, quantity->error, "%.3e");
    if (isfinite(quantity->fitted))
        printf("  %6.2f", quantity->fitted);
    else
        printf("  %6s", "none");
    put_verdict(quantity);
    printf("\n%s%-*s", colour(COLOUR_FAINT), width, "  order");
    put_numbers(study, quantity->order, "%.2f");
    printf("%s\n", colour(COLOUR_NONE));
}

/* "rebound: 8.128 GPa, extrapolated to 8.131 GPa, grid convergence index 4 MPa (0.05 %)" */
static void print_estimate(const struct study *study, const struct study_quantity *quantity)
{
    const struct extrapolation *extrapolation = &quantity->extrapolation;
    const double finest = quantity->measured[study->runs - 1];
    char value[64], limit[64], index[64];
    readable(finest, quantity->unit, value, sizeof value);
    readable(extrapolation->limit, quantity->unit, limit, sizeof limit);
    readable(extrapolation->index, quantity->unit, index, sizeof index);
    if (isfinite(extrapolation->limit))
        printf("%s: %s, extrapolated to %s, grid convergence index %s (%.2g %%)\n", quantity->name,
               value, limit, index, 100.0 * extrapolation->index / fabs(finest));
    else
        printf("%s: %s, nothing to extrapolate: the last three runs are %s\n", quantity->name,
               value, approach_name(extrapolation->approach));
}

static void print_study(const struct study *study, const char *name)
{
    int width = NAME_MIN;
    char text[200];
    for (int k = 0; k < study->quantities; k++)
        width = (int)maximum(width, name_text(&study->quantity[k], text, sizeof text));
    printf("\n%s: errors over %s\n\n%-*s", name, study->vary, width, "");
    for (int i = 0; i < study->runs; i++) {
        readable(study->run[i].resolution, "m", text, sizeof text);
        printf("  %*s", COLUMN, text);
    }
    printf("  %6s\n%-*s", "fitted", width, "particles");
    for (int i = 0; i < study->runs; i++)
        printf("  %*lld", COLUMN, (long long)study->run[i].particles);
    printf("\n%-*s", width, "seconds");
    for (int i = 0; i < study->runs; i++)
        printf("  %*.2g", COLUMN, study->run[i].seconds);
    putchar('\n');
    for (int k = 0; k < study->quantities; k++)
        print_quantity(study, &study->quantity[k], width);
    putchar('\n');
    for (int k = 0; k < study->quantities; k++)
        if (study->quantity[k].kind == STUDY_ESTIMATE)
            print_estimate(study, &study->quantity[k]);
}

/* DIR/riemann/gas with `--output DIR`, as for every verify; else results/gas, as for run. */
static struct error *folder_of(const struct cli_options *options, const char *path,
                               const struct simulation_case *input, const char *name, char **folder)
{
    if (!options->output)
        return results_folder(options, path, input->name, folder);
    *folder = name ? path_join(options->output, name) : NULL;
    return *folder ? NULL : out_of_memory();
}

/* The runs of a study lie in its folder: it is theirs alone. */
static struct error *check_folder(const char *folder, const struct cli_options *options)
{
    char *runs = path_join(folder, "convergence");
    struct error *error = !runs ? out_of_memory() : NULL;
    if (runs && !options->overwrite && access(runs, F_OK) == 0)
        error =
            error_new(ERROR_INPUT,
                      "%s: already contains a convergence study (--overwrite replaces it)", folder);
    free(runs);
    return ranks_agree(options->ranks, error);
}

static struct error *study_case(const char *path, const struct verify_options *verifying,
                                const struct simulation_case *input,
                                const struct cli_options *options)
{
    struct study study = {0};
    char *name = verify_name(path), *folder = NULL;
    struct error *error = folder_of(options, path, input, name, &folder);
    if (!error)
        error = check_folder(folder, options);
    if (!error)
        error = convergence_run(path, name, folder, verifying, &study);
    if (study.runs) {
        print_study(&study, name);
        struct error *unwritten = options->ranks->rank ? NULL : study_write(folder, &study);
        if (!unwritten)
            printf("results in %s/convergence.html\n", folder);
        error = error_join(error, unwritten);
    }
    study_free(&study);
    free(folder);
    free(name);
    return error;
}

int verify_convergence(const char *const *paths, int count, bool of_all,
                       const struct cli_options *options)
{
    struct many_runs many;
    struct verify_options *verifying = many_runs_begin(&many, options, NULL);
    verifying->running.overwrite = true;
    verifying->ended = run_ended;
    struct error *error = NULL;
    for (int i = 0; i < count && !verify_stop_requested(verifying); i++) {
        struct simulation_case *input = NULL;
        struct error *wrong = ranks_agree(
            options->ranks, case_read(paths[i], &verifying->reading, &bolide_catalogue, &input));
        if (!wrong && (!of_all || document_has(input->document, "convergence")))
            wrong = study_case(paths[i], verifying, input, options);
        error = error_join(error, wrong);
        case_free(input);
    }
    int status;
    many_runs_end(&many, error, &status);
    return status;
}
