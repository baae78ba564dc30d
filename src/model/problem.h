/* The problem of a run, which no step changes: the case, its materials, mirror walls, contact laws
 * and gravity. */
#ifndef BOLIDE_PROBLEM_H
#define BOLIDE_PROBLEM_H

#include "base/field.h"
#include "model/place.h"
#include "parallel/ghosts.h"
#include "particle/contact_law.h"

enum { CONTACT_GROUPS = 16, MATERIALS_MAX = 256 };

/* Further properties of a contact law. Surface 0 has no friction and the mean normal. */
struct contact_surface {
    double friction;
    int normal; /* enum contact_normal; the first is the group whose row of laws it is */
    int touch;  /* enum contact_touch */
};
enum { CONTACT_SURFACES = 60 };

struct findings;

struct problem {
    const struct simulation_case *input;
    int dimension;
    enum case_geometry geometry;
    int materials;
    struct material *material;
    struct place place;                          /* what of the case the solver computes */
    struct mirrors images;                       /* where images of particles are */
    double gravity[3];                           /* m/s^2, of what nothing holds */
    uint8_t *group_of_body;                      /* contact group of each body */
    uint8_t law[CONTACT_GROUPS][CONTACT_GROUPS]; /* of the first towards the second */
    int surfaces;
    struct contact_surface surface[CONTACT_SURFACES];
};

/* Creates the problem of PLACE, whose case must outlive it. ERROR_INPUT: walls or contacts
 * contradict each other; PROBLEM must be destroyed then too. */
struct error *problem_create(const struct place *place, struct problem *problem);
void problem_destroy(struct problem *problem);

/* A mistake in the case at SECTION.NAME ("bodies", "flyer"; NAME may be NULL): located in its file,
 * or with the path alone when a program made the case without a file. */
struct error *input_error(const struct simulation_case *input, const char *section,
                          const char *name, const char *format, ...) BOLIDE_PRINTF(4, 5);

/* That a material breaks at contacts of particles, for solvers and methods that have none that
 * break. */
void refuse_broken_contacts(const struct problem *problem, struct findings *findings);

/* The same of a material that waits with its failure. */
void refuse_standing_spall(const struct problem *problem, struct findings *findings);

/* The fields for the history variables of the case's materials beyond the core's, POINT_HISTORY at
 * most, which the solver adds to its store. Returns their number. */
int problem_history(const struct problem *problem, struct field_declaration *fields);

/* Whether products burn in the air. */
bool problem_afterburns(const struct problem *problem);

/* What of a case the solver gas alone computes, for the solvers of particles. */
void problem_refuse_gas_keys(const struct problem *problem, struct findings *findings);

/* True when the case has gravity. */
BOLIDE_INLINE bool problem_has_gravity(const struct problem *problem)
{
    const double *g = problem->gravity;
    return g[0] != 0.0 || g[1] != 0.0 || g[2] != 0.0;
}

#endif
