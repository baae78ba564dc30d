/* Lattices: where the particles of a body stand at the start, and how much of it each of them is.
 * The sites are numbered row by row, and a row is found from a number by arithmetic: each rank
 * walks its part of the numbers, and no array of sites exists. */
#ifndef BOLIDE_LATTICE_H
#define BOLIDE_LATTICE_H

#include "shape/shape.h"

/* The order of lattice_choices. */
enum lattice_kind { LATTICE_SQUARE, LATTICE_HEXAGONAL, LATTICE_RINGS, LATTICE_KINDS };

extern const struct choice lattice_choices[];

/* lattice: {rings: {...}} */
struct lattice_rings {
    struct vector_value center;
    int64_t count;
    double start;
};

struct lattice {
    enum lattice_kind kind;
    double
        sites; /* how many; those of a lattice of more than an id can tell apart are not walked */
    double volume; /* of the largest site, m^dimension */

    /* Square and hexagonal: rows along x, count.x sites in each, that fill the bounds of the shape.
     * The spacing is the resolution, changed on each axis so that a whole number fits. */
    struct vec3 origin, spacing;
    int64_t count[3];

    /* Rings: so many between two radii, of one width, or of one area when each has ring_sites. */
    struct radii radii;
    double arc, start; /* wanted distance along a ring, m; direction of the first site, radians */
    int64_t rings, ring_sites;
};

/* A line of sites along x, or a ring of them. */
struct lattice_row {
    int64_t index, first, sites; /* its number, its first site's, how many sites */
    double volume;               /* of each, m^dimension */
    struct bounds bounds;        /* of their places */
    double shift;                /* of the first site, in steps from the row's begin */
    double radius;               /* of a ring */
};

/* NULL when SHAPE in DIMENSION can have this lattice, else what is wrong (static text). The shape
 * itself is right and has bounds. */
const char *lattice_wrong(const struct one_of *lattice, const struct one_of *shape, int dimension);

/* The lattice of SHAPE with sites RESOLUTION apart, as far as it is in BOUNDS. */
struct lattice lattice_make(const struct one_of *lattice, const struct one_of *shape,
                            struct bounds bounds, double resolution, int dimension);

/* The row of SITE, the row after ROW, and the place of a site of a row. */
struct lattice_row lattice_row_of(const struct lattice *lattice, int64_t site);
struct lattice_row lattice_row_after(const struct lattice *lattice, const struct lattice_row *row);
struct vec3 lattice_place(const struct lattice *lattice, const struct lattice_row *row,
                          int64_t site);

#endif
