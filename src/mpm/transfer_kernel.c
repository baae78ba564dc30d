/* The loops of transfer.h. Weights are found for two, four or eight particles of a cell at once;
 * what a particle takes from nodes is summed in the lanes of these, and what it gives to a node is
 * one record, summed in the lanes of that. */
#include <string.h>

#include "mpm/transfer_weights.h"

#define JOIN2(name, isa) name##_##isa
#define JOIN1(name, isa) JOIN2(name, isa)
#define NAMED(name) JOIN1(name, BOLIDE_ISA)

/* All that a node has, as the compiler may keep it in a register. */
typedef double vector8 __attribute__((vector_size(64), may_alias));
typedef double vector4 __attribute__((vector_size(32), may_alias)); /* of the second field */

/* Where the nodes of a particle may have a velocity that changes over them: what its gradient adds at a node. */
INLINE void add_affine(const struct transfer *t, struct kind kind, const struct chunk *chunk,
                       int lane, int a, int b, int c, double factor, double *momentum)
{
    const double *g = t->gradient[chunk->index[lane]];
    const int at[3] = {a, b, c};
    for (int i = 0; i < kind.dimension; i++)
        for (int j = 0; j < kind.dimension; j++)
            momentum[i] += factor * g[3 * i + j] * chunk->away[j][at[j]][lane];
}

/* The record of a particle: PLAIN goes with the shape function, BY_SLOPE with its slopes, AROUND with what stands for the
 * shape function around the axis. */
struct record {
    vector8 plain, by_slope[3], around;
};

INLINE void record_of(const struct transfer *t, struct kind kind, int32_t i, struct record *record)
{
    const double mass = t->mass[i], volume = mass / t->density[i];
    const double p = t->pressure[i] + t->viscosity[i] - t->gauge[t->material[i]];
    const double *s = t->deviator[i], *u = t->velocity[i];
    /* force = -V sigma grad N (2-10); what an axis that there is not would get is zero */
    const bool y = kind.dimension > 1, z = kind.dimension > 2;
    const double v = -volume, vy = y ? v : 0.0, vz = z ? v : 0.0;
    record->plain = (vector8){mass, mass * u[0], mass * u[1], mass * u[2], 0.0, 0.0, 0.0, 0.0};
    const double around = t->axisymmetric ? v * (s[2] - p) / t->position[i][0] : 0.0;
    record->around = (vector8){0.0, 0.0, 0.0, 0.0, around, 0.0, 0.0, 0.0};
    record->by_slope[0] = (vector8){0.0, 0.0, 0.0, 0.0, v * (s[0] - p), vy * s[3], vz * s[5], 0.0};
    if (y)
        record->by_slope[1] =
            (vector8){0.0, 0.0, 0.0, 0.0, v * s[3], v * (s[1] - p), vz * s[4], 0.0};
    if (z)
        record->by_slope[2] =
            (vector8){0.0, 0.0, 0.0, 0.0, v * s[5], v * s[4], v * (s[2] - p), 0.0};
}

/* Adds a particle's record to the nodes of a row along the last axis: those share all but that axis' factor. LEVEL goes
 * with the shape function along it, TILT with its slope. */
INLINE void add_row(const struct chunk *chunk, struct kind kind, int lane, const vector8 *level,
                    const vector8 *tilt, double *node)
{
    const int last = kind.dimension - 1;
    vector8 *at = (vector8 *)node;
    for (int c = 0; c < kind.window; c++)
        at[c] += chunk->value[last][c][lane] * *level + chunk->slope[last][c][lane] * *tilt;
}

INLINE void add_record(const struct transfer *t, struct kind kind, const struct chunk *chunk,
                       int lane, size_t base, const struct record *record, double *patch)
{
    if (kind.dimension == 1) {
        add_row(chunk, kind, lane, &record->plain, &record->by_slope[0],
                patch + base * NODE_STRIDE);
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
            vector8 level = value * record->plain + along_a * record->by_slope[0];
            if (kind.dimension > 2)
                level += along_b * record->by_slope[1];
            else if (t->axisymmetric)
                level += chunk->around[a][lane] * record->around;
            const vector8 tilt = value * record->by_slope[kind.dimension - 1];
            const size_t row = kind.dimension > 2 ? node_of(t, kind, base, a, b, 0)
                                                  : node_of(t, kind, base, a, 0, 0);
            add_row(chunk, kind, lane, &level, &tilt, patch + row * NODE_STRIDE);
        }
}

