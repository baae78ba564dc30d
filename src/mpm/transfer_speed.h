/* The loops of the step limit by nodes (limit.c) over the particles of a block. For the file that
 * is compiled once an instruction set (transfer_kernel.h). */
#ifndef BOLIDE_MPM_TRANSFER_SPEED_H
#define BOLIDE_MPM_TRANSFER_SPEED_H

#include "mpm/transfer_records.h"

/* m c^2, m K and m of particle I. */
BOLIDE_INLINE vector4 speed_record(const struct transfer *t, int32_t i, double mass)
{
    const vector4 of = {mass * square(t->sound[i]), mass * t->courant[t->material[i]], mass, 0.0};
    return of;
}

BOLIDE_INLINE void bin_stiffness(const struct transfer *t, struct kind kind, int32_t bin)
{
    bin_records(t, kind, bin, speed_record);
}

BOLIDE_INLINE void bin_speed(const struct transfer *t, struct kind kind, int32_t bin, double *sound)
{
    double *patch = grid_patch(t->grid, t->back, bin);
    const struct corner corner = corner_of(t, kind, bin);
    for (int n = 0; n < patch_of(kind); n++) {
        double *node = patch + n * BACK_STRIDE;
        const double mass = node[SPEED_MASS], courant = node[SPEED_COURANT];
        node[SPEED_SOUND] = courant > 0.0 ? sqrt(node[SPEED_STIFFNESS] * mass) / courant : 0.0;
    }
    for (int cell = 0; cell < BLOCK_CELLS; cell++) {
        const struct cell_walk walk = cell_of(t, kind, &corner, bin, cell);
        const struct window nodes = window_of(patch, BACK_STRIDE, walk.base);
        struct chunk chunk;
        ALIGNED double weight[NODES_MAX][LANES], most[LANES];
        for (int32_t begin = 0; begin < walk.count; begin += kind.lanes) {
            const double(*w)[LANES] = weight;
            weigh(t, kind, &walk, begin, &chunk);
            find_weights(kind, &chunk, weight);
            FOR_LANES (kind, lane)
                most[lane] = 0.0;
            FOR_NODES (kind, a, b, c) {
                const double of = numbers_at(kind, nodes, a, b, c)[SPEED_SOUND];
                FOR_LANES (kind, lane)
                    most[lane] = (*w)[lane] > 0.0 ? maximum(most[lane], of) : most[lane];
                w++;
            }
            FOR_LANES (kind, lane)
                sound[lane] = most[lane];
            sound += chunk.count;
        }
    }
}

#endif
