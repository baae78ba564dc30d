/* Where levels of cells meet: what cells of one level see of the other, and fluxes that both have.
 *
 * A coarse cell beyond an end is the mean of the fine ones in its place. Fine cells beyond an end
 * are parts of a coarse one, which changes inside it by limited slopes (inner.h): none of the parts
 * has less than a quarter of the least density or pressure of its neighbours. Once all strips are
 * swept, coarse cells take the mean of the fluxes through the fine faces in place of their own. The
 * fraction of the second material, which changes by d alpha = -dt/h (V - alpha u), takes the means
 * of both V, what flows of its volume, and u, the speed of the faces. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "gas/inner.h"
#include "gas/states.h"
#include "grid/levels.h"
#include "parallel/block.h"

/* The axes across a sweep, the lower first, and how many cells of the next finer level there are
 * beside one along them. */
struct crosswise {
    int first, second, firsts, seconds;
};

static struct crosswise crosswise_of(int dimension, int axis)
{
    const struct gas_axes axes = gas_axes_of(axis);
    const int *across = axes.across;
    return (struct crosswise){across[0], across[1], across[0] < dimension ? 2 : 1,
                              across[1] < dimension ? 2 : 1};
}

/* Cell AT in cells twice as wide or, with UP -1, half as wide: then the first of them. */
static void change_level(int dimension, const int64_t at[3], int up, int64_t to[3])
{
    for (int axis = 0; axis < 3; axis++)
        to[axis] = axis >= dimension ? 0 : up > 0 ? block_of_cell(at[axis], 2) : 2 * at[axis];
}

static bool holds(const struct cell_block *block, const int64_t at[3])
{
    bool holds = true;
    for (int axis = 0; axis < 3; axis++)
        holds &=
            at[axis] >= block->corner[axis] && at[axis] < block->corner[axis] + block->count[axis];
    return holds;
}

/* The block that covers cell AT of LEVEL; LIKELY are tried first. NULL outside the domain. */
static const struct cell_block *find(const struct cell_blocks *cells, int level,
                                     const int64_t at[3], const struct cell_block *const likely[2])
{
    int64_t part[3];
    change_level(cells->dimension, at, -1, part);
    for (int k = 0; k < 2; k++)
        if ((likely[k]->level == level && holds(likely[k], at)) ||
            (likely[k]->level == level - 1 && holds(likely[k], part)))
            return likely[k];
    return cell_block_cover(cells, level, at);
}

/* The fields that sweeps write of the cell at WHERE of LEVEL: its own, or the means of its parts,
 * which have the shocks of all of them. False where it is outside the domain or a part of a wider
 * cell. */
static bool take(const struct gas *gas, int level, const int64_t where[3],
                 const struct cell_block *const likely[2], double *number)
{
    const struct cell_blocks *cells = gas->cells;
    int64_t at[3] = {where[0], where[1], where[2]};
    cell_into_domain(cells, level, at);
    const struct cell_block *block = find(cells, level, at, likely);
    if (!block || block->level > level)
        return false;
    if (block->level == level) {
        const int32_t i = cell_index_in(block, at);
        for (int n = 0; n < gas->layout.written; n++)
            number[n] = gas->u[n][i];
        return true;
    }
    assert(block->level == level - 1);
    const int parts = 1 << cells->dimension;
    int64_t first[3];
    int32_t part[8] = {0};
    int shock = 0;
    change_level(cells->dimension, at, -1, first);
    for (int k = 0; k < parts; k++) {
        const int64_t place[3] = {first[0] + (k & 1), first[1] + (k >> 1 & 1),
                                  first[2] + (k >> 2 & 1)};
        part[k] = cell_index_in(block, place);
        shock |= (int)gas->u[GAS_SHOCK][part[k]];
    }
    for (int n = 0; n < gas->layout.written; n++) {
        double of[8] = {0.0};
        for (int k = 0; k < parts; k++)
            of[k] = gas->u[n][part[k]];
        number[n] = gas_mean_of_parts(of, parts, gas_upper_part(gas, 0, first[0]));
    }
    number[GAS_SHOCK] = shock;
    return true;
}

