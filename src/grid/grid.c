/* Blocks of nodes, and the sums of patches; see grid.h. */
#include "grid/grid.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

static struct error *no_room(const struct grid *grid)
{
    return out_of_memory_for("a grid of %d blocks", grid->blocks);
}

/* The offsets of CODE; false for one that patches do not reach. */
static bool offsets_of(const struct grid *grid, int code, int offset[3])
{
    bool reached = true;
    for (int axis = 2; axis >= 0; axis--, code /= 3) {
        offset[axis] = code % 3 - 1;
        reached &=
            offset[axis] == 0 || (axis < grid->dimension && (offset[axis] > 0 || grid->reach > 0));
    }
    return reached;
}

static struct grid_overlap overlap_of(const struct grid *grid, int code)
{
    const int cells = block_cells(grid->dimension);
    struct grid_overlap o = {{1, 1, 1}, {0, 0, 0}, {0, 0, 0}};
    int offset[3];
    if (!offsets_of(grid, code, offset))
        return o;
    for (int axis = 0; axis < grid->dimension; axis++) {
        o.from[axis] = offset[axis] < 0 ? cells - grid->reach : 0;
        o.count[axis] = offset[axis] == 0 ? cells : offset[axis] < 0 ? grid->reach : grid->after;
        o.at[axis] = o.from[axis] + offset[axis] * cells + grid->reach;
    }
    return o;
}

void grid_start(struct grid *grid, int dimension, struct shape_window window)
{
    *grid = (struct grid){.dimension = dimension, .reach = window.before, .after = window.after};
    grid->side = block_cells(dimension) + window.before + window.after;
    grid->patch = 1;
    for (int axis = 0; axis < dimension; axis++)
        grid->patch *= grid->side;
    for (int code = 0; code < GRID_AROUND; code++)
        grid->overlap[code] = overlap_of(grid, code);
}

void grid_free(struct grid *grid)
{
    free(grid->key);
    free(grid->around);
    free(grid->touch);
    free(grid->bin_key);
    block_table_free(&grid->table);
    *grid = (struct grid){0};
}

static bool same_bins(const struct grid *grid, const struct bins *bins)
{
    if (!grid->blocks || bins->count != grid->bins)
        return false;
    for (int32_t b = 0; b < bins->count; b++)
        if (bins->bin[b].key != grid->bin_key[b])
            return false;
    return true;
}

static int compare_keys(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return x < y ? -1 : x > y;
}

/* The keys of all blocks that patches reach into, ascending. */
static struct error *find_blocks(struct grid *grid, const struct bins *bins)
{
    if (!memory_reserve((void **)&grid->key, &grid->block_capacity,
                        (int64_t)bins->count * GRID_AROUND, 0, sizeof *grid->key) ||
        !block_table_clear(&grid->table, (int64_t)bins->count * GRID_AROUND))
        return no_room(grid);
    for (int32_t b = 0; b < bins->count; b++) {
        int64_t own[3];
        int offset[3];
        block_coordinates(bins->bin[b].key, own);
        for (int code = 0; code < GRID_AROUND; code++) {
            if (!offsets_of(grid, code, offset))
                continue;
            const int64_t at[3] = {own[0] + offset[0], own[1] + offset[1], own[2] + offset[2]};
            const uint64_t key = block_key(at);
            grid->key[block_table_add(&grid->table, key)] = key;
        }
    }
    grid->blocks = grid->table.count;
    if (grid->blocks)
        qsort(grid->key, (size_t)grid->blocks, sizeof *grid->key, compare_keys);
    if (!block_table_clear(&grid->table, grid->blocks))
        return no_room(grid);
    for (int32_t n = 0; n < grid->blocks; n++)
        block_table_add(&grid->table, grid->key[n]);
    return NULL;
}

/* Which patches cover which blocks. Bins come in the order of keys, so that the touches of a block
 * do. */
static void join(struct grid *grid, const struct bins *bins)
{
    for (int32_t n = 0; n < grid->blocks; n++)
        for (int t = 0; t < GRID_AROUND; t++)
            grid->touch[n][t].bin = -1;
    for (int32_t b = 0; b < bins->count; b++) {
        int64_t own[3];
        int offset[3];
        block_coordinates(bins->bin[b].key, own);
        grid->bin_key[b] = bins->bin[b].key;
        for (int code = 0; code < GRID_AROUND; code++) {
            grid->around[b][code] = -1;
            if (!offsets_of(grid, code, offset))
                continue;
            const int64_t at[3] = {own[0] + offset[0], own[1] + offset[1], own[2] + offset[2]};
            const int32_t n = block_table_find(&grid->table, block_key(at));
            grid->around[b][code] = n;
            struct grid_touch *touch = grid->touch[n];
            while (touch->bin >= 0)
                touch++;
            *touch = (struct grid_touch){b, code};
        }
    }
}

