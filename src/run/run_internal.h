/* A run in progress; private to run.c and run_*.c. */
#ifndef BOLIDE_RUN_INTERNAL_H
#define BOLIDE_RUN_INTERNAL_H

#include "base/results.h"
#include "case/changes.h"
#include "measure/histograms.h"
#include "measure/probes.h"
#include "measure/profiles.h"
#include "output/checkpoint.h"
#include "output/history.h"
#include "run/judge.h"
#include "run/run.h"
#include "run/threads.h"
#include "run/warnings.h"

/* How far a run was at a moment of wall clock. */
struct progress_mark {
    double clock, time;
    int64_t step;
};

struct run {
    const struct simulation_case *input;
    const struct run_options *options;
    struct run_result *result;
    struct ranks ranks;
    struct simulation simulation;
    struct threads threads; /* of this rank */
    const struct solver_class *method;
    void *solver;
    struct population population; /* as it is now; of several the first */
    struct probes probes;
    const char *keeps; /* a probe whose rows stay in memory; NULL: none */
    struct profiles profiles;
    struct histograms histograms;
    struct checks *checks;
    struct judgement judgement; /* of the case, by its solver */
    struct warnings *warnings;
    struct limit limit;
    double step;                            /* the last one taken, s */
    double largest_step;                    /* of all, s */
    int64_t collapsed_steps;                /* the last so many were far too short */
    bool sound;                             /* the state is that of the end of a step */
    int64_t particles;                      /* of all ranks */
    bool stop_requested, checkpoint_is_due; /* on any rank */
    bool checkpoint_is_wanted;              /* by the user, and not yet written */
    sig_atomic_t checkpoints_requested;     /* requests for one that have been seen */

    /* What a resumed run needs beside the state: the totals at time zero, how many times each
     * output has been due and been written, and when. */
    struct totals start;
    struct check_memory *check_memory;
    int64_t history_due, snapshots_due; /* times the interval has passed */
    int64_t history_rows, snapshots;
    int64_t history_step; /* of the last row */
    struct csv_mark history_mark;
    double *snapshot_times;
    uint64_t *snapshot_hashes; /* of their files, 0 where there is none */
    int64_t snapshot_room;     /* in both */

    char *case_text;
    struct case_changes changes; /* from the case of the checkpoint that is loaded */
    struct {
        int64_t changed;  /* resumes with another case */
        int64_t segment;  /* those of them with another physics: the part of the run this is */
        int64_t past_end; /* the state is that of a step that was shortened to end the run */
    } resumes;
    bool shortened;          /* a step has been, to end the run */
    double removed_until;    /* s, the time of the bodies that were taken away last */
    int64_t checkpoint_step; /* of checkpoint.h5; -1: there is none */
    double checkpoint_time;  /* s */
    struct results_lock lock;
    struct run_log *log;
    struct history *history;
    double began, last_checkpoint, last_progress; /* clock_seconds() */
    double waited_before;                         /* delay_seconds() when the steps began */
    double last_progress_time;                    /* of the simulation */
    struct progress_mark mark[2];                 /* what is left is judged since the first */
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

/* Makes room for the times and hashes of COUNT snapshots, of which KEPT are known; false: there is
 * no memory. */
bool run_reserve_snapshots(struct run *run, int64_t count, int64_t kept);

/* Asks for run->population anew, after a step or a change of its members. */
void run_observe(struct run *run);

/* Takes the outputs that are due at this moment: history, snapshot; those of the last moment with
 * LAST. Also looks at what is conserved. */
struct error *run_watch(struct run *run, bool last);
/* Collective: draws the pictures of all snapshots. */
struct error *run_draw_pictures(struct run *run);
void run_progress(struct run *run);

/* Collective, at a row of the history, where the totals are NOW: warnings, and the error of an
 * energy that drifts too far. */
struct error *run_watch_physics(struct run *run, const struct totals *now);
/* Then too, after the probes: warnings of tracers. */
struct error *run_watch_tracers(struct run *run);
/* Computes the cases that the records of loads name, each rank for itself. */
struct error *run_take_records(struct run *run);
/* Runs INPUT without files, with all rows of its probe NAME, which TAKE then looks at. */
struct error *run_probe(const struct simulation_case *input, const struct run_options *options,
                        const char *name,
                        struct error *(*take)(const struct probe *probe, void *context),
                        void *context);
/* Collective: says what each load has delivered beside what it should have. */
void run_report_loads(struct run *run);

/* What a resumed run has otherwise (run_changes.c): collective, the difference of the case from
 * that of the checkpoint, and the errors of what may not change; which of the probes of the
 * checkpoint each probe is, and how many it has; the memory of checks; after the rest is loaded,
 * collective, the errors that need it, and what follows from the changes; the record of them, and
 * lines for the user. */
struct error *run_find_changes(struct run *run);
void run_place_probes(struct run *run);
int run_stored_probes(const struct run *run);
struct error *run_visit_checks(struct run *run, struct visitor *visitor);
struct error *run_check_loaded_changes(struct run *run);
struct error *run_follow_changes(struct run *run);
struct error *run_record_changes(struct run *run);
void run_report_changes(struct run *run);

/* s; the interval of history.csv. */
double run_history_interval(const struct run *run);

/* Before which the remaining time is spread over the last two steps, whose limit is not known yet:
 * that of the step before may be smaller. */
#define RUN_STEPS_BEFORE_END 3.0

/* Collective, before a step: keeps a checkpoint where this step may be the first that is shortened
 * to end the run, so that the run can be extended. */
struct error *run_checkpoint_before_end(struct run *run);
/* checkpoint.h5 at the end, unless that is there. */
struct error *run_checkpoint_at_end(struct run *run);

/* checkpoint.h5 now, and whether its wall-clock time has come. */
struct error *run_checkpoint(struct run *run);
bool run_checkpoint_is_due(const struct run *run);
struct error *run_load(struct run *run);

/* Collective: what is left of a run that fails with ERROR, which is taken: a snapshot of the
 * moment, and a checkpoint where the state is sound. Returns ERROR, joined with what went wrong
 * in the writing. */
struct error *run_save_failure(struct run *run, struct error *error);

/* Collective, once a step: all ranks learn of errors, of particles that were added or removed, of a
 * request to stop, and of a checkpoint that is due on any rank. Takes ERROR. */
struct error *run_agree(struct run *run, struct error *error);
struct error *run_take_step(struct run *run);

/* Collective, after a step: ERROR_STATE when steps have become so short that no run would end. */
struct error *run_check_step(struct run *run);
/* Says after the first step how many will follow if they are hopelessly many. */
void run_warn_of_length(struct run *run);

/* The lines at the beginning of a run, and at its end; before the latter, how fast it was goes into
 * the result and the table of rates. */
void run_report_beginning(struct run *run);
void run_measure_speed(struct run *run);
void run_report_end(struct run *run);

/* Whether the case begins with the particles of another run; what is wrong with that; takes them,
 * and its time (run_start.c). The last is collective. */
bool run_starts_from_folder(const struct run *run);
struct error *run_check_start(const struct run *run);
struct error *run_take_start(struct run *run);

/* summary.csv at the beginning of a run; and at its end, with what went wrong (ERROR, NULL:
 * nothing), then report.html. run_report returns ERROR, joined with what went wrong in the
 * writing. */
struct error *run_summary_begin(const struct run *run);
struct error *run_report(const struct run *run, struct error *error);

#endif
