/* Cells for a neighbour search among points of very different reach: levels of cells whose edges
 * are powers of two apart, only occupied cells kept, found by hashing. */
#ifndef BOLIDE_CELLS_H
#define BOLIDE_CELLS_H

#include "base/memory.h"
#include "particle/radix.h"

enum { CELL_LEVELS = 32, CELL_LEVEL_ZERO = 8 };

/* A point in the order of cells. */
struct cell_point {
    double x, y, z, reach;
    uint32_t key, entry; /* its order in rows and what they keep of it; see row_kernel.h */
    uint16_t body;
};

/* Cells are the runs of points of one key. */
struct cells {
    int dimension;
    double edge; /* of level CELL_LEVEL_ZERO */
    int32_t points;
    struct cell_point *point;
    int32_t count;
    struct key_run *cell;
    uint64_t slots;                       /* a power of two */
    int32_t *slot;                        /* cell index + 1, 0 for an empty slot */
    int32_t level_begin[CELL_LEVELS + 1]; /* cells are sorted by level */
};

/* Point I of those that CONTEXT is about. */
typedef struct cell_point cells_point(const void *context, int32_t i);

/* COUNT points of CONTEXT, in any order. */
struct cell_points {
    cells_point *point_of;
    const void *context;
    int32_t count;
};

/* Makes the cells of POINTS with THREADS threads. EDGE is the cell edge of level zero. Points are
 * neighbours when nearer than the sum of their reaches. The cells stand in parts of SCRATCH, of
 * cells_bytes() together. */
void cells_make(struct cells *cells, int dimension, double edge, struct cell_points points,
                struct scratch *scratch, int threads);
size_t cells_bytes(int32_t count);

/* The cells that may hold neighbours of the points of CELL: calls RUN with each one's points. */
typedef void cells_run(void *context, const struct cell_point *point, int32_t count);
void cells_around(const struct cells *cells, int32_t cell, cells_run *run, void *context);

#endif
