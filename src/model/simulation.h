/* A run in progress: the problem, what is computed with, the ledger and the time. */
#ifndef BOLIDE_SIMULATION_H
#define BOLIDE_SIMULATION_H

#include "model/ledger.h"
#include "model/load_record.h"
#include "model/load_trace.h"
#include "model/problem.h"
#include "parallel/partition.h"

enum { PHASES_MAX = 16 };

/* What the time of a phase is spent on. */
enum phase_kind {
    PHASE_BLOCKS,  /* members and nodes of this rank's blocks, by which the partition weighs them */
    PHASE_WAITING, /* other ranks */
    PHASE_SHARED,  /* what does not move with a block, or is mixed with waiting */
};

/* Wall-clock seconds spent in a named part of the step. */
struct phase {
    const char *name;
    double seconds;
};

/* A population by its NAME, as `of:` of a case has it. The solver owns its STORE. */
struct population_source {
    const char *name;
    const struct population_class *type;
    void *store;
    int columns;
    struct column column[COLUMNS_MAX];
};
enum { POPULATIONS_MAX = 4 };

/* What happens once in a run of a solver, such as the change to another method. */
struct event {
    const char *name;
    double time; /* s; NAN: it has not happened */
};
enum { EVENTS_MAX = 2 };

/* What is kept of a field over the time; see maps.h. */
enum map_kind { MAP_PEAK, MAP_ARRIVAL, MAP_IMPULSE };
enum { MAPS_MAX = MAPS_MOST + 2 }; /* a solver may add some */
struct map {
    const char *name, *field;
    enum map_kind kind;
    double above;  /* what counts as none */
    bool of_cells; /* particles have none */
    char memory[MAP_NAME + 8], unit[48];
};

struct simulation {
    const struct problem *problem; /* owned; nothing changes it */
    const struct ranks *ranks;
    int threads;
    struct partition partition; /* of the blocks among the ranks */
    int populations;            /* what it computes with */
    struct population_source population[POPULATIONS_MAX];
    struct population seen[POPULATIONS_MAX]; /* by simulation_see */
    int maps;
    struct map map[MAPS_MAX];
    struct ledger ledger;
    int loads; /* of the case */
    struct load_record *load;
    struct load_trace *trace; /* of each load; without rows where it has no record */
    int events;
    struct event event[EVENTS_MAX];
    double time;
    int64_t step;
    int64_t segment; /* how often what moves it was changed at a resume */
    int phases;
    struct phase phase[PHASES_MAX];
    double phase_end; /* clock_seconds() when the last phase ended; 0: none has begun */
};

/* Prepares a run of INPUT, or of PLACE in it, its problem, without members. The solver's create
 * adds their store, since it knows the fields; its fill puts the bodies into it. */
struct error *simulation_create(const struct simulation_case *input, const struct ranks *ranks,
                                int threads, struct simulation *simulation);
struct error *simulation_create_at(const struct place *place, const struct ranks *ranks,
                                   int threads, struct simulation *simulation);
void simulation_destroy(struct simulation *simulation);

/* Shows STORE, of TYPE, to all that watches the run, until the population is removed. NAME must
 * last as long. A store without members gets the fields of the simulation's maps. */
void simulation_add_population(struct simulation *simulation, const char *name,
                               const struct population_class *type, void *store);
void simulation_remove_population(struct simulation *simulation, const void *store);

/* The population at INDEX; and the one that checks, probes and pictures look at where they name
 * none: the first. */
struct population simulation_population_at(const struct simulation *simulation, int index);
struct population simulation_population(const struct simulation *simulation);

/* Looks at all populations as they are: the pointers of `seen` hold until members come or go. */
void simulation_see(struct simulation *simulation);
/* What OF, a body or a population of the case or NULL, is to be looked for in: that population as
 * it was seen; FIRST unless OF names another. */
const struct population *simulation_seen(const struct simulation *simulation, const char *of,
                                         const struct population *first);
/* All that is shown where POPULATION is: that alone, or with the first all others as they were
 * seen. Returns their number. */
int simulation_shown(const struct simulation *simulation, const struct population *population,
                     const struct population *shown[POPULATIONS_MAX]);
/* That SECTION.NAME has the key `of` with a name of a population that the run has not. */
struct error *simulation_check_of(const struct simulation *simulation, const char *section,
                                  const char *name, const char *of);

/* Adds an event that may happen; NAME must last as long. It happens at TIME. */
void simulation_add_event(struct simulation *simulation, const char *name);
void simulation_event(struct simulation *simulation, const char *name, double time);

/* Of all populations: whether members are to be taken in or out; takes them in and out; brings each
 * to the rank that owns its block; a number for all their bits. Collective, but for the first
 * two. */
bool simulation_changed(const struct simulation *simulation);
struct error *simulation_commit(struct simulation *simulation);
struct error *simulation_distribute(struct simulation *simulation);
uint64_t simulation_hash(const struct simulation *simulation);
/* Collective: how many members all populations have. */
int64_t simulation_members(const struct simulation *simulation);

/* Collective: mass, momentum, angular momentum, energy of the members of all populations. */
struct totals simulation_totals(const struct simulation *simulation);

/* Starts the clock of the phases: the time up to now counts for none. */
void simulation_start_phase(struct simulation *simulation);

/* Ends a phase: the time since the last one ended, or since simulation_start_phase, is added to
 * phase NAME of KIND. */
void simulation_end_phase(struct simulation *simulation, enum phase_kind kind, const char *name);

/* The same for the time that this rank has waited for others; nothing where it has none. */
void simulation_end_waiting(struct simulation *simulation);

/* Adds the time that the phases of PART of a coupling have taken, and clears them. */
void simulation_take_phases(struct simulation *simulation, struct simulation *part);

/* The error that names member INDEX, whose new state is impossible. */
struct error *simulation_impossible(const struct simulation *simulation, int32_t index);

/* The value at TIME of a FIELD of the time, KEY of NAME in the case; ERROR_STATE where it is not
 * finite. */
struct error *simulation_value_at(const struct simulation *simulation, double time,
                                  const struct field_value *field, const char *name,
                                  const char *key, double *value);

/* Time, step, ledger, events and members. */
struct error *simulation_visit(struct simulation *simulation, struct visitor *visitor);

/* True when TIME has reached the next multiple of INTERVAL, of which DUE have been, and counts it.
 * An INTERVAL that is not a number never comes. */
bool interval_is_due(double time, double interval, int64_t *due);

#endif