/* How much the state MIDDLE of cell AT of LEVEL changes within it along an axis. */
static void find_slope(const struct gas *gas, int level, const int64_t at[3], int axis,
                       const struct cell_block *const likely[2], const struct gas_inner *middle,
                       double slope[INNERS])
{
    struct gas_inner beside[2];
    bool known = true;
    for (int side = 0; side < 2 && known; side++) {
        int64_t to[3] = {at[0], at[1], at[2]};
        double number[GAS_FIELDS];
        to[axis] += side ? 1 : -1;
        known = take(gas, level, to, likely, number);
        if (known)
            beside[side] = gas_inner_of(gas, number);
    }
    memset(slope, 0, INNERS * sizeof *slope);
    if (known)
        gas_inner_slope(&beside[0], middle, &beside[1], slope);
}

/* No cell is blocked here, and none holds an explosive that has yet to burn. */
static void put(const struct gas *gas, int axis, const struct cell_seam *seam, int row,
                const double *number)
{
    for (int n = 0; n < gas->layout.fields; n++)
        cell_plane(&gas->halo, gas->cells->dimension, axis, seam->plane, n)[row] =
            n < gas->layout.written ? number[n] : 1.0;
}

/* Puts the parts, beyond a fine block, of the coarse cell one of which is AT, in row I, J of the
 * SEAMS, so many, that hold them. */
static void put_parts(const struct gas *gas, int axis, const struct cell_seam *seam, int seams,
                      const struct cell_block *const likely[2], const int64_t at[3], int i, int j)
{
    const int dimension = gas->cells->dimension, level = likely[0]->level + 1;
    const struct crosswise across = crosswise_of(dimension, axis);
    double slope[3][INNERS], number[GAS_FIELDS];
    int64_t whole[3];
    change_level(dimension, at, 1, whole);
    take(gas, level, whole, likely, number);
    const struct gas_inner middle = gas_inner_of(gas, number);
    for (int k = 0; k < dimension; k++)
        find_slope(gas, level, whole, k, likely, &middle, slope[k]);
    for (int s = 0; s < seams; s++)
        for (int second = 0; second < across.seconds; second++)
            for (int first = 0; first < across.firsts; first++) {
                int64_t part[3] = {at[0], at[1], at[2]};
                int side[3];
                part[axis] = seam[s].at;
                part[across.first] += first;
                part[across.second] += second;
                for (int k = 0; k < 3; k++)
                    side[k] = (int)(part[k] & 1);
                gas_inner_part(gas, &middle, slope, dimension, side, number);
                put(gas, axis, &seam[s], i + first + (j + second) * likely[0]->count[across.first],
                    number);
            }
}

/* Fills so many SEAMS of a block, whose cells are parts of the same ones where these are wider. */
static void fill_seams(const struct gas *gas, int axis, const struct cell_seam *seam, int seams)
{
    const struct cell_blocks *cells = gas->cells;
    const struct cell_block *own = &cells->block[seam->block];
    const struct crosswise across = crosswise_of(cells->dimension, axis);
    int64_t at[3] = {own->corner[0], own->corner[1], own->corner[2]};
    at[axis] = seam->at;
    const struct cell_block *source = cell_block_cover(cells, own->level, at);
    const bool coarse = source->level > own->level;
    if (!coarse && seams > 1) {
        fill_seams(gas, axis, &seam[0], 1);
        fill_seams(gas, axis, &seam[1], 1);
        return;
    }
    for (int j = 0; j < own->count[across.second]; j += coarse ? across.seconds : 1)
        for (int i = 0; i < own->count[across.first]; i += coarse ? across.firsts : 1) {
            const struct cell_block *const likely[2] = {own, source};
            double mean[GAS_FIELDS];
            at[across.first] = own->corner[across.first] + i;
            at[across.second] = own->corner[across.second] + j;
            if (coarse)
                put_parts(gas, axis, seam, seams, likely, at, i, j);
            else if (take(gas, own->level, at, likely, mean))
                put(gas, axis, seam, i + j * own->count[across.first], mean);
        }
}

/* Whether seam B follows A beyond the same end, and both lie in the same cells twice as wide. */
static bool are_paired(const struct cell_seam *a, const struct cell_seam *b)
{
    return a->block == b->block && block_of_cell(a->at, 2) == block_of_cell(b->at, 2);
}

