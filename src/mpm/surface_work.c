/* The impulse and work of what pushes on surfaces. The work of a force at a node in a step is that
 * along the mean velocity of the step, which all forces on the node have a part in: it is booked
 * after the last of them, contact. */
#include <string.h>

#include "base/memory.h"
#include "mpm/surface.h"

struct error *mpm_reserve_surfaces(struct mpm *mpm, const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    const bool pushes[] = {[SURFACE_LOADS] = input->loads.count > 0,
                           [SURFACE_OUTFLOWS] =
                               place_has_face(&simulation->problem->place, face_lets_out),
                           [SURFACE_OUTSIDE] = mpm->outside != NULL};
    for (int g = 0; g < mpm->layers; g++)
        for (int cause = 0; cause < SURFACE_CAUSES; cause++) {
            struct layer *layer = &mpm->layer[g];
            if (pushes[cause] && !layer->prescribed &&
                !memory_reserve((void **)&layer->pushed[cause], &layer->pushed_capacity[cause],
                                (int64_t)layer->grid.blocks * BLOCK_CELLS, 0,
                                sizeof *layer->pushed[cause]))
                return out_of_memory_for("forces at %d blocks", layer->grid.blocks);
        }
    return NULL;
}

void mpm_note_pushed(struct layer *layer, enum surface_cause cause, int threads)
{
    double(*pushed)[3] = layer->pushed[cause];
    const bool first = !layer->is_pushed[cause];
    layer->is_pushed[cause] = true;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int32_t n = 0; n < layer->grid.blocks; n++)
        for (int k = 0; k < BLOCK_CELLS; k++)
            for (int c = 0; c < 3; c++) {
                double *sum = &pushed[(int64_t)n * BLOCK_CELLS + k][c];
                *sum = (first ? 0.0 : *sum) + grid_node(&layer->back, n, k)[c];
            }
    for (int32_t w = 0; w < layer->walls; w++)
        for (int c = 0; c < 3; c++) {
            double *sum = &layer->wall[w].pushed_by[cause][c];
            *sum = (first ? 0.0 : *sum) + layer->wall[w].back[c];
        }
}

void mpm_push_area(const struct mpm_outside *outside, const int64_t at[3], const double area[3],
                   double force[3])
{
    for (int c = 0; c < 3; c++)
        force[c] = area[c] != 0.0 ? -area[c] * outside->pressure(outside->of, at, c) : 0.0;
}

double mpm_push_work(const struct mpm_push *push)
{
    double work = 0.0;
    for (int c = 0; c < 3; c++)
        work += push->impulse[c] * push->velocity[c];
    return work;
}

/* Books what PUSHED has noted of CAUSE, on NODE in a step of DT: PUSH has place and order. */
static void book_force(const struct mpm *mpm, enum surface_cause cause, const double pushed[3],
                       const double *node, double dt, struct mpm_push *push, struct ledger *ledger)
{
    static const enum ledger_cause causes[] = {
        [SURFACE_LOADS] = LEDGER_LOADS, [SURFACE_OUTFLOWS] = LEDGER_OUTFLOWS};
    if (pushed[0] == 0.0 && pushed[1] == 0.0 && pushed[2] == 0.0)
        return;
    for (int c = 0; c < 3; c++) {
        push->impulse[c] = dt * pushed[c];
        push->velocity[c] =
            (node[NODE_MOMENTUM + c] + 0.5 * dt * node[NODE_FORCE + c]) / node[NODE_MASS];
    }
    if (cause == SURFACE_OUTSIDE) {
        memcpy(push->area, push->impulse, sizeof push->area);
        mpm_push_area(mpm->outside, push->at, push->area, push->impulse);
        mpm->outside->pushed(mpm->outside->of, push);
        return;
    }
    const int64_t *at = push->at;
    const double *f = push->impulse;
    ledger_book(ledger, causes[cause], 0.0, vec3_make(f[0], f[1], f[2]),
                vec3_scale(mpm->edge, vec3_make((double)at[0], (double)at[1], (double)at[2])),
                mpm_push_work(push));
}

