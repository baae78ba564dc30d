/* Strips of blocks, and a sweep over all of them: those that need nothing of other ranks while
 * planes of these are under way, then the others. A sweep that would leave a cell with hardly any
 * density or energy is repeated in two halves, and these too, until its parts are short enough: the
 * state does not change until all strips are swept, and what was booked is taken back. */
#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "gas/gas_internal.h"

/* How much longer than to find that a block sleeps it takes to sweep it, about, in 3-D. */
enum { SWEEP_WORK = 20 };

const char gas_repetition[] = "repetition of sweeps that would empty a cell";

static void free_strips(struct gas_strips *strips)
{
    free(strips->block);
    free(strips->strip);
    memset(strips, 0, sizeof *strips);
}

void gas_free_strips(struct gas *gas)
{
    for (int axis = 0; axis < 3; axis++)
        free_strips(&gas->strips[axis]);
}

/* The block behind B along AXIS, -1 where it is not this rank's or begins a new strip. */
static int32_t next_block(const struct cell_blocks *cells, const struct cell_block *b, int axis)
{
    int64_t at[3] = {b->corner[0], b->corner[1], b->corner[2]};
    at[axis] += b->count[axis];
    const bool ends =
        at[axis] >= cell_domain_end(cells, b->level, axis, 1) || at[axis] % ROW_CELLS == 0;
    const struct cell_block *next = ends ? NULL : cell_block_at(cells, b->level, at);
    return next ? (int32_t)(next - cells->block) : -1;
}

/* Whether B continues the strip of the block before it. */
static bool is_continued(const struct cell_blocks *cells, const struct cell_block *b, int axis)
{
    int64_t at[3] = {b->corner[0], b->corner[1], b->corner[2]};
    if (at[axis] == cell_domain_end(cells, b->level, axis, 0) || at[axis] % ROW_CELLS == 0)
        return false;
    at[axis]--;
    return cell_block_at(cells, b->level, at) != NULL;
}

/* Whether what is beyond an end of block B along AXIS is of other ranks or outside a face. */
static bool is_open(const struct gas *gas, int axis, int32_t b, int side)
{
    const struct gas_seam_end *seam = gas_seam_end(gas, axis, b, side);
    bool open = gas->halo.axis[axis].waits[b][side] && !seam;
    for (int k = 0; seam && k < seam->besides; k++)
        open |= seam->beside[k] >= gas->cells->blocks;
    return open;
}

/* Strips begin at multiples of the longest row, where the domain does, and after blocks of
 * others. */
static void make_strips(const struct gas *gas, int axis, struct gas_strips *strips)
{
    const struct cell_blocks *cells = gas->cells;
    const struct cell_halo_axis *halo = &gas->halo.axis[axis];
    const bool round = gas->round && axis == 0;
    int32_t blocks = 0;
    for (int32_t b = 0; b < cells->blocks; b++) {
        if (is_continued(cells, &cells->block[b], axis))
            continue;
        struct gas_strip *strip = &strips->strip[strips->count++];
        strip->block = &strips->block[blocks];
        int32_t last = b;
        for (int32_t at = b; at >= 0; at = next_block(cells, &cells->block[at], axis)) {
            strips->block[blocks++] = at;
            strip->count++;
            last = at;
        }
        strip->waits = halo->waits[b][0] || halo->waits[last][1];
        strip->open = is_open(gas, axis, b, 0) || is_open(gas, axis, last, 1);
        const struct cell_block *low = &cells->block[b], *high = &cells->block[last];
        strip->bounds =
            round || low->corner[axis] == cell_domain_end(cells, low->level, axis, 0) ||
            high->corner[axis] + high->count[axis] == cell_domain_end(cells, low->level, axis, 1);
        strip->part = 1.0 / (double)(1 << low->level);
    }
    assert(blocks == cells->blocks);
    struct gas_strip *sorted = strips->strip + strips->count; /* the room is double */
    int32_t late = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (int32_t s = 0; s < strips->count; s++)
            if (strips->strip[s].waits == (pass == 1))
                sorted[late++] = strips->strip[s];
        strips->early = pass ? strips->early : late;
    }
    memmove(strips->strip, sorted, (size_t)strips->count * sizeof *sorted);
}

