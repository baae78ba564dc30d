/* Verification: runs cases and gathers their checks in one table. */
#ifndef BOLIDE_VERIFY_H
#define BOLIDE_VERIFY_H

#include "run/run.h"

/* How one case went. Without checks it passes by coming to its end. */
struct verify_case {
    char *name;          /* topic/name: the last two folders of its path */
    struct error *error; /* NULL: it ran; owned */
    struct run_result result;
    bool passed;
};

struct verify_options {
    struct case_options reading; /* material folders, settings, the short form */
    const struct catalogue *catalogue;
    const char
        *output; /* folder in which each case gets one of its name; NULL: nothing is written */
    int threads;
    const volatile sig_atomic_t *stop;
    const struct listener
        *listener; /* its `line` gets nothing, its `progress` the running case's */
    struct progress_pace progress;
    /* Called when a case has ended, may be NULL. */
    void (*ended)(void *context, const struct verify_case *verified);
    void *context;
};

struct verify_result {
    int count, passed, checks, checks_passed;
    struct verify_case *item;
};

/* Runs the COUNT cases at PATHS one after the other. NULL when all pass; ERROR_CHECK when a check
 * failed; the gravest error when a case could not be read or run (the others run nevertheless). */
struct error *verify_cases(const char *const *paths, int count,
                           const struct verify_options *options, struct verify_result *result);
void verify_result_free(struct verify_result *result);

#endif
