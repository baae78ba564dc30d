/* Sums of a few numbers a particle at nodes, for heat and for the limit of the step. For the file
 * that is compiled once an instruction set (transfer_kernel.h). */
#ifndef BOLIDE_MPM_TRANSFER_RECORDS_H
#define BOLIDE_MPM_TRANSFER_RECORDS_H

#include "mpm/transfer_body.h"

/* Sums four numbers a particle at the nodes of a block, by weight: RECORD_OF particle I, whose MASS
 * is zero where it only fills up lanes. */
BOLIDE_INLINE void bin_records(const struct transfer *t, struct kind kind, int32_t bin,
                               vector4 (*record_of)(const struct transfer *, int32_t, double))
{
    double *patch = grid_patch(t->grid, t->back, bin);
    memset(patch, 0, (size_t)(patch_of(kind) * BACK_STRIDE) * sizeof *patch);
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
                record[lane] = record_of(t, i, lane < chunk.count ? t->mass[i] : 0.0);
            }
            add_records4(kind, nodes_of(kind), weight, record, sum);
        }
        add_sums4(kind, walk.base, sum, patch);
    }
}

#endif
