/* A run in progress; private to run.c and run_output.c. */
#ifndef BOLIDE_RUN_INTERNAL_H
#define BOLIDE_RUN_INTERNAL_H

#include "measure/probes.h"
#include "measure/profiles.h"
#include "output/checkpoint.h"
#include "output/history.h"
#include "run/run.h"

struct run {
    const struct simulation_case *input;
    const struct run_options *options;
    struct run_result *result;
    struct ranks ranks;
    struct simulation simulation;
    const struct solver_class *method;
    void *solver;
    struct views views;
    struct probes probes;
    struct profiles profiles;
    struct checks *checks;
    struct limit limit;
    double step;                          /* the last one taken, s */
    int64_t particles;                    /* of all ranks */
    bool told_to_stop, checkpoint_is_due; /* a rank of them was, to a rank it is */

    /* What a resumed run needs beside the state: the totals at time zero, how many times each
     * output has been due and been written, and when. */
    struct totals start;
    struct check_memory *check_memory;
    int64_t history_due, snapshots_due; /* times the interval has passed */
    int64_t history_rows, snapshots;
    double *snapshot_times;
    int64_t snapshot_room;

    char *case_text;
    struct run_log *log;
    struct history *history;
    double began, last_checkpoint, last_progress; /* clock_seconds() */
    double start_time, last_progress_time;        /* of the simulation */
    double watching;                              /* wall-clock seconds spent in outputs */
    int64_t first_step;
};

/* The folder's path of NAME; NULL without a folder. Free it. */
char *run_path(const struct run *run, const char *name);

/* This rank writes the files. */
bool run_writes(const struct run *run);

/* A line for the log and the user. */
void run_say(struct run *run, const char *format, ...) BOLIDE_PRINTF(2, 3);

/* Looks whether the folder can take this run, or go on with it, and makes the text of the case;
 * nothing is written. */
struct error *run_check_folder(struct run *run);

/* Readies the folder, the log, the case as run and the history. */
struct error *run_open_folder(struct run *run);
struct error *run_close_files(struct run *run, struct error *error);

/* Fills run->views with what the solver shows now. */
void run_observe(struct run *run);

/* Takes the outputs that are due at this moment: history, snapshot, pictures; those of the last
 * moment with LAST. Also looks at what is conserved. */
struct error *run_watch(struct run *run, bool last);
void run_progress(struct run *run);

/* checkpoint.h5 now, and whether its wall-clock time has come. */
struct error *run_checkpoint(struct run *run);
bool run_checkpoint_is_due(const struct run *run);
struct error *run_load(struct run *run);

/* summary.csv at the beginning of a run; and at its end, with what went wrong (ERROR, NULL: nothing), then
 * report.html. run_report returns ERROR, joined with what went wrong in the writing. */
struct error *run_summary_begin(const struct run *run);
struct error *run_report(const struct run *run, struct error *error);

/* snapshots/failed.vtkhdf: the moment of an impossible state. */
struct error *run_snapshot_of_failure(struct run *run);

#endif
