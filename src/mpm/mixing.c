/* Mixing in shocks: what particles carry there and nodes do not have becomes heat.
 *
 * FLIP adds the accelerations of the nodes to the velocities of the particles, which keep the rest.
 * In a shock two cells wide that is a good fraction of the jump; it remains as noise, compresses
 * some particles far beyond the others, and does not decay next to a wall. So where the artificial
 * viscosity is large, particles move a fraction of the way to the velocity V = sum N m u/sum N m of
 * their nodes, and the kinetic energy that this takes heats them:
 *
 *   w = sum N a (V - u);   u' = u + w;   e' = e + sum N a (V - u)^2 - w^2/2
 *
 * Momentum is conserved; so is energy, because sum m u.w = -sum m N a (V - u)^2, and no particle
 * cools. It is part of the step of velocities (transfer_body.h), whose forces work with V and not
 * with u', so that e loses w.dv as well, dv what the forces add. Energies of the particles of one
 * material are mixed too, e' = e + sum N b (E - e), E = sum N m e/sum N m: nothing else smooths a
 * mode that nodes do not see, one particle hot and the next cold, or the heat that an impact leaves
 * at a wall. Those of products count with the heat that burning has freed, else what has not burnt
 * yet would become colder than the explosive can be. At a node of several materials b = 0. b is dt
 * times the mean rate of the node's particles (mixing_rate of transfer_scatter.h), at most 1, and
 * a = 2b/3. Walls act as on all nodal sums. */
#include "base/memory.h"
#include "mpm/mpm_internal.h"

bool mpm_find_shocks(const struct mpm *mpm, const struct simulation *simulation,
                     struct layer *layer)
{
    bool any = false;
    if (!(mpm->parameters.shock_mixing > 0.0) || layer->prescribed)
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
            if (!layer->prescribed && !mpm_is_far(mpm, layer, b) &&
                mpm_covers(layer, b, layer->shocked))
                transfer_heat(&transfer, b);
    }
    mpm_exchange(mpm, simulation, offsetof(struct layer, back));
    for (int g = 0; g < mpm->layers; g++) {
        struct layer *layer = &mpm->layer[g];
        const struct transfer transfer = mpm_transfer_of(mpm, simulation, layer);
        if (layer->prescribed)
            continue;
        sum_heat(mpm, simulation, layer);
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
        for (int32_t b = 0; b < layer->bins.count; b++) {
            if (mpm_is_far(mpm, layer, b) || !mpm_covers(layer, b, layer->shocked))
                continue;
            grid_spread(&layer->grid, &layer->main, b);
            grid_spread(&layer->grid, &layer->back, b);
            transfer_mix(&transfer, b, dt);
        }
    }
}
