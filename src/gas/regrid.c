/* Cells of several levels follow pressure waves. Every few steps each block asks for the level that
 * its pressures need, one finer or coarser than its own at most: where the pressure bends, cells
 * become finer, and around it before the wave arrives; where it does not, coarser.
 *
 * The measure is that of R. Löhner, Comput. Methods Appl. Mech. Eng. 61 (1987) 323, a second
 * difference over first ones. Small waves do not count.
 *
 * Parts of a coarse cell get its conserved numbers with limited slopes, and a coarse cell the mean
 * of its parts: masses, momentum and energy stay (inner.h). */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "gas/inner.h"
#include "grid/levels.h"
#include "parallel/block.h"

/* Bends from which cells become finer, and below which they become coarser; the change of the
 * pressure over two cells from which it counts; the part of the pressure that is noise. */
static const double FINER = 0.25, COARSER = 0.1, LEAST_CHANGE = 0.01, NOISE = 0.002;

/* Cells around a bend that become finer: more than a wave crosses between two changes. */
enum { AROUND = 4, SIDES = 27 };

/* What a block asks for: its level, and which of the places around it are near a bend of it. */
struct demand {
    int level;
    bool near[SIDES];
};

static double bend_of(double low, double middle, double high)
{
    if (!(minimum(minimum(low, high), middle) > 0.0)) /* an obstacle blocks one */
        return 0.0;
    const double change = fabs(high - low) / minimum(low, high);
    const double bend =
        fabs(high - 2.0 * middle + low) /
        (fabs(high - middle) + fabs(middle - low) + NOISE * (low + 2.0 * middle + high));
    return change < LEAST_CHANGE ? 0.0 : bend;
}

