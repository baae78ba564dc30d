/* Damage that spreads through a material: nodes get the mean damage of their particles, D_I = sum N
 * m D/sum N m, and particles the gradient sum grad N (D_I - D), over the nodes with a damage. */
#include <math.h>

#include "material/material.h"
#include "mpm/mpm_internal.h"

bool mpm_any_spreads(const struct simulation *simulation)
{
    bool any = false;
    for (int m = 0; m < simulation->problem->materials; m++)
        any |= strength_spreads(&simulation->problem->material[m].strength);
    return any;
}

double mpm_spread_step(const struct mpm *mpm, const struct simulation *simulation)
{
    double least = INFINITY;
    for (int b = 0; b < simulation->problem->input->bodies.count && mpm->spreads; b++)
        least = minimum(
            least, strength_spread_step(&body_material(simulation->problem->input, b)->strength,
                                        2.0 * mpm->half_size[b] * mpm->edge));
    return least;
}

void mpm_find_spread(struct mpm *mpm, struct simulation *simulation)
{
    bool spreads[MATERIALS_MAX];
    if (!mpm->spreads)
        return;
    for (int m = 0; m < simulation->problem->materials; m++)
        spreads[m] = strength_spreads(&simulation->problem->material[m].strength);
    for (int g = 0; g < mpm->layers; g++) {
        struct layer *layer = &mpm->layer[g];
        struct transfer transfer = mpm_transfer_of(mpm, simulation, layer);
        transfer.spreads = spreads;
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
        for (int32_t b = 0; b < layer->bins.count; b++)
            if (!mpm_is_far(mpm, layer, b))
                transfer_damage(&transfer, b);
    }
    mpm_exchange(mpm, simulation, offsetof(struct layer, back));
    for (int g = 0; g < mpm->layers; g++) {
        struct layer *layer = &mpm->layer[g];
        struct transfer transfer = mpm_transfer_of(mpm, simulation, layer);
        transfer.spreads = spreads;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
        for (int32_t n = 0; n < layer->grid.blocks; n++)
            grid_reduce(&layer->grid, &layer->back, n);
        mpm_fold_heat(mpm, layer);
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
        for (int32_t b = 0; b < layer->bins.count; b++) {
            if (mpm_is_far(mpm, layer, b))
                continue;
            grid_spread(&layer->grid, &layer->back, b);
            transfer_spread(&transfer, b);
        }
    }
}
