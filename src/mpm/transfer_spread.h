/* The loops of damage that spreads (spread.c) over the particles of a block. For the file that is
 * compiled once an instruction set (transfer_kernel.h). */
#ifndef BOLIDE_MPM_TRANSFER_SPREAD_H
#define BOLIDE_MPM_TRANSFER_SPREAD_H

#include "mpm/transfer_records.h"

/* m D and m of particle I, where its damage spreads. */
BOLIDE_INLINE vector4 damage_record(const struct transfer *t, int32_t i, double mass)
{
    const double own = t->spreads[t->material[i]] ? mass : 0.0;
    const vector4 of = {own * t->damage[i], own, 0.0, 0.0};
    return of;
}

BOLIDE_INLINE void bin_damage(const struct transfer *t, struct kind kind, int32_t bin)
{
    bin_records(t, kind, bin, damage_record);
}

/* Lane LANE of a chunk: sum grad N (D_I - D), over nodes that have a damage. */
BOLIDE_INLINE double damage_gradient(struct kind kind, const struct chunk *chunk, int lane,
                                     struct window nodes, double damage)
{
    double sum[3] = {0.0, 0.0, 0.0};
    FOR_NODES (kind, a, b, c) {
        const double *node = numbers_at(kind, nodes, a, b, c);
        const struct weight w = weight_of(kind, chunk, lane, a, b, c);
        const double rise = node[SPREAD_MASS] > 0.0 ? node[SPREAD_DAMAGE] - damage : 0.0;
        for (int k = 0; k < kind.dimension; k++)
            sum[k] += w.slope[k] * rise;
    }
    return sqrt(square(sum[0]) + square(sum[1]) + square(sum[2]));
}

BOLIDE_INLINE void bin_spread(const struct transfer *t, struct kind kind, int32_t bin)
{
    double *patch = grid_patch(t->grid, t->back, bin);
    const struct corner corner = corner_of(t, kind, bin);
    for (int n = 0; n < patch_of(kind); n++) {
        double *node = patch + n * BACK_STRIDE;
        node[SPREAD_DAMAGE] =
            node[SPREAD_MASS] > 0.0 ? node[SPREAD_DAMAGE] / node[SPREAD_MASS] : 0.0;
    }
    for (int cell = 0; cell < BLOCK_CELLS; cell++) {
        const struct cell_walk walk = cell_of(t, kind, &corner, bin, cell);
        const struct window nodes = window_of(patch, BACK_STRIDE, walk.base);
        struct chunk chunk;
        for (int32_t begin = 0; begin < walk.count; begin += kind.lanes) {
            weigh(t, kind, &walk, begin, &chunk);
            for (int lane = 0; lane < chunk.count; lane++) {
                const int32_t i = chunk.index[lane];
                t->damage_gradient[i] =
                    t->spreads[t->material[i]]
                        ? damage_gradient(kind, &chunk, lane, nodes, t->damage[i])
                        : 0.0;
            }
        }
    }
}

#endif
