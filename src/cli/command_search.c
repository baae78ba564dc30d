/* bolide search: bisection of a key of a case on whether a check passes. */
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "cli/cli.h"
#include "study/search.h"

/* "speed = 450 m/s: fails: 212 m/s (at most 0 m/s), 3.1 s" */
static void run_ended(void *context, const struct verify_case *verified)
{
    const struct search *search = context;
    const struct check_result *check = verify_find_check(verified, search->check);
    char measured[96] = "", allowed[96] = "";
    terminal_clear_line();
    if (verified->error || !check || !verified->sweep_values)
        return; /* the error tells of it */
    const bool passes = check->verdict == CHECK_PASSED || check->verdict == CHECK_PASSES_NOW;
    check_measured_text(check, measured, sizeof measured);
    check_allowed_text(check, allowed, sizeof allowed);
    printf("%s = %s: %s%s%s: %s%s%s (%s), %.1f s\n", search->key, verified->sweep[0].text,
           colour(passes ? COLOUR_GOOD : COLOUR_BAD), passes ? "passes" : "fails",
           colour(COLOUR_NONE), measured, check->nothing ? ": " : "",
           check->nothing ? check->nothing : "", allowed, verified->result.seconds);
    for (int i = 0; i < verified->result.warnings.count; i++) {
        const struct warning *warning = &verified->result.warnings.item[i];
        if (!warning->expected)
            printf("  %swarning%s: %s\n", colour(COLOUR_WARN), colour(COLOUR_NONE), warning->name);
    }
    fflush(stdout);
}

static void print_found(const struct search *search, const struct search_result *result)
{
    const char *space = *result->unit ? " " : "";
    const double middle = 0.5 * (result->passes + result->fails);
    printf("%s passes at %.6g%s%s and fails at %.6g%s%s: limit %s%.6g%s%s +- %.2g%s%s%s\n",
           search->check, result->passes, space, result->unit, result->fails, space, result->unit,
           colour(COLOUR_STRONG), middle, space, result->unit,
           0.5 * fabs(result->passes - result->fails), space, result->unit, colour(COLOUR_NONE));
}

static int search_case(const struct simulation_case *input, const struct search *search,
                       const struct cli_options *options)
{
    const char *path = options->names.text[0];
    char *folder = NULL;
    struct search_result result = {0};
    struct many_runs many;
    struct verify_options *verifying = many_runs_begin(&many, options, NULL);
    verifying->ended = run_ended;
    verifying->context = (void *)search;
    char *name = text_format("%s-search", input->name);
    struct error *error = name ? results_folder(options, path, name, &folder) : out_of_memory();
    if (!error)
        error = search_run(path, input->name, folder, verifying, search, &result);
    if (result.found)
        print_found(search, &result);
    if (result.runs.count && result.runs.item[0].sweep_values)
        printf("%d runs; table in %s/sweep.csv, report: %s/report.html\n", result.runs.count,
               folder, folder);
    int status;
    if (many_runs_end(&many, error, &status))
        printf("continue with --resume\n");
    search_result_free(&result);
    free(folder);
    free(name);
    return status;
}

int command_search(const struct cli_options *options)
{
    const struct search search = {options->key, options->from, options->to, options->check,
                                  options->within};
    if (!search.key || !search.from || !search.to || !search.check)
        return report_error(error_new(ERROR_INPUT, "search needs %s; see `bolide help search`",
                                      !search.key    ? "--key PATH, the key to vary"
                                      : !search.from ? "--from A, one end of the values"
                                      : !search.to   ? "--to B, the other end of the values"
                                                     : "--check NAME, the check to decide by"));
    struct simulation_case *input = NULL;
    struct error *error =
        ranks_agree(options->ranks, read_case(options->names.text[0], options, &input));
    int status = error ? report_error(error) : search_case(input, &search, options);
    case_free(input);
    return status;
}
