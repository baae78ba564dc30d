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

/* Adds a particle's record to the sums of a row of nodes along the last axis, which have all
 * factors but that axis' in common. LEVEL is multiplied by the shape function along it, TILT by its
 * slope. */
BOLIDE_INLINE void add_row(const struct chunk *chunk, struct kind kind, int lane,
                           const vector8 *level, const vector8 *tilt, vector8 *sum)
{
    const int last = kind.dimension - 1;
    for (int c = 0; c < kind.window; c++)
        sum[c] += chunk->value[last][c][lane] * *level + chunk->slope[last][c][lane] * *tilt;
}

BOLIDE_INLINE void add_node_record(const struct transfer *t, struct kind kind,
                                   const struct chunk *chunk, int lane,
                                   const struct node_record *record, vector8 *sum)
{
    vector8 plain, by_slope[3], around;
    memcpy(&plain, record->plain, sizeof plain);
    memcpy(&around, record->around, sizeof around);
    memcpy(by_slope, record->by_slope, (size_t)kind.dimension * sizeof plain);
    if (kind.dimension == 1) {
        add_row(chunk, kind, lane, &plain, &by_slope[0], sum);
        return;
    }
    for (int a = 0; a < kind.window; a++)
        for (int b = 0; b < (kind.dimension > 2 ? kind.window : 1); b++) {
            double value = chunk->value[0][a][lane], along_a = chunk->slope[0][a][lane];
            double along_b = 0.0;
            if (kind.dimension > 2) {
                along_b = value * chunk->slope[1][b][lane];
                along_a *= chunk->value[1][b][lane];
                value *= chunk->value[1][b][lane];
            }
            vector8 level = value * plain + along_a * by_slope[0];
            if (kind.dimension > 2)
                level += along_b * by_slope[1];
            else if (t->axisymmetric)
                level += chunk->around[a][lane] * around;
            const vector8 tilt = value * by_slope[kind.dimension - 1];
            add_row(chunk, kind, lane, &level, &tilt,
                    sum + (kind.dimension > 2 ? a * kind.window + b : a) * kind.window);
        }
}

/* Adds the sums of a cell to its nodes in the patch. */
BOLIDE_INLINE void add_sums8(struct kind kind, size_t base, const vector8 *sum, double *patch)
{
    FOR_NODES (kind, a, b, c)
        vector8_add_to(patch + node_of(kind, base, a, b, c) * NODE_STRIDE, *sum++);
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
                                  vector8 *sum)
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
    vector8 sum[NODES_MAX];
    vector8_clear(sum, nodes_of(kind));
    for (int32_t begin = 0; begin < walk->count; begin += kind.lanes) {
        weigh(t, kind, walk, begin, &chunk);
        scatter_forces(t, kind, &chunk, record, sum);
        scatter_affine(t, kind, &chunk, walk->base, patch);
    }
    add_sums8(kind, walk->base, sum, patch);
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
