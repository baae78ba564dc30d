/* The particles of a cell and the shape functions at the nodes that they reach, some at once in
 * lanes. For the file that is compiled once an instruction set (transfer_kernel.h). */
#ifndef BOLIDE_MPM_TRANSFER_WEIGHTS_H
#define BOLIDE_MPM_TRANSFER_WEIGHTS_H

#include <string.h>

#include "base/lanes.h"
#include "base/wide.h"
#include "mpm/transfer.h"

/* Nodes of a window along an axis, and in all. */
enum { WINDOW_MAX = 4, NODES_MAX = WINDOW_MAX * WINDOW_MAX * WINDOW_MAX };

/* What is known when the loops are compiled. */
struct kind {
    int dimension, window; /* nodes along an axis that a particle of a cell reaches */
    int lanes;             /* particles at once: those of a cell at the start */
};

BOLIDE_INLINE struct kind kind_make(int dimension, int window, int lanes)
{
    struct kind kind = {dimension, window, lanes};
    return kind;
}

/* All lanes; a loop over them stays one until it is made wide. */
#define FOR_LANES(kind, lane) _Pragma("omp simd") for (int lane = 0; lane < (kind).lanes; lane++)

BOLIDE_INLINE int nodes_of(struct kind kind)
{
    return kind.dimension == 1   ? kind.window
           : kind.dimension == 2 ? kind.window * kind.window
                                 : kind.window * kind.window * kind.window;
}

/* Nodes of a patch along an axis, and in all: those of the grid's, known when it is compiled. */
BOLIDE_INLINE int side_of(struct kind kind)
{
    return block_cells(kind.dimension) + kind.window - 1;
}

BOLIDE_INLINE int patch_of(struct kind kind)
{
    const int side = side_of(kind);
    return kind.dimension == 1 ? side : kind.dimension == 2 ? side * side : side * side * side;
}

/* Up to eight particles of a cell, and their shape functions. What is behind the last particle
 * is the last one again. */
struct chunk {
    int count;
    int32_t index[LANES];
    ALIGNED double value[3][WINDOW_MAX][LANES]; /* along an axis, at a node */
    ALIGNED double slope[3][WINDOW_MAX][LANES]; /* 1/m */
    ALIGNED double away[3][WINDOW_MAX][LANES];  /* of the node from the particle, m; affine only */
    ALIGNED double around[WINDOW_MAX][LANES];   /* along x, for what acts around the axis */
    ALIGNED double face[3][WINDOW_MAX][LANES];  /* of the face behind a node; by faces only */
};

/* The cell of a bin that a loop is at. */
struct cell_walk {
    int64_t index[3]; /* in the global grid */
    size_t base;      /* first node of its window, in the patch */
    const int32_t *list;
    int32_t count;
};

/* The first cell of a bin. */
struct corner {
    int64_t index[3];
};

BOLIDE_INLINE struct corner corner_of(const struct transfer *t, struct kind kind, int32_t bin)
{
    struct corner corner;
    block_coordinates(t->bins->bin[bin].key, corner.index);
    for (int axis = 0; axis < 3; axis++)
        corner.index[axis] *= block_cells(kind.dimension);
    return corner;
}

BOLIDE_INLINE struct cell_walk cell_of(const struct transfer *t, struct kind kind,
                                       const struct corner *corner, int32_t bin, int cell)
{
    const struct bin *b = &t->bins->bin[bin];
    struct cell_walk walk;
    int place[3];
    walk.base = 0;
    walk.list = t->bins->list + b->first + b->cell[cell];
    walk.count = b->cell[cell + 1] - b->cell[cell];
    bin_cell_place(kind.dimension, cell, place);
    for (int axis = 0; axis < 3; axis++)
        walk.index[axis] = 0;
    for (int axis = 0; axis < kind.dimension; axis++) {
        walk.index[axis] = corner->index[axis] + place[axis];
        walk.base = walk.base * (size_t)side_of(kind) + (size_t)place[axis];
    }
    return walk;
}

BOLIDE_INLINE void weigh_axis(struct kind kind, enum grid_shape shape, const double *xi,
                              const double *half, double (*value)[LANES], double (*slope)[LANES])
{
    for (int k = 0; k < kind.window; k++)
        FOR_LANES (kind, lane) {
            const double r = xi[lane] - (double)(k - 1);
            value[k][lane] = shape_value(shape, r, half[lane]);
            slope[k][lane] = shape_slope(shape, r, half[lane]);
        }
}

