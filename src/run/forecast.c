/* Forecasts without a pilot; see forecast.h. */
#include "run/forecast.h"

#include <math.h>
#include <stdlib.h>

#include "base/machine.h"
#include "base/memory.h"
#include "model/solver.h"
#include "run/rates.h"

/* Updates a second of one thread where nothing was measured on this machine. */
static const double ASSUMED_RATE = 1e6;

static double members_of(const struct estimate *estimate)
{
    return (double)estimate->particles + estimate->cells;
}

/* Seconds of output a member and a time; those of a picture, by dimension, a member and whatever is
 * in it; those of the report. Measured on runs of the examples, SPH, MPM and gas alike within a
 * factor of two. */
static const double SNAPSHOT_SECONDS = 7e-7, CHECKPOINT_SECONDS = 7e-7, ROW_SECONDS = 1e-7,
                    PROFILE_SECONDS = 1e-7, PAGE_SECONDS = 0.1, PROBE_SECONDS = 5e-9,
                    PROBE_ROW_SECONDS = 2e-6;
static const double PICTURE_SECONDS[] = {3e-7, 6e-7, 3e-6}, SHEET_SECONDS[] = {0.01, 0.03, 0.15};

/* How many times an output with INTERVAL (NAN: none but the first and the last) is due. */
static double times_of(double interval, double until)
{
    return 2.0 + (interval > 0.0 ? ceil(until / interval) - 1.0 : 0.0);
}

static double seconds_of_probes(const struct simulation_case *input, double members, double steps)
{
    double seconds = 0.0;
    for (int i = 0; i < input->probes.count; i++) {
        const double every = case_probe(input, i)->every;
        const double rows =
            isnan(every) ? steps : minimum(steps, times_of(every, input->run.until));
        seconds += rows * (PROBE_ROW_SECONDS + PROBE_SECONDS * members);
    }
    return seconds;
}

double forecast_output(const struct simulation_case *input, const struct estimate *estimate,
                       const struct forecast *forecast)
{
    const struct output_input *output = &input->output;
    const double members = members_of(estimate);
    const double until = input->run.until;
    const double snapshots = minimum(forecast->steps + 1.0, times_of(output->every, until));
    const double history = isnan(output->history) ? 0.01 * until : output->history;
    const double rows = minimum(forecast->steps + 1.0, times_of(history, until));
    /* without the key one, of the bodies */
    const int pictures = output->pictures.names ? output->pictures.count : input->dimension > 1;
    const double each = (output->snapshots ? SNAPSHOT_SECONDS : 0.0) +
                        PROFILE_SECONDS * input->profiles.count +
                        PICTURE_SECONDS[input->dimension - 1] * pictures;
    const double checkpoints =
        1.0 + (output->checkpoint > 0.0 ? forecast->seconds / output->checkpoint : 0.0);
    return PAGE_SECONDS +
           snapshots * (each * members + SHEET_SECONDS[input->dimension - 1] * pictures) +
           rows * ROW_SECONDS * members + checkpoints * CHECKPOINT_SECONDS * members +
           seconds_of_probes(input, members, forecast->steps);
}

/* The case that INPUT starts from is computed with one thread. */
static double seconds_before(const struct simulation_case *input, const char *rates)
{
    const struct start_input *start = &input->start;
    const struct run_options alone = {.threads = 1, .rates = rates};
    if (!start->input)
        return 0.0;
    struct simulation_case source = *start->input;
    struct estimate estimate;
    if (!isnan(start->at))
        source.run.until = minimum(source.run.until, start->at);
    struct error *error = estimate_size(&source, &estimate);
    if (error) {
        error_free(error);
        return 0.0;
    }
    const struct forecast forecast = forecast_make(&source, &estimate, &alone);
    estimate_free(&estimate);
    return forecast.seconds + forecast.before;
}

/* Of the program and its libraries, of a picture in 1-D, 2-D and 3-D, and a member, of what sorts
 * and writes it. Measured on blocks of 1e4 to 1e5 members with SPH, MPM and gas. */
static const double PROGRAM_BYTES = 2e7, PICTURE_BYTES[] = {7e6, 2.2e7, 1.3e7},
                    WORKING_BYTES = 75.0, SNAPSHOT_BYTES = 140.0;

