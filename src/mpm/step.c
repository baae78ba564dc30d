/* A step of the material point method. prepare: particles into cells, mass, momentum and force to
 * nodes, step limit; advance: nodes, then particles in the order of the scheme. Source: Cui,
 * dissertation (2014), section 2.3. */
#include <omp.h>
#include <stdlib.h>

#include "base/clock.h"
#include "base/memory.h"
#include "model/particles/held.h"
#include "mpm/mpm_internal.h"

/* The store is sorted again when so much of it has left the cells that it was stored by. */
static const double moved_limit = 0.25;

struct transfer mpm_transfer_of(const struct mpm *mpm, const struct simulation *simulation,
                                struct layer *layer)
{
    const struct particles *p = mpm->particles;
    const struct mpm_fields fields = mpm_fields_of(mpm);
    return (struct transfer){.dimension = simulation->problem->dimension,
                             .shape = (enum grid_shape)mpm->parameters.shape,
                             .window = 1 + layer->grid.reach + layer->grid.after,
                             .axisymmetric = simulation->problem->geometry == GEOMETRY_AXISYMMETRIC,
                             .affine = mpm_is_affine(mpm),
                             .by_moments = mpm->parameters.transfer == MPM_APIC,
                             .edge = mpm->edge,
                             .bins = &layer->bins,
                             .grid = &layer->grid,
                             .main = &layer->main,
                             .back = &layer->back,
                             .normal = &layer->normal,
                             .by_faces = mpm_is_by_faces(&mpm->parameters),
                             .stress = &layer->stress,
                             .fill = &layer->fill,
                             .flip = mpm->parameters.flip,
                             .conserves = mpm_conserves(&mpm->parameters),
                             .mixing = mpm->parameters.shock_mixing,
                             .position = p->position,
                             .velocity = p->velocity,
                             .energy = p->energy,
                             .mass = p->mass,
                             .density = p->density,
                             .pressure = p->pressure,
                             .viscosity = fields.viscosity,
                             .sound = fields.sound_long,
                             .deviator = (const double(*)[6])p->deviator,
                             .material = p->material,
                             .body = p->body,
                             .gradient = fields.velocity_gradient,
                             .divergence = fields.divergence,
                             .shock = fields.shock,
                             .half_size = mpm->half_size,
                             .gauge = mpm->gauge,
                             .burnt = p->history[HISTORY_burnt],
                             .reaction = mpm->reaction,
                             .courant = mpm->courant,
                             .balances = mpm->balances_of,
                             .ambient = fields.ambient,
                             .damage = p->history[HISTORY_damage],
                             .damage_gradient = fields.damage_gradient};
}

static struct binned binned_of(const struct mpm *mpm, const struct simulation *simulation)
{
    const struct particles *p = mpm->particles;
    struct binned binned = {.dimension = simulation->problem->dimension,
                            .edge = mpm->edge,
                            .shift = p->shift,
                            .count = p->count,
                            .blocks = p->blocks,
                            .block = p->block,
                            .position = (const double(*)[3])p->position,
                            .id = p->id,
                            .order = p->order,
                            .groups = mpm->layers,
                            .group_of_body = mpm->layer_of_body,
                            .body = p->body};
    for (int axis = 0; axis < 3; axis++) {
        binned.low[axis] = mpm->has_plane[axis][0] ? mpm->plane[axis][0] : INT64_MIN;
        binned.high[axis] =
            mpm->has_plane[axis][1] ? mpm->plane[axis][1] - (p->shift > 0.0 ? 0 : 1) : INT64_MAX;
    }
    return binned;
}

static struct error *find_cells(struct mpm *mpm, const struct simulation *simulation)
{
    const struct binned binned = binned_of(mpm, simulation);
    return bins_find(&mpm->bins, &binned, simulation->threads);
}

static struct error *fill_bins(struct mpm *mpm, const struct simulation *simulation)
{
    const struct binned binned = binned_of(mpm, simulation);
    return bins_fill(&mpm->bins, &binned, simulation->threads);
}

/* Room for the rates of the largest bin, for each thread. */
static struct error *reserve_rates(struct mpm *mpm)
{
    int64_t most = 0;
    for (int32_t b = 0; b < mpm->bins.count; b++)
        most =
            mpm->bins.bin[b].cell[BLOCK_CELLS] > most ? mpm->bins.bin[b].cell[BLOCK_CELLS] : most;
    if (most + 8 <= mpm->rate_capacity)
        return NULL;
    const int64_t wanted = most + most / 2 + 8; /* lanes behind the last */
    for (int t = 0; t < mpm->threads; t++) {
        free(mpm->rate[t]);
        mpm->rate[t] = memory_allocate((size_t)wanted * RATES * sizeof(double));
        if (!mpm->rate[t]) {
            mpm->rate_capacity = 0;
            return out_of_memory_for("%lld particles of a block", (long long)wanted);
        }
    }
    mpm->rate_capacity = wanted;
    return NULL;
}

