/* The loops of the balance of pressures (balance.c) over the particles of a block. For the file
 * that is compiled once an instruction set (transfer_kernel.h). */
#ifndef BOLIDE_MPM_TRANSFER_BALANCE_H
#define BOLIDE_MPM_TRANSFER_BALANCE_H

#include "mpm/transfer_records.h"

/* By what volume particle I of MASS would give way in the step to a unit of pressure, m^3/Pa. */
BOLIDE_INLINE double compliance_of(const struct transfer *t, int32_t i, double mass)
{
    const double sound = t->sound[i], density = t->density[i];
    const double part = minimum(1.0, t->mixing * sound * t->balance_dt / t->edge);
    return t->balances[t->material[i]]
               ? part * mass / density / (density * square(sound) + 2.0 * t->largest_pressure)
               : 0.0;
}

BOLIDE_INLINE vector4 compliance_record(const struct transfer *t, int32_t i, double mass)
{
    const double s = compliance_of(t, i, mass), number = (double)t->material[i];
    const vector4 of = {s * t->pressure[i], s, s * number, s * square(number)};
    return of;
}

BOLIDE_INLINE void bin_compliance(const struct transfer *t, struct kind kind, int32_t bin)
{
    bin_records(t, kind, bin, compliance_record);
}

/* Turns the sums of a node into the mean of the pressure and whether it has several materials. */
BOLIDE_INLINE void settle_balance(double *node)
{
    const double sum = node[BALANCE_SUM], per_sum = sum > 0.0 ? 1.0 / sum : 0.0,
                 mean = node[BALANCE_NUMBER] * per_sum,
                 spread = node[BALANCE_SQUARE] * per_sum - square(mean);
    node[BALANCE_PRESSURE] *= per_sum;
    node[BALANCE_SUM] = spread > 1e-6 ? 1.0 : 0.0;
}

/* By what VOLUME per compliance the lanes of a chunk give way, and what WORK they do by that. */
BOLIDE_INLINE void gather_balance(const struct transfer *t, struct kind kind,
                                  const struct chunk *chunk, struct window nodes, double *volume,
                                  double *work)
{
    ALIGNED double weight[NODES_MAX][LANES], pressure[LANES] = {0.0};
    const double(*w)[LANES] = weight;
    find_weights(kind, chunk, weight);
    FOR_LANES (kind, lane) {
        pressure[lane] = t->pressure[chunk->index[lane]];
        volume[lane] = work[lane] = 0.0;
    }
    FOR_NODES (kind, a, b, c) {
        const double *node = numbers_at(kind, nodes, a, b, c);
        for (int lane = 0; lane < kind.lanes && node[BALANCE_SUM] > 0.0; lane++) {
            const double excess = (*w)[lane] * (pressure[lane] - node[BALANCE_PRESSURE]);
            volume[lane] += excess;
            work[lane] += excess * node[BALANCE_PRESSURE];
        }
        w++;
    }
}

BOLIDE_INLINE void bin_balance(const struct transfer *t, struct kind kind, int32_t bin)
{
    double *patch = grid_patch(t->grid, t->back, bin);
    const struct corner corner = corner_of(t, kind, bin);
    bool any = false;
    for (int n = 0; n < patch_of(kind); n++) {
        settle_balance(patch + n * BACK_STRIDE);
        any |= patch[n * BACK_STRIDE + BALANCE_SUM] > 0.0;
    }
    for (int cell = 0; cell < BLOCK_CELLS && any; cell++) {
        const struct cell_walk walk = cell_of(t, kind, &corner, bin, cell);
        const struct window nodes = window_of(patch, BACK_STRIDE, walk.base);
        struct chunk chunk;
        ALIGNED double volume[LANES], work[LANES];
        for (int32_t begin = 0; begin < walk.count; begin += kind.lanes) {
            weigh(t, kind, &walk, begin, &chunk);
            gather_balance(t, kind, &chunk, nodes, volume, work);
            for (int lane = 0; lane < chunk.count; lane++) {
                const int32_t i = chunk.index[lane];
                const double s = compliance_of(t, i, t->mass[i]);
                t->given[i][0] = s * volume[lane];
                t->given[i][1] = -s * work[lane];
            }
        }
    }
}

#endif