static double bytes_of(const struct simulation_case *input, const struct estimate *estimate)
{
    const struct output_input *output = &input->output;
    const double members = members_of(estimate);
    const double written = output->snapshots ? SNAPSHOT_BYTES * members : 0.0;
    const double drawn = output->pictures.count ? PICTURE_BYTES[input->dimension - 1] : 0.0;
    return PROGRAM_BYTES + estimate->bytes + WORKING_BYTES * members + maximum(written, drawn);
}

struct forecast forecast_make(const struct simulation_case *input, const struct estimate *estimate,
                              const struct run_options *options)
{
    const double members = members_of(estimate);
    const int ranks = options->ranks ? options->ranks->size : 1;
    struct forecast forecast = {.threads = ranks * run_threads(options->threads, members / ranks)};
    const double found = rates_find(options->rates, input, forecast.threads);
    const double rate = isnan(found) ? ASSUMED_RATE * forecast.threads : found;
    forecast.steps = ceil(forecast_steps(input, estimate, 0.0));
    if (input->run.max_steps > 0)
        forecast.steps = minimum(forecast.steps, (double)input->run.max_steps);
    forecast.before = seconds_before(input, options->rates);
    forecast.rate = isnan(found) ? RATE_ASSUMED : RATE_OF_EARLIER_RUN;
    forecast.seconds = forecast.steps * members / rate;
    forecast.output = forecast_output(input, estimate, &forecast);
    forecast.bytes = bytes_of(input, estimate);
    return forecast;
}

double forecast_total(const struct forecast *forecast)
{
    return forecast->before + forecast->seconds + forecast->output;
}

/* "24 s", "3 min", "2.5 h". */
static void duration_text(double seconds, char *buffer, size_t size)
{
    static const struct {
        double from, unit;
        const char *name;
    } units[] = {{172800.0, 86400.0, "days"}, {7200.0, 3600.0, "h"}, {120.0, 60.0, "min"}};
    for (size_t i = 0; i < COUNT_OF(units); i++)
        if (seconds >= units[i].from) {
            snprintf(buffer, size, "%.2g %s", seconds / units[i].unit, units[i].name);
            return;
        }
    snprintf(buffer, size, seconds < 10.0 ? "%.2g s" : "%.0f s", seconds);
}

char *forecast_text(const struct forecast *forecast)
{
    char time[48], output[48], source[128] = "", before[96] = "";
    duration_text(forecast->seconds, time, sizeof time);
    duration_text(forecast->output, output, sizeof output);
    if (forecast->before > 0.0) {
        char text[48];
        duration_text(forecast->before, text, sizeof text);
        snprintf(before, sizeof before, " + %s for the start", text);
    }
    if (forecast->rate == RATE_OF_PILOT) {
        char resolution[48], took[48];
        readable(forecast->pilot_resolution, "m", resolution, sizeof resolution);
        duration_text(forecast->pilot_seconds, took, sizeof took);
        snprintf(source, sizeof source, "pilot: resolution %s, %s", resolution, took);
    } else
        snprintf(source, sizeof source, "%s; --pilot measures",
                 forecast->rate == RATE_ASSUMED ? "a guess" : "at the rate of the last run");
    return text_format("about %.0f steps, %s + %s for output%s on %d thread%s (%s)",
                       forecast->steps, time, output, before, forecast->threads,
                       forecast->threads == 1 ? "" : "s", source);
}

struct error *forecast_check_memory(const struct simulation_case *input,
                                    const struct forecast *forecast, const struct ranks *ranks)
{
    const double here = forecast->bytes * ranks_beside(ranks) / ranks->size;
    const double lacking = ranks_maximum(ranks, here - machine_memory());
    char needed[48], there[48];
    if (!(lacking > 0.0))
        return NULL;
    readable(here, "B", needed, sizeof needed);
    readable(machine_memory(), "B", there, sizeof there);
    return input_error(input, "resolution", NULL,
                       "the run needs about %s of memory, and there are %s: choose a coarser "
                       "resolution or a larger machine; --force runs it nevertheless",
                       needed, there);
}