/* Room for what leaves a strip on each of so many THREADS. */
static struct error *reserve_through(struct gas *gas, int threads)
{
    if (gas->throughs >= threads)
        return NULL;
    free(gas->through);
    gas->through = memory_allocate((size_t)threads * sizeof *gas->through);
    gas->throughs = gas->through ? threads : 0;
    return gas->through ? NULL : out_of_memory_for("strips of cells");
}

/* How many numbers pass through the faces of a SIDE of the cut across AXIS. */
static size_t numbers_passed(const struct gas_cut *cut, int axis, int side)
{
    size_t faces = cut && cut->open[axis][side] ? GAS_PASSED : 0;
    for (int k = 0; k < 3 && faces; k++)
        faces *= k == axis ? 1 : (size_t)(cut->high[k] - cut->low[k]);
    return faces;
}

/* Room for what has passed through the faces of the cut. */
static struct error *reserve_passed(struct gas *gas)
{
    size_t most = 1;
    for (int axis = 0; axis < 3; axis++) {
        const size_t both = numbers_passed(gas->cut, axis, 0) + numbers_passed(gas->cut, axis, 1);
        most = both > most ? both : most;
    }
    free(gas->kept_passed);
    gas->kept_passed = memory_allocate(most * sizeof *gas->kept_passed);
    return gas->kept_passed ? NULL : out_of_memory_for("strips of cells");
}

struct error *gas_plan_strips(struct gas *gas, int threads)
{
    const struct cell_blocks *cells = gas->cells;
    TRY(reserve_through(gas, threads));
    TRY(reserve_passed(gas));
    for (int axis = 0; axis < cells->dimension; axis++) {
        struct gas_strips *strips = &gas->strips[axis];
        free_strips(strips);
        const size_t room = (size_t)cells->blocks + 1;
        strips->block = memory_allocate(room * sizeof *strips->block);
        strips->strip = memory_allocate(2 * room * sizeof *strips->strip);
        if (!strips->block || !strips->strip)
            return out_of_memory_for("strips of cells");
        make_strips(gas, axis, strips);
    }
    return NULL;
}

/* Whether block B holds the same gas at rest as block A, which is still. */
static bool is_alike(const struct gas *gas, int32_t a, int32_t b)
{
    const int32_t i = gas->cells->block[a].first, j = gas->cells->block[b].first;
    return !gas->block[b].awake && gas->u[GAS_DENSITY][i] == gas->u[GAS_DENSITY][j] &&
           gas->u[GAS_ENERGY][i] == gas->u[GAS_ENERGY][j] &&
           (!gas->layout.two || (gas->u[GAS_SECOND][i] == gas->u[GAS_SECOND][j] &&
                                 gas->u[GAS_FRACTION][i] == gas->u[GAS_FRACTION][j]));
}

/* Whether a face that a coupling watches may lie across the strip. */
static bool is_cut(const struct gas *gas, const struct gas_strip *strip, int axis)
{
    const struct gas_cut *cut = gas->cut;
    const struct cell_block *first = &gas->cells->block[strip->block[0]],
                            *last = &gas->cells->block[strip->block[strip->count - 1]];
    bool inside = cut != NULL && first->level == 0;
    for (int k = 0; k < 3 && inside; k++)
        inside =
            cut->low[k] <= last->corner[k] + last->count[k] && cut->high[k] >= first->corner[k];
    return inside && (cut->open[axis][0] || cut->open[axis][1]);
}

/* Of a plane across AXIS. */
static int rows_across(const struct cell_block *block, int axis)
{
    return cell_block_cells(block) / block->count[axis];
}

/* Whether a plane beyond an end of block B along AXIS holds what block A does, which is still. */
static bool is_plane_alike(const struct gas *gas, int32_t a, int axis, int32_t b, int32_t plane)
{
    const int rows = rows_across(&gas->cells->block[b], axis);
    const int32_t first = gas->cells->block[a].first;
    bool alike = true;
    for (int n = 0; n < gas->layout.fields && alike; n++) {
        const double *number = cell_plane(&gas->halo, gas->cells->dimension, axis, plane, n);
        const double own = n == gas->layout.open ? 1.0 : gas->u[n][first];
        for (int row = 0; row < rows; row++)
            alike &= number[row] == own;
    }
    return alike;
}

