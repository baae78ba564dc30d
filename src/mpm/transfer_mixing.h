/* The loops of mixing in shocks (mixing.c) over the particles of a block. For the file that is
 * compiled once an instruction set (transfer_kernel.c). */
#ifndef BOLIDE_MPM_TRANSFER_MIXING_H
#define BOLIDE_MPM_TRANSFER_MIXING_H

#include "mpm/transfer_body.h"

BOLIDE_INLINE void bin_heat(const struct transfer *t, struct kind kind, int32_t bin)
{
    double *patch = grid_patch(t->grid, t->back, bin);
    memset(patch, 0, (size_t)(t->grid->patch * BACK_STRIDE) * sizeof *patch);
    const struct corner corner = corner_of(t, kind, bin);
    for (int cell = 0; cell < BLOCK_CELLS; cell++) {
        const struct cell_walk walk = cell_of(t, kind, &corner, bin, cell);
        struct chunk chunk;
        ALIGNED double weight[NODES_MAX][LANES];
        vector4 sum[NODES_MAX];
        if (walk.count == 0)
            continue;
        vector4_clear(sum, nodes_of(kind));
        for (int32_t begin = 0; begin < walk.count; begin += kind.lanes) {
            weigh(t, kind, &walk, begin, &chunk);
            find_weights(kind, &chunk, weight);
            for (int lane = 0; lane < chunk.count; lane++) {
                const int32_t i = chunk.index[lane];
                const double mass = t->mass[i], number = (double)t->material[i];
                const vector4 record = {mass * t->energy[i], mass * number, mass * square(number),
                                        0.0};
                for (int n = 0; n < nodes_of(kind); n++)
                    sum[n] += weight[n][lane] * record;
            }
        }
        add_sums(t, kind, walk.base, sum, BACK_STRIDE, patch);
    }
}

/* Turns the sums of a node into what particles take from it in a step of DT: its velocity and
 * energy, in NODE_MIXING the fraction a and in HEAT_NUMBER the fraction b, 0 where the node has
 * several materials (mixing.c). */
BOLIDE_INLINE void settle_node(double *node, double *heat, double dt)
{
    const double per_mass = 1.0 / node[NODE_MASS], part = dt * node[NODE_MIXING] * per_mass;
    const double mean = heat[HEAT_NUMBER] * per_mass,
                 spread = heat[HEAT_SQUARE] * per_mass - square(mean);
    for (int k = 0; k < 3; k++)
        node[NODE_VELOCITY + k] *= per_mass;
    node[NODE_MIXING] = mixing_of_velocity(part);
    heat[HEAT_ENERGY] *= per_mass;
    heat[HEAT_NUMBER] = fabs(spread) < 1e-6 ? minimum(1.0, part) : 0.0;
}

/* Whether any node of a window mixes. */
BOLIDE_INLINE bool window_mixes(const struct transfer *t, struct kind kind, struct window nodes)
{
    bool mixes = false;
    FOR_NODES(kind, a, b, c)
    mixes |= numbers_at(t, kind, nodes, a, b, c)[NODE_MIXING] > 0.0;
    return mixes;
}

/* What the lanes of a chunk change by: velocity, and energy. */
BOLIDE_INLINE void gather_mixed(const struct transfer *t, struct kind kind,
                                const struct chunk *chunk, struct window nodes, struct window heats,
                                double (*change)[LANES], double *gain)
{
    ALIGNED double weight[NODES_MAX][LANES], energy[LANES], velocity[3][LANES];
    const double(*w)[LANES] = weight;
    find_weights(kind, chunk, weight);
    for (int lane = 0; lane < kind.lanes; lane++) {
        energy[lane] = t->energy[chunk->index[lane]];
        gain[lane] = 0.0;
        for (int k = 0; k < kind.dimension; k++) {
            velocity[k][lane] = t->velocity[chunk->index[lane]][k];
            change[k][lane] = 0.0;
        }
    }
    FOR_NODES(kind, a, b, c)
    {
        const double *node = numbers_at(t, kind, nodes, a, b, c),
                     *heat = numbers_at(t, kind, heats, a, b, c);
        for (int lane = 0; lane < kind.lanes && node[NODE_MIXING] > 0.0; lane++) {
            const double part = (*w)[lane] * node[NODE_MIXING];
            for (int k = 0; k < kind.dimension; k++) {
                const double off = node[NODE_VELOCITY + k] - velocity[k][lane];
                change[k][lane] += part * off;
                gain[lane] += part * square(off);
            }
            gain[lane] += (*w)[lane] * heat[HEAT_NUMBER] * (heat[HEAT_ENERGY] - energy[lane]);
        }
        w++;
    }
    for (int lane = 0; lane < kind.lanes; lane++)
        for (int k = 0; k < kind.dimension; k++)
            gain[lane] -= 0.5 * square(change[k][lane]);
}

BOLIDE_INLINE void bin_mix(const struct transfer *t, struct kind kind, int32_t bin, double dt)
{
    double *patch = grid_patch(t->grid, t->main, bin), *heat = grid_patch(t->grid, t->back, bin);
    const struct corner corner = corner_of(t, kind, bin);
    for (int n = 0; n < t->grid->patch; n++)
        if (patch[n * NODE_STRIDE + NODE_MIXING] > 0.0)
            settle_node(patch + n * NODE_STRIDE, heat + n * BACK_STRIDE, dt);
    for (int cell = 0; cell < BLOCK_CELLS; cell++) {
        const struct cell_walk walk = cell_of(t, kind, &corner, bin, cell);
        const struct window nodes = window_of(patch, NODE_STRIDE, walk.base),
                            heats = window_of(heat, BACK_STRIDE, walk.base);
        struct chunk chunk;
        ALIGNED double change[3][LANES], gain[LANES];
        if (walk.count == 0 || !window_mixes(t, kind, nodes))
            continue;
        for (int32_t begin = 0; begin < walk.count; begin += kind.lanes) {
            weigh(t, kind, &walk, begin, &chunk);
            gather_mixed(t, kind, &chunk, nodes, heats, change, gain);
            for (int lane = 0; lane < chunk.count; lane++) {
                const int32_t i = chunk.index[lane];
                for (int k = 0; k < kind.dimension; k++)
                    t->velocity[i][k] += change[k][lane];
                t->energy[i] += gain[lane];
            }
        }
    }
}

#endif
