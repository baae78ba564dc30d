/* Balance of pressures where several materials share nodes.
 *
 * Nodes have one velocity, so particles of two materials at one node get strains between those of
 * both: one is compressed too far and the other too little. The sum of their volumes is right.
 * Their pressures, which should be equal in fluids, can differ by half for good. So particles
 * exchange volume at the nodes that they share, and those of higher pressure do work on the others:
 *
 *   P = sum N s p/sum N s;   V' = V + s sum N (p - P);   e' = e - s/m sum N P (p - P)
 *
 * s is the compliance V/(rho c^2 + 2 p_max) times `shock_mixing` c dt/h, at most 1; p_max, the
 * largest pressure anywhere, keeps the change of a soft particle beside a stiff one below half its
 * volume. Volume and energy are conserved at each node. Only liquids, explosives and their products
 * take part: the pressures of solids may differ by their strength, and an ideal gas is so soft that
 * it gives way anyway. Walls act as on all nodal sums. What particles are given is found with the
 * sums of the nodes, and taken when the forces of their old stresses have done their work. */
#include "base/memory.h"
#include "material/material.h"
#include "mpm/mpm_internal.h"

bool mpm_balances(const struct material *material)
{
    return !material_has_strength(material) && isnan(eos_ratio_of_heats(&material->eos));
}

void mpm_note_mixtures(struct mpm *mpm, const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    for (int g = 0; g < mpm->layers && mpm->parameters.shock_mixing > 0.0; g++) {
        struct layer *layer = &mpm->layer[g];
        int first = -1;
        for (int b = 0; b < input->bodies.count; b++) {
            const int material = case_body(input, b)->material_index;
            if ((mpm->layer_of_body[b] != g && mpm->layer_at_rest[b] != g) ||
                !mpm->balances_of[material])
                continue;
            layer->balances |= first >= 0 && material != first && !layer->prescribed;
            first = material;
        }
    }
}

/* Collective: that of all particles, Pa. */
static double largest_pressure(const struct mpm *mpm, const struct simulation *simulation)
{
    const struct particles *p = mpm->particles;
    double most = 0.0;
#pragma omp parallel for schedule(static) num_threads(simulation->threads) reduction(max : most)
    for (int32_t i = 0; i < p->count; i++)
        most = maximum(most, fabs(p->pressure[i]));
    ranks_maximum_of(simulation->ranks, &most, 1);
    return most;
}

static void sum_compliance(const struct mpm *mpm, const struct simulation *simulation,
                           struct layer *layer, const struct transfer *transfer)
{
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
    for (int32_t b = 0; b < layer->bins.count; b++)
        if (!mpm_is_far(mpm, layer, b))
            transfer_compliance(transfer, b);
}

static void find_given(const struct mpm *mpm, const struct simulation *simulation,
                       struct layer *layer, const struct transfer *transfer)
{
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        grid_reduce(&layer->grid, &layer->back, n);
    mpm_fold_balance(mpm, layer);
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
    for (int32_t b = 0; b < layer->bins.count; b++)
        if (!mpm_is_far(mpm, layer, b)) {
            grid_spread(&layer->grid, &layer->back, b);
            transfer_balance(transfer, b);
        }
}

struct error *mpm_balance_pressures(struct mpm *mpm, struct simulation *simulation, double dt)
{
    const int32_t count = mpm->particles->count;
    mpm->balances = false;
    for (int g = 0; g < mpm->layers; g++)
        mpm->balances |= mpm->layer[g].balances;
    if (!mpm->balances)
        return NULL;
    TRY(ranks_agree(simulation->ranks, memory_reserve((void **)&mpm->given, &mpm->given_capacity,
                                                      count, 0, sizeof *mpm->given)
                                           ? NULL
                                           : out_of_memory_for("%d particles", count)));
    for (int32_t i = 0; i < count; i++)
        mpm->given[i][0] = mpm->given[i][1] = 0.0;
    const double most = largest_pressure(mpm, simulation);
    for (int pass = 0; pass < 2; pass++) {
        for (int g = 0; g < mpm->layers; g++) {
            struct layer *layer = &mpm->layer[g];
            struct transfer transfer = mpm_transfer_of(mpm, simulation, layer);
            transfer.balance_dt = dt;
            transfer.largest_pressure = most;
            transfer.given = mpm->given;
            if (layer->balances)
                (pass ? find_given : sum_compliance)(mpm, simulation, layer, &transfer);
        }
        if (!pass)
            mpm_exchange(mpm, simulation, offsetof(struct layer, back));
    }
    return NULL;
}

void mpm_take_given(const struct mpm *mpm, const struct simulation *simulation)
{
    const struct particles *p = mpm->particles;
    const struct mpm_fields fields = mpm_fields_of(mpm);
    if (!mpm->balances)
        return;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++) {
        const double volume = mpm->given[i][0], energy = mpm->given[i][1] / p->mass[i],
                     before = p->mass[i] / p->density[i];
        if (volume == 0.0)
            continue;
        p->pressure[i] -= p->density[i] * square(fields.sound_long[i]) * volume / before;
        p->density[i] = p->mass[i] / (before + volume);
        p->energy[i] += energy;
        if (fields.at_state)
            fields.at_state[i] += energy;
    }
}
