/* The run loop: from a case to its last state, its files and its verdicts. */
#ifndef BOLIDE_RUN_H
#define BOLIDE_RUN_H

#include <signal.h>

#include "output/report.h"
#include "run/checks.h"
#include "run/warnings.h"

/* How often progress is shown: at least this many seconds of wall clock and this fraction of the
 * run since the last time; or SILENCE seconds, which grow to a twentieth of what the run has
 * taken, but not beyond ten minutes. */
struct progress_pace {
    double seconds, fraction, silence;
};

/* A run of more steps does not end in a time that anybody has. */
enum { RUN_STEPS_HOPELESS = 1000000000 };

struct run_options {
    const char *output;        /* folder of the results; NULL: nothing is written */
    bool overwrite;            /* results that are there already give way */
    bool resume;               /* go on from the folder's checkpoint */
    bool change;               /* from there on with other values of keys that allow it */
    bool force;                /* whatever memory there is */
    const struct ranks *ranks; /* that run it together; NULL: this process alone */
    int threads;               /* at most; 0: as many as OpenMP would take */
    bool fixed_threads;        /* never fewer than there is work for, however busy the machine is */
    int64_t max_steps;         /* of this call, which then stops as if told to; 0: no limit */
    double max_seconds;        /* of wall clock, after the first step of this call; 0: no limit */
    const volatile sig_atomic_t *stop; /* not zero: write a checkpoint and stop; may be NULL */
    /* How many times a checkpoint was asked for; the run then continues. May be NULL. */
    const volatile sig_atomic_t *checkpoints;
    const struct listener *listener; /* may be NULL */
    /* Told of an error that this rank alone has, which nothing else can tell the others, who wait
     * for it; NULL: nobody. */
    void (*alarm)(const struct ranks *ranks, const struct error *error);
    struct progress_pace progress;
    const char *rates; /* the table that the rate of this run goes into; NULL: none */
};

struct run_result {
    bool finished; /* false: stopped early; a run with a folder can be resumed */
    int64_t steps, particles,
        updates; /* steps since time zero; updates of particles in this call */
    double time, seconds, updates_per_second;
    double step; /* s, the last one */
    int threads; /* at most, of a rank */
    /* Updates a second without the time that others kept the processors busy. */
    double undisturbed_rate;
    double energy_drift;
    uint64_t hash;               /* of all particles' bits */
    struct check_results checks; /* empty unless finished */
    struct warning_results warnings;
};

/* Runs INPUT to its end, or until told to stop. Watching a run never changes it. A failed check is
 * no error. ERROR_INPUT, also where the run needs more memory than there is (unless `force`),
 * ERROR_STATE (the folder then has snapshots/failed.vtkhdf) or ERROR_SYSTEM; RESULT is then as far
 * as the run came. Collective. */
struct error *run_case(const struct simulation_case *input, const struct run_options *options,
                       struct run_result *result);
void run_result_free(struct run_result *result);

/* The threads that a run of MEMBERS on one rank takes at most, where ASKED (0: any number) were
 * asked for. */
int run_threads(int asked, double members);

/* The mistakes that a run of INPUT would tell before its first step, but for those of the particles
 * (generate_summary): walls, contacts, solver, checks, pictures; where run_is_filled_in_check also
 * those of cells, such as gaps between bodies, and of the case that it starts from. */
struct error *run_validate(const struct simulation_case *input);
/* The same but for cells; then TAKE gets the probe NAME, which INPUT has, with its columns. */
struct probe;
struct error *run_prepare_probe(const struct simulation_case *input, const char *name,
                                struct error *(*take)(const struct probe *probe, void *context),
                                void *context);
/* Whether cells, and the case that INPUT starts from, take a few seconds at most. */
bool run_is_filled_in_check(const struct simulation_case *input);

/* The step from TIME towards UNTIL where LIMIT is the largest allowed: what remains is spread over
 * the last two steps, so that no tiny step comes last. */
double step_towards(double limit, double time, double until);

#endif
