/* run.log, the progress line and readable numbers; see report.h. */
#include "output/report.h"

#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"

struct run_log {
    FILE *file;
    char *path;
    struct listener listener;
    bool failed; /* a line could not be written; told when the log is closed */
};

struct error *run_log_open(const char *path, bool resume, const struct listener *listener,
                           struct run_log **log)
{
    struct run_log *made = calloc(1, sizeof *made);
    char *copy = text_copy(path);
    FILE *file = NULL;
    struct error *error = made && copy ? file_open(path, resume ? "a" : "w", &file)
                                       : error_new(ERROR_SYSTEM, "%s: out of memory", path);
    if (error) {
        free(copy);
        free(made);
        return error;
    }
    *made = (struct run_log){.file = file, .path = copy};
    if (listener)
        made->listener = *listener;
    *log = made;
    return NULL;
}

void run_log_line(struct run_log *log, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *text = text_vformat(format, arguments);
    va_end(arguments);
    if (!text) {
        log->failed = true;
        return;
    }
    if (fprintf(log->file, "%s\n", text) < 0 || fflush(log->file))
        log->failed = true;
    if (log->listener.line)
        log->listener.line(log->listener.context, text);
    free(text);
}

struct error *run_log_close(struct run_log *log)
{
    if (!log)
        return NULL;
    bool failed = fclose(log->file) || log->failed;
    struct error *error =
        failed ? error_new(ERROR_SYSTEM, "%s: not all lines could be written", log->path) : NULL;
    free(log->path);
    free(log);
    return error;
}

/* The prefix with which VALUE, rounded to four digits, stands between 1 and 1000, from pico to
 * giga. */
static const char *prefix_of(double value, double *scale)
{
    static const struct {
        const char *name;
        double scale;
    } prefixes[] = {{"G", 1e9},  {"M", 1e6},  {"k", 1e3}, {"", 1.0},
                    {"m", 1e-3}, {"u", 1e-6}, {"n", 1e-9}};
    for (size_t i = 0; i < COUNT_OF(prefixes); i++)
        if (fabs(value) >= prefixes[i].scale * 0.99995) {
            *scale = prefixes[i].scale;
            return prefixes[i].name;
        }
    *scale = 1e-12;
    return "p";
}

/* True where a prefix before UNIT multiplies the whole: not "kg", "%", "1/s", "m^2", and nobody
 * says kilokelvin. */
static bool takes_prefix(const char *unit)
{
    static const char *const without[] = {"", "%", "1", "K", "degC", "deg", "rad", "g", "kg"};
    size_t length = strcspn(unit, "/*^");
    for (size_t i = 0; i < COUNT_OF(without); i++)
        if (strlen(without[i]) == length && !strncmp(unit, without[i], length))
            return false;
    return unit[length] != '^';
}

void readable(double value, const char *unit, char *buffer, size_t size)
{
    readable_digits(value, unit, 4, buffer, size);
}

void readable_digits(double value, const char *unit, int digits, char *buffer, size_t size)
{
    double scale = 1.0;
    const char *prefix = "";
    if (takes_prefix(unit) && value != 0.0 && isfinite(value))
        prefix = prefix_of(value, &scale);
    if (!strcmp(prefix, "k") && !strcmp(unit, "s")) {
        prefix = "";
        scale = 1.0;
    }
    snprintf(buffer, size, "%.*g%s%s%s", digits, value / scale, *unit ? " " : "", prefix, unit);
}

/* The same with a steady number of digits, for a line that is drawn over and over. */
static void steady(double value, const char *unit, int digits, char *buffer, size_t size)
{
    double scale = 1.0;
    const char *prefix = value != 0.0 && isfinite(value) ? prefix_of(value, &scale) : "";
    double shown = fabs(value / scale);
    int decimals = digits - (shown >= 99.995 ? 3 : shown >= 9.9995 ? 2 : 1);
    snprintf(buffer, size, "%.*f %s%s", decimals > 0 ? decimals : 0, value / scale, prefix, unit);
}

/* "0:12", "3:05:09" */
static void clock_text(double seconds, char *buffer, size_t size)
{
    if (!(seconds >= 0.0 && seconds < 1e9)) {
        snprintf(buffer, size, "?");
        return;
    }
    long whole = lround(seconds), hours = whole / 3600, minutes = whole / 60 % 60;
    if (hours)
        snprintf(buffer, size, "%ld:%02ld:%02ld", hours, minutes, whole % 60);
    else
        snprintf(buffer, size, "%ld:%02ld", minutes, whole % 60);
}

void progress_text(const struct simulation *simulation, const struct limit *limit,
                   double updates_per_second, double seconds_left, char *buffer, size_t size)
{
    char now[32], until[32], dt[32], rate[32], left[32];
    double end = simulation->problem->input->run.until;
    steady(simulation->time, "s", 3, now, sizeof now);
    steady(end, "s", 3, until, sizeof until);
    steady(limit->dt, "s", 2, dt, sizeof dt);
    steady(updates_per_second, "", 2, rate, sizeof rate);
    clock_text(seconds_left, left, sizeof left);
    double share = end > 0.0 ? 100.0 * simulation->time / end : 100.0;
    size_t rate_length = strlen(rate);
    if (rate_length && rate[rate_length - 1] == ' ')
        rate[rate_length - 1] = '\0';
    snprintf(buffer, size, "step %lld  t %s of %s (%.0f %%)  dt %s (%s)  %s updates/s  left %s",
             (long long)simulation->step, now, until, share, dt, limit->why ? limit->why : "?",
             rate, left);
}
