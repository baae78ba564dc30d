/* The largest step: dt = min h/(c/K + max |u_i|/K), over all particles.
 *
 * c is the speed of sound of the particle and K the Courant number of the case. By nodes c/K is the
 * largest of the nodes that the particle reaches: c^2 = sum N m c^2/sum N m, K = sum N m K/sum N m,
 * with another K of solids than of fluids. A node is moved by the stiffness of all its particles
 * together and has the mass of all. Where gas comes in as particles, one of next to no mass may be
 * very hot; alone it would set the step. */
#include <omp.h>

#include "mpm/mpm_internal.h"

/* What may limit the step. */
enum { LIMIT_SOUND, LIMIT_VELOCITY };
static const char *const limit_reasons[] = {"sound speed", "velocity"};

/* *FIRST becomes the limit of particle I for SOUND as its speed and COURANT as K, if that comes
 * before. */
static void find_first(const struct mpm *mpm, int32_t i, double sound, double courant,
                       struct ranked *first)
{
    const double *u = mpm->particles->velocity[i];
    const double fast = maximum(fabs(u[0]), maximum(fabs(u[1]), fabs(u[2])));
    const struct ranked one = {courant * mpm->edge / (sound + fast), mpm->particles->id[i],
                               fast > sound ? LIMIT_VELOCITY : LIMIT_SOUND};
    if (ranked_before(&one, first))
        *first = one;
}

static struct ranked first_of_particles(const struct mpm *mpm, const struct simulation *simulation,
                                        struct ranked first)
{
    const double *sound = mpm_fields_of(mpm).sound_long;
#pragma omp parallel num_threads(simulation->threads)
    {
        struct ranked own = first;
#pragma omp for schedule(static)
        for (int32_t i = 0; i < mpm->particles->count; i++)
            find_first(mpm, i, sound[i], mpm->parameters.courant, &own);
#pragma omp critical(bolide_mpm_limit)
        if (ranked_before(&own, &first))
            first = own;
    }
    return first;
}

/* Collective: sums m c^2, m K and m at the nodes of all layers, in the second field. */
static void sum_speeds(struct mpm *mpm, struct simulation *simulation)
{
    for (int g = 0; g < mpm->layers; g++) {
        struct layer *layer = &mpm->layer[g];
        const struct transfer transfer = mpm_transfer_of(mpm, simulation, layer);
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
        for (int32_t b = 0; b < layer->bins.count; b++)
            if (!mpm_is_far(mpm, layer, b))
                transfer_stiffness(&transfer, b);
    }
    mpm_exchange(mpm, simulation, offsetof(struct layer, back));
    for (int g = 0; g < mpm->layers; g++) {
        struct layer *layer = &mpm->layer[g];
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
        for (int32_t n = 0; n < layer->grid.blocks; n++)
            grid_reduce(&layer->grid, &layer->back, n);
        mpm_fold_heat(mpm, layer);
    }
}

static struct ranked first_of_layer(const struct mpm *mpm, const struct simulation *simulation,
                                    struct layer *layer, struct ranked first)
{
    const struct transfer transfer = mpm_transfer_of(mpm, simulation, layer);
#pragma omp parallel num_threads(simulation->threads)
    {
        double *sound = mpm->rate[omp_get_thread_num()];
        struct ranked own = first;
#pragma omp for schedule(dynamic, 4)
        for (int32_t b = 0; b < layer->bins.count; b++) {
            const struct bin *bin = &layer->bins.bin[b];
            if (mpm_is_far(mpm, layer, b))
                continue;
            grid_spread(&layer->grid, &layer->back, b);
            transfer_speed(&transfer, b, sound);
            for (int32_t k = 0; k < bin->cell[BLOCK_CELLS]; k++) {
                const int32_t i = layer->bins.list[bin->first + k];
                const double courant = mpm->courant[mpm->particles->material[i]];
                find_first(mpm, i, courant * sound[k], courant, &own);
            }
        }
#pragma omp critical(bolide_mpm_limit)
        if (ranked_before(&own, &first))
            first = own;
    }
    return first;
}

struct limit mpm_limit(struct mpm *mpm, struct simulation *simulation)
{
    struct ranked first = {(double)INFINITY, UINT64_MAX, LIMIT_SOUND};
    if (mpm->limits_by_nodes) {
        sum_speeds(mpm, simulation);
        for (int g = 0; g < mpm->layers; g++)
            first = first_of_layer(mpm, simulation, &mpm->layer[g], first);
    } else
        first = first_of_particles(mpm, simulation, first);
    return limit_of_ranks(simulation->ranks, first, limit_reasons);
}
