/* Stresses that push through the faces between nodes, in lanes. For the file that is compiled once
 * an instruction set (transfer_kernel.h).
 *
 * The slope of a shape function is a difference of functions M of the two faces of its node: along
 * an axis N_I' = (M_(I-1/2) - M_(I+1/2))/h, M the B-spline of the next lower degree. So the sum of
 * V sigma grad N of (2-10) is a difference of sums over faces, V sigma M N N/h. Where particles
 * fill the space about a face the sum of V M N N is h^3, but only in the mean: with particles that
 * move through the grid it goes up and down, and a uniform stress pushes nodes. So each face has
 * its own factor, 1 over that sum (fill.c), and what pushes through it is a mean of stresses. What
 * pushes a node on pushes the next one back, and works with the difference of their velocities:
 * momentum and energy are conserved. */
#ifndef BOLIDE_MPM_TRANSFER_FACES_H
#define BOLIDE_MPM_TRANSFER_FACES_H

#include "base/wide.h"
#include "mpm/transfer_weights.h"

/* Faces across AXIS in a window, along each axis. */
BOLIDE_INLINE int faces_along(struct kind kind, int across, int axis)
{
    return axis >= kind.dimension ? 1 : kind.window - (across == axis);
}

#define FOR_FACES(kind, across, a, b, c)                       \
    for (int a = 0; a < faces_along(kind, across, 0); a++)     \
        for (int b = 0; b < faces_along(kind, across, 1); b++) \
            for (int c = 0; c < faces_along(kind, across, 2); c++)

/* The functions along AXIS of faces ACROSS an axis. */
BOLIDE_INLINE const double (*factors_of(const struct chunk *chunk, int across, int axis))[LANES]
{
    return across == axis ? chunk->face[axis] : chunk->value[axis];
}

BOLIDE_INLINE int faces_of(struct kind kind, int across)
{
    return faces_along(kind, across, 0) * faces_along(kind, across, 1) *
           faces_along(kind, across, 2);
}

/* The functions of the lanes of a chunk at the faces of the window ACROSS an axis. */
BOLIDE_INLINE void find_face_weights(struct kind kind, const struct chunk *chunk, int across,
                                     double (*weight)[LANES])
{
    const double(*wa)[LANES] = factors_of(chunk, across, 0),
          (*wb)[LANES] = factors_of(chunk, across, 1), (*wc)[LANES] = factors_of(chunk, across, 2);
    FOR_FACES (kind, across, a, b, c) {
        FOR_LANES (kind, lane) {
            double w = wa[a][lane];
            if (kind.dimension > 1)
                w *= wb[b][lane];
            if (kind.dimension > 2)
                w *= wc[c][lane];
            (*weight)[lane] = w;
        }
        weight++;
    }
}

/* What the particles of a cell have for faces across each axis, or for nodes: what pushes, and
 * fills. */
struct face_sums {
    vector4 of[3][NODES_MAX], ring[NODES_MAX];
};

BOLIDE_INLINE void clear_faces(struct kind kind, bool round, struct face_sums *sums)
{
    for (int d = 0; d < kind.dimension; d++)
        vector4_clear(sums->of[d], faces_of(kind, d));
    vector4_clear(sums->ring, round ? nodes_of(kind) : 0);
}

/* The records of the lanes of a chunk for faces across each axis. */
struct face_records {
    vector4 of[3][LANES];
};

BOLIDE_INLINE void load_face_records(const struct transfer *t, struct kind kind,
                                     const struct chunk *chunk, struct face_records *records)
{
    const double edge = t->edge, full = kind.dimension == 1   ? 1.0
                                        : kind.dimension == 2 ? 1.0 / edge
                                                              : 1.0 / square(edge);
    for (int lane = 0; lane < kind.lanes; lane++) {
        const int32_t i = chunk->index[lane];
        const double v = lane < chunk->count ? t->mass[i] / (t->density[i] * edge) : 0.0;
        const double p = t->pressure[i] + t->viscosity[i] - t->gauge[t->material[i]];
        const double *s = t->deviator[i];
        const double to_z = kind.dimension > 2 ? v : 0.0; /* else numbers of the node stand there */
        const vector4 x = {v * (s[0] - p), v * s[3], to_z * s[5], v * full},
                      y = {v * s[3], v * (s[1] - p), to_z * s[4], v * full},
                      z = {v * s[5], v * s[4], v * (s[2] - p), v * full};
        records->of[0][lane] = x;
        records->of[1][lane] = y;
        records->of[2][lane] = z;
    }
}