/* Stores the particles as bins have them. */
static struct error *store_by_bins(struct mpm *mpm, struct simulation *simulation)
{
    struct particles *p = mpm->particles;
    const struct bins *bins = &mpm->bins;
    if (mpm->layers > 1) { /* blocks have a bin for each layer */
        TRY(particles_sort(p));
        TRY(find_cells(mpm, simulation));
        return fill_bins(mpm, simulation);
    }
    if (!memory_reserve((void **)&mpm->block, &mpm->block_capacity, bins->count, 0,
                        sizeof *mpm->block))
        return out_of_memory_for("%d blocks", bins->count);
    for (int32_t b = 0; b < bins->count; b++)
        mpm->block[b] =
            (struct block){bins->bin[b].key, bins->bin[b].first, bins->bin[b].cell[BLOCK_CELLS]};
    TRY(particles_arrange(p, bins->list, mpm->block, bins->count));
    bins_settle(&mpm->bins, p->order, simulation->threads);
    return NULL;
}

/* Particle INDEX leaves for rank OWNER, if that is another one. */
static bool note_leaving(struct mpm *mpm, int32_t index, int owner)
{
    if (owner == mpm->particles->ranks->rank)
        return true;
    if (!memory_reserve((void **)&mpm->leaving, &mpm->leaving_capacity, mpm->leaves + 1,
                        mpm->leaves, sizeof *mpm->leaving))
        return false;
    mpm->leaving[mpm->leaves++] = (struct send_item){owner, index};
    return true;
}

/* The particles that lie in blocks of other ranks: strays, and those of blocks that a coupling has
 * given to another rank. */
static struct error *find_leaving(struct mpm *mpm, const struct simulation *simulation)
{
    const struct bins *bins = &mpm->bins;
    const struct particles *p = mpm->particles;
    const struct partition *partition = &simulation->partition;
    bool room = true;
    mpm->leaves = 0;
    for (int32_t k = 0; k < bins->strays && room; k++) {
        int32_t index;
        const uint64_t key = bins_stray(bins, k, &index);
        room = note_leaving(mpm, index, partition_owner(partition, key));
    }
    for (int32_t b = 0; b < p->blocks && room; b++) {
        const struct block *block = &p->block[b];
        const int owner = partition_owner(partition, block->key);
        const bool stays = owner == simulation->ranks->rank;
        for (int32_t k = 0; k < block->count && room && !stays; k++)
            if (!bins_is_stray(bins, block->first + k))
                room = note_leaving(mpm, block->first + k, owner);
    }
    return room ? NULL : out_of_memory_for("particles that go to other ranks");
}

/* The block that particle I is stored in; 0 where there are none. */
static int32_t storage_block(const struct particles *p, int32_t i)
{
    int32_t low = 0, high = p->blocks;
    while (high - low > 1) {
        const int32_t middle = (low + high) / 2;
        *(p->block[middle].first <= i ? &low : &high) = middle;
    }
    return low;
}

/* The particles that leave go, others come in their places and behind all others: the blocks of
 * these are searched again. */
static struct error *hand_over(struct mpm *mpm, const struct simulation *simulation)
{
    struct particles *p = mpm->particles;
    const int32_t before = p->count, blocks = p->blocks;
    bool *again = memory_allocate((size_t)blocks + 1);
    struct error *error = again ? NULL : out_of_memory_for("%d blocks", blocks);
    for (int32_t k = 0; k < mpm->leaves && !error; k++)
        again[storage_block(p, mpm->leaving[k].item)] = true;
    error = ranks_agree(simulation->ranks, error);
    if (!error)
        error = particles_hand_over(p, mpm->leaving, mpm->leaves);
    if (!error && p->blocks > 0)
        again[p->blocks - 1] = true; /* it may begin or end elsewhere */
    if (!error) {
        const struct binned binned = binned_of(mpm, simulation);
        error = blocks == 0
                    ? bins_find(&mpm->bins, &binned, simulation->threads)
                    : bins_find_again(&mpm->bins, &binned, again, before, simulation->threads);
    }
    free(again);
    return error;
}