struct error *grid_plan(struct grid *grid, const struct bins *bins)
{
    if (same_bins(grid, bins))
        return NULL;
    TRY(find_blocks(grid, bins));
    if (!memory_reserve((void **)&grid->around, &grid->bin_capacity, bins->count, 0,
                        sizeof *grid->around) ||
        !memory_reserve((void **)&grid->bin_key, &grid->bin_key_capacity, bins->count, 0,
                        sizeof *grid->bin_key) ||
        !memory_reserve((void **)&grid->touch, &grid->touch_capacity, grid->blocks, 0,
                        sizeof *grid->touch))
        return no_room(grid);
    grid->bins = bins->count;
    join(grid, bins);
    return NULL;
}

struct error *grid_patches_reserve(struct grid_field *field, const struct grid *grid)
{
    const int64_t patches = (int64_t)grid->bins * grid->patch;
    const size_t bytes = (size_t)field->stride * sizeof(double);
    return memory_reserve((void **)&field->patch, &field->patch_capacity, patches, 0, bytes)
               ? NULL
               : no_room(grid);
}

struct error *grid_field_reserve(struct grid_field *field, const struct grid *grid)
{
    const int64_t nodes = (int64_t)grid->blocks * BLOCK_CELLS;
    const size_t bytes = (size_t)field->stride * sizeof(double);
    return memory_reserve((void **)&field->node, &field->node_capacity, nodes, 0, bytes)
               ? grid_patches_reserve(field, grid)
               : no_room(grid);
}

void grid_field_free(struct grid_field *field)
{
    free(field->node);
    free(field->patch);
    *field = (struct grid_field){.stride = field->stride};
}

/* Adds LENGTH numbers of a row of nodes to those of another, four at a time while there are. */
static inline void add_row(double *restrict to, const double *restrict from, int length)
{
    int k = 0;
    for (; k + 4 <= length; k += 4)
        for (int c = 0; c < 4; c++)
            to[k + c] += from[k + c];
    for (; k < length; k++)
        to[k] += from[k];
}

/* Where a node is in a box of SIDE nodes along each axis. */
static inline size_t place_at(int dimension, int side, const int at[3])
{
    size_t place = 0;
    for (int axis = 0; axis < dimension; axis++)
        place = place * (size_t)side + (size_t)at[axis];
    return place;
}

/* Adds the overlap of a patch to a block's nodes, or copies it from these. */
static inline void meet(const struct grid *grid, int code, double *node, double *patch, int stride,
                        bool spread)
{
    const int dimension = grid->dimension, cells = block_cells(dimension);
    const struct grid_overlap *o = &grid->overlap[code];
    assert(dimension >= 1 && dimension <= 3);
    /* rows run along the last axis; the axes before it are A and B */
    const int rows_a = dimension > 1 ? o->count[0] : 1, rows_b = dimension > 2 ? o->count[1] : 1;
    const int length = o->count[dimension - 1] * stride, in_block = cells * stride,
              in_patch = grid->side * stride;
    node += place_at(dimension, cells, o->from) * (size_t)stride;
    patch += place_at(dimension, grid->side, o->at) * (size_t)stride;
    for (int a = 0; a < rows_a; a++) {
        double *own = node + a * in_block * (dimension > 2 ? cells : 1);
        double *other = patch + a * in_patch * (dimension > 2 ? grid->side : 1);
        for (int b = 0; b < rows_b; b++, own += in_block, other += in_patch)
            if (spread)
                memcpy(other, own, (size_t)length * sizeof *own);
            else
                add_row(own, other, length);
    }
}

void grid_reduce(const struct grid *grid, struct grid_field *field, int32_t block)
{
    double *node = grid_node(field, block, 0);
    memset(node, 0, (size_t)(BLOCK_CELLS * field->stride) * sizeof *node);
    for (int t = 0; t < GRID_AROUND && grid->touch[block][t].bin >= 0; t++)
        meet(grid, grid->touch[block][t].code, node,
             grid_patch(grid, field, grid->touch[block][t].bin), field->stride, false);
}

void grid_spread(const struct grid *grid, struct grid_field *field, int32_t bin)
{
    for (int code = 0; code < GRID_AROUND; code++)
        if (grid->around[bin][code] >= 0)
            meet(grid, code, grid_node(field, grid->around[bin][code], 0),
                 grid_patch(grid, field, bin), field->stride, true);
}

double *grid_node_at(const struct grid *grid, const struct grid_field *field, const int64_t at[3])
{
    const int cells = block_cells(grid->dimension);
    int64_t block[3] = {0, 0, 0};
    int k = 0;
    for (int axis = 0; axis < grid->dimension; axis++) {
        block[axis] = block_of_cell(at[axis], cells);
        k = k * cells + (int)(at[axis] - block[axis] * cells);
    }
    int32_t n = block_table_find(&grid->table, block_key(block));
    return n < 0 ? NULL : grid_node(field, n, k);
}
