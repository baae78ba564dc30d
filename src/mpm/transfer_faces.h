/* Stresses that push through the faces between nodes, in lanes. For the file that is compiled once an
 * instruction set (transfer_kernel.c).
 *
 * The slope of a shape function is a difference of functions M of the two faces of its node: along
 * an axis N_I' = (M_(I-1/2) - M_(I+1/2))/h, M the B-spline of the next lower degree. So the sum of
 * V sigma grad N of (2-10) is a difference of sums over faces, V sigma M N N/h. Where particles fill
 * the space about a face the sum of V M N N is h^3, but only in the mean: with particles that move
 * through the grid it goes up and down, and a uniform stress pushes nodes. So each face has its own
 * factor, 1 over that sum (fill.c), and what pushes through it is a mean of stresses. What pushes a
 * node on pushes the next one back, and works with the difference of their velocities: momentum and
 * energy are conserved. */
#ifndef BOLIDE_MPM_TRANSFER_FACES_H
#define BOLIDE_MPM_TRANSFER_FACES_H

#include "base/wide.h"
#include "mpm/transfer_weights.h"

/* Faces across AXIS in a window, along each axis. */
BOLIDE_INLINE int faces_along(struct kind kind, int across, int axis)
{
    return axis >= kind.dimension ? 1 : kind.window - (across == axis);
}

#define FOR_FACES(kind, across, a, b, c)                         \
    for (int a = 0; a < faces_along(kind, across, 0); a++)       \
        for (int b = 0; b < faces_along(kind, across, 1); b++)   \
            for (int c = 0; c < faces_along(kind, across, 2); c++)

/* The functions along AXIS of faces ACROSS an axis. */
BOLIDE_INLINE const double (*factors_of(const struct chunk *chunk, int across, int axis))[LANES]
{
    return across == axis ? chunk->face[axis] : chunk->value[axis];
}

/* The place of a node of a window among its nodes. */
BOLIDE_INLINE int place_of(struct kind kind, int a, int b, int c)
{
    return kind.dimension == 1   ? a
           : kind.dimension == 2 ? a * kind.window + b
                                 : (a * kind.window + b) * kind.window + c;
}

/* What pushes through faces across each axis. */
struct face_record {
    vector4 of[3];
};

BOLIDE_INLINE struct face_record face_record_of(const struct transfer *t, struct kind kind,
                                                int32_t i)
{
    const double edge = t->edge, v = t->mass[i] / (t->density[i] * edge);
    const double p = t->pressure[i] + t->viscosity[i] - t->gauge[t->material[i]];
    const double *s = t->deviator[i];
    const double fill = kind.dimension == 1   ? v
                        : kind.dimension == 2 ? v / edge
                                              : v / square(edge);
    const bool round = kind.dimension == 2 && t->axisymmetric;
    const struct face_record record = {{{v * (s[0] - p), v * s[3], round ? 0.0 : v * s[5], fill},
                                        {v * s[3], v * (s[1] - p), round ? 0.0 : v * s[4], fill},
                                        {v * s[5], v * s[4], v * (s[2] - p), fill}}};
    return record;
}

/* Adds the record of particle LANE to the sums of the faces of the window, DIMENSION a node. */
BOLIDE_INLINE void add_faces(struct kind kind, const struct chunk *chunk, int lane,
                             const struct face_record *record, vector4 *sum)
{
    for (int d = 0; d < kind.dimension; d++) {
        const double(*wa)[LANES] = factors_of(chunk, d, 0), (*wb)[LANES] = factors_of(chunk, d, 1),
                    (*wc)[LANES] = factors_of(chunk, d, 2);
        for (int a = 0; a < faces_along(kind, d, 0); a++) {
            const vector4 in_a = wa[a][lane] * record->of[d];
            for (int b = 0; b < faces_along(kind, d, 1); b++) {
                const vector4 in_b = kind.dimension > 1 ? wb[b][lane] * in_a : in_a;
                for (int c = 0; c < faces_along(kind, d, 2); c++)
                    sum[place_of(kind, a, b, c) * kind.dimension + d] +=
                        kind.dimension > 2 ? wc[c][lane] * in_b : in_b;
            }
        }
    }
}

/* Adds what particle LANE has around the axis to the nodes of the window, two records each. */
BOLIDE_INLINE void add_ring(const struct transfer *t, struct kind kind, const struct chunk *chunk,
                            int lane, vector4 *sum)
{
    const int32_t i = chunk->index[lane];
    const double area = t->mass[i] / (t->density[i] * t->position[i][0]);
    const double stress = t->deviator[i][2] - t->pressure[i] - t->viscosity[i] +
                          t->gauge[t->material[i]];
    const vector4 fill = {0.0, 0.0, area / square(t->edge), 0.0},
                  hoop = {0.0, 0.0, -area * stress, 0.0};
    for (int a = 0; a < kind.window; a++)
        for (int b = 0; b < kind.window; b++) {
            const double w = chunk->value[0][a][lane] * chunk->value[1][b][lane];
            sum[2 * place_of(kind, a, b, 0)] += w * fill;
            sum[2 * place_of(kind, a, b, 0) + 1] += w * hoop;
        }
}