void gas_fill_seams(const struct gas *gas, int axis, int threads)
{
    const struct cell_halo_axis *halo = &gas->halo.axis[axis];
    if (halo->seams == 0)
        return;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int32_t s = 0; s < halo->seams; s++)
        if (s == 0 || !are_paired(&halo->seam[s - 1], &halo->seam[s]))
            fill_seams(gas, axis, &halo->seam[s],
                       s + 1 < halo->seams && are_paired(&halo->seam[s], &halo->seam[s + 1]) ? 2
                                                                                             : 1);
}

/* The blocks beside an end of BLOCK along AXIS, where they are of another level. */
static void find_beside(const struct cell_blocks *cells, const struct cell_block *block, int axis,
                        int side, struct gas_seam_end *end)
{
    const struct crosswise across = crosswise_of(cells->dimension, axis);
    end->besides = 0;
    for (int k = 0; k < across.firsts * across.seconds; k++) {
        int64_t at[3] = {block->corner[0], block->corner[1], block->corner[2]};
        at[axis] += side ? block->count[axis] : -1;
        at[across.first] += k % across.firsts ? block->count[across.first] - 1 : 0;
        at[across.second] += k / across.firsts ? block->count[across.second] - 1 : 0;
        cell_into_domain(cells, block->level, at);
        const struct cell_block *beside = cell_block_cover(cells, block->level, at);
        if (!beside || beside->level == block->level)
            return;
        if (beside->level < block->level) { /* the part of the cell that is at the corner */
            change_level(cells->dimension, at, -1, at);
            at[axis] += side ? 0 : 1;
            at[across.first] += k % across.firsts;
            at[across.second] += k / across.firsts;
            beside = cell_block_cover(cells, block->level - 1, at);
        }
        end->beside[end->besides++] = (int32_t)(beside - cells->block);
    }
}

void gas_free_seams(struct gas *gas)
{
    for (int axis = 0; axis < 3; axis++) {
        free(gas->seams[axis].end);
        free(gas->seams[axis].came);
        free(gas->seams[axis].of);
        exchange_free(&gas->seams[axis].exchange);
        memset(&gas->seams[axis], 0, sizeof gas->seams[axis]);
    }
}

/* Adds an end of BLOCK along AXIS where it meets another level; of a copy only a fine one beside a
 * coarse block of this rank. False when memory is out. */
static bool add_end(const struct cell_blocks *cells, int axis, int32_t block, int side,
                    struct gas_seams *seams)
{
    struct gas_seam_end end = {.block = block, .side = side};
    seams->of[block][side] = -1;
    find_beside(cells, &cells->block[block], axis, side, &end);
    if (end.besides == 0 ||
        (block >= cells->blocks && (end.beside[0] >= cells->blocks ||
                                    cells->block[end.beside[0]].level < cells->block[block].level)))
        return true;
    if (!memory_reserve((void **)&seams->end, &seams->capacity, seams->count + 1, seams->count,
                        sizeof *seams->end))
        return false;
    seams->of[block][side] = seams->count;
    seams->end[seams->count++] = end;
    return true;
}

static struct error *find_ends(const struct cell_blocks *cells, int axis, struct gas_seams *seams)
{
    const int32_t all = cells->blocks + cells->copies;
    seams->of = memory_allocate(((size_t)all + 1) * sizeof *seams->of);
    bool room = seams->of != NULL;
    for (int32_t b = 0; b < all && room; b++) {
        for (int side = 0; side < 2 && room; side++)
            room = add_end(cells, axis, b, side, seams);
        if (b < cells->blocks)
            seams->own = seams->count;
    }
    return room ? NULL : out_of_memory_for("strips of cells");
}

