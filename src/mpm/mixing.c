/* Mixing in shocks: what particles carry there and nodes do not have becomes heat.
 *
 * FLIP adds the accelerations of the nodes to the velocities of the particles, which keep the
 * rest. In a shock two cells wide that is a good fraction of the jump; it remains as noise,
 * compresses some particles far beyond the others, and does not decay next to a wall. So where
 * the artificial viscosity is large, particles move a fraction of the way to the velocity V =
 * sum N m u/sum N m of their nodes, and the kinetic energy that this takes heats them:
 *
 *   w = sum N a (V - u);   u' = u + w;   e' = e + sum N a (V - u)^2 - w^2/2
 *
 * Momentum is conserved; so is energy, because sum m u.w = -sum m N a (V - u)^2, and no particle
 * cools. Energies of the particles of one material are mixed too, e' = e + sum N b (E - e), E =
 * sum N m e/sum N m: nothing else smooths a mode that nodes do not see, one particle hot and the
 * next cold, or the heat that an impact leaves at a wall. At a node of several materials b = 0.
 * b is dt times the mean rate of the node's particles (mixing_rate of transfer_body.h), at most
 * 1, and a = b/10. Walls act as on all nodal sums. */
#include "base/memory.h"
#include "mpm/mpm_internal.h"

bool mpm_find_shocks(const struct mpm *mpm, const struct simulation *simulation,
                     struct layer *layer)
{
    bool any = false;
    if (!(mpm->parameters.shock_mixing > 0.0) || layer->held)
        return false;
#pragma omp parallel for schedule(static) num_threads(simulation->threads) reduction(| : any)
    for (int32_t n = 0; n < layer->grid.blocks; n++) {
        bool found = false;
        for (int k = 0; k < BLOCK_CELLS; k++)
            found |= grid_node(&layer->main, n, k)[NODE_MIXING] > 0.0;
        layer->shocked[n] = found;
        any |= found;
    }
    return any;
}

/* Whether any of the blocks that the patch of a bin covers contains a shock. */
static bool bin_is_shocked(const struct layer *layer, int32_t bin)
{
    bool shocked = false;
    for (int code = 0; code < GRID_AROUND; code++) {
        const int32_t block = layer->grid.around[bin][code];
        shocked |= block >= 0 && layer->shocked[block];
    }
    return shocked;
}

/* Walls push: their images contribute to the velocity of a node, so what its particles gain does
 * not cancel. Of the gain the fraction `flip` is kept. */
static void book_walls(const struct mpm *mpm, struct simulation *simulation,
                       const struct layer *layer, double dt)
{
    for (int32_t w = 0; w < layer->walls; w++) {
        const struct wall_node *wall = &layer->wall[w];
        const double *sum = wall->sum, *node = wall->node, mass = node[NODE_MASS];
        const double part =
            mpm->parameters.flip * mixing_of_velocity(dt * node[NODE_MIXING] / mass);
        double push[3];
        for (int k = 0; k < 3; k++)
            push[k] =
                part * (sum[NODE_MASS] * node[NODE_MOMENTUM + k] / mass - sum[NODE_MOMENTUM + k]);
        if (wall->booked && part > 0.0)
            mpm_book_wall(mpm, simulation, wall, push);
    }
}

static void sum_heat(struct mpm *mpm, const struct simulation *simulation, struct layer *layer)
{
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        if (layer->shocked[n])
            grid_reduce(&layer->grid, &layer->back, n);
    mpm_fold_heat(mpm, layer);
}

void mpm_mix_shocks(struct mpm *mpm, struct simulation *simulation, double dt)
{
    if (!mpm->shocks)
        return;
    for (int g = 0; g < mpm->layers; g++) {
        struct layer *layer = &mpm->layer[g];
        const struct transfer transfer = mpm_transfer_of(mpm, simulation, layer);
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
        for (int32_t b = 0; b < layer->bins.count; b++)
            if (!layer->held && !mpm_is_far(mpm, layer, b) && bin_is_shocked(layer, b))
                transfer_heat(&transfer, b);
    }
    mpm_exchange(mpm, simulation, offsetof(struct layer, back));
    for (int g = 0; g < mpm->layers; g++) {
        struct layer *layer = &mpm->layer[g];
        const struct transfer transfer = mpm_transfer_of(mpm, simulation, layer);
        if (layer->held)
            continue;
        sum_heat(mpm, simulation, layer);
        book_walls(mpm, simulation, layer, dt);
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
        for (int32_t b = 0; b < layer->bins.count; b++) {
            if (mpm_is_far(mpm, layer, b) || !bin_is_shocked(layer, b))
                continue;
            grid_spread(&layer->grid, &layer->main, b);
            grid_spread(&layer->grid, &layer->back, b);
            transfer_mix(&transfer, b, dt);
        }
    }
}
