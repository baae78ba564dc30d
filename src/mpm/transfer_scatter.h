/* What particles add to nodes: the bodies of the loops in transfer.h that scatter. */
#ifndef BOLIDE_MPM_TRANSFER_SCATTER_H
#define BOLIDE_MPM_TRANSFER_SCATTER_H

#include <string.h>

#include "base/wide.h"
#include "mpm/transfer_work.h"

/* With an affine velocity field in a particle: the contribution of its velocity gradient to the
 * momentum of a node. */
BOLIDE_INLINE void add_affine(const struct transfer *t, struct kind kind, const struct chunk *chunk,
                              int lane, const int at[3], double *momentum)
{
    const double value = weight_of(kind, chunk, lane, at[0], at[1], at[2]).value;
    const double *g = t->gradient[chunk->index[lane]];
    const double factor = value * t->mass[chunk->index[lane]];
    for (int i = 0; i < kind.dimension; i++)
        for (int j = 0; j < kind.dimension; j++)
            momentum[i] += factor * g[3 * i + j] * chunk->away[j][at[j]][lane];
}

/* The contributions of a particle to its nodes: PLAIN is multiplied by the shape function, BY_SLOPE
 * by its slopes, AROUND by the weight of the hoop direction. Components that are always zero are
 * set once. */
struct node_record {
    ALIGNED double plain[NODE_STRIDE], by_slope[3][NODE_STRIDE], around[NODE_STRIDE];
};

/* The rate at which the energy of a particle is mixed, 1/s. */
BOLIDE_INLINE double mixing_rate(const struct transfer *t, int32_t i)
{
    return t->mixing * t->sound[i] / t->edge * t->shock[i];
}

BOLIDE_INLINE void node_record_of(const struct transfer *t, struct kind kind, int32_t i,
                                  struct node_record *record)
{
    const double mass = t->mass[i], v = -mass / t->density[i];
    const double p = t->pressure[i] + t->viscosity[i] - t->gauge[t->material[i]];
    const double *s = t->deviator[i], *u = t->velocity[i];
    double(*by_slope)[NODE_STRIDE] = record->by_slope;
    record->plain[NODE_MASS] = mass;
    if (t->mixing > 0.0)
        record->plain[NODE_MIXING] = mass * mixing_rate(t, i);
    for (int k = 0; k < 3; k++)
        record->plain[NODE_MOMENTUM + k] = mass * u[k];
    if (t->axisymmetric)
        record->around[NODE_FORCE] = v * (s[2] - p) / t->position[i][0];
    /* force = -V sigma grad N (2-10); components of axes that the case has not stay zero */
    by_slope[0][NODE_FORCE] = v * (s[0] - p);
    if (kind.dimension > 1) {
        by_slope[0][NODE_FORCE + 1] = by_slope[1][NODE_FORCE] = v * s[3];
        by_slope[1][NODE_FORCE + 1] = v * (s[1] - p);
    }
    if (kind.dimension > 2) {
        by_slope[0][NODE_FORCE + 2] = by_slope[2][NODE_FORCE] = v * s[5];
        by_slope[1][NODE_FORCE + 2] = by_slope[2][NODE_FORCE + 1] = v * s[4];
        by_slope[2][NODE_FORCE + 2] = v * (s[2] - p);
    }
}

/* Numbers of nodes in two halves, the second from NODE_FORCE on: vectors as wide as any processor
 * has them at once. */
struct node_halves {
    vector4 low[NODES_MAX], high[NODES_MAX];
};

/* Adds a particle's record to the sums of its nodes, a row along the last axis at a time, which has
 * all factors but that axis' in common: LEVEL is multiplied by the shape function along it, TILT by
 * its slope. The first half, mass and momentum, has no slopes. */
