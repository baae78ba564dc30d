/* The bodies of the loops in transfer.h, for a block, a cell and a particle. Weights are computed
 * for several particles of a cell at a time, one a lane. Transfers to particles are summed in the
 * lanes of the particles. Transfers to nodes form one record a node, which is summed over the
 * particles of a cell and then over cells. Everything here also compiles as CUDA device code. */
#ifndef BOLIDE_MPM_TRANSFER_BODY_H
#define BOLIDE_MPM_TRANSFER_BODY_H

#include <string.h>

#include "mpm/transfer_scatter.h"

BOLIDE_INLINE void bin_slopes(const struct transfer *t, struct kind kind, int32_t bin)
{
    double *patch = grid_patch(t->grid, t->normal, bin);
    memset(patch, 0, (size_t)(patch_of(kind) * BACK_STRIDE) * sizeof *patch);
    const struct corner corner = corner_of(t, kind, bin);
    for (int cell = 0; cell < BLOCK_CELLS; cell++) {
        const struct cell_walk walk = cell_of(t, kind, &corner, bin, cell);
        struct chunk chunk;
        for (int32_t begin = 0; begin < walk.count; begin += kind.lanes) {
            weigh(t, kind, &walk, begin, &chunk);
            for (int lane = 0; lane < chunk.count; lane++)
                FOR_NODES (kind, a, b, c) {
                    const struct weight w = weight_of(kind, &chunk, lane, a, b, c);
                    double *node = patch + node_of(kind, walk.base, a, b, c) * BACK_STRIDE;
                    for (int k = 0; k < kind.dimension; k++)
                        node[k] += t->mass[chunk.index[lane]] * w.slope[k];
                }
        }
    }
}

/* The same as `gather` with slopes: sum[i][j] is d data_i / d x_j. */
BOLIDE_INLINE void gather_slopes(struct kind kind, const struct chunk *chunk, struct window from,
                                 double (*sum)[3][LANES])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            FOR_LANES (kind, lane)
                sum[i][j][lane] = 0.0;
    FOR_NODES (kind, a, b, c) {
        const double *node = numbers_at(kind, from, a, b, c);
        ALIGNED double slope[3][LANES];
        FOR_LANES (kind, lane) {
            const struct weight w = weight_of(kind, chunk, lane, a, b, c);
            for (int j = 0; j < kind.dimension; j++)
                slope[j][lane] = w.slope[j];
        }
        for (int i = 0; i < kind.dimension; i++)
            for (int j = 0; j < kind.dimension; j++)
                FOR_LANES (kind, lane)
                    sum[i][j][lane] += slope[j][lane] * node[i];
    }
}

/* The gradient that a particle carries on: by slopes, or by first moments over
 * the second one of the shape function, sum_I N u (x_I - x) / sum_I N (x_I -
 * x)^2 (Jiang et al., ACM Trans. Graph. 34 (2015) 51). */
