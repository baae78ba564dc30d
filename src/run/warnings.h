/* Warnings of a run: what happened that the models of the case do not cover, by name. A warning
 * does not stop the run or change its exit status. The run prints it at its first occurrence and at
 * the end, and the report shows it beside the verdict.
 *
 * A run looks for warnings at the rows of the history and at the end, not at every step: it can
 * miss a state that lasts less than the interval between rows. The result depends on the states
 * alone, not on threads, ranks or where a run was resumed. */
#ifndef BOLIDE_RUN_WARNINGS_H
#define BOLIDE_RUN_WARNINGS_H

#include "base/visitor.h"
#include "measure/probes.h"
#include "model/simulation.h"

/* The kinds before WARNING_ENERGY are of members and are counted by material. */
enum warning_kind {
    WARNING_TENSION,     /* beyond what the material bears */
    WARNING_SPEED,       /* beyond what set the case in motion */
    WARNING_TEMPERATURE, /* below 0 K */
    WARNING_DENSITY,     /* beyond the range of the equation of state */
    WARNING_INSTABILITY, /* tension that lasts longer than the method holds a body in it */
    WARNING_UNLIT,       /* an explosive is compressed before its detonation arrives */
    WARNING_REGION,      /* a solid is near the open face of a region */
    WARNING_ENERGY,      /* of all members together: it is not conserved */
    WARNING_TRACER,      /* of a tracer: its particle has failed */
    WARNING_COARSE,      /* of the case: its resolution is too coarse */
    WARNING_INPUT,       /* of the case: input without effect, or that contradicts itself */
    WARNING_LOAD,        /* of a load: it does not deliver the impulse that it should */
    WARNING_KINDS
};

/* Numbers only, as a checkpoint takes them. COUNT 0: it has not happened. */
struct warning_memory {
    double count;          /* the most members at one moment */
    double time, step;     /* when it was first seen, */
    double value, limit;   /* and the worst member then: its value, the limit, */
    double body, place[3]; /* its body and position */
    double worst, worst_time, worst_limit;
};
enum { WARNING_NUMBERS = sizeof(struct warning_memory) / sizeof(double) };

/* One warning of a run that has ended; it stands by itself when the run is gone. SI units. */
struct warning {
    enum warning_kind kind;
    char *name;     /* "tension in copper" */
    char *text;     /* name, values, place and remedy in one line */
    char *expected; /* the reason that the case gives for it; NULL: it does not list it */
};

struct warning_results {
    int count, unexpected;
    struct warning *item;
};

struct judgement;
struct warnings;

/* Readies the watch of SIMULATION, whose solver has given JUDGEMENT, which must outlive it. NULL
 * where memory is out. */
struct warnings *warnings_create(const struct simulation *simulation,
                                 const struct judgement *judgement);
void warnings_free(struct warnings *warnings);

/* Collective: what may move as fast as what moves now needs no warning. Once, at time zero. */
void warnings_start(struct warnings *warnings, const struct simulation *simulation);

/* Collective: looks at all members. NOW are their totals, DRIFT is the relative change of energy, 0
 * where it is nobody's concern. TELL, on every rank, gets the text of each warning that is new. */
struct error *warnings_watch(struct warnings *warnings, const struct simulation *simulation,
                             const struct totals *now, double drift,
                             void (*tell)(void *context, const char *text), void *context);

/* Collective: notes the tracers among PROBES whose particle has failed, after they took their rows;
 * TELL as above. */
struct error *warnings_watch_tracers(struct warnings *warnings, const struct simulation *simulation,
                                     const struct probes *probes,
                                     void (*tell)(void *context, const char *text), void *context);

/* Collective: notes loads that have not delivered the impulse of their own pressure over their
 * surface, or none by the end; TELL as above. */
struct error *warnings_watch_loads(struct warnings *warnings, const struct simulation *simulation,
                                   void (*tell)(void *context, const char *text), void *context);

/* The impulse of a load with its unit, one number for each dimension. */
void load_impulse_text(const struct problem *problem, const double impulse[3], char *text,
                       size_t size);

/* All that happened so far. ERROR_SYSTEM when memory is out. */
struct error *warnings_conclude(const struct warnings *warnings,
                                const struct simulation *simulation,
                                struct warning_results *results);
void warning_results_free(struct warning_results *results);

/* "; 2 warnings, 1 of them expected"; "" of none. Owned by the caller; NULL when memory is out. */
char *warnings_count_text(int count, int unexpected);

/* Saves or loads what happened so far. What is loaded is of a case with STORED probes; each of
 * PROBES knows its number among them. */
struct error *warnings_visit(struct warnings *warnings, const struct probes *probes, int stored,
                             struct visitor *visitor);
/* ERROR_SYSTEM when what was loaded names a body that is none of BODIES. */
struct error *warnings_check_loaded(const struct warnings *warnings, int bodies);

#endif
