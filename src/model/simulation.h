/* A run in progress: what is computed (the case), its state, and what every solver may use. */
#ifndef BOLIDE_SIMULATION_H
#define BOLIDE_SIMULATION_H

#include "case/case.h"
#include "model/ledger.h"
#include "parallel/ghosts.h"
#include "parallel/partition.h"
#include "particle/contact_law.h"

enum { CONTACT_GROUPS = 16, MATERIALS_MAX = 256, PHASES_MAX = 16 };

/* What else a law may say. Surface 0 has no friction and the mean normal. */
struct contact_surface {
    double friction;
    int normal; /* enum contact_normal; the first is the group whose row of laws it is */
    int touch;  /* enum contact_touch */
};
enum { CONTACT_SURFACES = 60 };

/* What the time of a phase is spent on. */
enum phase_kind {
    PHASE_BLOCKS, /* the members and nodes of this rank's blocks: what the partition weighs them by */
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
};
enum { POPULATIONS_MAX = 4 };

struct simulation {
    const struct simulation_case *input;
    const struct ranks *ranks;
    int threads;
    int dimension;
    enum case_geometry geometry;
    int materials;
    struct material *material;
    struct mirrors mirrors;                      /* rigid slip walls */
    double gravity[3];                           /* m/s^2, of what nothing holds */
    uint8_t *group_of_body;                      /* contact group of each body */
    uint8_t law[CONTACT_GROUPS][CONTACT_GROUPS]; /* of the first towards the second */
    int surfaces;
    struct contact_surface surface[CONTACT_SURFACES];
    struct partition partition; /* of the blocks among the ranks */
    int populations;            /* what it computes with */
    struct population_source population[POPULATIONS_MAX];
    struct ledger ledger;
    double time;
    int64_t step;
    int phases;
    struct phase phase[PHASES_MAX];
    double phase_end; /* clock_seconds() when the last phase ended; 0: none has begun */
};

/* A mistake in the case at SECTION.NAME ("bodies", "flyer"; NAME may be NULL): located in its file,
 * or with the path alone when a program made the case without a file. */
struct error *input_error(const struct simulation_case *input, const char *section,
                          const char *name, const char *format, ...) BOLIDE_PRINTF(4, 5);

/* That a case for particles names a domain, boundaries of one or obstacles, which are for cells. */
struct error *refuse_boundaries(const struct simulation_case *input);

/* Prepares a run of INPUT without members: materials, walls, contact laws. The solver's create adds
 * their store, since it knows the fields; its fill puts the bodies into it. */
struct error *simulation_create(const struct simulation_case *input, const struct ranks *ranks,
                                int threads, struct simulation *simulation);
void simulation_destroy(struct simulation *simulation);

/* Shows STORE, of TYPE, to all that watches the run, until the population is removed. NAME must
 * last as long. */
void simulation_add_population(struct simulation *simulation, const char *name,
                               const struct population_class *type, void *store);
void simulation_remove_population(struct simulation *simulation, const void *store);

/* The fields for what the case's materials remember beyond the core's, POINT_HISTORY at most: the solver adds them to its
 * store. Returns how many. */
int simulation_history(const struct simulation *simulation, struct field_declaration *fields);

/* The population that checks, probes and pictures look at where they name none: the first. */
BOLIDE_INLINE struct population simulation_population(const struct simulation *simulation)
{
    assert(simulation->populations);
    return simulation->population[0].type->members(simulation->population[0].store);
}

/* Of all populations: whether members are to be taken in or out; takes them in and out; brings each
 * to the rank that owns its block; a number for all their bits. Collective, but for the first two. */
bool simulation_changed(const struct simulation *simulation);
struct error *simulation_commit(struct simulation *simulation);
struct error *simulation_distribute(struct simulation *simulation);
uint64_t simulation_hash(const struct simulation *simulation);
/* Collective: how many members all populations have. */
int64_t simulation_members(const struct simulation *simulation);

/* True when the case has gravity. */
BOLIDE_INLINE bool simulation_has_gravity(const struct simulation *simulation)
{
    const double *g = simulation->gravity;
    return g[0] != 0.0 || g[1] != 0.0 || g[2] != 0.0;
}

/* Starts the clock of the phases: the time up to now counts for none. */
void simulation_start_phase(struct simulation *simulation);

/* Ends a phase: the time since the last one ended, or since simulation_start_phase, is added to phase
 * NAME of KIND. */
void simulation_end_phase(struct simulation *simulation, enum phase_kind kind, const char *name);

/* The same for the time that this rank has waited for others; nothing where it has none. */
void simulation_end_waiting(struct simulation *simulation);

/* The error that names member INDEX, whose new state is impossible. */
struct error *simulation_impossible(const struct simulation *simulation, int32_t index);

/* The value at TIME of a FIELD of the time, KEY of NAME in the case; ERROR_STATE where it is not finite. */
struct error *simulation_value_at(const struct simulation *simulation, double time,
                                  const struct field_value *field, const char *name,
                                  const char *key, double *value);

/* Time, step, ledger and members. */
struct error *simulation_visit(struct simulation *simulation, struct visitor *visitor);

/* True when TIME has reached the next multiple of INTERVAL, of which DUE have been, and counts it. An
 * INTERVAL that is not a number never comes. */
bool interval_is_due(double time, double interval, int64_t *due);

#endif
