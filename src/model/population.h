/* What a solver computes with, as everything that watches a run sees it: its members, each with
 * an id, a place, a mass, a density and a velocity, and columns of named quantities. Members are
 * particles, which move, or cells, which stay. Measures, totals, histories, snapshots and pictures
 * know no more of a solver than this. */
#ifndef BOLIDE_POPULATION_H
#define BOLIDE_POPULATION_H

#include "base/error.h"
#include "base/field.h"

enum population_kind { POPULATION_OF_PARTICLES, POPULATION_OF_CELLS };

struct cell_block;
struct population;
struct problem;

/* A named quantity of the members: an array of the store, or a function. */
struct column {
    const char *name, *unit, *help;
    int components; /* 1, 3 or 6 */
    int field; /* of the population; -1: COMPUTE fills OUT, components numbers a member, for the
                     * members begin .. end - 1 */
    void (*compute)(const struct population *population, int64_t begin, int64_t end, double *out);
};
enum { COLUMNS_MAX = 48 };

struct population_source;

/* The members that this rank owns. A handful of pointers, to be asked for again after each step. */
struct population {
    const struct population_source *source; /* of the simulation */
    const char *name;                       /* "particles", "gas" */
    enum population_kind kind;
    const struct problem *problem;
    int dimension;
    int threads; /* for loops over the members */
    int32_t count;
    uint64_t order; /* an index means the same member while it stays */
    const uint64_t *id;
    const uint16_t *material, *body;
    const double *mass, *density, *energy, *pressure; /* energy in J/kg */
    const double (*position)[3], (*velocity)[3];
    const double (*deviator)[6]; /* of stress; NULL: no member bears shear */
    const double *fraction; /* of a second material in cells; NULL: members are of one material */
    double edge;            /* of a cell, m; of several levels, of the finest */
    const double *size;     /* the edge of each cell, m; NULL: there is one level */
    int32_t blocks;         /* of cells; a block has the same cells on any number of ranks */
    const struct cell_block *block;
    int fields; /* that a store keeps by name, the above among them */
    const struct field *field;
    int columns; /* the same throughout a run */
    const struct column *column;
    const int64_t *fragment; /* of each member, from 0 (measure/fragments.h); NULL: not wanted */
};

/* Whether member I contains material; false for a cell that an obstacle blocks. */
BOLIDE_INLINE bool population_has(const struct population *population, int32_t i)
{
    return population->mass[i] != 0.0;
}

/* Whether member I holds two materials: no equation of state of one gives its pressure. */
BOLIDE_INLINE bool population_is_mixed(const struct population *population, int32_t i)
{
    return population->fraction && population->fraction[i] > 0.0 && population->fraction[i] < 1.0;
}

/* What its members are called. */
BOLIDE_INLINE const char *population_members(const struct population *population)
{
    return population->kind == POPULATION_OF_CELLS ? "cells" : "particles";
}

/* What the run loop does with a store of members, whatever they are. */
struct population_class {
    struct population (*members)(const void *store);
    /* Adds COUNT fields to a store without members. */
    void (*add)(void *store, const struct field_declaration *more, int count);
    /* Whether members are to be taken in or out, which commit then does. */
    bool (*changed)(const void *store);
    struct error *(*commit)(void *store);
    /* Collective: every member goes to the rank that owns its block. */
    struct error *(*distribute)(void *store);
    /* Collective: loads or saves the state. */
    struct error *(*visit)(void *store, struct visitor *visitor);
    /* Collective: one number for the bits of the state, whatever the order of storage. */
    uint64_t (*hash)(const void *store);
};

/* D = V^(1/dimension): the edge of a cube, the side of a square, a length (1.70). */
BOLIDE_INLINE double diameter_of_volume(double volume, int dimension)
{
    return dimension == 1 ? volume : dimension == 2 ? sqrt(volume) : cbrt(volume);
}

#endif
