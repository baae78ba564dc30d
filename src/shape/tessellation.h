/* Voronoi cells of random sites in a box: the grains of a polycrystal, or, with a gap between them,
 * convex grains in a binder. They follow from the parameters alone, with the same bits on any
 * number of threads and ranks.
 *
 * The sites are the centers of a packing (grains.h) that is far from dense, so that no two are very
 * close, as in a Matern process. A point is in a grain when it is half the gap from the faces of
 * its cell: the planes half-way between its site and others. */
#ifndef BOLIDE_TESSELLATION_H
#define BOLIDE_TESSELLATION_H

#include "shape/shape.h"

/* What is wanted. Of the numbers `gap` and `fraction` the other is NAN. */
struct tessellation_wanted {
    int dimension;
    struct bounds box;
    double size;     /* a grain has this, squared or cubed, of the box on average */
    double gap;      /* between the faces of neighbours */
    double fraction; /* of the box that all grains fill */
    double picked;   /* fraction of their volume that is in the grains of the shape */
    bool periodic[3];
    uint64_t seed;
};

/* One block of memory; free() it. */
struct tessellation {
    struct tessellation_wanted wanted;
    double low[3], extent[3], cell[3], least_cell, half_gap;
    int64_t count, cells[3];
    double (*site)[3];
    int64_t *next, *head; /* the sites of a cell are a list; -1 ends it */
    bool *is_picked;
};

/* Makes *made, or says why that is impossible (static text). The box and the size are positive,
 * fractions are above zero and at most one. */
const char *tessellation_make(const struct tessellation_wanted *wanted, struct tessellation **made);

/* Whether POINT of the box is in a grain that is picked. */
bool tessellation_holds(const struct tessellation *grains, struct vec3 point);

#endif