/* Whether the copy B of another rank's block holds what block A does, which is still. */
static bool is_copy_alike(const struct gas *gas, int32_t a, int32_t b)
{
    const struct cell_block *copy = &gas->cells->block[b];
    const int32_t first = gas->cells->block[a].first, end = copy->first + cell_block_cells(copy);
    bool alike = true;
    for (int n = 0; n < gas->layout.written && alike; n++)
        for (int32_t i = copy->first; i < end; i++)
            alike &= gas->u[n][i] == gas->u[n][first];
    return alike;
}

/* Whether block A and what is beyond an end of block B along AXIS hold the same gas at rest. */
static bool is_alike_beyond(const struct gas *gas, int32_t a, int axis, int32_t b, int side)
{
    const struct gas_seam_end *seam = gas_seam_end(gas, axis, b, side);
    const struct cell_halo_axis *halo = &gas->halo.axis[axis];
    bool alike = true;
    for (int k = 0; seam && k < seam->besides && alike; k++)
        alike = seam->beside[k] < gas->cells->blocks ? is_alike(gas, a, seam->beside[k])
                                                     : is_copy_alike(gas, a, seam->beside[k]);
    for (int depth = 0; !seam && depth < gas->halo.depth && alike; depth++) {
        const struct cell_source *source = &halo->beyond[b][side][depth];
        alike = source->block >= 0 ? is_alike(gas, a, source->block)
                                   : is_plane_alike(gas, a, axis, b, source->at);
    }
    return alike;
}

/* A sweep leaves one gas at rest as it is, to the bit, whatever the step is: fluxes are its
 * pressure everywhere. What it knows of the blocks is as they are before the sweep. */
static bool may_sleep(const struct gas *gas, const struct gas_strip *strip, int axis)
{
    const int32_t first = strip->block[0], last = strip->block[strip->count - 1];
    if (gas->block[first].awake || is_cut(gas, strip, axis))
        return false;
    for (int k = 1; k < strip->count; k++)
        if (!is_alike(gas, first, strip->block[k]))
            return false;
    return is_alike_beyond(gas, first, axis, first, 0) &&
           is_alike_beyond(gas, first, axis, last, 1);
}

static void copy_block(struct gas *gas, int32_t b)
{
    const struct cell_block *block = &gas->cells->block[b];
    const size_t cells = (size_t)cell_block_cells(block);
    for (int n = 0; n < gas->layout.written; n++)
        memcpy(gas->other[n] + block->first, gas->u[n] + block->first, cells * sizeof(double));
    gas->block[b].same = true;
}

/* Whether a plane beyond an end of block B along AXIS has no shock. */
static bool is_plane_calm(const struct gas *gas, int axis, int32_t b, int32_t plane)
{
    const int rows = rows_across(&gas->cells->block[b], axis);
    const double *shock = cell_plane(&gas->halo, gas->cells->dimension, axis, plane, GAS_SHOCK);
    bool calm = true;
    for (int row = 0; row < rows; row++)
        calm &= shock[row] == 0.0;
    return calm;
}

/* Whether the copy B of another rank's block has no shock. */
static bool is_copy_calm(const struct gas *gas, int32_t b)
{
    const struct cell_block *copy = &gas->cells->block[b];
    const int32_t end = copy->first + cell_block_cells(copy);
    bool calm = true;
    for (int32_t i = copy->first; i < end; i++)
        calm &= gas->u[GAS_SHOCK][i] == 0.0;
    return calm;
}

/* Whether no shock is beyond an end of block B along AXIS. */
static bool is_calm_beyond(const struct gas *gas, int axis, int32_t b, int side)
{
    const struct gas_seam_end *seam = gas_seam_end(gas, axis, b, side);
    const struct cell_halo_axis *halo = &gas->halo.axis[axis];
    bool calm = true;
    for (int k = 0; seam && k < seam->besides; k++)
        calm &= seam->beside[k] < gas->cells->blocks ? !gas->block[seam->beside[k]].shocked
                                                     : is_copy_calm(gas, seam->beside[k]);
    for (int depth = 0; !seam && depth < gas->halo.depth && calm; depth++) {
        const struct cell_source *source = &halo->beyond[b][side][depth];
        calm = source->block >= 0 ? !gas->block[source->block].shocked
                                  : is_plane_calm(gas, axis, b, source->at);
    }
    return calm;
}

