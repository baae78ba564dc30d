/* A solver is a choice of the catalogue's kind "solver"; its thing is a struct solver_class of
 * functions. The run loop knows no method: it prepares, chooses the step, advances. */
#ifndef BOLIDE_SOLVER_H
#define BOLIDE_SOLVER_H

#include "model/findings.h"
#include "model/simulation.h"
#include "particle/field_rows.h"
#include "shape/shape.h"

/* The largest step, what limits it, the id of the member where, and the time of the solver's next
 * event, which no step may pass: a body stops, a load begins. */
struct limit {
    double dt;
    const char *why;
    uint64_t id;
    double event;
};

BOLIDE_INLINE struct limit limit_of_nothing(void)
{
    return (struct limit){INFINITY, "nothing", 0, INFINITY};
}

/* Collective: the limit of the member that comes first of all ranks (ranked_before); what OWN says
 * of the rank's own first one is an index of REASONS. */
BOLIDE_INLINE struct limit limit_of_ranks(const struct ranks *ranks, struct ranked own,
                                          const char *const *reasons)
{
    ranks_first(ranks, &own);
    const struct limit limit = {own.value, reasons[own.what], own.id, INFINITY};
    return limit;
}

/* What `bolide check` counts: members of bodies in BOX alone, and CELLS beside them, of BYTES
 * each. */
struct counted {
    struct bounds box;
    double part; /* of the sites there that get a member at the start; 0: all */
    double cells, bytes;
};

/* What a solver says of a case, and of itself with the parameters of the case. */
struct judgement {
    struct findings findings;
    /* The jump of velocity over the speed of sound up to which its Riemann problem holds. */
    double largest_jump;
    /* Why the total energy may drift, and what helps, as sentences; NULL: it is conserved. */
    const char *energy_lost;
    /* What may hold where it stops in an impossible state, as a sentence; NULL: nothing. */
    const char *instead;
    /* In 2-D and 3-D bodies of materials for which this is true creep and come apart in lasting
     * tension, whatever their strength; see run/warnings_tension.c. NULL: none does. */
    bool (*loses_tension)(const struct material *material);
    /* Where materials that are NARROW, by their index, must stay to be computed. */
    struct bounds room;
    bool (*narrow)(const struct material *material);
};

/* Among the bits of solver_class.boundaries: faces may have several parts. */
#define BOUNDARY_PARTS (1u << BOUNDARY_KINDS)
/* Courant numbers lie above this: a smaller step adds less than rounding takes, and no run of it
 * ends. */
#define COURANT_LEAST 1e-6

/* The boundaries that every solver has. */
#define BOUNDARIES_CLOSED (1u << BOUNDARY_REFLECTING | 1u << BOUNDARY_SYMMETRY)

struct solver_class {
    const char *members; /* what it computes with: "cells"; NULL: particles */
    unsigned boundaries; /* that it has: bits 1 << enum boundary_kind, BOUNDARY_PARTS */
    bool removes;        /* bodies may be taken away, and walls when it is resumed */
    size_t size;         /* bytes of the solver's own state, zeroed before create */
    /* Makes the solver's stores, with fields by the case's parameters PARAMETERS, and shows them as
     * populations (simulation_add_population). Members come after, from `fill` or from a
     * checkpoint; `start` is called once they are there. */
    struct error *(*create)(void *solver, struct simulation *simulation, const void *parameters);
    /* Collective: what the bodies of the case put into the population. */
    struct error *(*fill)(void *solver, struct simulation *simulation);
    struct error *(*start)(void *solver, struct simulation *simulation);
    /* Collective: everything that level n determines: lists, ghosts, rates; returns the largest
     * step. */
    struct error *(*prepare)(void *solver, struct simulation *simulation, struct limit *limit);
    /* Collective: all stages; ends at level n + 1 with every derived field up to date. Leaves time
     * and step alone. An error may be this rank's alone: the run loop makes the ranks agree. */
    struct error *(*advance)(void *solver, struct simulation *simulation, double dt);
    /* Arrays beyond the simulation's that a resumed run needs. */
    struct error *(*state)(void *solver, struct visitor *visitor);
    /* Takes from BEFORE, which has ended another run, the same for a case that begins with its
     * particles; BODY gives for each body of BEFORE that of this case, -1: none. NULL: nothing. */
    void (*carry)(void *solver, const void *before, const int *body);
    void (*destroy)(void *solver);
    /* Bytes a particle, for `bolide check`, at DIMENSION. */
    double (*bytes)(const void *parameters, int dimension);
    /* Fills *counted from a case that may be wrong; NULL where all bodies become particles. */
    void (*count)(const void *parameters, const struct simulation_case *input,
                  struct counted *counted);
    /* The step that a particle of DIAMETER allows in state POINT at the start of INPUT, for `bolide
     * check`. */
    double (*step)(const void *parameters, const struct simulation_case *input,
                   const struct material *material, const struct point *point, double diameter);
    /* Multiplies what of PARAMETERS is a length of cells or particles by FACTOR, for a run with a
     * coarser resolution; NULL where nothing is. */
    void (*coarsen)(void *parameters, double factor);
    /* Every field that it may add to the store: tables of rows, NULL after the last table. */
    const struct field_row *const *fields;
    /* Finds what of the case it cannot do, or not well; says what the run must know of it. NULL:
     * nothing. */
    void (*judge)(const void *parameters, const struct simulation *simulation,
                  struct judgement *judgement);
};

/* What SOLVER with PARAMETERS says; the caller frees the findings. */
struct judgement judge_with(const struct solver_class *solver, const void *parameters,
                            const struct simulation *simulation);

#endif
