/* The loops of mixing in shocks (mixing.c), and of heat, over the particles of a block. For the
 * file that is compiled once an instruction set (transfer_kernel.h). */
#ifndef BOLIDE_MPM_TRANSFER_MIXING_H
#define BOLIDE_MPM_TRANSFER_MIXING_H

#include "mpm/transfer_records.h"

/* The energy of particle I with the heat that its products have set free: as energies count from
 * the explosive at rest, products are that much below it at the same temperature. */
BOLIDE_INLINE double heat_of(const struct transfer *t, int32_t i)
{
    return t->burnt ? t->energy[i] + t->burnt[i] * t->reaction[t->material[i]] : t->energy[i];
}

/* m e, m n and m n^2 of particle I, n the number of its material. */
BOLIDE_INLINE vector4 heat_record(const struct transfer *t, int32_t i, double mass)
{
    const double number = (double)t->material[i];
    const vector4 of = {mass * heat_of(t, i), mass * number, mass * square(number), 0.0};
    return of;
}

BOLIDE_INLINE void bin_heat(const struct transfer *t, struct kind kind, int32_t bin)
{
    bin_records(t, kind, bin, heat_record);
}

/* Turns the sums of a node into what particles take from it in a step of DT: its energy, and in
 * HEAT_NUMBER the fraction b, 0 where the node has several materials (mixing.c). */
BOLIDE_INLINE void settle_node(const double *node, double *heat, double dt)
{
    const double per_mass = 1.0 / node[NODE_MASS], part = dt * node[NODE_MIXING] * per_mass;
    const double mean = heat[HEAT_NUMBER] * per_mass,
                 spread = heat[HEAT_SQUARE] * per_mass - square(mean);
    heat[HEAT_ENERGY] *= per_mass;
    heat[HEAT_NUMBER] = fabs(spread) < 1e-6 ? minimum(1.0, part) : 0.0;
}

/* What the energies of the lanes of a chunk change by. */
BOLIDE_INLINE void gather_heat(const struct transfer *t, struct kind kind,
                               const struct chunk *chunk, struct window nodes, struct window heats,
                               double *gain)
{
    ALIGNED double weight[NODES_MAX][LANES], energy[LANES] = {0.0};
    const double(*w)[LANES] = weight;
    find_weights(kind, chunk, weight);
    FOR_LANES (kind, lane) {
        energy[lane] = heat_of(t, chunk->index[lane]);
        gain[lane] = 0.0;
    }
    FOR_NODES (kind, a, b, c) {
        const double *node = numbers_at(kind, nodes, a, b, c),
                     *heat = numbers_at(kind, heats, a, b, c);
        for (int lane = 0; lane < kind.lanes && node[NODE_MIXING] > 0.0; lane++)
            gain[lane] += (*w)[lane] * heat[HEAT_NUMBER] * (heat[HEAT_ENERGY] - energy[lane]);
        w++;
    }
}

BOLIDE_INLINE void bin_mix(const struct transfer *t, struct kind kind, int32_t bin, double dt)
{
    double *patch = grid_patch(t->grid, t->main, bin), *heat = grid_patch(t->grid, t->back, bin);
    const struct corner corner = corner_of(t, kind, bin);
    for (int n = 0; n < patch_of(kind); n++)
        if (patch[n * NODE_STRIDE + NODE_MIXING] > 0.0)
            settle_node(patch + n * NODE_STRIDE, heat + n * BACK_STRIDE, dt);
    for (int cell = 0; cell < BLOCK_CELLS; cell++) {
        const struct cell_walk walk = cell_of(t, kind, &corner, bin, cell);
        const struct window nodes = window_of(patch, NODE_STRIDE, walk.base),
                            heats = window_of(heat, BACK_STRIDE, walk.base);
        struct chunk chunk;
        ALIGNED double gain[LANES];
        if (walk.count == 0 || !window_mixes(kind, nodes))
            continue;
        for (int32_t begin = 0; begin < walk.count; begin += kind.lanes) {
            weigh(t, kind, &walk, begin, &chunk);
            gather_heat(t, kind, &chunk, nodes, heats, gain);
            for (int lane = 0; lane < chunk.count; lane++)
                t->energy[chunk.index[lane]] += gain[lane];
        }
    }
}

BOLIDE_INLINE void bin_warm(const struct transfer *t, struct kind kind, int32_t bin)
{
    const double *patch = grid_patch(t->grid, t->back, bin);
    const struct corner corner = corner_of(t, kind, bin);
    for (int cell = 0; cell < BLOCK_CELLS; cell++) {
        const struct cell_walk walk = cell_of(t, kind, &corner, bin, cell);
        struct chunk chunk;
        ALIGNED double heat[1][LANES], weight[NODES_MAX][LANES];
        for (int32_t begin = 0; begin < walk.count; begin += kind.lanes) {
            weigh(t, kind, &walk, begin, &chunk);
            find_weights(kind, &chunk, weight);
            gather(kind, weight, window_of(patch + BACK_HEAT, BACK_STRIDE, walk.base), 1, heat);
            for (int lane = 0; lane < chunk.count; lane++)
                t->energy[chunk.index[lane]] += heat[0][lane];
        }
    }
}

#endif
