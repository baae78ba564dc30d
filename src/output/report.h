/* What a run tells while it goes: run.log, and a line of progress through the caller's function,
 * since the library never prints. */
#ifndef BOLIDE_RUN_REPORT_H
#define BOLIDE_RUN_REPORT_H

#include <stdio.h>

#include "model/solver.h"

/* Where the library sends its words: `line` gets whole lines for the user, `progress` the text of
 * one line that is drawn over again. Either may be NULL. */
struct listener {
    void (*line)(void *context, const char *text);
    void (*progress)(void *context, const char *text);
    void *context;
};

struct run_log;

/* Opens FOLDER's run.log (appending when RESUME) and sends lines to LISTENER too. */
struct error *run_log_open(const char *path, bool resume, const struct listener *listener,
                           struct run_log **log);
void run_log_line(struct run_log *log, const char *format, ...) BOLIDE_PRINTF(2, 3);
struct error *run_log_close(struct run_log *log);

/* The progress line: "step 1200  t 3.10 us of 5.00 us (62 %)  dt 2.1 ns (sound)  1.3 M updates/s
 * left 0:12". BUFFER holds SIZE bytes. */
void progress_text(const struct simulation *simulation, const struct limit *limit,
                   double updates_per_second, double seconds_left, char *buffer, size_t size);

/* A number with a readable unit multiple of the SI unit: 3.1e-6, "s" gives "3.1 us". */
void readable(double value, const char *unit, char *buffer, size_t size);

/* The same with DIGITS significant digits; `readable` gives four. */
void readable_digits(double value, const char *unit, int digits, char *buffer, size_t size);

#endif