/* Adds what the lanes of a chunk have for faces ACROSS an axis. */
BOLIDE_INLINE void add_faces(struct kind kind, const struct chunk *chunk, int across,
                             const struct face_records *records, struct face_sums *sums)
{
    ALIGNED double weight[NODES_MAX][LANES];
    find_face_weights(kind, chunk, across, weight);
    add_records4(kind, faces_of(kind, across), weight, records->of[across], sums->of[across]);
}

/* Adds what the lanes of a chunk have around the axis to the nodes of the window. */
BOLIDE_INLINE void add_ring(const struct transfer *t, struct kind kind, const struct chunk *chunk,
                            const double (*weight)[LANES], struct face_sums *sums)
{
    vector4 record[LANES];
    for (int lane = 0; lane < kind.lanes; lane++) {
        const int32_t i = chunk->index[lane];
        const double stress =
            t->deviator[i][2] - t->pressure[i] - t->viscosity[i] + t->gauge[t->material[i]];
        const double area =
            lane < chunk->count ? t->mass[i] / (t->density[i] * t->position[i][0]) : 0.0;
        const vector4 ring = {area / square(t->edge), -area * stress, 0.0, 0.0};
        record[lane] = ring;
    }
    add_records4(kind, nodes_of(kind), weight, record, sums->ring);
}

/* Adds what the lanes of a chunk push through faces, and fill; WEIGHT at nodes. */
BOLIDE_INLINE void scatter_faces(const struct transfer *t, struct kind kind,
                                 const struct chunk *chunk, const double (*weight)[LANES],
                                 struct face_sums *sums)
{
    struct face_records records;
    load_face_records(t, kind, chunk, &records);
    add_faces(kind, chunk, 0, &records, sums);
    if (kind.dimension > 1)
        add_faces(kind, chunk, 1, &records, sums);
    if (kind.dimension > 2)
        add_faces(kind, chunk, 2, &records, sums);
    if (kind.dimension == 2 && t->axisymmetric)
        add_ring(t, kind, chunk, weight, sums);
}

/* Adds the sums of a cell, whose first node is BASE, to the patch of stresses. */
BOLIDE_INLINE void keep_faces(const struct transfer *t, struct kind kind, size_t base,
                              const struct face_sums *sums, double *stress)
{
    for (int d = 0; d < kind.dimension; d++) {
        const vector4 *sum = sums->of[d];
        FOR_FACES (kind, d, a, b, c)
            vector4_add_to(stress +
                               (node_of(kind, base, a, b, c) * (size_t)kind.dimension + (size_t)d) *
                                   FACE_STRIDE,
                           *sum++);
    }
    if (!(kind.dimension == 2 && t->axisymmetric))
        return;
    const double *sum = (const double *)sums->ring;
    FOR_NODES (kind, a, b, c) {
        double *node = stress + node_of(kind, base, a, b, c) * 2 * FACE_STRIDE;
        node[FACE_RING] += sum[0];
        node[FACE_HOOP] += sum[1];
        sum += FACE_STRIDE;
    }
}

/* Copies what fills the faces of a patch. */
BOLIDE_INLINE void keep_fill(const struct transfer *t, struct kind kind, const double *stress,
                             double *fill)
{
    for (int n = 0; n < patch_of(kind); n++)
        for (int d = 0; d < kind.dimension; d++)
            fill[n * FILL_STRIDE + d] = stress[(n * kind.dimension + d) * FACE_STRIDE + FACE_FILL];
    for (int n = 0; n < patch_of(kind) && kind.dimension == 2 && t->axisymmetric; n++)
        fill[n * FILL_STRIDE + FILL_RING] = stress[n * 2 * FACE_STRIDE + FACE_RING];
}

/* So many nodes of a patch lie between one and the next along AXIS. */
BOLIDE_INLINE int patch_step(struct kind kind, int axis)
{
    int step = 1;
    for (int k = axis + 1; k < kind.dimension; k++)
        step *= side_of(kind);
    return step;
}

/* The factors of what pushes along each axis through a face across AXIS of a node with FILL. Shear
 * goes as particles have it: pairs of equal shear turn nothing, and with other factors they
 * would. */
