/* bolide run: one case, or all runs of its sweep, into one folder. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "base/results.h"
#include "cli/cli.h"
#include "run/forecast.h"

/* Adds a blank and WORD to TEXT, quoted where a shell would take it apart. */
static void put_word(FILE *text, const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "/._-+=,:@%";
    const bool quoted = !*word || word[strspn(word, plain)];
    fputs(quoted ? " '" : " ", text);
    for (; *word; word++)
        if (*word == '\'')
            fputs("'\\''", text);
        else
            putc(*word, text);
    fputs(quoted ? "'" : "", text);
}

/* The command that continues the run of OPTIONS in fresh memory; NULL when memory is out. */
static char *resume_command(const struct cli_options *options)
{
    char *text = NULL;
    size_t size;
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return NULL;
    fputs("bolide run", file);
    put_word(file, options->names.text[0]);
    fputs(options->quick ? " --short" : options->thorough ? " --long" : "", file);
    for (int i = 0; i < options->settings.count; i++) {
        fputs(" --set", file);
        put_word(file, options->settings.text[i]);
    }
    if (options->output) {
        fputs(" --output", file);
        put_word(file, options->output);
    }
    if (options->ranks_wanted > 1)
        fprintf(file, " --ranks %lld", (long long)options->ranks_wanted);
    fputs(" --resume", file);
    if (fclose(file)) {
        free(text);
        return NULL;
    }
    return text;
}

/* Says TEXT (taken) as a line. */
static void say(const struct listener *listener, char *text)
{
    if (text)
        listener->line(listener->context, text);
    free(text);
}

/* How to go on with a run that was stopped. */
static void say_how_to_resume(const struct listener *listener, const struct cli_options *options)
{
    char *command = resume_command(options);
    if (command)
        say(listener, text_format("continue with --resume: %s", command));
    free(command);
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
    const struct listener listener = terminal_listener();
    char *rates = rates_path();
    struct many_runs many;
    struct verify_options *verifying = many_runs_begin(&many, options, folder);
    verifying->running.listener = &listener;
    verifying->running.rates = rates;
    struct verify_result result = {0};
    struct error *error =
        verify_case(options->names.text[0], input->name, folder, verifying, &result);
    if (result.count && result.item[0].sweep_values)
        report_sweep(&listener, &result, input->sweep_runs, folder);
    int status;
    if (many_runs_end(&many, error, &status))
        say_how_to_resume(&listener, options);
    verify_result_free(&result);
    free(rates);
    return status;
}

/* A run of more than a minute is announced. Its pilot, of which two may be tried, takes a small
 * fraction of it, and less than the user's patience. */
static const double WORTH_A_PILOT = 60.0, PILOT_FRACTION = 0.02, PILOT_SECONDS = 5.0;

static void announce(const struct simulation_case *input, const struct estimate *estimate,
                     const struct run_options *running, struct forecast *forecast)
{
    const double total = ranks_maximum(running->ranks, forecast_total(forecast));
    if (!(total > WORTH_A_PILOT) || forecast->steps > RUN_STEPS_HOPELESS)
        return;
    forecast_by_pilot(input, estimate, running, minimum(PILOT_SECONDS, PILOT_FRACTION * total),
                      forecast);
    char *text = forecast_text(forecast);
    if (text && forecast_total(forecast) > WORTH_A_PILOT)
        say(running->listener, text_copy(text));
    free(text);
}

/* What a run would say of its folder, before a pilot. */
static struct error *check_folder(const struct run_options *running)
{
    struct results_lock lock = {0};
    struct error *error = NULL;
    struct stat status;
    if (running->ranks->rank == 0 && !stat(running->output, &status) && S_ISDIR(status.st_mode)) {
        error = results_lock(running->output, &lock);
        if (!error)
            error = results_check(running->output, running->overwrite);
        results_unlock(&lock);
    }
    return ranks_agree(running->ranks, error);
}

/* Tells how long a run of INPUT will take, and refuses one that memory is too small for. A mistake
 * of the case is left to the run. */
static struct error *look_ahead(const struct simulation_case *input, struct run_options *running)
{
    struct estimate estimate;
    if (running->resume)
        return NULL;
    TRY(check_folder(running));
    struct error *error = estimate_size(input, &estimate);
    if (error) {
        error_free(error);
        return NULL;
    }
    struct forecast forecast = forecast_make(input, &estimate, running);
    if (!running->force)
        error = forecast_check_memory(input, &forecast, running->ranks);
    if (!error)
        announce(input, &estimate, running, &forecast);
    running->force = true; /* it has been looked at */
    estimate_free(&estimate);
    return error;
}

static int run_input(const struct simulation_case *input, const struct cli_options *options,
                     const char *folder)
{
    struct listener listener = terminal_listener();
    char *rates = rates_path();
    struct run_options running = running_of(options, folder, &listener, rates);
    struct run_result result = {0};
    struct error *error = look_ahead(input, &running);
    if (!error)
        error = run_case(input, &running, &result);
    free(rates);
    int status = EXIT_OK;
    if (error)
        status = report_error(error);
    else if (!result.finished)
        status = signals_status();
    else if (result.checks.failed)
        status = ERROR_CHECK;
    if (!error) {
        say(&listener, text_format("results in %s", folder));
        say(&listener, text_format("report: %s/report.html", folder));
        if (!result.finished)
            say_how_to_resume(&listener, options);
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
