/* bolide run: one case into one folder. */
#include <stdlib.h>

#include "base/memory.h"
#include "cli/cli.h"

static int run_input(const struct simulation_case *input, const struct cli_options *options,
                     const char *folder)
{
    struct listener listener = terminal_listener();
    struct run_options running = {
        .output = folder,
        .overwrite = options->overwrite,
        .resume = options->resume,
        .threads = (int)options->threads,
        .stop = signals_catch(),
        .listener = &listener,
        .progress = terminal_pace(),
    };
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
        char *words =
            text_format("results in %s%s", folder, result.finished ? "" : "; go on with --resume");
        if (words)
            listener.line(listener.context, words);
        free(words);
    }
    run_result_free(&result);
    return status;
}

int command_run(const struct cli_options *options)
{
    struct simulation_case *input;
    struct error *error = read_case(options->names.text[0], options, &input);
    if (error)
        return report_error(error);
    char *folder =
        options->output ? text_copy(options->output) : text_format("results/%s", input->name);
    int status = folder ? run_input(input, options, folder)
                        : report_error(error_new(ERROR_SYSTEM, "out of memory"));
    free(folder);
    case_free(input);
    return status;
}