/* Collective: what flows through fine ends beside copies goes to the ranks that have the blocks. */
static struct error *plan_fluxes(const struct cell_blocks *cells, struct gas_seams *seams)
{
    struct send_item *send = memory_allocate(((size_t)seams->own + 1) * sizeof *send);
    seams->came = memory_allocate((size_t)(seams->count - seams->own + 1) * sizeof *seams->came);
    struct error *error = ranks_agree(
        cells->ranks, send && seams->came ? NULL : out_of_memory_for("strips of cells"));
    int32_t sends = 0;
    for (int32_t k = 0; k < seams->own && !error; k++) {
        const struct gas_seam_end *end = &seams->end[k];
        const struct cell_block *beside = &cells->block[end->beside[0]];
        if (end->beside[0] >= cells->blocks && beside->level > cells->block[end->block].level)
            send[sends++] = (struct send_item){partition_owner(cells->partition, beside->key), k};
    }
    if (!error)
        error = exchange_plan(&seams->exchange, cells->ranks, send, sends);
    if (!error)
        error = ranks_agree(cells->ranks, exchange_reserve(&seams->exchange, sizeof *seams->end));
    assert(error || seams->exchange.comes == seams->count - seams->own);
    free(send);
    return error;
}

struct error *gas_plan_seams(struct gas *gas)
{
    const struct cell_blocks *cells = gas->cells;
    gas_free_seams(gas);
    for (int axis = 0; axis < cells->dimension && cells->levels > 1; axis++) {
        TRY(ranks_agree(cells->ranks, find_ends(cells, axis, &gas->seams[axis])));
        if (cells->ranks->joined)
            TRY(plan_fluxes(cells, &gas->seams[axis]));
    }
    return NULL;
}

void gas_pass_fluxes(struct gas *gas, int axis)
{
    struct gas_seams *seams = &gas->seams[axis];
    if (!cell_blocks_are_spread(gas->cells))
        return;
    exchange_start(&seams->exchange, seams->end, sizeof *seams->end, seams->came);
    exchange_finish(&seams->exchange);
    for (int32_t k = seams->own; k < seams->count; k++) {
        struct gas_seam_end *end = &seams->end[k];
        const struct gas_seam_end *came = &seams->came[k - seams->own];
        end->swept = came->swept;
        memcpy(end->flux, came->flux, sizeof end->flux);
    }
}

struct gas_seam_end *gas_seam_end(const struct gas *gas, int axis, int32_t block, int side)
{
    const struct gas_seams *seams = &gas->seams[axis];
    return seams->of && seams->of[block][side] >= 0 ? &seams->end[seams->of[block][side]] : NULL;
}

void gas_forget_fluxes(const struct gas *gas, int axis)
{
    for (int32_t k = 0; k < gas->seams[axis].count; k++)
        gas->seams[axis].end[k].swept = false;
}

void gas_keep_fluxes(const struct gas *gas, int axis, const struct gas_strip *strip,
                     const struct gas_through *through)
{
    for (int side = 0; side < 2; side++) {
        struct gas_seam_end *end =
            gas_seam_end(gas, axis, strip->block[side ? strip->count - 1 : 0], side);
        if (!end)
            continue;
        memcpy(end->flux, through->end[side], sizeof end->flux);
        end->swept = true;
    }
}

/* The mean of what flows through the fine faces beside row I, J of END; false where none of it
 * differs from what flows through END. */
static bool mean_flux(const struct gas *gas, int axis, const struct gas_seam_end *end, int i, int j,
                      double mean[THROUGH_NUMBERS])
{
    const struct cell_blocks *cells = gas->cells;
    const struct cell_block *own = &cells->block[end->block];
    const struct crosswise across = crosswise_of(cells->dimension, axis);
    const int faces = across.firsts * across.seconds, numbers = gas_numbers_through(&gas->layout);
    int64_t at[3] = {own->corner[0], own->corner[1], own->corner[2]}, part[3];
    at[axis] += end->side ? own->count[axis] : -1;
    at[across.first] += i;
    at[across.second] += j;
    cell_into_domain(cells, own->level, at);
    change_level(cells->dimension, at, -1, part);
    part[axis] += end->side ? 0 : 1;
    const struct cell_block *beside = NULL;
    for (int k = 0; k < end->besides && !beside; k++)
        if (holds(&cells->block[end->beside[k]], part))
            beside = &cells->block[end->beside[k]];
    const struct gas_seam_end *other =
        gas_seam_end(gas, axis, (int32_t)(beside - cells->block), 1 - end->side);
    const int row =
        (int)(part[across.first] - beside->corner[across.first]) +
        (int)(part[across.second] - beside->corner[across.second]) * beside->count[across.first];
    const double upper = gas_upper_part(gas, across.first, part[across.first]);
    for (int n = 0; n < numbers && other->swept; n++) {
        double of[4] = {0.0};
        for (int k = 0; k < faces; k++)
            of[k] = other->flux[row + k % across.firsts +
                                k / across.firsts * beside->count[across.first]][n];
        mean[n] = gas_mean_of_parts(of, faces, upper);
    }
    return other->swept;
}