/* Whether no shock is in a strip, in the cells beyond its ends, and in what was written there
 * last. */
static bool is_calm(const struct gas *gas, const struct gas_strip *strip, int axis)
{
    const int32_t first = strip->block[0], last = strip->block[strip->count - 1];
    bool calm = true;
    for (int k = 0; k < strip->count; k++)
        calm &= !gas->block[strip->block[k]].shocked && !gas->block[strip->block[k]].stale;
    return calm && is_calm_beyond(gas, axis, first, 0) && is_calm_beyond(gas, axis, last, 1);
}

/* Which strips of a sweep along AXIS sleep, of those with planes beyond their ends (OPEN) or of the
 * others; blocks that do not are awake for the rest of the step. */
static void choose_strips(struct gas *gas, const struct simulation *simulation, int axis, bool open)
{
    struct gas_strips *strips = &gas->strips[axis];
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t s = 0; s < strips->count; s++)
        if (strips->strip[s].open == open) {
            strips->strip[s].sleeps = may_sleep(gas, &strips->strip[s], axis);
            strips->strip[s].calm = is_calm(gas, &strips->strip[s], axis);
        }
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t s = 0; s < strips->count; s++)
        for (int k = 0; strips->strip[s].open == open && k < strips->strip[s].count; k++) {
            const int32_t b = strips->strip[s].block[k];
            if (!strips->strip[s].sleeps) {
                gas->block[b].awake = true;
                gas->block[b].same = false;
            } else if (!gas->block[b].same)
                copy_block(gas, b);
            gas->block[b].work += strips->strip[s].sleeps ? 1 : SWEEP_WORK;
        }
}

/* The strips of a SWEEP, those that are early, while planes are under way, or the others. Whether
 * some cell is left with hardly anything. */
static bool sweep_strips(struct gas *gas, struct simulation *simulation,
                         const struct gas_sweep *sweep, bool early)
{
    const struct gas_strips *strips = &gas->strips[sweep->axis];
    const int32_t first = early ? 0 : strips->early, end = early ? strips->early : strips->count;
    bool spent = false;
#pragma omp parallel num_threads(simulation->threads) reduction(|| : spent)
    {
        struct ledger own = {0};
        struct gas_through *of = &gas->through[omp_get_thread_num()];
#pragma omp for schedule(dynamic)
        for (int32_t s = first; s < end; s++) {
            if (strips->strip[s].sleeps && !strips->strip[s].bounds)
                continue;
            gas_sweep_strip(sweep, &strips->strip[s], of);
            spent = spent || of->spent;
            gas_keep_fluxes(gas, sweep->axis, &strips->strip[s], of);
            gas_book(gas, simulation, &strips->strip[s], of, sweep->axis, sweep->dt, &own);
            if (early && omp_get_thread_num() == 0)
                cell_halo_advance(&gas->halo, sweep->axis);
        }
#pragma omp critical(bolide_gas_sweep)
        ledger_join(&simulation->ledger, &own);
    }
    return spent;
}

/* What sweeps have written becomes the state. */
static void take_written(struct gas *gas, struct cell_blocks *cells)
{
    for (int n = 0; n < gas->layout.written; n++) {
        for (int k = 0; k < cells->fields; k++)
            if (cells->field[k].data == (void *)gas->u[n])
                cells->field[k].data = gas->other[n];
        double *written = gas->other[n];
        gas->other[n] = gas->u[n];
        gas->u[n] = written;
    }
    for (int32_t b = 0; b < cells->blocks; b++) {
        gas->block[b].stale = gas->block[b].shocked;
        gas->block[b].shocked = gas->shocked[b];
        gas->shocked[b] = false;
    }
    cells->density = gas->u[GAS_DENSITY];
}