BOLIDE_INLINE void add_node_record(const struct transfer *t, struct kind kind,
                                   const struct chunk *chunk, int lane,
                                   const struct node_record *record, struct node_halves *sum)
{
    const int last = kind.dimension - 1, rows = kind.dimension > 2 ? kind.window : 1;
    const vector4 low = vector4_load(record->plain),
                  plain = vector4_load(record->plain + NODE_FORCE),
                  around = vector4_load(record->around + NODE_FORCE);
    vector4 by_slope[3];
    for (int axis = 0; axis < kind.dimension; axis++)
        by_slope[axis] = vector4_load(record->by_slope[axis] + NODE_FORCE);
    for (int a = 0; a < (kind.dimension > 1 ? kind.window : 1); a++)
        for (int b = 0; b < rows; b++) {
            double value = 1.0, along_a = 0.0, along_b = 0.0;
            if (kind.dimension > 1) {
                value = chunk->value[0][a][lane];
                along_a = chunk->slope[0][a][lane];
            }
            if (kind.dimension > 2) {
                along_b = value * chunk->slope[1][b][lane];
                along_a *= chunk->value[1][b][lane];
                value *= chunk->value[1][b][lane];
            }
            vector4 level = value * plain;
            if (kind.dimension > 1)
                level += along_a * by_slope[0];
            if (kind.dimension > 2)
                level += along_b * by_slope[1];
            else if (kind.dimension > 1 && t->axisymmetric)
                level += chunk->around[a][lane] * around;
            const vector4 tilt = value * by_slope[last], flat = value * low;
            const int row = (a * rows + b) * kind.window;
            for (int c = 0; c < kind.window; c++) {
                const double along = chunk->value[last][c][lane];
                sum->low[row + c] += along * flat;
                sum->high[row + c] += along * level + chunk->slope[last][c][lane] * tilt;
            }
        }
}

/* Adds the sums of a cell to its nodes in the patch. */
BOLIDE_INLINE void add_halves(struct kind kind, size_t base, const struct node_halves *sum,
                              double *patch)
{
    const vector4 *low = sum->low, *high = sum->high;
    FOR_NODES (kind, a, b, c) {
        double *node = patch + node_of(kind, base, a, b, c) * NODE_STRIDE;
        vector4_add_to(node, *low++);
        vector4_add_to(node + NODE_FORCE, *high++);
    }
}

BOLIDE_INLINE void add_sums4(struct kind kind, size_t base, const vector4 *sum, double *patch)
{
    FOR_NODES (kind, a, b, c)
        vector4_add_to(patch + node_of(kind, base, a, b, c) * BACK_STRIDE, *sum++);
}

/* What the particles of a cell have for nodes where forces act through faces: mass and momentum;
 * and behind three zeros what they mix, where any does. */
struct node_sums {
    vector4 plain[NODES_MAX], mixing[NODES_MAX];
    bool mixes;
};

/* Adds the contributions of the particles of a chunk to the sums of their nodes, without forces. */
BOLIDE_INLINE void scatter_nodes(const struct transfer *t, struct kind kind,
                                 const struct chunk *chunk, const double (*weight)[LANES],
                                 struct node_sums *sums)
{
    vector4 plain[LANES], mixing[LANES];
    bool mixes = false;
    for (int lane = 0; lane < kind.lanes; lane++) {
        const int32_t i = chunk->index[lane];
        const double mass = lane < chunk->count ? t->mass[i] : 0.0, *u = t->velocity[i];
        const vector4 of = {mass, mass * u[0], mass * u[1], mass * u[2]};
        plain[lane] = of;
        mixes |= t->mixing > 0.0 && t->shock[i] != 0.0;
    }
    add_records4(kind, nodes_of(kind), weight, plain, sums->plain);
    if (!mixes)
        return;
    for (int lane = 0; lane < kind.lanes; lane++) {
        const int32_t i = chunk->index[lane];
        const vector4 of = {0.0, 0.0, 0.0,
                            lane < chunk->count ? t->mass[i] * mixing_rate(t, i) : 0.0};
        mixing[lane] = of;
    }
    sums->mixes = true;
    add_records4(kind, nodes_of(kind), weight, mixing, sums->mixing);
}

BOLIDE_INLINE void add_node_sums(struct kind kind, size_t base, const struct node_sums *sums,
                                 double *patch)
{
    const vector4 *plain = sums->plain, *mixing = sums->mixing;
    FOR_NODES (kind, a, b, c)
        vector4_add_to(patch + node_of(kind, base, a, b, c) * NODE_STRIDE, *plain++);
    if (!sums->mixes)
        return;
    FOR_NODES (kind, a, b, c)
        vector4_add_to(patch + node_of(kind, base, a, b, c) * NODE_STRIDE + NODE_STRIDE / 2,
                       *mixing++);
}

