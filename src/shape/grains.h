/* Random packings of grains that do not overlap: discs in a rectangle, spheres in a block. They
 * follow from the parameters alone, with the same bits on any number of threads and ranks.
 *
 * The largest grain comes first. Each is placed at random where it has room (random sequential
 * addition; Widom, J. Chem. Phys. 44 (1966) 3888). One that finds none in a number of tries is
 * placed anywhere, and then grains that overlap push each other apart until none does, a relaxation
 * like that of Jodrey and Tory, Phys. Rev. A 32 (1985) 2347. */
#ifndef BOLIDE_GRAINS_H
#define BOLIDE_GRAINS_H

#include "shape/shape.h"

/* What is wanted. Radii are evenly distributed between two, all changed by one factor so that a
 * whole number of grains has the fraction of the box. */
struct grains_wanted {
    int dimension;
    struct bounds box;
    double fraction, smallest, largest, gap;
    bool periodic[3];
    uint64_t seed;
};

/* One block of memory; free() it. */
struct grains {
    struct grains_wanted wanted;
    double extent[3], half_gap, reach; /* of the box; the largest radius with half a gap */
    int64_t count, cells[3];
    double (*center)[3];
    double *radius;
    int64_t *next, *head; /* the grains of a cell are a list; -1 ends it */
};

/* Makes *grains, or says why that is impossible (static text). The box and the radii are positive,
 * the fraction is below one. */
const char *grains_make(const struct grains_wanted *wanted, struct grains **grains);

/* Whether POINT of the box is in a grain. */
bool grains_hold(const struct grains *grains, struct vec3 point);

#endif