BOLIDE_INLINE void keep_gradient(const struct transfer *t, struct kind kind,
                                 const struct chunk *chunk, struct window velocity)
{
    ALIGNED double sum[3][3][LANES];
    gather_slopes(kind, chunk, velocity, sum);
    if (t->by_moments && kind.window > 2) {
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                FOR_LANES (kind, lane)
                    sum[i][j][lane] = 0.0;
        FOR_NODES (kind, a, b, c) {
            const int at[3] = {a, b, c};
            const double *node = numbers_at(kind, velocity, a, b, c);
            FOR_LANES (kind, lane) {
                const double w = weight_of(kind, chunk, lane, a, b, c).value;
                for (int i = 0; i < kind.dimension; i++)
                    for (int j = 0; j < kind.dimension; j++)
                        sum[i][j][lane] += w * node[i] * chunk->away[j][at[j]][lane];
            }
        }
        FOR_LANES (kind, lane)
            for (int j = 0; j < kind.dimension; j++) {
                double second = 0.0;
                for (int k = 0; k < kind.window; k++)
                    second += chunk->value[j][k][lane] * square(chunk->away[j][k][lane]);
                for (int i = 0; i < kind.dimension; i++)
                    sum[i][j][lane] /= second;
            }
    }
    for (int lane = 0; lane < chunk->count; lane++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                t->gradient[chunk->index[lane]][3 * i + j] = sum[i][j][lane];
}

/* New velocities of the lanes of a chunk, from the sums over nodes of acceleration and velocity. */
BOLIDE_INLINE void accelerate(const struct transfer *t, struct kind kind, const struct chunk *chunk,
                              struct transfer_step step, double (*push)[LANES],
                              double (*flow)[LANES])
{
    for (int lane = 0; lane < chunk->count; lane++) {
        double *u = t->velocity[chunk->index[lane]], *x = t->position[chunk->index[lane]];
        for (int k = 0; k < kind.dimension; k++) {
            u[k] += step.dt * push[k][lane];
            if (t->flip < 1.0)
                /* The caller has gathered `flow`; the analyzer forgets what it knew of flip. */
                // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult)
                u[k] = t->flip * u[k] + (1.0 - t->flip) * flow[k][lane];
            if (step.move)
                x[k] += step.dt * flow[k][lane];
        }
    }
}

/* Adds the momenta of the lanes of a chunk to the SUM of each node. */
BOLIDE_INLINE void add_momenta(const struct transfer *t, struct kind kind,
                               const struct chunk *chunk, const double (*weight)[LANES],
                               vector4 *sum)
{
    vector4 record[LANES];
    for (int lane = 0; lane < kind.lanes; lane++) {
        const int32_t i = chunk->index[lane];
        const double *u = t->velocity[i], mass = lane < chunk->count ? t->mass[i] : 0.0;
        const double divergence = t->divergence ? t->divergence[i] : 0.0;
        const vector4 momentum = {mass * u[0], mass * u[1], mass * u[2], mass * divergence};
        record[lane] = momentum;
    }
    add_records4(kind, nodes_of(kind), weight, record, sum);
}

BOLIDE_INLINE void bin_velocity(const struct transfer *t, struct kind kind, int32_t bin,
                                struct transfer_step step, bool scatter_back)
{
    const double *patch = grid_patch(t->grid, t->main, bin);
    double *back = scatter_back ? grid_patch(t->grid, t->back, bin) : NULL;
    const bool blend = t->flip < 1.0 || step.move;
    if (back)
        memset(back, 0, (size_t)(patch_of(kind) * BACK_STRIDE) * sizeof *back);
    ALIGNED double stretch[STRETCH_MAX];
    if (t->by_faces && t->conserves)
        bin_stretch(t, kind, bin, step.dt, stretch);
    const struct corner corner = corner_of(t, kind, bin);
    for (int cell = 0; cell < BLOCK_CELLS; cell++) {
        const struct cell_walk walk = cell_of(t, kind, &corner, bin, cell);
        const struct window nodes = window_of(patch, NODE_STRIDE, walk.base),
                            flows = window_of(patch + NODE_VELOCITY, NODE_STRIDE, walk.base),
                            accelerations =
                                window_of(patch + NODE_ACCELERATION, NODE_STRIDE, walk.base);
        const bool mixes = t->mixing > 0.0 && walk.count > 0 && window_mixes(kind, nodes);
        struct chunk chunk;
        ALIGNED double push[3][LANES], flow[3][LANES], weight[NODES_MAX][LANES];
        vector4 sum[NODES_MAX];
        if (walk.count == 0)
            continue;
        vector4_clear(sum, nodes_of(kind));
        for (int32_t begin = 0; begin < walk.count; begin += kind.lanes) {
            weigh(t, kind, &walk, begin, &chunk);
            find_weights(kind, &chunk, weight);
            gather(kind, weight, accelerations, kind.dimension, push);
            if (blend)
                gather(kind, weight, flows, kind.dimension, flow);
            if (mixes || t->conserves) {
                struct given given = {{{0.0}}, {0.0}};
                if (mixes)
                    gather_mixed(t, kind, &chunk, weight, nodes, step.dt, push, &given);
                if (t->conserves)
                    gather_work(t, kind, &chunk, weight, nodes, stretch, step.dt, push, &given);
                take_given(t, kind, &chunk, &given);
            }
            accelerate(t, kind, &chunk, step, push, flow);
            if (t->affine)
                keep_gradient(t, kind, &chunk, flows);
            if (!back)
                continue;
            add_momenta(t, kind, &chunk, weight, sum);
            for (int lane = 0; lane < chunk.count && t->affine; lane++)
                FOR_NODES (kind, a, b, c) {
                    const int at[3] = {a, b, c};
                    add_affine(t, kind, &chunk, lane, at,
                               back + node_of(kind, walk.base, a, b, c) * BACK_STRIDE);
                }
        }
        if (back)
            add_sums4(kind, walk.base, sum, back);
    }
}

BOLIDE_INLINE void bin_again(const struct transfer *t, struct kind kind, int32_t bin,
                             const double *from, bool accelerations, double *to)
{
    memset(to, 0, (size_t)(patch_of(kind) * NODE_STRIDE) * sizeof *to);
    const struct corner corner = corner_of(t, kind, bin);
    ALIGNED double got[NODE_STRIDE][LANES] = {{0.0}}, weight[NODES_MAX][LANES];
    for (int cell = 0; cell < BLOCK_CELLS; cell++) {
        const struct cell_walk walk = cell_of(t, kind, &corner, bin, cell);
        struct chunk chunk;
        struct node_halves sum;
        vector4_clear(sum.low, walk.count ? nodes_of(kind) : 0);
        vector4_clear(sum.high, walk.count ? nodes_of(kind) : 0);
        for (int32_t begin = 0; begin < walk.count; begin += kind.lanes) {
            weigh(t, kind, &walk, begin, &chunk);
            find_weights(kind, &chunk, weight);
            gather(kind, weight, window_of(from + NODE_VELOCITY, NODE_STRIDE, walk.base),
                   kind.dimension, got + NODE_VELOCITY);
            if (accelerations)
                gather(kind, weight, window_of(from + NODE_ACCELERATION, NODE_STRIDE, walk.base),
                       kind.dimension, got + NODE_ACCELERATION);
            for (int lane = 0; lane < chunk.count; lane++) {
                const double m = t->mass[chunk.index[lane]];
                const vector4 low = {0.0, m * got[1][lane], m * got[2][lane], m * got[3][lane]},
                              high = {m * got[4][lane], m * got[5][lane], m * got[6][lane], 0.0};
                for (int n = 0; n < nodes_of(kind); n++) {
                    sum.low[n] += weight[n][lane] * low;
                    sum.high[n] += weight[n][lane] * high;
                }
            }
        }
        if (walk.count)
            add_halves(kind, walk.base, &sum, to);
    }
}

/* Strain and spin of the lanes of a chunk from the gradients of velocity SUM; AROUND is the
 * velocity away from the axis. */
BOLIDE_INLINE void keep_rates(const struct transfer *t, struct kind kind, const struct chunk *chunk,
                              double (*sum)[3][LANES], const double *around, struct rates rates)
{
    const bool round = kind.dimension == 2 && t->axisymmetric;
    double *row[RATES];
    for (int c = 0; c < RATES; c++)
        row[c] = rates.to + (size_t)c * rates.stride;
    FOR_LANES (kind, lane) {
        row[0][lane] = sum[0][0][lane];
        row[1][lane] = sum[1][1][lane];
        row[2][lane] = round ? around[lane] / t->position[chunk->index[lane]][0] : sum[2][2][lane];
        row[3][lane] = 0.5 * (sum[0][1][lane] + sum[1][0][lane]);
        row[4][lane] = 0.5 * (sum[1][2][lane] + sum[2][1][lane]);
        row[5][lane] = 0.5 * (sum[2][0][lane] + sum[0][2][lane]);
        row[6][lane] = 0.5 * (sum[2][1][lane] - sum[1][2][lane]);
        row[7][lane] = 0.5 * (sum[0][2][lane] - sum[2][0][lane]);
        row[8][lane] = 0.5 * (sum[1][0][lane] - sum[0][1][lane]);
        row[RATE_UNRESOLVED][lane] = 0.0;
    }
}

/* Stores for each particle of a chunk the part of last step's divergence that the nodes cannot
 * represent, and keeps the divergence of this step for the next one. */
BOLIDE_INLINE void filter_divergence(const struct transfer *t, struct kind kind,
                                     const struct chunk *chunk, const double (*weight)[LANES],
                                     struct window back, struct rates rates)
{
    ALIGNED double mean[1][LANES];
    double *unresolved = rates.to + (size_t)RATE_UNRESOLVED * rates.stride;
    gather(kind, weight, back, 1, mean);
    FOR_LANES (kind, lane)
        unresolved[lane] = t->divergence[chunk->index[lane]] - mean[0][lane];
    for (int lane = 0; lane < chunk->count; lane++)
        t->divergence[chunk->index[lane]] =
            rates.to[lane] + rates.to[rates.stride + lane] + rates.to[2 * rates.stride + lane];
}

BOLIDE_INLINE void bin_gradient(const struct transfer *t, struct kind kind, int32_t bin,
                                struct transfer_step step, struct nodal velocity,
                                struct rates rates)
{
    const bool round = kind.dimension == 2 && t->axisymmetric;
    const double *patch = grid_patch(t->grid, t->main, bin);
    const struct corner corner = corner_of(t, kind, bin);
    for (int cell = 0; cell < BLOCK_CELLS; cell++) {
        const struct cell_walk walk = cell_of(t, kind, &corner, bin, cell);
        const struct window of = window_of(velocity.data, velocity.stride, walk.base),
                            flows = window_of(patch + NODE_VELOCITY, NODE_STRIDE, walk.base);
        struct chunk chunk;
        ALIGNED double sum[3][3][LANES], flow[3][LANES], around[LANES];
        ALIGNED double weight[NODES_MAX][LANES];
        for (int32_t begin = 0; begin < walk.count; begin += kind.lanes) {
            weigh(t, kind, &walk, begin, &chunk);
            find_weights(kind, &chunk, weight);
            gather_slopes(kind, &chunk, of, sum);
            if (round)
                gather_around(kind, &chunk, of, around);
            if (step.move)
                gather(kind, weight, flows, kind.dimension, flow);
            keep_rates(t, kind, &chunk, sum, around, rates);
            if (t->divergence)
                filter_divergence(
                    t, kind, &chunk, weight,
                    window_of(velocity.data + BACK_DIVERGENCE, velocity.stride, walk.base), rates);
            rates.to += chunk.count;
            for (int lane = 0; lane < chunk.count && step.move; lane++)
                for (int k = 0; k < kind.dimension; k++)
                    t->position[chunk.index[lane]][k] += step.dt * flow[k][lane];
        }
    }
}

#endif
