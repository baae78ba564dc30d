/* bolide run: one case, or all runs of its sweep, into one folder. */
#include <stdlib.h>

#include "base/memory.h"
#include "cli/cli.h"
#include "study/verify.h"

static struct run_options running_of(const struct cli_options *options, const char *folder,
                                     const struct listener *listener)
{
    return (struct run_options){
        .output = folder,
        .overwrite = options->overwrite,
        .resume = options->resume,
        .ranks = options->ranks,
        .threads = (int)options->threads,
        .fixed_threads = options_fix_threads(),
        .stop = signals_catch(),
        .checkpoints = signals_checkpoints(),
        .listener = listener,
        .alarm = terminal_alarm,
        .progress = terminal_pace(),
    };
}

/* Says TEXT (taken) as a line. */
static void say(const struct listener *listener, char *text)
{
    if (text)
        listener->line(listener->context, text);
    free(text);
}

static void report_sweep(const struct listener *listener, const struct verify_result *result,
                         int runs, const char *folder)
{
    char *checks = verify_checks_text(result);
    if (checks)
        say(listener,
            text_format("%d of %d runs passed%s; table in %s/sweep.csv, report: %s/report.html",
                        result->passed, runs, checks, folder, folder));
    free(checks);
}

static int run_sweep(const struct simulation_case *input, const struct cli_options *options,
                     const char *folder)
{
    struct listener listener = terminal_listener();
    char *materials = share_folder("materials");
    const char *const folders[] = {materials};
    struct verify_options verifying = {
        .reading = case_reading(options, folders),
        .catalogue = &bolide_catalogue,
        .running = running_of(options, folder, &listener),
    };
    struct verify_result result = {0};
    struct error *error =
        verify_case(options->names.text[0], input->name, folder, &verifying, &result);
    if (result.count && result.item[0].sweep_values)
        report_sweep(&listener, &result, input->sweep_runs, folder);
    int status = error ? report_error(error) : EXIT_OK;
    if (*verifying.running.stop) {
        say(&listener, text_copy("continue with --resume"));
        status = signals_status();
    }
    verify_result_free(&result);
    free(materials);
    return status;
}

static int run_input(const struct simulation_case *input, const struct cli_options *options,
                     const char *folder)
{
    struct listener listener = terminal_listener();
    struct run_options running = running_of(options, folder, &listener);
    struct run_result result;
    struct error *error = run_case(input, &running, &result);
    int status = EXIT_OK;
    if (error)
        status = report_error(error);
    else if (!result.finished)
        status = signals_status();
    else if (result.checks.failed)
        status = ERROR_CHECK;
    if (!error) {
        say(&listener, text_format("results in %s%s", folder,
                                   result.finished ? "" : "; continue with --resume"));
        say(&listener, text_format("report: %s/report.html", folder));
    }
    run_result_free(&result);
    return status;
}

int command_run(const struct cli_options *options)
{
    struct simulation_case *input;
    struct error *error =
        ranks_agree(options->ranks, read_case(options->names.text[0], options, &input));
    if (error)
        return report_error(error);
    char *folder;
    error = results_folder(options, options->names.text[0], input->name, &folder);
    int status = error               ? report_error(error)
                 : input->sweep_runs ? run_sweep(input, options, folder)
                                     : run_input(input, options, folder);
    free(folder);
    case_free(input);
    return status;
}