BOLIDE_INLINE vector4 face_factors(struct kind kind, const double *fill, int axis)
{
    const vector4 factors = {axis == 0 ? fill[0] : 1.0,
                             kind.dimension < 2 ? 0.0
                             : axis == 1        ? fill[1]
                                                : 1.0,
                             kind.dimension < 3 ? 0.0
                             : axis == 2        ? fill[2]
                                                : 1.0,
                             0.0};
    return factors;
}

BOLIDE_INLINE void bin_push(const struct transfer *t, struct kind kind, int32_t bin)
{
    const double *stress = grid_patch(t->grid, t->stress, bin),
                 *fill = grid_patch(t->grid, t->fill, bin);
    double *patch = grid_patch(t->grid, t->main, bin);
    for (int d = 0; d < kind.dimension; d++) {
        const int step = patch_step(kind, d);
        for (int n = 0; n + step < patch_of(kind); n++) {
            const vector4 push = vector4_load(stress + (n * kind.dimension + d) * FACE_STRIDE) *
                                 face_factors(kind, fill + n * FILL_STRIDE, d);
            double *low = patch + n * NODE_STRIDE + NODE_FORCE;
            vector4_add_to(low, push);
            vector4_add_to(low + step * NODE_STRIDE, -1.0 * push);
        }
    }
    for (int n = 0; n < patch_of(kind) && kind.dimension == 2 && t->axisymmetric; n++)
        patch[n * NODE_STRIDE + NODE_FORCE] +=
            stress[n * 2 * FACE_STRIDE + FACE_HOOP] * fill[n * FILL_STRIDE + FILL_RING];
}

/* Numbers of the largest patch of stresses, in 3-D. */
enum { STRETCH_MAX = 7 * 7 * 7 * 3 * FACE_STRIDE };

/* Fills STRETCH, laid out as the patch of stresses of a bin, with what they work with in a step of
 * DT: differences over the faces of the ways of nodes, over the edge, with the factors. */
BOLIDE_INLINE void bin_stretch(const struct transfer *t, struct kind kind, int32_t bin, double dt,
                               double *stretch)
{
    const double *patch = grid_patch(t->grid, t->main, bin),
                 *fill = grid_patch(t->grid, t->fill, bin);
    const double per_edge = 1.0 / t->edge;
    for (int d = 0; d < kind.dimension; d++) {
        const int step = patch_step(kind, d);
        for (int n = 0; n + step < patch_of(kind); n++) {
            const double *low = patch + n * NODE_STRIDE, *high = low + step * NODE_STRIDE;
            const vector4 more = vector4_load(high + NODE_VELOCITY) -
                                 vector4_load(low + NODE_VELOCITY),
                          push = vector4_load(high + NODE_ACCELERATION) -
                                 vector4_load(low + NODE_ACCELERATION),
                          mean = dt * per_edge * (more - 0.5 * dt * push) *
                                 face_factors(kind, fill + n * FILL_STRIDE, d);
            memcpy(stretch + (n * kind.dimension + d) * FACE_STRIDE, &mean, sizeof mean);
        }
    }
    for (int n = 0; n < patch_of(kind) && kind.dimension == 2 && t->axisymmetric; n++) {
        const double *node = patch + n * NODE_STRIDE;
        stretch[n * 2 * FACE_STRIDE + FACE_HOOP] =
            dt * (node[NODE_VELOCITY] - 0.5 * dt * node[NODE_ACCELERATION]) *
            fill[n * FILL_STRIDE + FILL_RING];
    }
}

/* What the lanes of a chunk take of the first numbers of the faces ACROSS an axis, as many as there
 * are axes. BASE is the first node of the window in the patch. */
BOLIDE_INLINE void gather_faces(struct kind kind, const struct chunk *chunk, const double *stretch,
                                size_t base, int across, double (*sum)[LANES])
{
    ALIGNED double weight[NODES_MAX][LANES];
    const double(*w)[LANES] = weight;
    find_face_weights(kind, chunk, across, weight);
    for (int k = 0; k < kind.dimension; k++)
        FOR_LANES (kind, lane)
            sum[k][lane] = 0.0;
    FOR_FACES (kind, across, a, b, c) {
        const double *face =
            stretch +
            (node_of(kind, base, a, b, c) * (size_t)kind.dimension + (size_t)across) * FACE_STRIDE;
        for (int k = 0; k < kind.dimension; k++)
            FOR_LANES (kind, lane)
                sum[k][lane] += (*w)[lane] * face[k];
        w++;
    }
}

#endif