/* Quadratic functions at XI, at most half a cell from the node in the middle. */
BOLIDE_INLINE void weigh_centred(struct kind kind, const double *xi, double (*value)[LANES],
                                 double (*slope)[LANES])
{
    FOR_LANES (kind, lane) {
        const double low = 0.5 - xi[lane], high = 0.5 + xi[lane];
        value[0][lane] = 0.5 * square(low);
        value[1][lane] = 0.75 - square(xi[lane]);
        value[2][lane] = 0.5 * square(high);
        slope[0][lane] = -low;
        slope[1][lane] = -2.0 * xi[lane];
        slope[2][lane] = high;
    }
}

/* Functions of the faces behind nodes, whose differences are the slopes: of a B-spline that of the
 * next lower degree. */
BOLIDE_INLINE void weigh_faces(struct kind kind, const double (*slope)[LANES],
                               double (*face)[LANES])
{
    for (int k = 0; k + 1 < kind.window; k++)
        FOR_LANES (kind, lane)
            face[k][lane] = (k > 0 ? face[k - 1][lane] : 0.0) - slope[k][lane];
}

BOLIDE_INLINE void weigh_chunk(const struct transfer *t, struct kind kind,
                               const struct cell_walk *walk, int32_t begin, int32_t count,
                               struct chunk *chunk)
{
    const double per_edge = 1.0 / t->edge;
    ALIGNED double place[3][LANES], half[LANES];
    memcpy(chunk->index, walk->list + begin, (size_t)count * sizeof *chunk->index);
    for (int lane = count; lane < kind.lanes; lane++)
        chunk->index[lane] = walk->list[begin + count - 1];
    const bool sized = t->shape == SHAPE_GIMP || (t->axisymmetric && !t->by_faces);
    for (int lane = 0; lane < kind.lanes && sized; lane++)
        half[lane] = t->half_size[t->body[chunk->index[lane]]];
    for (int lane = 0; lane < kind.lanes; lane++)
        for (int axis = 0; axis < kind.dimension; axis++)
            place[axis][lane] = t->position[chunk->index[lane]][axis];
    for (int axis = 0; axis < kind.dimension; axis++) {
        double(*value)[LANES] = chunk->value[axis], (*slope)[LANES] = chunk->slope[axis],
        *xi = place[axis];
        FOR_LANES (kind, lane)
            xi[lane] = xi[lane] * per_edge - (double)walk->index[axis];
        if (kind.window == 2)
            FOR_LANES (kind, lane) {
                value[0][lane] = 1.0 - xi[lane];
                value[1][lane] = xi[lane];
                slope[0][lane] = -1.0;
                slope[1][lane] = 1.0;
            }
        else if (kind.window == 4 && t->shape == SHAPE_GIMP)
            weigh_axis(kind, SHAPE_GIMP, xi, half, value, slope);
        else if (kind.window == 3)
            weigh_centred(kind, xi, value, slope);
        else if (t->shape == SHAPE_QUADRATIC)
            weigh_axis(kind, SHAPE_QUADRATIC, xi, half, value, slope);
        else
            weigh_axis(kind, SHAPE_CUBIC, xi, half, value, slope);
        const double first = kind.window == 2 ? 0.0 : -1.0;
        for (int k = 0; axis == 0 && t->axisymmetric && k < kind.window; k++)
            FOR_LANES (kind, lane)
                chunk->around[k][lane] =
                    t->by_faces ? value[k][lane]
                                : shape_around(t->shape, xi[lane] - (first + k), half[lane]);
        if (t->by_faces)
            weigh_faces(kind, slope, chunk->face[axis]);
        for (int k = 0; k < kind.window; k++)
            FOR_LANES (kind, lane)
                slope[k][lane] *= per_edge;
        for (int k = 0; t->affine && k < kind.window; k++)
            FOR_LANES (kind, lane)
                chunk->away[axis][k][lane] = ((first + k) - xi[lane]) * t->edge;
    }
}

/* Of wide windows there is one body a dimension, which all loops call. */
#define WEIGH_WIDE(dimension, window)                                                            \
    APART void weigh_##dimension##_##window(const struct transfer *t,                            \
                                            const struct cell_walk *walk, int32_t begin,         \
                                            int32_t count, struct chunk *chunk)                  \
    {                                                                                            \
        weigh_chunk(t, kind_make(dimension, window, 1 << dimension), walk, begin, count, chunk); \
    }
WEIGH_WIDE(1, 3)
WEIGH_WIDE(2, 3)
WEIGH_WIDE(3, 3)
WEIGH_WIDE(1, 4)
WEIGH_WIDE(2, 4)
WEIGH_WIDE(3, 4)
#undef WEIGH_WIDE