/* Particles into cells, on the ranks that own these. Space is divided anew where the case has it
 * so, or some rank has worked longer. */
static struct error *place_particles(struct mpm *mpm, struct simulation *simulation)
{
    enum { STEPS = 20 }; /* between comparisons of work */
    struct particles *p = mpm->particles;
    const int64_t every = simulation->problem->input->run.rebalance;
    const bool several = simulation->ranks->size > 1,
               recut = several && every > 0 && simulation->step % every == 0,
               uneven = several && simulation->step % STEPS == 0 &&
                        partition_is_uneven(&simulation->partition);
    struct error *error = find_cells(mpm, simulation);
    if (several && !error)
        error = find_leaving(mpm, simulation);
    double goes = several && !error && mpm->leaves > 0;
    TRY(ranks_agree_on(simulation->ranks, error, &goes, 1));
    if (recut || uneven) {
        TRY(particles_distribute(p, recut));
        TRY(find_cells(mpm, simulation));
    } else if (goes > 0.0)
        TRY(hand_over(mpm, simulation));
    TRY(fill_bins(mpm, simulation));
    return (double)mpm->bins.moved > moved_limit * p->count ? store_by_bins(mpm, simulation) : NULL;
}

/* Gives each layer its part of the bins. */
static void share_bins(struct mpm *mpm)
{
    for (int g = 0; g < mpm->layers; g++) {
        const int32_t begin = mpm->bins.begin[g];
        mpm->layer[g].bins = (struct bins){.count = mpm->bins.begin[g + 1] - begin,
                                           .list = mpm->bins.list,
                                           .bin = mpm->bins.bin + begin};
    }
}

static struct error *reserve_fields(struct mpm *mpm, const struct simulation *simulation)
{
    for (int g = 0; g < mpm->layers; g++) {
        struct layer *layer = &mpm->layer[g];
        TRY(grid_plan(&layer->grid, &layer->bins));
        TRY(grid_field_reserve(&layer->main, &layer->grid));
        TRY(grid_field_reserve(&layer->back, &layer->grid));
        if (mpm->layers > 1)
            TRY(grid_field_reserve(&layer->normal, &layer->grid));
        if (mpm_is_by_faces(&mpm->parameters)) {
            TRY(mpm->layers > 1 ? grid_field_reserve(&layer->stress, &layer->grid)
                                : grid_patches_reserve(&layer->stress, &layer->grid));
            TRY(grid_field_reserve(&layer->fill, &layer->grid));
        }
    }
    for (int g = 0; g < mpm->layers; g++)
        if (!memory_reserve((void **)&mpm->layer[g].shocked, &mpm->layer[g].shocked_capacity,
                            mpm->layer[g].grid.blocks, 0, sizeof(bool)))
            return out_of_memory_for("%d blocks", mpm->layer[g].grid.blocks);
    TRY(mpm_reserve_order(mpm));
    TRY(mpm_reserve_surfaces(mpm, simulation));
    if (mpm->layers > 1)
        TRY(mpm_find_meetings(mpm));
    if (mpm->halo.far)
        TRY(mpm_reserve_halo(mpm));
    return reserve_rates(mpm);
}

/* Collective: particles into cells, and the blocks of nodes that these need. */
static struct error *refresh_grid(struct mpm *mpm, struct simulation *simulation)
{
    struct error *error = place_particles(mpm, simulation);
    if (simulation->ranks->size > 1)
        TRY(mpm_find_halo(mpm, simulation, error));
    else if (!error)
        share_bins(mpm);
    return ranks_agree(simulation->ranks, error ? error : reserve_fields(mpm, simulation));
}

/* Particles give to their patches, those of bins that are NEAR other ranks or of the others. */
static void scatter(struct mpm *mpm, const struct simulation *simulation, bool near)
{
    for (int g = 0; g < mpm->layers; g++) {
        struct layer *layer = &mpm->layer[g];
        const struct transfer transfer = mpm_transfer_of(mpm, simulation, layer);
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
        for (int32_t b = 0; b < layer->bins.count; b++)
            if (!mpm_is_far(mpm, layer, b) && mpm_is_near(mpm, layer, b) == near) {
                transfer_scatter(&transfer, b);
                mpm_exchange_advance(mpm);
            }
    }
}

