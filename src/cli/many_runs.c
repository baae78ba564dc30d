/* How commands run cases. */
#include <stdlib.h>

#include "cli/cli.h"

struct run_options running_of(const struct cli_options *options, const char *folder,
                              const struct listener *listener, const char *rates)
{
    return (struct run_options){
        .output = folder,
        .overwrite = options->overwrite,
        .resume = options->resume,
        .change = options->change,
        .force = options->force,
        .ranks = options->ranks,
        .threads = (int)options->threads,
        .fixed_threads = options_fix_threads(),
        .stop = signals_catch(),
        .checkpoints = signals_checkpoints(),
        .listener = listener,
        .alarm = terminal_alarm,
        .progress = terminal_pace(),
        .rates = rates,
    };
}

struct verify_options *many_runs_begin(struct many_runs *many, const struct cli_options *options,
                                       const char *folder)
{
    many->listener = (struct listener){.progress = terminal_listener().progress};
    many->materials = share_folder("materials");
    const bool draws_over = terminal_pace().fraction == 0.0;
    many->verifying = (struct verify_options){
        .reading = case_reading(options, (const char *const *)&many->materials),
        .catalogue = &bolide_catalogue,
        .running = running_of(options, folder, draws_over ? &many->listener : NULL, NULL),
    };
    return &many->verifying;
}

bool many_runs_end(struct many_runs *many, struct error *error, int *status)
{
    free(many->materials);
    *status = error ? report_error(error) : EXIT_OK;
    const bool stopped = *many->verifying.running.stop;
    if (stopped)
        *status = signals_status();
    return stopped;
}