BOLIDE_INLINE void weigh(const struct transfer *t, struct kind kind, const struct cell_walk *walk,
                         int32_t begin, struct chunk *chunk)
{
    const int32_t left = walk->count - begin, count = left < kind.lanes ? left : kind.lanes;
    if (kind.window == 2)
        weigh_chunk(t, kind, walk, begin, count, chunk);
    else if (kind.window == 3)
        kind.dimension == 1   ? weigh_1_3(t, walk, begin, count, chunk)
        : kind.dimension == 2 ? weigh_2_3(t, walk, begin, count, chunk)
                              : weigh_3_3(t, walk, begin, count, chunk);
    else
        kind.dimension == 1   ? weigh_1_4(t, walk, begin, count, chunk)
        : kind.dimension == 2 ? weigh_2_4(t, walk, begin, count, chunk)
                              : weigh_3_4(t, walk, begin, count, chunk);
    chunk->count = count;
}

/* The node at a, b, c of a window; nodes of axes that there are not count as one. */
BOLIDE_INLINE size_t node_of(struct kind kind, size_t base, int a, int b, int c)
{
    const size_t side = (size_t)side_of(kind);
    if (kind.dimension == 1)
        return base + (size_t)a;
    if (kind.dimension == 2)
        return base + (size_t)a * side + (size_t)b;
    return base + ((size_t)a * side + (size_t)b) * side + (size_t)c;
}

/* The numbers of the nodes of a window: at DATA those of the patch, STRIDE a node. */
struct window {
    const double *data;
    int stride;
    size_t base; /* of the window's first node */
};

BOLIDE_INLINE struct window window_of(const double *data, int stride, size_t base)
{
    const struct window window = {data, stride, base};
    return window;
}

BOLIDE_INLINE const double *numbers_at(struct kind kind, struct window window, int a, int b, int c)
{
    return window.data + node_of(kind, window.base, a, b, c) * (size_t)window.stride;
}

#define FOR_NODES(kind, a, b, c)                                             \
    for (int a = 0; a < (kind).window; a++)                                  \
        for (int b = 0; b < ((kind).dimension > 1 ? (kind).window : 1); b++) \
            for (int c = 0; c < ((kind).dimension > 2 ? (kind).window : 1); c++)

/* The shape function and its slopes of particle LANE at a node. */
struct weight {
    double value, slope[3];
};

BOLIDE_INLINE struct weight weight_of(struct kind kind, const struct chunk *chunk, int lane, int a,
                                      int b, int c)
{
    double va = chunk->value[0][a][lane], sa = chunk->slope[0][a][lane];
    double vb = 1.0, sb = 0.0, vc = 1.0, sc = 0.0;
    if (kind.dimension > 1) {
        vb = chunk->value[1][b][lane];
        sb = chunk->slope[1][b][lane];
    }
    if (kind.dimension > 2) {
        vc = chunk->value[2][c][lane];
        sc = chunk->slope[2][c][lane];
    }
    const struct weight w = {va * vb * vc, {sa * vb * vc, va * sb * vc, va * vb * sc}};
    return w;
}

/* The shape functions of the lanes of a chunk at all nodes of the window. */
BOLIDE_INLINE void find_weights(struct kind kind, const struct chunk *chunk,
                                double (*weight)[LANES])
{
    FOR_NODES (kind, a, b, c) {
        FOR_LANES (kind, lane) {
            double w = chunk->value[0][a][lane];
            if (kind.dimension > 1)
                w *= chunk->value[1][b][lane];
            if (kind.dimension > 2)
                w *= chunk->value[2][c][lane];
            (*weight)[lane] = w;
        }
        weight++;
    }
}

/* For the lanes of a chunk: the sums over nodes, with their WEIGHT, of COUNT of their numbers. */
BOLIDE_INLINE void gather(struct kind kind, const double (*weight)[LANES], struct window from,
                          int count, double (*sum)[LANES])
{
    for (int k = 0; k < count; k++)
        FOR_LANES (kind, lane)
            sum[k][lane] = 0.0;
    FOR_NODES (kind, a, b, c) {
        const double *node = numbers_at(kind, from, a, b, c);
        for (int k = 0; k < count; k++)
            FOR_LANES (kind, lane)
                sum[k][lane] += (*weight)[lane] * node[k];
        weight++;
    }
}

/* Adds the RECORD of each lane to the sums of COUNT nodes or faces, with their WEIGHT; records of
 * lanes behind the last particle are zero. */
BOLIDE_INLINE void add_records4(struct kind kind, int count, const double (*weight)[LANES],
                                const vector4 *record, vector4 *sum)
{
    for (int n = 0; n < count; n++) {
        vector4 all = sum[n];
        for (int lane = 0; lane < kind.lanes; lane++)
            all += weight[n][lane] * record[lane];
        sum[n] = all;
    }
}

#endif