/* Keeps what a sweep along AXIS changes before its state is taken, or brings it back. */
static void keep_books(struct gas *gas, struct simulation *simulation, int axis, bool back)
{
    struct ledger *from = back ? &gas->kept_ledger : &simulation->ledger,
                  *to = back ? &simulation->ledger : &gas->kept_ledger;
    double *kept = gas->kept_passed;
    *to = *from;
    for (int side = 0; side < 2; side++) {
        const size_t count = numbers_passed(gas->cut, axis, side);
        if (count)
            memcpy(back ? gas->cut->passed[axis][side] : kept,
                   back ? kept : gas->cut->passed[axis][side], count * sizeof *kept);
        kept += count;
    }
    if (back)
        memset(gas->shocked, 0, (size_t)gas->cells->blocks * sizeof *gas->shocked);
}

/* Collective: sweeps along AXIS over DT from the time BEGIN into what is not the state yet. SPENT:
 * some cell of some rank is left with hardly anything. */
static struct error *sweep_once(struct gas *gas, struct simulation *simulation, int axis,
                                double begin, double dt, bool *spent)
{
    struct cell_blocks *cells = gas->cells;
    struct gas_sweep sweep = {.cells = cells,
                              .halo = &gas->halo,
                              .closure = gas_closure_of(gas),
                              .layout = &gas->layout,
                              .thaws = gas->thaws,
                              .axis = axis,
                              .r = dt / cells->edge,
                              .round = axis == 0 ? gas->round : 0,
                              .shocked = gas->shocked,
                              .second_order = gas->second_order,
                              .riemann = gas->riemann,
                              .scheme = gas->scheme,
                              .cut = gas->cut,
                              .joins = cells->levels > 1,
                              .dt = dt};
    if (!gas->second_order) /* Lax-Wendroff takes explosives for burnt */
        sweep.closure.lit = NULL;
    memcpy(sweep.from, gas->u, sizeof sweep.from);
    memcpy(sweep.to, gas->other, sizeof sweep.to);
    choose_strips(gas, simulation, axis, false);
    gas_forget_fluxes(gas, axis);
    cell_halo_start(&gas->halo, cells, axis, sweep.from);
    cell_copies_start(&gas->copies, cells, sweep.from);
    bool own = sweep_strips(gas, simulation, &sweep, true);
    simulation_end_phase(simulation, PHASE_BLOCKS, "sweeps");
    cell_halo_finish(&gas->halo, axis);
    cell_copies_finish(&gas->copies, cells, gas->u);
    simulation_end_waiting(simulation);
    gas_fill_seams(gas, axis, simulation->threads);
    struct error *error = gas_fill_planes(gas, simulation, axis, begin + 0.5 * dt);
    if (!error) {
        choose_strips(gas, simulation, axis, true);
        own |= sweep_strips(gas, simulation, &sweep, false);
    }
    gas_pass_fluxes(gas, axis);
    own |= gas_match_seams(gas, axis, dt, simulation->threads);
    simulation_end_phase(simulation, PHASE_BLOCKS, "sweeps");
    double any = own;
    error = ranks_agree_on(simulation->ranks, error, &any, 1);
    *spent = any > 0.0;
    simulation_end_waiting(simulation);
    return error;
}

/* Says so the first time in a run. */
static void note_repetition(struct simulation *simulation)
{
    for (int k = 0; k < simulation->events; k++)
        if (simulation->event[k].name == gas_repetition && isnan(simulation->event[k].time))
            simulation_event(simulation, gas_repetition, simulation->time);
}

static struct error *sweep_parts(struct gas *gas, struct simulation *simulation, int axis,
                                 double begin, double dt, int halvings)
{
    bool spent;
    keep_books(gas, simulation, axis, false);
    TRY(sweep_once(gas, simulation, axis, begin, dt, &spent));
    if (!spent || halvings == 0) {
        take_written(gas, gas->cells);
        return NULL;
    }
    keep_books(gas, simulation, axis, true);
    note_repetition(simulation);
    TRY(sweep_parts(gas, simulation, axis, begin, 0.5 * dt, halvings - 1));
    return sweep_parts(gas, simulation, axis, begin + 0.5 * dt, 0.5 * dt, halvings - 1);
}

struct error *gas_sweep(struct gas *gas, struct simulation *simulation, int axis, double dt)
{
    enum { HALVINGS = 5 };
    return sweep_parts(gas, simulation, axis, simulation->time, dt, HALVINGS);
}