/* Marks the places around BLOCK that lie within AROUND cells of its cell at C. */
static void mark_near(const struct cell_block *block, int dimension, const int c[3],
                      struct demand *demand)
{
    for (int k = 0; k < SIDES; k++) {
        const int to[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
        bool near = true;
        for (int axis = 0; axis < 3; axis++)
            near &= to[axis] == 0 ||
                    (axis < dimension &&
                     (to[axis] < 0 ? c[axis] < AROUND : c[axis] >= block->count[axis] - AROUND));
        demand->near[k] |= near;
    }
}

/* The distance from CENTER to the nearest place of BLOCK. */
static double distance_to(const struct gas *gas, const struct cell_block *block,
                          const struct vector_value *center)
{
    const double edge = cell_block_edge(gas->cells, block);
    double far = 0.0;
    for (int axis = 0; axis < gas->cells->dimension; axis++) {
        const double low = (double)block->corner[axis] * edge,
                     high = low + block->count[axis] * edge,
                     from = center->count ? center->at[axis] : 0.0;
        far += square(maximum(maximum(low - from, from - high), 0.0));
    }
    return sqrt(far);
}

/* The level whose cells are as wide as the nearest place of BLOCK from the centre of the blast lets
 * them be. */
static int level_by_distance(const struct gas *gas, const struct cell_block *block)
{
    const double far = distance_to(gas, block, &gas->parameters.center),
                 edge = gas->parameters.cells_to_front * gas->cells->edge;
    int level = 0;
    while (level + 1 < gas->cells->levels && edge * (double)(2 << level) <= far)
        level++;
    return level;
}

/* What block B asks for by its own pressures. */
static struct demand demand_of(const struct gas *gas, int32_t b)
{
    const struct cell_blocks *cells = gas->cells;
    const struct cell_block *block = &cells->block[b];
    struct demand demand = {.level = block->level};
    double most = 0.0;
    int c[3];
    for (c[2] = 0; c[2] < block->count[2]; c[2]++)
        for (c[1] = 0; c[1] < block->count[1]; c[1]++)
            for (c[0] = 0; c[0] < block->count[0]; c[0]++) {
                const int32_t i = block->first + c[0] * cell_stride(block, 0) +
                                  c[1] * cell_stride(block, 1) + c[2] * cell_stride(block, 2);
                double bend = 0.0;
                for (int axis = 0; axis < cells->dimension; axis++)
                    if (c[axis] > 0 && c[axis] < block->count[axis] - 1)
                        bend =
                            maximum(bend, bend_of(cells->pressure[i - cell_stride(block, axis)],
                                                  cells->pressure[i],
                                                  cells->pressure[i + cell_stride(block, axis)]));
                if (bend > FINER)
                    mark_near(block, cells->dimension, c, &demand);
                most = maximum(most, bend);
            }
    demand.level += most > FINER ? -1 : most > COARSER ? 0 : 1;
    if (distance_to(gas, block, &gas->start_center) < gas->start_reach)
        demand.level = 0;
    int least = isnan(gas->parameters.cells_to_front) ? 0 : level_by_distance(gas, block);
    if (least > block->level + 1)
        least = block->level + 1;
    if (demand.level < least)
        demand.level = least;
    return demand;
}

/* Adds to WANT, which has room, what block B asks for, of itself and around it. */
static int64_t add_wants(const struct gas *gas, int32_t b, const struct demand *demand,
                         struct cell_want *want)
{
    const struct cell_blocks *cells = gas->cells;
    const struct cell_block *block = &cells->block[b];
    int64_t wants = 0;
    for (int k = 0; k < SIDES; k++) {
        const int to[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
        const bool own = to[0] == 0 && to[1] == 0 && to[2] == 0;
        int64_t at[3];
        if (!own && !demand->near[k])
            continue;
        for (int axis = 0; axis < 3; axis++)
            at[axis] = block->corner[axis] + (to[axis] < 0   ? -1
                                              : to[axis] > 0 ? block->count[axis]
                                                             : 0);
        cell_into_domain(cells, block->level, at);
        const struct cell_block *there = own ? block : cell_block_known(cells, block->level, at);
        if (!there)
            continue;
        struct cell_want *of = &want[wants++];
        of->level = demand->level > there->level - 1 ? demand->level : there->level - 1;
        for (int axis = 0; axis < 3; axis++)
            of->at[axis] = axis >= cells->dimension ? 0
                           : of->level > block->level
                               ? block_of_cell(at[axis], (int64_t)1 << (of->level - block->level))
                               : at[axis] * (1 << (block->level - of->level));
    }
    return wants;
}

/* Collective: the blocks that WANT, WANTS of this rank, and what the others want ask for, *COUNT of
 * them. */
static struct error *list_wanted(const struct cell_blocks *cells, const struct cell_want *want,
                                 int64_t wants, struct cell_block **list, int64_t *count)
{
    void *all = NULL;
    int64_t total = 0;
    if (!cell_blocks_are_spread(cells))
        return levels_list(cells, want, wants, list, count);
    TRY(ranks_gather(cells->ranks, -1, want, wants, sizeof *want, &all, &total));
    struct error *error = ranks_agree(cells->ranks, levels_list(cells, all, total, list, count));
    free(all);
    return error;
}

/* Collective: the blocks that the state asks for, *COUNT of them. */
static struct error *ask(const struct gas *gas, int threads, struct cell_block **list,
                         int64_t *count)
{
    const struct cell_blocks *cells = gas->cells;
    const size_t blocks = (size_t)cells->blocks;
    struct demand *demand = memory_allocate((blocks + 1) * sizeof *demand);
    struct cell_want *want = memory_allocate((blocks * SIDES + 1) * sizeof *want);
    int64_t wants = 0;
    struct error *error =
        ranks_agree(cells->ranks, demand && want ? NULL : out_of_memory_for("cells"));
    if (!error) {
#pragma omp parallel for schedule(static) num_threads(threads)
        for (int32_t b = 0; b < cells->blocks; b++)
            demand[b] = demand_of(gas, b);
        for (int32_t b = 0; b < cells->blocks; b++)
            wants += add_wants(gas, b, &demand[b], want + wants);
        error = list_wanted(cells, want, wants, list, count);
    }
    free(demand);
    free(want);
    return error;
}

/* Whether LIST, COUNT blocks, differs from those that CELLS have on all ranks. */
static bool differs(const struct cell_blocks *cells, const struct cell_block *list, int64_t count)
{
    const bool spread = cell_blocks_are_spread(cells);
    const struct cell_block *all = spread ? cells->whole.block : cells->block;
    bool differs = count != (spread ? cells->whole.count : cells->blocks);
    for (int64_t b = 0; b < count && !differs; b++)
        differs = list[b].key != all[b].key || list[b].level != all[b].level;
    return differs;
}

struct error *gas_ask_levels(struct gas *gas, int threads, struct cell_block **list, int64_t *count,
                             bool *changed)
{
    TRY(ask(gas, threads, list, count));
    *changed = differs(gas->cells, *list, *count);
    if (!*changed) {
        free(*list);
        *list = NULL;
    }
    return NULL;
}

/* What goes from one store to another: the old one, and numbers of both. */
struct transfer {
    const struct cell_blocks *from, *to;
    const double *was_open; /* NULL: all cells are */
    double *open;
    const struct gas *gas;
    const double *old[GAS_FIELDS]; /* but `open` */
    double *new[GAS_FIELDS];
};

static void copy_cell(const struct transfer *t, int32_t from, int32_t to)
{
    const struct gas_layout *layout = &t->gas->layout;
    t->to->body[to] = t->from->body[from];
    t->to->material[to] = t->from->material[from];
    if (t->open)
        t->open[to] = t->was_open[from];
    for (int n = 0; n < layout->fields; n++)
        if (n != layout->open)
            t->new[n][to] = t->old[n][from];
}

static void merge_cells(const struct transfer *t, const struct cell_block *old, const int64_t at[3],
                        int32_t to)
{
    const int dimension = t->from->dimension, parts = 1 << dimension;
    double of[GAS_FIELDS][8];
    int shock = 0;
    for (int k = parts - 1; k >= 0; k--) {
        int64_t part[3] = {0, 0, 0};
        for (int axis = 0; axis < dimension; axis++)
            part[axis] = 2 * at[axis] + (k >> axis & 1);
        const int32_t i = cell_index_in(old, part);
        copy_cell(t, i, to);
        for (int n = 0; n < t->gas->layout.written; n++)
            of[n][k] = t->old[n][i];
        shock |= (int)t->old[GAS_SHOCK][i];
    }
    for (int n = 0; n < t->gas->layout.written; n++)
        t->new[n][to] = gas_mean_of_parts(of[n], parts, gas_upper_part(t->gas, 0, 2 * at[0]));
    t->new[GAS_SHOCK][to] = shock;
}

/* Divides cell AT of OLD into its parts in NEW; neighbours in OLD tell how it changes. */
static void divide_cell(const struct transfer *t, const struct cell_block *old, const int64_t at[3],
                        const struct cell_block *new)
{
    const int dimension = t->from->dimension, written = t->gas->layout.written;
    const int32_t i = cell_index_in(old, at);
    double number[7][GAS_FIELDS] = {{0.0}}, part[8][GAS_FIELDS];
    const double *beside[3][2] = {{NULL}};
    for (int n = 0; n < written; n++)
        number[0][n] = t->old[n][i];
    for (int k = 0; k < 2 * dimension; k++) {
        const int64_t c = at[k / 2] - old->corner[k / 2];
        if (c == (k % 2 ? old->count[k / 2] - 1 : 0))
            continue;
        for (int n = 0; n < written; n++)
            number[1 + k][n] = t->old[n][i + (k % 2 ? 1 : -1) * cell_stride(old, k / 2)];
        beside[k / 2][k % 2] = number[1 + k];
    }
    const double upper[3] = {gas_upper_part(t->gas, 0, 2 * at[0]), 0.5, 0.5};
    gas_divide(t->gas, number[0], beside, upper, part);
    for (int k = 0; k < 1 << dimension; k++) {
        int64_t to[3] = {0, 0, 0};
        for (int axis = 0; axis < dimension; axis++)
            to[axis] = 2 * at[axis] + (k >> axis & 1);
        const int32_t j = cell_index_in(new, to);
        copy_cell(t, i, j);
        for (int n = 0; n < written; n++)
            t->new[n][j] = part[k][n];
    }
}

/* Fills block NEW. */
static void fill_block(const struct transfer *t, const struct cell_block *new)
{
    const int dimension = t->from->dimension;
    int64_t at[3];
    int step[3];
    const struct cell_block *old = cell_block_cover(t->from, new->level, new->corner);
    for (int axis = 0; axis < 3; axis++)
        step[axis] = axis < dimension && old->level > new->level ? 2 : 1;
    for (at[2] = new->corner[2]; at[2] < new->corner[2] + new->count[2]; at[2] += step[2])
        for (at[1] = new->corner[1]; at[1] < new->corner[1] + new->count[1]; at[1] += step[1])
            for (at[0] = new->corner[0]; at[0] < new->corner[0] + new->count[0]; at[0] += step[0]) {
                const struct cell_block *source =
                    old->level < new->level ? cell_block_cover(t->from, new->level, at) : old;
                int64_t whole[3] = {0, 0, 0};
                for (int axis = 0; axis < dimension; axis++)
                    whole[axis] = block_of_cell(at[axis], 2);
                if (source->level == new->level)
                    copy_cell(t, cell_index_in(source, at), cell_index_in(new, at));
                else if (source->level < new->level)
                    merge_cells(t, source, at, cell_index_in(new, at));
                else
                    divide_cell(t, source, whole, new);
            }
}

/* Collective: what this rank's part of LIST, COUNT blocks, takes from other ranks comes to it. */
static struct error *fetch(struct gas *gas, struct cell_block *list, int64_t count)
{
    bool moved;
    struct error *error = cell_blocks_fetch(gas->cells, list, count, &moved);
    if (error)
        free(list);
    else if (moved)
        gas_bind(gas, gas->cells);
    return error;
}

/* The state moves into LIST, COUNT blocks, which is taken over. */
static struct error *move(struct gas *gas, struct cell_block *list, int64_t count, int threads)
{
    struct cell_blocks *cells = gas->cells, old;
    struct transfer t = {.from = &old, .to = cells, .was_open = gas->open, .gas = gas};
    memcpy(t.old, gas->u, sizeof t.old);
    struct error *error = cell_blocks_renew(cells, list, (int32_t)count, &old);
    gas->room = 0; /* sweeps have exchanged arrays of the old store with their own */
    if (!error) {
        gas_bind(gas, cells);
        t.open = gas->open;
        memcpy(t.new, gas->u, sizeof t.new);
#pragma omp parallel for schedule(static) num_threads(threads)
        for (int32_t b = 0; b < cells->blocks; b++)
            fill_block(&t, &cells->block[b]);
    }
    cell_blocks_destroy(&old);
    return error;
}

/* The blocks with those of LEVEL and of coarser levels divided once, *COUNT of them. */
static struct error *divide_from(const struct cell_blocks *cells, int level,
                                 struct cell_block **list, int64_t *count)
{
    int64_t wants = 0;
    struct cell_want *want = memory_allocate(((size_t)cells->blocks + 1) * sizeof *want);
    if (!want)
        return out_of_memory_for("cells");
    for (int32_t b = 0; b < cells->blocks; b++) {
        const struct cell_block *block = &cells->block[b];
        const int up = block->level >= level && block->level > 0 ? 1 : 0;
        want[wants].level = block->level - up;
        for (int axis = 0; axis < 3; axis++)
            want[wants].at[axis] = block->corner[axis] * (axis < cells->dimension ? 1 << up : 1);
        wants++;
    }
    struct error *error = levels_list(cells, want, wants, list, count);
    free(want);
    return error;
}

struct error *gas_refine(struct gas *gas, struct simulation *simulation)
{
    for (int level = gas->cells->levels - 1; level > 0; level--) {
        struct cell_block *list = NULL;
        int64_t count = 0;
        TRY(divide_from(gas->cells, level, &list, &count));
        TRY(move(gas, list, count, simulation->threads));
        TRY(gas_plan(gas, simulation));
        TRY(gas_derive(gas, simulation, NULL));
    }
    return NULL;
}

struct error *gas_regrid(struct gas *gas, struct simulation *simulation)
{
    const int64_t every = gas->parameters.regrid;
    struct cell_block *list = NULL;
    int64_t count = 0;
    bool changed = false;
    if (gas->cells->levels < 2 || every == 0 || simulation->step == 0 ||
        simulation->step % every != 0)
        return NULL;
    if (!gas->unburnt)
        gas->cells->regions = gas->lasting;
    TRY(gas_ask_levels(gas, simulation->threads, &list, &count, &changed));
    if (!changed)
        return NULL;
    TRY(fetch(gas, list, count));
    TRY(ranks_agree(simulation->ranks, move(gas, list, count, simulation->threads)));
    TRY(gas_plan(gas, simulation));
    return ranks_agree(simulation->ranks, gas_derive(gas, simulation, NULL));
}
