/* Nodal velocities by the inverse of the full mass matrix, m_IJ = sum m N_I N_J, instead of the
 * lumped one, whose velocities v are those of the particles smoothed once more: waves of a few
 * cells run late behind a shock and ring there. With S from nodes to particles, v_p = sum N v_I,
 * and S+ back, sum N m v_p / m_I, the inverse to order k is
 *
 *   v(k) = v + (1 - S+ S) v + ... + (1 - S+ S)^(k-1) v
 *
 * and the same holds for accelerations. 1 - S+ S has eigenvalues between 0 and 1, and it takes
 * nothing from momentum. Source: Nairn and Hammerquist, CMAME 377 (2021) 113667, FMPM(k);
 * Hammerquist and Nairn, CMAME 318 (2017) 724, XPIC(m). */
#include <string.h>

#include "base/clock.h"
#include "mpm/mpm_internal.h"

struct error *mpm_reserve_order(struct mpm *mpm)
{
    for (int g = 0; g < mpm->layers && mpm->parameters.order > 1; g++) {
        struct layer *layer = &mpm->layer[g];
        layer->left.stride = layer->mapped.stride = NODE_STRIDE;
        TRY(grid_field_reserve(&layer->left, &layer->grid));
        TRY(grid_field_reserve(&layer->mapped, &layer->grid));
    }
    return NULL;
}

void mpm_free_order(struct layer *layer)
{
    grid_field_free(&layer->left);
    grid_field_free(&layer->mapped);
}

/* Where the velocity of node K of a block stands that is raised: with ACCELERATIONS in the main
 * field, else in the second. */
static double *velocity_of(struct layer *layer, int32_t block, int k, bool accelerations)
{
    return accelerations ? grid_node(&layer->main, block, k) + NODE_VELOCITY
                         : grid_node(&layer->back, block, k);
}

/* Particles get what is left, and give it back. */
static void map_left(struct mpm *mpm, const struct simulation *simulation, struct layer *layer,
                     bool accelerations)
{
    const struct transfer transfer = mpm_transfer_of(mpm, simulation, layer);
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
    for (int32_t b = 0; b < layer->bins.count; b++)
        if (!mpm_is_far(mpm, layer, b)) {
            grid_spread(&layer->grid, &layer->left, b);
            transfer_again(&transfer, b, grid_patch(&layer->grid, &layer->left, b), accelerations,
                           grid_patch(&layer->grid, &layer->mapped, b));
        }
}

/* What walls push by what they change of the sums SUM, which then are theirs (see book_walls of
 * nodes.c). */
static void book_walls(const struct mpm *mpm, struct simulation *simulation, struct layer *layer,
                       double dt)
{
    const double flip = mpm->parameters.flip;
    for (int32_t w = 0; w < layer->walls; w++) {
        const struct wall_node *wall = &layer->wall[w];
        const double *raw = wall->raised, *sum = wall->mapped;
        const double mass = wall->node[NODE_MASS],
                     share = mass > 0.0 ? wall->sum[NODE_MASS] / mass : 0.0;
        double push[3], place[3];
        for (int c = 0; c < 3 && wall->booked; c++) {
            const double v = raw[NODE_VELOCITY + c] - share * sum[NODE_VELOCITY + c],
                         a = raw[NODE_ACCELERATION + c] - share * sum[NODE_ACCELERATION + c];
            push[c] = flip * dt * a + (1.0 - flip) * v;
            place[c] = (double)wall->at[c] * mpm->edge;
        }
        if (wall->booked)
            ledger_book(&simulation->ledger, LEDGER_WALLS, 0.0,
                        vec3_make(push[0], push[1], push[2]),
                        vec3_make(place[0], place[1], place[2]), 0.0);
    }
}

/* Sums of what came back, walls included. */
static void sum_mapped(struct mpm *mpm, struct simulation *simulation, struct layer *layer,
                       double dt, bool accelerations)
{
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        grid_reduce(&layer->grid, &layer->mapped, n);
    for (int32_t w = 0; w < layer->walls; w++)
        memcpy(layer->wall[w].raised, layer->wall[w].mapped, sizeof layer->wall[w].raised);
    mpm_fold_vectors(mpm, layer, &layer->mapped);
    if (accelerations)
        book_walls(mpm, simulation, layer, dt);
}

/* The next term of the series, which stands in the field of what is left, is added. */
static void add_term(const struct mpm *mpm, const struct simulation *simulation,
                     struct layer *layer, bool accelerations)
{
    const int count = accelerations ? 6 : 3;
    const double least = accelerations ? 0.0 : mpm->least_mass;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        for (int k = 0; k < BLOCK_CELLS; k++) {
            const double mass = grid_node(&layer->main, n, k)[NODE_MASS];
            const double *mapped = grid_node(&layer->mapped, n, k) + NODE_VELOCITY;
            double *left = grid_node(&layer->left, n, k) + NODE_VELOCITY;
            double *velocity = velocity_of(layer, n, k, accelerations);
            for (int c = 0; c < count && mass > least; c++) {
                left[c] -= mapped[c] / mass;
                velocity[c] += left[c];
            }
        }
}

static void start_series(const struct simulation *simulation, struct layer *layer,
                         bool accelerations)
{
    const size_t count = accelerations ? 6 : 3;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        for (int k = 0; k < BLOCK_CELLS; k++) {
            double *left = grid_node(&layer->left, n, k);
            memset(left, 0, NODE_STRIDE * sizeof *left);
            memcpy(left + NODE_VELOCITY, velocity_of(layer, n, k, accelerations),
                   count * sizeof *left);
        }
}

void mpm_raise_order(struct mpm *mpm, struct simulation *simulation, double dt, bool accelerations)
{
    for (int g = 0; g < mpm->layers && mpm->parameters.order > 1; g++)
        if (!mpm->layer[g].prescribed)
            start_series(simulation, &mpm->layer[g], accelerations);
    for (int64_t order = 1; order < mpm->parameters.order; order++) {
        for (int g = 0; g < mpm->layers; g++)
            if (!mpm->layer[g].prescribed)
                map_left(mpm, simulation, &mpm->layer[g], accelerations);
        mpm_exchange(mpm, simulation, offsetof(struct layer, mapped));
        for (int g = 0; g < mpm->layers; g++)
            if (!mpm->layer[g].prescribed) {
                sum_mapped(mpm, simulation, &mpm->layer[g], dt, accelerations);
                add_term(mpm, simulation, &mpm->layer[g], accelerations);
            }
    }
}
