/* The loops of the step limit by nodes (limit.c) over the particles of a block. For the file that
 * is compiled once an instruction set (transfer_kernel.h). */
#ifndef BOLIDE_MPM_TRANSFER_SPEED_H
#define BOLIDE_MPM_TRANSFER_SPEED_H

#include "mpm/transfer_body.h"

BOLIDE_INLINE void bin_stiffness(const struct transfer *t, struct kind kind, int32_t bin)
{
    double *patch = grid_patch(t->grid, t->back, bin);
    memset(patch, 0, (size_t)(t->grid->patch * BACK_STRIDE) * sizeof *patch);
    const struct corner corner = corner_of(t, kind, bin);
    for (int cell = 0; cell < BLOCK_CELLS; cell++) {
        const struct cell_walk walk = cell_of(t, kind, &corner, bin, cell);
        struct chunk chunk;
        ALIGNED double weight[NODES_MAX][LANES];
        vector4 sum[NODES_MAX], record[LANES];
        if (walk.count == 0)
            continue;
        vector4_clear(sum, nodes_of(kind));
        for (int32_t begin = 0; begin < walk.count; begin += kind.lanes) {
            weigh(t, kind, &walk, begin, &chunk);
            find_weights(kind, &chunk, weight);
            for (int lane = 0; lane < kind.lanes; lane++) {
                const int32_t i = chunk.index[lane];
                const double mass = lane < chunk.count ? t->mass[i] : 0.0;
                const vector4 of = {mass * square(t->sound[i]), mass * t->courant[t->material[i]],
                                    mass, 0.0};
                record[lane] = of;
            }
            add_records4(kind, nodes_of(kind), weight, record, sum);
        }
        add_sums4(t, kind, walk.base, sum, patch);
    }
}

BOLIDE_INLINE void bin_speed(const struct transfer *t, struct kind kind, int32_t bin, double *sound)
{
    double *patch = grid_patch(t->grid, t->back, bin);
    const struct corner corner = corner_of(t, kind, bin);
    for (int n = 0; n < t->grid->patch; n++) {
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
                const double of = numbers_at(t, kind, nodes, a, b, c)[SPEED_SOUND];
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
