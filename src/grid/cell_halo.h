/* The cells beyond the ends of blocks: where a sweep along an axis finds the neighbours of the
 * cells that a rank owns. They are cells of its other blocks, reached across faces of the domain by
 * what lies outside them, or planes of cells: copies of those of other ranks, and what the caller
 * puts outside a face and where levels meet. */
#ifndef BOLIDE_CELL_HALO_H
#define BOLIDE_CELL_HALO_H

#include "grid/cell_blocks.h"
#include "parallel/exchange.h"

enum { CELL_GHOSTS = 4 }; /* cells known beyond an end */

/* What is outside a face of the domain: copies of its cells, their mirror images, the cells of the
 * opposite face, or planes that the caller fills. */
enum cell_face { CELL_FACE_COPIES, CELL_FACE_MIRROR, CELL_FACE_PERIODIC, CELL_FACE_FILLED };

/* The cell at place `at` along the axis of block `block`, or, where that is -1, of plane `at`. The
 * component of vectors along the axis changes its sign where it is turned. */
struct cell_source {
    int32_t block, at;
    bool turned;
};

/* A plane that the caller fills: of block `block`, outside its `side` (0 low, 1 high), `depth`
 * cells from its end, 0 the next. What a mirror and a copy would have there. */
struct cell_filled {
    int32_t block, side, depth, plane;
    int64_t at; /* its index in the global grid along the axis */
    struct cell_source mirror, copy;
};

/* A plane that the caller fills with cells of another level: beyond block `block`, in cells of its
 * level at place `at` along the axis. */
struct cell_seam {
    int32_t block, plane;
    int64_t at;
};

/* Of one axis. */
struct cell_halo_axis {
    struct cell_source (*beyond)[2][CELL_GHOSTS]; /* of each block: low and high, next first */
    bool (*waits)[2];                             /* of each block: its end needs a plane */
    int32_t planes;                               /* of other ranks, filled ones, seams */
    double *plane;                                /* numbers of all planes */
    int32_t fills;
    struct cell_filled *filled;
    int32_t seams;
    struct cell_seam *seam;
    struct cell_source *sent; /* planes that other ranks want, in the order of their items */
    struct exchange exchange;
    int64_t plane_capacity, filled_capacity, seam_capacity;
};

struct cell_halo {
    int depth;   /* cells beyond an end, CELL_GHOSTS at most */
    int numbers; /* of a cell */
    enum cell_face face[3][2];
    uint64_t order; /* of the blocks when it was planned */
    struct cell_halo_axis axis[3];
};

/* Collective: plans for CELLS, whose ranks agree on `depth`, `numbers` and `face`. Quick while the
 * blocks stay. */
struct error *cell_halo_plan(struct cell_halo *halo, const struct cell_blocks *cells);
void cell_halo_free(struct cell_halo *halo);

/* Sends to other ranks what they want along AXIS of FIELD, arrays of as many numbers as the halo
 * has; planes hold what comes after finish. Who computes before calls advance from time to time. */
void cell_halo_start(struct cell_halo *halo, const struct cell_blocks *cells, int axis,
                     const double *const *field);
void cell_halo_advance(struct cell_halo *halo, int axis);
void cell_halo_finish(struct cell_halo *halo, int axis);

/* Number N of plane P; its cells run along the lower of the two other axes first. */
BOLIDE_INLINE double *cell_plane(const struct cell_halo *halo, int dimension, int axis, int32_t p,
                                 int n)
{
    const size_t room = (size_t)cell_plane_room(dimension);
    return halo->axis[axis].plane + ((size_t)p * (size_t)halo->numbers + (size_t)n) * room;
}

#endif
