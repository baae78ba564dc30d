/* Particles as dots of a picture, painted by all ranks: each paints some rows of pixels. Private to
 * the pictures. */
#ifndef BOLIDE_PICTURE_DOTS_H
#define BOLIDE_PICTURE_DOTS_H

#include "picture/internal.h"

/* The plane of the picture, and what of space is in it. */
struct plane {
    bool rings;             /* the particles are those of axisymmetry */
    bool cells;             /* the members are cells of a grid, squares that leave no gap */
    int across, up, normal; /* axes of space; normal -1: none */
    struct range extent[3]; /* of the particles with their size */
    bool wall[3][2];        /* the low, the high end of the extent is a mirror wall */
    double middle;          /* of the slab, along the normal */
    double diameter;        /* geometric mean of the particles' */
};

BOLIDE_INLINE double middle_of(struct range range) { return 0.5 * (range.low + range.high); }
BOLIDE_INLINE double length_of(struct range range) { return range.high - range.low; }

/* Collective: finds extents, mean diameter, and in 3-D the two longest axes. */
struct plane plane_find(const struct simulation *simulation, const struct population *population);

/* A particle in the picture, in metres from the middle of the extents: floats halve the memory. */
struct dot {
    float across, up, depth, diameter, value;
    uint64_t order; /* of dots of one depth: cells first, then particles, each by their ids */
};

/* Those of this rank. */
struct dots {
    int64_t count, capacity;
    struct dot *dot;
    struct range values; /* of this rank's, then of all */
    int64_t of_all;      /* the number of all ranks' */
};

/* Adds the dots of this rank's particles. Free dots->dot also after an error. */
struct error *dots_take(const struct shown *shown, const struct plane *plane, struct dots *dots);

/* What is painted upon: columns left .. right - 1 and rows top .. bottom - 1 of pixels, the middle
 * of the extents at (x, y) and SCALE pixels a metre. Small particles are painted as squares,
 * too. */
struct viewport {
    int left, right, top, bottom;
    double x, y, scale;
    bool squares; /* and CELLS are squares of their own size */
    bool cells;
    const struct colour_scale *colours; /* NULL: values are categories */
};

/* Collective: paints the dots of all ranks over each other, what lies deeper first, of equal depth
 * in their order, so that the picture is the same however they are stored. Rank 0 gets the rows,
 * right pixels each, in fresh memory at *image; the others NULL. DOTS lose their order. */
struct error *dots_paint(const struct ranks *ranks, struct dots *dots,
                         const struct viewport *viewport, uint32_t **image);

#endif