INLINE void scatter(const struct transfer *t, struct kind kind, int32_t bin)
{
    double *patch = grid_patch(t->grid, t->main, bin);
    memset(patch, 0, (size_t)(t->grid->patch * NODE_STRIDE) * sizeof *patch);
    const struct corner corner = corner_of(t, kind, bin);
    for (int cell = 0; cell < BLOCK_CELLS; cell++) {
        const struct cell_walk walk = cell_of(t, kind, &corner, bin, cell);
        struct chunk chunk;
        struct record record;
        for (int32_t begin = 0; begin < walk.count; begin += kind.lanes) {
            weigh(t, kind, &walk, begin, &chunk);
            for (int lane = 0; lane < chunk.count; lane++) {
                record_of(t, kind, chunk.index[lane], &record);
                add_record(t, kind, &chunk, lane, walk.base, &record, patch);
                if (!t->affine)
                    continue;
                FOR_NODES(kind, a, b, c)
                {
                    const double value = weight_of(kind, &chunk, lane, a, b, c).value;
                    double *node = patch + node_of(t, kind, walk.base, a, b, c) * NODE_STRIDE;
                    add_affine(t, kind, &chunk, lane, a, b, c, value * t->mass[chunk.index[lane]],
                               node + NODE_MOMENTUM);
                }
            }
        }
    }
}

INLINE void scatter_slopes(const struct transfer *t, struct kind kind, int32_t bin)
{
    double *patch = grid_patch(t->grid, t->normal, bin);
    memset(patch, 0, (size_t)(t->grid->patch * BACK_STRIDE) * sizeof *patch);
    const struct corner corner = corner_of(t, kind, bin);
    for (int cell = 0; cell < BLOCK_CELLS; cell++) {
        const struct cell_walk walk = cell_of(t, kind, &corner, bin, cell);
        struct chunk chunk;
        for (int32_t begin = 0; begin < walk.count; begin += kind.lanes) {
            weigh(t, kind, &walk, begin, &chunk);
            for (int lane = 0; lane < chunk.count; lane++)
                FOR_NODES(kind, a, b, c)
                {
                    const struct weight w = weight_of(kind, &chunk, lane, a, b, c);
                    double *node = patch + node_of(t, kind, walk.base, a, b, c) * BACK_STRIDE;
                    for (int k = 0; k < kind.dimension; k++)
                        node[k] += t->mass[chunk.index[lane]] * w.slope[k];
                }
        }
    }
}

/* For the lanes of a chunk: the sums over nodes of COUNT numbers at DATA, STRIDE a node. */
INLINE void gather(const struct transfer *t, struct kind kind, const struct chunk *chunk,
                   size_t base, const double *data, int stride, int count, double (*sum)[LANES])
{
    for (int k = 0; k < count; k++)
        for (int lane = 0; lane < kind.lanes; lane++)
            sum[k][lane] = 0.0;
    FOR_NODES(kind, a, b, c)
    {
        const double *node = data + node_of(t, kind, base, a, b, c) * (size_t)stride;
        ALIGNED double w[LANES];
        for (int lane = 0; lane < kind.lanes; lane++) {
            w[lane] = chunk->value[0][a][lane];
            if (kind.dimension > 1)
                w[lane] *= chunk->value[1][b][lane];
            if (kind.dimension > 2)
                w[lane] *= chunk->value[2][c][lane];
        }
        for (int k = 0; k < count; k++)
            for (int lane = 0; lane < kind.lanes; lane++)
                sum[k][lane] += w[lane] * node[k];
    }
}

/* The same of the sums with slopes: sum[i][j] is d data_i / d x_j. */
INLINE void gather_slopes(const struct transfer *t, struct kind kind, const struct chunk *chunk,
                          size_t base, const double *data, int stride, double (*sum)[3][LANES])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int lane = 0; lane < kind.lanes; lane++)
                sum[i][j][lane] = 0.0;
    FOR_NODES(kind, a, b, c)
    {
        const double *node = data + node_of(t, kind, base, a, b, c) * (size_t)stride;
        ALIGNED double slope[3][LANES];
        for (int lane = 0; lane < kind.lanes; lane++) {
            const struct weight w = weight_of(kind, chunk, lane, a, b, c);
            for (int j = 0; j < kind.dimension; j++)
                slope[j][lane] = w.slope[j];
        }
        for (int i = 0; i < kind.dimension; i++)
            for (int j = 0; j < kind.dimension; j++)
                for (int lane = 0; lane < kind.lanes; lane++)
                    sum[i][j][lane] += slope[j][lane] * node[i];
    }
}

