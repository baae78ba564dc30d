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

/* Wall-clock seconds spent in a named part of the step. */
struct phase {
    const char *name;
    double seconds;
};

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
    struct partition partition;             /* of the blocks among the ranks */
    const struct population_class *members; /* what it computes with; NULL: nothing yet */
    void *store;                            /* of them, owned */
    struct ledger ledger;
    double time;
    int64_t step;
    int phases;
    struct phase phase[PHASES_MAX];
};

/* A mistake in the case at SECTION.NAME ("bodies", "flyer"; NAME may be NULL): located in its file,
 * or with the path alone when a program made the case without a file. */
struct error *input_error(const struct simulation_case *input, const char *section,
                          const char *name, const char *format, ...) BOLIDE_PRINTF(4, 5);

/* Prepares a run of INPUT without members: materials, walls, contact laws. The solver's create adds
 * their store, since it knows the fields; its fill puts the bodies into it. */
struct error *simulation_create(const struct simulation_case *input, const struct ranks *ranks,
                                int threads, struct simulation *simulation);
void simulation_destroy(struct simulation *simulation);

/* Gives SIMULATION members of a class, none yet: an empty store that the caller makes ready. */
struct error *simulation_populate(struct simulation *simulation,
                                  const struct population_class *members);
void simulation_depopulate(struct simulation *simulation);

/* The fields for what the case's materials remember beyond the core's, POINT_HISTORY at most: the solver adds them to its
 * store. Returns how many. */
int simulation_history(const struct simulation *simulation, struct field_declaration *fields);

/* What watchers of the run see of it. */
BOLIDE_INLINE struct population simulation_population(const struct simulation *simulation)
{
    assert(simulation->members);
    return simulation->members->members(simulation->store);
}

/* True when the case has gravity. */
BOLIDE_INLINE bool simulation_has_gravity(const struct simulation *simulation)
{
    const double *g = simulation->gravity;
    return g[0] != 0.0 || g[1] != 0.0 || g[2] != 0.0;
}

/* Adds SECONDS to phase NAME. */
void simulation_spend(struct simulation *simulation, const char *name, double seconds);

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
