/* Output to the terminal: errors, lines of a run, the progress line, colours. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/visible.h"
#include "cli/cli.h"

/* open() returns the lowest free descriptor, so streams opened in this order get the standard
 * numbers. */
void terminal_open_closed_streams(void)
{
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; stream++)
        if (fcntl(stream, F_GETFD) < 0 && open("/dev/null", O_RDWR) != stream)
            exit(ERROR_SYSTEM);
}

/* The original stderr of a rank whose output is discarded, for alarms. */
static FILE *alarm_stream;

void terminal_silence(const struct ranks *ranks)
{
    if (ranks->rank == 0)
        return;
    alarm_stream = fdopen(dup(STDERR_FILENO), "w");
    if (!freopen("/dev/null", "w", stdout) || !freopen("/dev/null", "w", stderr))
        ranks_abort(ranks, ERROR_SYSTEM);
}

void terminal_alarm(const struct ranks *ranks, const struct error *error)
{
    FILE *stream = alarm_stream ? alarm_stream : stderr;
    for (int i = 0; i < error_count(error); i++)
        fprintf(stream, "rank %d: %s\n", ranks->rank, error_message(error, i));
    fflush(stream);
    ranks_abort(ranks, (int)error_kind(error));
}

/* The progress line goes to stderr, so that stdout has complete lines only. */
static bool draws_over(void) { return isatty(STDERR_FILENO); }

void terminal_clear_line(void)
{
    if (draws_over())
        fputs("\r\033[K", stderr);
}

const char *colour(enum colour which)
{
    const char *never = getenv("NO_COLOR");
    static const char *const sequences[] = {"\033[0m", "\033[32m", "\033[1;31m",
                                            "\033[2m", "\033[1m",  "\033[33m"};
    return isatty(STDOUT_FILENO) && !(never && *never) ? sequences[which] : "";
}

int report_error(struct error *error)
{
    int status = (int)error_kind(error);
    terminal_clear_line();
    fflush(stdout);
    for (int i = 0; i < error_count(error); i++)
        fprintf(stderr, "%s\n", error_message(error, i));
    error_free(error);
    return status;
}

static void say_line(void *context, const char *text)
{
    (void)context;
    terminal_clear_line();
    bool bad = strstr(text, "check FAILED") != NULL, warn = strstr(text, "check known deviation");
    fputs(bad ? colour(COLOUR_BAD) : warn ? colour(COLOUR_WARN) : "", stdout);
    text_put_visible(stdout, text);
    printf("%s\n", bad || warn ? colour(COLOUR_NONE) : "");
    fflush(stdout);
}

static void say_progress(void *context, const char *text)
{
    (void)context;
    FILE *stream = draws_over() ? stderr : stdout;
    if (draws_over())
        putc('\r', stream);
    text_put_visible(stream, text);
    fputs(draws_over() ? "\033[K" : "\n", stream);
    fflush(stream);
}

struct listener terminal_listener(void) { return (struct listener){say_line, say_progress, NULL}; }

struct progress_pace terminal_pace(void)
{
    return draws_over() ? (struct progress_pace){0.2, 0.0, 0.0}
                        : (struct progress_pace){2.0, 0.1, 10.0};
}