/* Collective: mass, momentum and force of all nodes, and where shocks are. */
static struct error *sum_particles(struct mpm *mpm, struct simulation *simulation)
{
    struct error *error = NULL;
    const size_t field = offsetof(struct layer, main);
    const bool early = !mpm_is_by_faces(&mpm->parameters); /* patches are complete at once */
    if (simulation->ranks->size > 1)
        scatter(mpm, simulation, true);
    if (early)
        mpm_exchange_start(mpm, simulation, field);
    scatter(mpm, simulation, false);
    mpm_push_faces(mpm, simulation);
    simulation_end_phase(simulation, PHASE_BLOCKS, "particles to grid");
    if (early)
        mpm_exchange_finish(mpm, simulation, field);
    else
        mpm_exchange(mpm, simulation, field);
    double shocks = 0.0;
    for (int g = 0; g < mpm->layers && !error; g++) {
        error = mpm_sum_nodes(mpm, simulation, &mpm->layer[g]);
        if (!error && mpm_find_shocks(mpm, simulation, &mpm->layer[g]))
            shocks = 1.0;
    }
    simulation_end_phase(simulation, PHASE_BLOCKS, "grid update");
    TRY(ranks_agree_on(simulation->ranks, error, &shocks, 1));
    simulation_end_waiting(simulation);
    mpm->shocks = shocks > 0.0;
    return NULL;
}

/* A fast impact that starts with a whole step is felt one step too late, and what strikes first is
 * compressed too far. So no particle moves further than this fraction of a cell in the first step,
 * and a step is at most this factor longer than the one before. */
static const double first_way = 0.1, step_growth = 1.2;

/* Collective: of all particles; not zero. */
static double largest_speed(const struct simulation *simulation, const struct particles *p)
{
    double most = 1e-300;
#pragma omp parallel for schedule(static) num_threads(simulation->threads) reduction(max : most)
    for (int32_t i = 0; i < p->count; i++)
        most = maximum(most, sqrt(vec3_dot(vector_at(p->velocity[i]), vector_at(p->velocity[i]))));
    ranks_maximum_of(simulation->ranks, &most, 1);
    return most;
}

struct error *mpm_prepare(void *solver, struct simulation *simulation, struct limit *limit)
{
    struct mpm *mpm = solver;
    mpm_stop_bodies(mpm, simulation);
    TRY(refresh_grid(mpm, simulation));
    simulation_end_phase(simulation, PHASE_SHARED, "cell search");
    TRY(sum_particles(mpm, simulation));
    *limit = mpm_limit(mpm, simulation);
    const double allowed = mpm->limit_before > 0.0
                               ? step_growth * mpm->limit_before
                               : first_way * mpm->edge / largest_speed(simulation, mpm->particles);
    const double spread = mpm_spread_step(mpm, simulation);
    mpm->limit = minimum(minimum(limit->dt, allowed), spread);
    if (allowed < limit->dt)
        *limit = (struct limit){allowed, "growth of the step", limit->id, INFINITY};
    if (spread < limit->dt)
        *limit = (struct limit){spread, "failure wave", limit->id, INFINITY};
    limit->event = next_event(simulation);
    simulation_end_phase(simulation, PHASE_SHARED, "time step");
    return NULL;
}

/* New velocities of particles from their nodes, those of bins that are NEAR other ranks or of the
 * others; with SCATTER their momentum goes back to nodes. */
static void gather_velocities(struct mpm *mpm, const struct simulation *simulation,
                              struct transfer_step step, bool scatter, bool near)
{
    for (int g = 0; g < mpm->layers; g++) {
        struct layer *layer = &mpm->layer[g];
        const struct transfer transfer = mpm_transfer_of(mpm, simulation, layer);
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
        for (int32_t b = 0; b < layer->bins.count; b++) {
            if (mpm_is_far(mpm, layer, b) || mpm_is_near(mpm, layer, b) != near)
                continue;
            grid_spread(&layer->grid, &layer->main, b);
            if (!layer->prescribed)
                transfer_velocity(&transfer, b, step, scatter);
            mpm_exchange_advance(mpm);
        }
    }
}

static void find_velocities(struct mpm *mpm, struct simulation *simulation,
                            struct transfer_step step, bool scatter)
{
    const size_t field = offsetof(struct layer, back);
    if (simulation->ranks->size > 1)
        gather_velocities(mpm, simulation, step, scatter, true);
    if (scatter)
        mpm_exchange_start(mpm, simulation, field);
    gather_velocities(mpm, simulation, step, scatter, false);
    simulation_end_phase(simulation, PHASE_BLOCKS, "grid to particles");
    if (scatter)
        mpm_exchange_finish(mpm, simulation, field);
}

/* New states of all particles of a layer from nodal velocities: those of the second field or,
 * with OF_MAIN, of the first. *FAILED becomes the one with the smallest id whose state is
 * impossible, if that is smaller than the one that was there. */