/* The same for the nodes of a block that are not near a wall, if this rank owns the block. */
static void book_block(const struct mpm *mpm, const struct layer *layer, enum surface_cause cause,
                       int32_t block, double dt, struct ledger *ledger)
{
    if (mpm_is_far(mpm, layer, layer->grid.touch[block][0].bin))
        return;
    int64_t corner[3];
    grid_corner(&layer->grid, block, corner);
    for (int k = 0; k < BLOCK_CELLS; k++) {
        struct mpm_push push = {
            .order = {2 * (uint64_t)(layer - mpm->layer) + 1, layer->grid.key[block], (uint64_t)k}};
        mpm_node_index(layer->grid.dimension, corner, k, push.at);
        if (!mpm_near_wall(mpm, layer, push.at))
            book_force(mpm, cause, layer->pushed[cause][(int64_t)block * BLOCK_CELLS + k],
                       grid_node(&layer->main, block, k), dt, &push, ledger);
    }
}

/* The same for a node near a wall. */
static void book_wall(const struct mpm *mpm, const struct layer *layer, enum surface_cause cause,
                      const struct wall_node *wall, double dt, struct ledger *ledger)
{
    const int64_t node = (wall->node - layer->main.node) / NODE_STRIDE;
    struct mpm_push push = {.at = {wall->at[0], wall->at[1], wall->at[2]},
                            .order = {2 * (uint64_t)(layer - mpm->layer),
                                      layer->grid.key[node / BLOCK_CELLS],
                                      (uint64_t)(node % BLOCK_CELLS)}};
    if (wall->booked)
        book_force(mpm, cause, wall->pushed_by[cause], wall->node, dt, &push, ledger);
}

static void book_layer(const struct mpm *mpm, struct simulation *simulation,
                       const struct layer *layer, enum surface_cause cause, double dt)
{
    for (int32_t w = 0; w < layer->walls; w++)
        book_wall(mpm, layer, cause, &layer->wall[w], dt, &simulation->ledger);
#pragma omp parallel num_threads(cause == SURFACE_OUTSIDE ? 1 : simulation->threads)
    {
        struct ledger own = {0};
#pragma omp for schedule(static)
        for (int32_t n = 0; n < layer->grid.blocks; n++)
            book_block(mpm, layer, cause, n, dt, &own);
#pragma omp critical(bolide_mpm_surface)
        ledger_join(&simulation->ledger, &own);
    }
}

void mpm_book_surfaces(const struct mpm *mpm, struct simulation *simulation, double dt)
{
    for (int g = 0; g < mpm->layers; g++)
        for (int cause = 0; cause < SURFACE_CAUSES; cause++)
            if (!mpm->layer[g].prescribed && mpm->layer[g].is_pushed[cause])
                book_layer(mpm, simulation, &mpm->layer[g], (enum surface_cause)cause, dt);
}

static void book_delivered(const double *force, double dt, struct load_record *record)
{
    const double impulse[3] = {dt * force[0], dt * force[1], dt * force[2]};
    load_record_add(record, LOAD_DELIVERED, impulse);
}

void mpm_book_load(const struct mpm *mpm, const struct layer *layer, double dt,
                   struct load_record *record)
{
    int64_t corner[3], at[3];
    for (int32_t w = 0; w < layer->walls; w++)
        if (layer->wall[w].booked)
            book_delivered(layer->wall[w].back, dt, record);
    for (int32_t n = 0; n < layer->grid.blocks; n++) {
        if (mpm_is_far(mpm, layer, layer->grid.touch[n][0].bin))
            continue;
        grid_corner(&layer->grid, n, corner);
        for (int k = 0; k < BLOCK_CELLS; k++) {
            mpm_node_index(layer->grid.dimension, corner, k, at);
            const double *force = grid_node(&layer->back, n, k);
            if ((force[0] != 0.0 || force[1] != 0.0 || force[2] != 0.0) &&
                !mpm_near_wall(mpm, layer, at))
                book_delivered(force, dt, record);
        }
    }
}
