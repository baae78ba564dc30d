/* Verification: runs cases, and all runs of those that have a sweep, and gathers their checks in
 * one table. */
#ifndef BOLIDE_VERIFY_H
#define BOLIDE_VERIFY_H

#include "run/run.h"

/* How one case, or one run of a sweep, went. Without checks it passes by coming to its end. */
struct verify_case {
    /* topic/name: the last two folders of its path; of a sweep with the run's folder behind */
    char *name;
    const char *path;
    const char *form;    /* static: "normal", "short" or "long" */
    struct error *error; /* NULL: it ran; owned */
    struct run_result result;
    bool passed;       /* a run of a convergence study: came to its end, whatever its checks say */
    bool warned;       /* it fails by a warning that the case does not expect */
    double resolution; /* m; of a run of a sweep or a study */
    bool fits;         /* no run: the fits through those of a sweep */
    int sweep_values;  /* 0: no run of a sweep */
    struct sweep_value *sweep;
};

struct verify_options {
    struct case_options reading; /* material folders, settings, the form */
    const struct catalogue *catalogue;
    /* How each is run. Output is the folder in which each case gets one of its name. */
    struct run_options running;
    bool record;        /* store what each measured beside it */
    bool compare;       /* with what is stored; what differs is an error */
    bool warnings_fail; /* a run fails by a warning that its case does not expect */
    /* Called when a case or a run of a sweep has ended, may be NULL. */
    void (*ended)(void *context, const struct verify_case *verified);
    void *context;
};

struct verify_result {
    int count;         /* items */
    int cases, passed; /* items that ran: not the fits through a sweep */
    /* REGRESSION_BOUNDS passed too, and are not counted among CHECKS_PASSED. */
    int checks, checks_passed, regression_bounds, known_deviations, measured_only;
    int warnings, unexpected; /* of the runs, and those that no case expects */
    struct verify_case *item;
};

/* "; 12 checks: 9 passed, 2 within regression bounds, 1 known deviation; 1 warning, expected"; of
 * what there is none, nothing is said. Owned by the caller; NULL when memory is out. */
char *verify_checks_text(const struct verify_result *result);

/* What the check called NAME of a run measured; NULL: it has none. */
const struct check_result *verify_find_check(const struct verify_case *run, const char *name);

/* Runs the COUNT cases at PATHS one after the other. NULL when all pass; ERROR_CHECK when a check
 * failed or a value differs from the record that it is compared with; the gravest error when a case
 * could not be read or run (the others run nevertheless). */
struct error *verify_cases(const char *const *paths, int count,
                           const struct verify_options *options, struct verify_result *result);

/* Runs the case at PATH, or every run of its sweep, as NAME into FOLDER (NULL: nothing is written);
 * a run of a sweep gets a folder in it, the sweep's table and plots stand beside these.
 * Options.running's own folder counts for nothing. RESULT, empty or not, grows by how each went.
 * With `resume`, a run that left a checkpoint goes on with it, another begins. As above, of all
 * that stands in RESULT. */
struct error *verify_case(const char *path, const char *name, const char *folder,
                          const struct verify_options *options, struct verify_result *result);
void verify_result_free(struct verify_result *result);

/* The ranks that run cases together. */
const struct ranks *verify_ranks(const struct verify_options *options);

/* Collective: whether any rank received a request to stop. */
bool verify_stop_requested(const struct verify_options *options);

/* "riemann/gas" of ".../riemann/gas/case.yaml", the path itself where it has no such folders. A
 * path with "." or ".." in it is resolved before. NULL when memory is out; free it. */
char *verify_name(const char *path);

#endif