static void find_states(struct mpm *mpm, struct simulation *simulation, struct layer *layer,
                        struct transfer_step step, bool of_main, int32_t *failed)
{
    const struct transfer transfer = mpm_transfer_of(mpm, simulation, layer);
    const struct particles *p = mpm->particles;
    if (layer->prescribed) /* two of them that meet would strain each other */
        return;
#pragma omp parallel num_threads(simulation->threads)
    {
        double *rate = mpm->rate[omp_get_thread_num()];
        int32_t own = -1;
#pragma omp for schedule(dynamic, 4)
        for (int32_t b = 0; b < layer->bins.count; b++) {
            struct nodal of = {grid_patch(&layer->grid, &layer->main, b) + NODE_VELOCITY,
                               NODE_STRIDE};
            if (mpm_is_far(mpm, layer, b))
                continue;
            if (!of_main) {
                grid_spread(&layer->grid, &layer->back, b);
                of = (struct nodal){grid_patch(&layer->grid, &layer->back, b), BACK_STRIDE};
            }
            transfer_gradient(&transfer, b, step, of,
                              (struct rates){rate, (size_t)mpm->rate_capacity});
            const int32_t found = mpm_update_points(mpm, simulation, layer, b, step.dt, rate);
            if (found >= 0 && (own < 0 || p->id[found] < p->id[own]))
                own = found;
        }
#pragma omp critical(bolide_mpm_failure)
        if (own >= 0 && (*failed < 0 || p->id[own] < p->id[*failed]))
            *failed = own;
    }
}

/* The same of all layers, from velocities that particles have mapped back, from those at the end
 * of the step, or with FIRST from those at its begin. */
static struct error *update_states(struct mpm *mpm, struct simulation *simulation, double dt,
                                   bool first)
{
    const bool of_main = mpm->parameters.scheme == MPM_USL;
    int32_t failed = -1;
    for (int g = 0; g < mpm->layers && !of_main; g++)
        mpm_find_velocities(mpm, simulation, &mpm->layer[g], first);
    if (!of_main)
        mpm_raise_order(mpm, simulation, dt, false);
    if (mpm->layers > 1 && !of_main)
        mpm_join_velocities(mpm, simulation);
    simulation_end_phase(simulation, PHASE_BLOCKS, "grid update");
    for (int g = 0; g < mpm->layers; g++)
        find_states(mpm, simulation, &mpm->layer[g], (struct transfer_step){dt, !first}, of_main,
                    &failed);
    simulation_end_phase(simulation, PHASE_BLOCKS, "stresses");
    return failed < 0 ? NULL : simulation_impossible(simulation, failed);
}

struct error *mpm_advance(void *solver, struct simulation *simulation, double dt)
{
    struct mpm *mpm = solver;
    const int scheme = mpm->parameters.scheme;
    mpm->limit_before = mpm->limit;
    mpm_book_gravity(mpm, simulation, dt, true);
    mpm_mix_shocks(mpm, simulation, dt);
    TRY(mpm_balance_pressures(mpm, simulation, dt));
    mpm_find_spread(mpm, simulation);
    if (scheme == MPM_USF) {
        TRY(ranks_agree(simulation->ranks, update_states(mpm, simulation, dt, true)));
        TRY(sum_particles(mpm, simulation));
    }
    mpm_book_hoop(mpm, simulation, dt);
    mpm_damp_shear(mpm, simulation, dt);
    TRY(mpm_push_surfaces(mpm, simulation, dt));
    if (mpm->layers > 1)
        mpm_meet(mpm, simulation, dt);
    mpm_book_surfaces(mpm, simulation, dt);
    for (int g = 0; g < mpm->layers; g++)
        mpm_advance_nodes(mpm, simulation, &mpm->layer[g], dt);
    mpm_raise_order(mpm, simulation, dt, true);
    simulation_end_phase(simulation, PHASE_BLOCKS, "grid update");
    find_velocities(mpm, simulation, (struct transfer_step){dt, scheme == MPM_USF},
                    scheme == MPM_MUSL);
    mpm_take_given(mpm, simulation);
    mpm_book_ambient(mpm, simulation);
    mpm_book_gravity(mpm, simulation, dt, false);
    struct error *error = scheme == MPM_USF ? NULL : update_states(mpm, simulation, dt, false);
    mpm_move_prescribed(mpm, simulation, dt);
    error = error_join(error, drive_bodies(simulation, mpm->particles, dt));
    mpm_lose_particles(mpm, simulation);
    return error;
}