/* Whether what a sweep leaves of a cell, AFTER, is hardly anything. */
static bool is_spent(const struct gas *gas, const double *before, const double *after)
{
    const double pressure = gas_pressure_of(gas, before);
    return !(after[GAS_DENSITY] > 0.5 * GAS_LEAST * before[GAS_DENSITY] &&
             gas_pressure_of(gas, after) > 0.5 * GAS_LEAST * minimum(pressure, fabs(pressure)));
}

/* Cell I of a block takes the fluxes MEAN in place of FLUX, where R is dt/h with the sign of its
 * side. Whether hardly anything is left of it. */
static bool match_cell(const struct gas *gas, int32_t i, const double *flux, const double *mean,
                       double r)
{
    double before[GAS_FIELDS], after[GAS_FIELDS], change[THROUGH_NUMBERS] = {0.0};
    for (int n = 0; n < gas->layout.written; n++) {
        before[n] = gas->u[n][i];
        after[n] = gas->other[n][i];
    }
    for (int n = 0; n < gas_numbers_through(&gas->layout); n++)
        change[n] = r * (mean[n] - flux[n]);
    for (int n = 0; n < GAS_NUMBERS; n++)
        after[n] += change[n];
    if (gas->layout.two) {
        after[GAS_SECOND] += change[THROUGH_SECOND];
        after[GAS_FRACTION] +=
            change[THROUGH_VOLUME] - before[GAS_FRACTION] * change[THROUGH_SPEED];
        if (gas->layout.afterburns)
            after[GAS_AFTERBURNT] =
                maximum(after[GAS_AFTERBURNT] + change[THROUGH_AFTERBURNT], 0.0);
        gas_settle(gas, after);
    }
    for (int n = 0; n < gas->layout.written; n++)
        gas->other[n][i] = after[n];
    return is_spent(gas, before, after);
}

static bool match_end(const struct gas *gas, int axis, const struct gas_seam_end *end, double dt)
{
    const struct cell_block *own = &gas->cells->block[end->block];
    const struct crosswise across = crosswise_of(gas->cells->dimension, axis);
    const double face = (double)(own->corner[0] + (end->side ? own->count[0] : 0)),
                 middle = (double)(own->corner[0] + (end->side ? own->count[0] - 1 : 0)) + 0.5;
    double r = (end->side ? -dt : dt) / cell_block_edge(gas->cells, own);
    if (axis == 0 && gas->round)
        r *= pow(face, gas->round) / gas_cell_volume(1.0, 1.0, middle, gas->round);
    bool spent = false;
    for (int j = 0; j < own->count[across.second]; j++)
        for (int i = 0; i < own->count[across.first]; i++) {
            double mean[THROUGH_NUMBERS];
            int64_t at[3] = {own->corner[0], own->corner[1], own->corner[2]};
            at[axis] += end->side ? own->count[axis] - 1 : 0;
            at[across.first] += i;
            at[across.second] += j;
            if (mean_flux(gas, axis, end, i, j, mean))
                spent |= match_cell(gas, cell_index_in(own, at),
                                    end->flux[i + j * own->count[across.first]], mean, r);
        }
    return spent;
}

bool gas_match_seams(const struct gas *gas, int axis, double dt, int threads)
{
    const struct gas_seams *seams = &gas->seams[axis];
    bool spent = false;
    if (seams->count == 0)
        return false;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(|| : spent)
    for (int32_t k = 0; k < seams->count; k++) {
        const struct gas_seam_end *end = &seams->end[k];
        const bool coarse =
            gas->cells->block[end->beside[0]].level < gas->cells->block[end->block].level;
        if (coarse && end->swept)
            spent = match_end(gas, axis, end, dt) || spent;
    }
    return spent;
}