/* The same with forces, to sums of nodes. */
BOLIDE_INLINE void scatter_forces(const struct transfer *t, struct kind kind,
                                  const struct chunk *chunk, struct node_record *record,
                                  struct node_halves *sum)
{
    for (int lane = 0; lane < chunk->count; lane++)
        node_record_of(t, kind, chunk->index[lane], &record[lane]);
    for (int lane = 0; lane < chunk->count; lane++)
        add_node_record(t, kind, chunk, lane, &record[lane], sum);
}

/* Adds the affine contributions of the particles of a chunk to the momenta of a patch. */
BOLIDE_INLINE void scatter_affine(const struct transfer *t, struct kind kind,
                                  const struct chunk *chunk, size_t base, double *patch)
{
    for (int lane = 0; lane < chunk->count && t->affine; lane++)
        FOR_NODES (kind, a, b, c) {
            const int at[3] = {a, b, c};
            double *node = patch + node_of(kind, base, a, b, c) * NODE_STRIDE;
            add_affine(t, kind, chunk, lane, at, node + NODE_MOMENTUM);
        }
}

/* Adds what the particles of a cell have to the nodes and faces of a patch. */
BOLIDE_INLINE void cell_scatter_faces(const struct transfer *t, struct kind kind,
                                      const struct cell_walk *walk, double *patch, double *stress)
{
    struct chunk chunk;
    struct face_sums through;
    struct node_sums sums;
    ALIGNED double weight[NODES_MAX][LANES];
    sums.mixes = false;
    vector4_clear(sums.plain, nodes_of(kind));
    vector4_clear(sums.mixing, nodes_of(kind));
    clear_faces(kind, t->axisymmetric, &through);
    for (int32_t begin = 0; begin < walk->count; begin += kind.lanes) {
        weigh(t, kind, walk, begin, &chunk);
        find_weights(kind, &chunk, weight);
        scatter_nodes(t, kind, &chunk, weight, &sums);
        scatter_faces(t, kind, &chunk, weight, &through);
        scatter_affine(t, kind, &chunk, walk->base, patch);
    }
    add_node_sums(kind, walk->base, &sums, patch);
    keep_faces(t, kind, walk->base, &through, stress);
}

/* The same with forces at nodes. */
BOLIDE_INLINE void cell_scatter_forces(const struct transfer *t, struct kind kind,
                                       const struct cell_walk *walk, struct node_record *record,
                                       double *patch)
{
    struct chunk chunk;
    struct node_halves sum;
    vector4_clear(sum.low, nodes_of(kind));
    vector4_clear(sum.high, nodes_of(kind));
    for (int32_t begin = 0; begin < walk->count; begin += kind.lanes) {
        weigh(t, kind, walk, begin, &chunk);
        scatter_forces(t, kind, &chunk, record, &sum);
        scatter_affine(t, kind, &chunk, walk->base, patch);
    }
    add_halves(kind, walk->base, &sum, patch);
}

BOLIDE_INLINE void bin_scatter(const struct transfer *t, struct kind kind, int32_t bin)
{
    double *patch = grid_patch(t->grid, t->main, bin);
    double *stress = t->by_faces ? grid_patch(t->grid, t->stress, bin) : NULL;
    memset(patch, 0, (size_t)(patch_of(kind) * NODE_STRIDE) * sizeof *patch);
    if (stress)
        memset(stress, 0, (size_t)(patch_of(kind) * FACE_STRIDE * kind.dimension) * sizeof *stress);
    const struct corner corner = corner_of(t, kind, bin);
    struct node_record record[LANES] = {0};
    for (int cell = 0; cell < BLOCK_CELLS; cell++) {
        const struct cell_walk walk = cell_of(t, kind, &corner, bin, cell);
        if (walk.count > 0 && stress)
            cell_scatter_faces(t, kind, &walk, patch, stress);
        else if (walk.count > 0)
            cell_scatter_forces(t, kind, &walk, record, patch);
    }
    if (stress)
        keep_fill(t, kind, stress, grid_patch(t->grid, t->fill, bin));
}

#endif