/* Copies what fills the faces of a patch. */
BOLIDE_INLINE void keep_fill(const struct transfer *t, struct kind kind, const double *stress,
                             double *fill)
{
    for (int n = 0; n < t->grid->patch; n++)
        for (int d = 0; d < kind.dimension; d++)
            fill[n * FILL_STRIDE + d] = stress[(n * kind.dimension + d) * FACE_STRIDE + FACE_FILL];
    for (int n = 0; n < t->grid->patch && kind.dimension == 2 && t->axisymmetric; n++)
        fill[n * FILL_STRIDE + FILL_RING] = stress[n * 2 * FACE_STRIDE + FACE_RING];
}

/* So many nodes of a patch lie between one and the next along AXIS. */
BOLIDE_INLINE int patch_step(const struct transfer *t, struct kind kind, int axis)
{
    int step = 1;
    for (int k = axis + 1; k < kind.dimension; k++)
        step *= t->grid->side;
    return step;
}

/* The factor of what pushes along COMPONENT through a face across AXIS. Shear goes as particles have
 * it: pairs of equal shear turn nothing, and with other factors they would. */
BOLIDE_INLINE double face_factor(const double *fill, int axis, int component)
{
    return axis == component ? fill[axis] : 1.0;
}

BOLIDE_INLINE void bin_push(const struct transfer *t, struct kind kind, int32_t bin)
{
    const double *stress = grid_patch(t->grid, t->stress, bin),
                 *fill = grid_patch(t->grid, t->fill, bin);
    double *patch = grid_patch(t->grid, t->main, bin);
    for (int d = 0; d < kind.dimension; d++) {
        const int step = patch_step(t, kind, d);
        for (int n = 0; n + step < t->grid->patch; n++) {
            const double *face = stress + (n * kind.dimension + d) * FACE_STRIDE;
            double *low = patch + n * NODE_STRIDE + NODE_FORCE, *high = low + step * NODE_STRIDE;
            for (int k = 0; k < kind.dimension; k++) {
                const double push = face[k] * face_factor(fill + n * FILL_STRIDE, d, k);
                low[k] += push;
                high[k] -= push;
            }
        }
    }
    for (int n = 0; n < t->grid->patch && kind.dimension == 2 && t->axisymmetric; n++)
        patch[n * NODE_STRIDE + NODE_FORCE] +=
            stress[n * 2 * FACE_STRIDE + FACE_HOOP] * fill[n * FILL_STRIDE + FILL_RING];
}

/* Turns the patch of stresses of a bin into that of what they work with in a step of DT: differences
 * over the faces of the ways of nodes, over the edge, with the factors. */
BOLIDE_INLINE void bin_stretch(const struct transfer *t, struct kind kind, int32_t bin, double dt)
{
    const double *patch = grid_patch(t->grid, t->main, bin),
                 *fill = grid_patch(t->grid, t->fill, bin);
    double *stretch = grid_patch(t->grid, t->stress, bin);
    const double per_edge = 1.0 / t->edge;
    for (int d = 0; d < kind.dimension; d++) {
        const int step = patch_step(t, kind, d);
        for (int n = 0; n + step < t->grid->patch; n++) {
            const double *low = patch + n * NODE_STRIDE, *high = low + step * NODE_STRIDE;
            double *face = stretch + (n * kind.dimension + d) * FACE_STRIDE;
            for (int k = 0; k < kind.dimension; k++) {
                const double more = high[NODE_VELOCITY + k] - low[NODE_VELOCITY + k],
                             push = high[NODE_ACCELERATION + k] - low[NODE_ACCELERATION + k];
                face[k] = dt * per_edge * (more - 0.5 * dt * push) *
                          face_factor(fill + n * FILL_STRIDE, d, k);
            }
        }
    }
    for (int n = 0; n < t->grid->patch && kind.dimension == 2 && t->axisymmetric; n++) {
        const double *node = patch + n * NODE_STRIDE;
        stretch[n * 2 * FACE_STRIDE + FACE_HOOP] =
            dt * (node[NODE_VELOCITY] - 0.5 * dt * node[NODE_ACCELERATION]) *
            fill[n * FILL_STRIDE + FILL_RING];
    }
}

/* What the lanes of a chunk take of the first numbers of the faces ACROSS an axis, as many as there are
 * axes. BASE is the first node of the window in the patch. */
BOLIDE_INLINE void gather_faces(const struct transfer *t, struct kind kind,
                                const struct chunk *chunk, const double *stretch, size_t base,
                                int across, double (*sum)[LANES])
{
    const double(*wa)[LANES] = factors_of(chunk, across, 0),
                (*wb)[LANES] = factors_of(chunk, across, 1),
                (*wc)[LANES] = factors_of(chunk, across, 2);
    for (int k = 0; k < kind.dimension; k++)
        for (int lane = 0; lane < kind.lanes; lane++)
            sum[k][lane] = 0.0;
    FOR_FACES(kind, across, a, b, c)
    {
        const double *face =
            stretch + (node_of(t, kind, base, a, b, c) * (size_t)kind.dimension + (size_t)across) *
                          FACE_STRIDE;
        for (int lane = 0; lane < kind.lanes; lane++) {
            double w = wa[a][lane];
            if (kind.dimension > 1)
                w *= wb[b][lane];
            if (kind.dimension > 2)
                w *= wc[c][lane];
            for (int k = 0; k < kind.dimension; k++)
                sum[k][lane] += w * face[k];
        }
    }
}

#endif
