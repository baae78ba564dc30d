/* A walk over the sites of one body that become particles: in the shape, on the near side of the
 * axis and of walls across it, and not replaced by another body. Private to this module. */
#ifndef BOLIDE_WALK_H
#define BOLIDE_WALK_H

#include "model/generate.h"
#include "model/overlap.h"

struct walk {
    const struct simulation_case *input;
    int body;
    struct lattice lattice;
    struct bounds kept;     /* what the walls that cut the body leave; infinite without any */
    bool plain;             /* every site becomes a particle */
    int64_t site, end;      /* the next one to look at */
    struct lattice_row row; /* of the site; empty before the first */
    double volume;          /* m^dimension, of the particle that walk_next has found */
    struct rival *rivals;   /* bodies whose bounds meet this one's, */
    int rival_count;
    int *near; /* and those among them that meet the row */
    int near_count;
    int conflict; /* a body that overlaps by mistake, -1: none found yet */
    struct vec3 conflict_place;
};

/* Begins a walk over the part of BODY's lattice that falls to this rank; walk_end in any case.
 * ERROR_INPUT when the lattice has too many sites or lies too far from the origin. */
struct error *walk_begin(struct walk *walk, const struct overlaps *overlaps, int body,
                         const struct ranks *ranks);
/* The box of all sites of a lattice of lines. */
struct bounds walk_sites(const struct walk *walk);
/* The next site that becomes a particle, and where; false behind the last. */
bool walk_next(struct walk *walk, int64_t *site, struct vec3 *place);
void walk_end(struct walk *walk);

/* What a square metre of the plane stands for at PLACE: a metre of depth, or the radius, for a
 * radian. */
double walk_depth(const struct simulation_case *input, struct vec3 place);

/* What a particle of BODY starts with: NULL, or what is wrong, and *key, of the body, that it is
 * about. */
const char *walk_start(const struct simulation_case *input, int body, struct vec3 place,
                       struct point *point, double velocity[3], const char **key);

/* ERROR_INPUT for the body with the most work when all walks of a case take too long
 * (generate_work). */
struct error *walk_check_work(const struct place *place, const struct ranks *ranks);

#endif
