/* bolide verify: cases and their checks as one table. */
#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "cli/cli.h"

struct row {
    char measured[96], allowed[96];
};

static void case_ended(void *context, const struct verify_case *verified)
{
    (void)context;
    terminal_clear_line();
    printf("%s: %s%s%s, %.1f s, %.3g M updates/s, energy drift %.2g\n", verified->name,
           colour(verified->passed ? COLOUR_GOOD : COLOUR_BAD),
           verified->error    ? "could not run"
           : verified->passed ? "passed"
                              : "FAILED",
           colour(COLOUR_NONE), verified->result.seconds,
           1e-6 * verified->result.updates_per_second, verified->result.energy_drift);
    const struct warning_results *warnings = &verified->result.warnings;
    for (int i = 0; i < warnings->count; i++) {
        const struct warning *warning = &warnings->item[i];
        printf("  %s%swarning%s: %s%s%s\n", colour(COLOUR_WARN),
               warning->expected ? "expected " : "", colour(COLOUR_NONE),
               warning->expected ? warning->name : warning->text, warning->expected ? ": " : "",
               warning->expected ? warning->expected : "");
    }
    fflush(stdout);
}

static int longer(int width, const char *text)
{
    int length = text ? (int)strlen(text) : 0;
    return length > width ? length : width;
}

static void print_rule(int width)
{
    for (int i = 0; i < width; i++)
        putchar('-');
    putchar('\n');
}

static const char *colour_of(const struct check_result *result)
{
    return colour(check_failed(result)                       ? COLOUR_BAD
                  : result->verdict == CHECK_KNOWN_DEVIATION ? COLOUR_WARN
                  : result->verdict == CHECK_MEASURED_ONLY   ? COLOUR_NONE
                                                             : COLOUR_GOOD);
}

/* Each case's name stands at its first check. */
static void print_table(const struct verify_result *result)
{
    int name = 4, check = 5, measured = 8, allowed = 7;
    struct row row;
    for (int i = 0; i < result->count; i++) {
        const struct verify_case *verified = &result->item[i];
        name = longer(name, verified->name);
        for (int k = 0; k < verified->result.checks.count; k++) {
            const struct check_result *r = &verified->result.checks.item[k];
            check_measured_text(r, row.measured, sizeof row.measured);
            check_allowed_text(r, row.allowed, sizeof row.allowed);
            check = longer(check, r->name);
            measured = longer(measured, row.measured);
            allowed = longer(allowed, row.allowed);
        }
    }
    printf("\n%-*s  %-*s  %-*s  %-*s  verdict\n", name, "case", check, "check", measured,
           "measured", allowed, "allowed");
    print_rule(name + check + measured + allowed + 15);
    for (int i = 0; i < result->count; i++) {
        const struct verify_case *verified = &result->item[i];
        for (int k = 0; k < verified->result.checks.count; k++) {
            const struct check_result *r = &verified->result.checks.item[k];
            check_measured_text(r, row.measured, sizeof row.measured);
            check_allowed_text(r, row.allowed, sizeof row.allowed);
            char *verdict = check_verdict_text(r);
            printf("%-*s  %-*s  %-*s  %-*s  %s%s%s\n", name, k ? "" : verified->name, check,
                   r->name, measured, row.measured, allowed, row.allowed, colour_of(r),
                   verdict ? verdict : check_verdict_name(r->verdict), colour(COLOUR_NONE));
            free(verdict);
        }
    }
    print_rule(name + check + measured + allowed + 15);
    char *checks = verify_checks_text(result);
    printf("%d of %d cases passed%s\n", result->passed, result->cases, checks ? checks : "");
    free(checks);
}

static int verify_paths(const char *const *paths, int count, const struct cli_options *options)
{
    struct many_runs many;
    struct verify_options *verifying = many_runs_begin(&many, options, options->output);
    verifying->reading.recording = options->record;
    verifying->record = options->record;
    verifying->compare = options->compare;
    verifying->warnings_fail = true;
    verifying->ended = case_ended;
    struct verify_result result;
    struct error *error = verify_cases(paths, count, verifying, &result);
    if (result.checks || result.warnings)
        print_table(&result);
    int status;
    many_runs_end(&many, error, &status);
    verify_result_free(&result);
    return status;
}

static int verify_listed(const char *const *paths, int count, const struct cli_options *options)
{
    return options->convergence ? verify_convergence(paths, count, options->all, options)
                                : verify_paths(paths, count, options);
}

static int verify_all(const struct cli_options *options)
{
    char *examples = share_folder("examples");
    char *pattern = examples ? text_format("%s/*/*/case.yaml", examples) : NULL;
    glob_t found = {0};
    int status;
    if (!pattern || glob(pattern, 0, NULL, &found) || !found.gl_pathc)
        status = report_error(error_new(ERROR_INPUT, "no examples found; set BOLIDE_SHARE to the "
                                                     "folder that holds examples/ and materials/"));
    else
        status = verify_listed((const char *const *)found.gl_pathv, (int)found.gl_pathc, options);
    globfree(&found);
    free(pattern);
    free(examples);
    return status;
}

int command_verify(const struct cli_options *options)
{
    if (options->all == (options->names.count > 0))
        return report_error(
            error_new(ERROR_INPUT, "verify needs cases, or --all; see `bolide help verify`"));
    return options->all ? verify_all(options)
                        : verify_listed(options->names.text, options->names.count, options);
}
