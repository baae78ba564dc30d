/* Calibration: keys of a case are fitted to measured values, by least squares, in runs that each
 * compute the case and its further cases with other values of the keys. */
#ifndef BOLIDE_CALIBRATE_H
#define BOLIDE_CALIBRATE_H

#include "page/curve.h"
#include "study/least_squares.h"
#include "study/verify.h"

/* A target in one computation, of which a sweep has several. */
struct calibrated_value {
    char *name;           /* "length", "length, speed=300 m/s" */
    int target;           /* of the case */
    int computation;      /* of the calibration */
    int first, count;     /* its residuals */
    double is, deviation; /* is: of a check */
    char unit[DIMENSION_TEXT];
    struct curve data; /* of a trace */
};

/* A computation of a run: one of the files, and the run of its sweep. */
struct computation {
    int file;
    char *name;  /* of the folder of the run of its sweep; NULL: it has none */
    char *label; /* the same for people, "speed=130 m/s", where that is unique */
};

/* One of the cases: FILE 0 is the case itself. */
struct calibrated_file {
    char *path, *folder; /* folder: in that of a run; NULL: that itself */
    int first, count;    /* its computations */
};

struct calibrated_run {
    double key[CALIBRATED_KEYS_MAX]; /* SI */
    double *measured;                /* of each value; root mean square of a trace. NAN: none */
    double *residual;
    double sum;     /* of squares; INFINITY: it failed */
    double seconds; /* 0: taken from an earlier calibration */
    char *failure;  /* why; NULL: it did not */
};

struct calibration {
    const struct simulation_case *input;
    const char *folder;
    int files, computations, values, residuals, runs;
    struct calibrated_file *file;
    struct computation *computation;
    struct calibrated_value *value;
    struct calibrated_run *run;
    char **path; /* of each key in the case */
    struct least_squares_result fit;
    double covariance[CALIBRATED_KEYS_MAX * CALIBRATED_KEYS_MAX];
    int best; /* run; -1: none */
};

/* Called after each run, the last of the calibration. */
typedef void calibrate_ended(void *context, const struct calibration *calibration);

/* Calibrates INPUT, the case at PATH as OPTIONS read it, in FOLDER, where each run gets a folder;
 * see the files in docs/case.md. With `resume` runs that FOLDER's table has are not repeated. A run
 * that cannot start ends it with its error, one that stops in an impossible state is a failed run.
 * Free CALIBRATION also after an error. */
struct error *calibrate(const struct simulation_case *input, const char *path, const char *folder,
                        const struct verify_options *options, calibrate_ended *ended, void *context,
                        struct calibration *calibration);
void calibration_free(struct calibration *calibration);

/* Prepares a calibration of INPUT, the case at PATH, and drops it: ERROR_INPUT for what is wrong
 * with its further cases, or with probes and traces of its targets. */
struct error *calibrate_validate(const struct simulation_case *input, const char *path,
                                 const struct verify_options *options);

/* Key K of the best run, its standard deviation, and the correlation of two keys. */
double calibrated_value_of(const struct calibration *calibration, int k);
double calibrated_deviation(const struct calibration *calibration, int k);
double calibrated_correlation(const struct calibration *calibration, int k, int other);

/* The unit of key K. */
const char *calibrated_unit(const struct calibration *calibration, int k, char *buffer);

/* What must be said of key K: that it is at a bound, has no influence, or which others the targets
 * do not tell it apart from. "" where nothing; NULL when memory is out. Free it. */
char *calibrated_note(const struct calibration *calibration, int k);

/* The misfit of value V in RUN: root mean square over its deviation. */
double calibrated_misfit(const struct calibration *calibration, int v,
                         const struct calibrated_run *run);

/* calibrate_files.c */

/* The table of the runs in the folder of a calibration. */
extern const char calibrate_table_name[];
struct error *calibrate_write_runs(const struct calibration *calibration);
/* What came out: the keys, the targets, an include, a page. */
struct error *calibrate_write_result(const struct calibration *calibration);
/* Reads the runs of an earlier calibration; ERROR_INPUT when it had other keys or targets. */
struct error *calibrate_read_runs(struct calibration *calibration);
/* The folder of run INDEX, in fresh memory. */
char *calibrate_run_folder(const struct calibration *calibration, int index);

/* calibrate_values.c */

/* What replaces values of the case FILE: the USER's settings, but for those of `calibrate` where it
 * is a further case, and with KEYS (NULL: none) those of a run. Free also after an error. */
struct calibrate_settings {
    const char **text;
    int count, first; /* FIRST of our own */
};
struct error *calibrate_settings(const struct calibration *calibration, int file,
                                 const double *keys, const struct case_options *user,
                                 struct calibrate_settings *settings);
void calibrate_settings_free(struct calibrate_settings *settings);
/* The folder of the computation AT of RUN, in fresh memory. */
char *calibrate_computation_folder(const struct calibration *calibration, int run, int at);
/* Finds the files, their computations and the values. */
struct error *calibrate_prepare(struct calibration *calibration, const char *path,
                                const struct verify_options *options);
/* ERROR_INPUT where CHECK, of the value V, measures what has not the dimension of the target. */
struct error *calibrate_check_unit(const struct calibration *calibration, int v,
                                   const struct check_result *check);
/* Fills the residuals of value V from what RUN, whose results are in FOLDER, measured. */
struct error *calibrate_residuals(const struct calibration *calibration, int v, const char *folder,
                                  struct calibrated_run *run);

/* calibrate_traces.c */

/* Reads the trace of VALUE, of a target of a probe in HERE, the case of its computation. */
struct error *calibrate_prepare_trace(const struct calibration *calibration,
                                      const struct simulation_case *here,
                                      struct calibrated_value *value);
/* Fills its residuals from the probe whose record is in FOLDER. */
struct error *calibrate_trace_residuals(const struct calibration *calibration, int v,
                                        const char *folder, struct calibrated_run *run);

#endif
