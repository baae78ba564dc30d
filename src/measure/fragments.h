/* The fragments of broken bodies: the connected sets of particles that have not failed
 * (connected.h), heaviest first. Failed particles belong to none: together they are the dust. */
#ifndef BOLIDE_FRAGMENTS_H
#define BOLIDE_FRAGMENTS_H

#include "model/columns.h"
#include "model/simulation.h"

struct fragment {
    double mass;      /* in the unit of the ledger */
    double size;      /* m: diameter of the sphere of its volume, in a plane of the circle */
    double center[3]; /* of mass; in axisymmetry the mean of the radius and of the axis */
    double velocity[3], spin[3];
    double low[3], high[3]; /* with the edges of its particles */
    int64_t particles;
    uint64_t label; /* the lowest id of its particles */
    int body;       /* -1 of dust: several */
};

struct fragments {
    int64_t count;
    struct fragment
        *item; /* by mass, heaviest first, of equal masses by label; the same on all ranks */
    struct fragment dust; /* mass, center, velocity and number of the failed particles */
    int32_t members;
    int64_t *of_member; /* the fragment of each owned particle, from 0; FRAGMENT_NONE: of none */
};
enum { FRAGMENT_NONE = -1 };

/* Collective: the fragments of BODY (-1: all) in POPULATION, whose particles connect over LINK
 * times the sum of their diameters. They do not depend on the order of storage, threads or ranks.
 * Free FRAGMENTS also after an error. */
struct error *fragments_find(const struct ranks *ranks, const struct population *population,
                             int body, double link, struct fragments *fragments);
void fragments_free(struct fragments *fragments);

/* The name of the column with the fragment of each particle, from 1, heaviest first; 0: of none. */
extern const char fragments_column[];

/* POPULATION with that column too; valid as long as FRAGMENTS (NULL: the column must not be read)
 * and COLUMNS, which gets all of its columns. */
struct population fragments_show(const struct population *population,
                                 const struct fragments *fragments,
                                 struct column columns[COLUMNS_MAX]);

/* Writes FRAGMENTS to PATH as CSV: a row a fragment, heaviest first, the dust last. One rank calls
 * it. */
struct error *fragments_write(const char *path, const struct simulation *simulation,
                              const struct fragments *fragments);

#endif