/* The gradient that a particle carries on: by slopes, or by first moments over the second one of the shape function,
 * sum_I N u (x_I - x) / sum_I N (x_I - x)^2 (Jiang et al., ACM Trans. Graph. 34 (2015) 51). */
INLINE void keep_gradient(const struct transfer *t, struct kind kind, const struct chunk *chunk,
                          size_t base, const double *velocity)
{
    ALIGNED double sum[3][3][LANES];
    gather_slopes(t, kind, chunk, base, velocity, NODE_STRIDE, sum);
    if (t->by_moments && kind.window > 2) {
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                for (int lane = 0; lane < kind.lanes; lane++)
                    sum[i][j][lane] = 0.0;
        FOR_NODES(kind, a, b, c)
        {
            const int at[3] = {a, b, c};
            const double *node = velocity + node_of(t, kind, base, a, b, c) * NODE_STRIDE;
            for (int lane = 0; lane < kind.lanes; lane++) {
                const double w = weight_of(kind, chunk, lane, a, b, c).value;
                for (int i = 0; i < kind.dimension; i++)
                    for (int j = 0; j < kind.dimension; j++)
                        sum[i][j][lane] += w * node[i] * chunk->away[j][at[j]][lane];
            }
        }
        for (int lane = 0; lane < kind.lanes; lane++)
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

INLINE void velocity(const struct transfer *t, struct kind kind, int32_t bin, double dt,
                     bool scatter_back, bool move)
{
    const double *patch = grid_patch(t->grid, t->main, bin);
    double *back = scatter_back ? grid_patch(t->grid, t->back, bin) : NULL;
    const bool blend = t->flip < 1.0 || move;
    if (back)
        memset(back, 0, (size_t)(t->grid->patch * BACK_STRIDE) * sizeof *back);
    const struct corner corner = corner_of(t, kind, bin);
    for (int cell = 0; cell < BLOCK_CELLS; cell++) {
        const struct cell_walk walk = cell_of(t, kind, &corner, bin, cell);
        struct chunk chunk;
        ALIGNED double push[3][LANES], flow[3][LANES];
        for (int32_t begin = 0; begin < walk.count; begin += kind.lanes) {
            weigh(t, kind, &walk, begin, &chunk);
            gather(t, kind, &chunk, walk.base, patch + NODE_ACCELERATION, NODE_STRIDE,
                   kind.dimension, push);
            if (blend)
                gather(t, kind, &chunk, walk.base, patch + NODE_VELOCITY, NODE_STRIDE,
                       kind.dimension, flow);
            for (int lane = 0; lane < chunk.count; lane++) {
                double *u = t->velocity[chunk.index[lane]], *x = t->position[chunk.index[lane]];
                for (int k = 0; k < kind.dimension; k++) {
                    u[k] += dt * push[k][lane];
                    if (t->flip < 1.0)
                        u[k] = t->flip * u[k] + (1.0 - t->flip) * flow[k][lane];
                    if (move)
                        x[k] += dt * flow[k][lane];
                }
            }
            if (t->affine)
                keep_gradient(t, kind, &chunk, walk.base, patch + NODE_VELOCITY);
            for (int lane = 0; lane < chunk.count && back; lane++) {
                const double *u = t->velocity[chunk.index[lane]], mass = t->mass[chunk.index[lane]];
                const vector4 momentum = {mass * u[0], mass * u[1], mass * u[2], 0.0};
                FOR_NODES(kind, a, b, c)
                {
                    const double value = weight_of(kind, &chunk, lane, a, b, c).value;
                    double *node = back + node_of(t, kind, walk.base, a, b, c) * BACK_STRIDE;
                    *(vector4 *)node += value * momentum;
                    if (t->affine)
                        add_affine(t, kind, &chunk, lane, a, b, c, mass * value, node);
                }
            }
        }
    }
}

/* The radial velocity of the lanes of a chunk as the hoop strain sees it. */
INLINE void gather_around(const struct transfer *t, struct kind kind, const struct chunk *chunk,
                          size_t base, const double *velocity, int stride, double *sum)
{
    for (int lane = 0; lane < kind.lanes; lane++)
        sum[lane] = 0.0;
    for (int a = 0; a < kind.window; a++)
        for (int b = 0; b < kind.window; b++) {
            const double *node = velocity + node_of(t, kind, base, a, b, 0) * (size_t)stride;
            for (int lane = 0; lane < kind.lanes; lane++)
                sum[lane] += chunk->around[a][lane] * chunk->value[1][b][lane] * node[0];
        }
}

INLINE void gradient(const struct transfer *t, struct kind kind, int32_t bin, double dt,
                     const double *of, int stride, bool move, double *rate)
{
    const bool round = kind.dimension == 2 && t->axisymmetric;
    const double *patch = grid_patch(t->grid, t->main, bin);
    const struct corner corner = corner_of(t, kind, bin);
    for (int cell = 0; cell < BLOCK_CELLS; cell++) {
        const struct cell_walk walk = cell_of(t, kind, &corner, bin, cell);
        struct chunk chunk;
        ALIGNED double sum[3][3][LANES], flow[3][LANES], around[LANES];
        for (int32_t begin = 0; begin < walk.count; begin += kind.lanes) {
            weigh(t, kind, &walk, begin, &chunk);
            gather_slopes(t, kind, &chunk, walk.base, of, stride, sum);
            if (round)
                gather_around(t, kind, &chunk, walk.base, of, stride, around);
            if (move)
                gather(t, kind, &chunk, walk.base, patch + NODE_VELOCITY, NODE_STRIDE,
                       kind.dimension, flow);
            for (int lane = 0; lane < chunk.count; lane++, rate += RATE_STRIDE) {
                double *x = t->position[chunk.index[lane]];
                rate[0] = sum[0][0][lane];
                rate[1] = sum[1][1][lane];
                rate[2] = round ? around[lane] / x[0] : sum[2][2][lane];
                rate[3] = 0.5 * (sum[0][1][lane] + sum[1][0][lane]);
                rate[4] = 0.5 * (sum[1][2][lane] + sum[2][1][lane]);
                rate[5] = 0.5 * (sum[2][0][lane] + sum[0][2][lane]);
                rate[RATE_SPIN] = 0.5 * (sum[2][1][lane] - sum[1][2][lane]);
                rate[RATE_SPIN + 1] = 0.5 * (sum[0][2][lane] - sum[2][0][lane]);
                rate[RATE_SPIN + 2] = 0.5 * (sum[1][0][lane] - sum[0][1][lane]);
                for (int k = 0; k < kind.dimension && move; k++)
                    x[k] += dt * flow[k][lane];
            }
        }
    }
}

/* One switch a block: in each branch dimension and window are constants. */
#define BY_KIND(t, CALL)                                         \
    switch ((t)->dimension * 2 + ((t)->shape != SHAPE_LINEAR)) { \
    case 2:                                                      \
        CALL(1, 2);                                              \
        break;                                                   \
    case 3:                                                      \
        CALL(1, 4);                                              \
        break;                                                   \
    case 4:                                                      \
        CALL(2, 2);                                              \
        break;                                                   \
    case 5:                                                      \
        CALL(2, 4);                                              \
        break;                                                   \
    case 6:                                                      \
        CALL(3, 2);                                              \
        break;                                                   \
    default:                                                     \
        CALL(3, 4);                                              \
    }

void NAMED(transfer_scatter)(const struct transfer *t, int32_t bin);
void NAMED(transfer_slopes)(const struct transfer *t, int32_t bin);
void NAMED(transfer_velocity)(const struct transfer *t, int32_t bin, double dt, bool scatter_back,
                              bool move);
void NAMED(transfer_gradient)(const struct transfer *t, int32_t bin, double dt, const double *of,
                              int stride, bool move, double *rate);

void NAMED(transfer_scatter)(const struct transfer *t, int32_t bin)
{
#define CALL(dimension, window) scatter(t, (struct kind){dimension, window, 1 << dimension}, bin)
    BY_KIND(t, CALL)
#undef CALL
}

void NAMED(transfer_slopes)(const struct transfer *t, int32_t bin)
{
#define CALL(dimension, window) \
    scatter_slopes(t, (struct kind){dimension, window, 1 << dimension}, bin)
    BY_KIND(t, CALL)
#undef CALL
}

void NAMED(transfer_velocity)(const struct transfer *t, int32_t bin, double dt, bool scatter_back,
                              bool move)
{
#define CALL(dimension, window) \
    velocity(t, (struct kind){dimension, window, 1 << dimension}, bin, dt, scatter_back, move)
    BY_KIND(t, CALL)
#undef CALL
}

void NAMED(transfer_gradient)(const struct transfer *t, int32_t bin, double dt, const double *of,
                              int stride, bool move, double *rate)
{
#define CALL(dimension, window) \
    gradient(t, (struct kind){dimension, window, 1 << dimension}, bin, dt, of, stride, move, rate)
    BY_KIND(t, CALL)
#undef CALL
}
