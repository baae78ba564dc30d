/* Levels of cells; see cells.h. A level's edge is at least the sum of the reaches of two of its
 * points, so that points of one level are found in adjacent cells; between levels the range is the
 * mean of the two edges. */
#include "particle/cells.h"

#include "parallel/block.h"

/* A key: five bits of level on top, the coordinates share the rest. */
static int axis_bits(int dimension) { return dimension == 1 ? 57 : dimension == 2 ? 28 : 19; }

static int64_t axis_limit(int dimension) { return (int64_t)1 << (axis_bits(dimension) - 1); }

static double level_edge(const struct cells *cells, int level)
{
    return ldexp(cells->edge, level - CELL_LEVEL_ZERO);
}

static uint64_t key_of(const struct cells *cells, int level, const int64_t at[3])
{
    const int dimension = cells->dimension, bits = axis_bits(dimension);
    uint64_t key = (uint64_t)level;
    assert(dimension <= 3);
    for (int axis = 0; axis < dimension; axis++)
        key = key << bits | (uint64_t)(at[axis] + axis_limit(dimension));
    return key;
}

static int level_of_key(const struct cells *cells, uint64_t key)
{
    return (int)(key >> axis_bits(cells->dimension) * cells->dimension);
}

/* The smallest level whose edge holds the support of two such points. */
static int level_of_reach(const struct cells *cells, double reach)
{
    int exponent;
    double ratio = 2.0 * reach / cells->edge;
    double fraction =
        frexp(ratio, &exponent); /* ratio = fraction 2^exponent, 1/2 <= fraction < 1 */
    int level = CELL_LEVEL_ZERO + exponent - (fraction == 0.5);
    return level < 0 ? 0 : level >= CELL_LEVELS ? CELL_LEVELS - 1 : level;
}

static uint64_t slot_of(const struct cells *cells, uint64_t key)
{
    return (key * 0x9e3779b97f4a7c15u >> 20) & (cells->slots - 1);
}

static int32_t find_cell(const struct cells *cells, uint64_t key)
{
    for (uint64_t s = slot_of(cells, key);; s = (s + 1) & (cells->slots - 1)) {
        int32_t cell = cells->slot[s] - 1;
        if (cell < 0 || cells->cell[cell].key == key)
            return cell;
    }
}

/* Where a cell ends up among those of like slot depends on who comes first, what is found there
 * does not. */
static void index_cells(struct cells *cells, int threads)
{
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int32_t c = 0; c < cells->count; c++) {
        uint64_t s = slot_of(cells, cells->cell[c].key);
        int32_t empty = 0;
        while (!__atomic_compare_exchange_n(&cells->slot[s], &empty, c + 1, false, __ATOMIC_RELAXED,
                                            __ATOMIC_RELAXED)) {
            s = (s + 1) & (cells->slots - 1);
            empty = 0;
        }
    }
}

/* The first cell of LEVEL or a higher one. */
static int32_t first_of_level(const struct cells *cells, int level)
{
    int32_t low = 0, high = cells->count;
    while (low < high) {
        int32_t middle = low + (high - low) / 2;
        if (level_of_key(cells, cells->cell[middle].key) < level)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static uint64_t key_of_point(const struct cells *cells, const struct cell_point *point)
{
    int level = level_of_reach(cells, point->reach);
    double edge = level_edge(cells, level), x[3] = {point->x, point->y, point->z};
    int64_t at[3] = {0, 0, 0};
    const int dimension = cells->dimension;
    assert(dimension <= 3);
    for (int axis = 0; axis < dimension; axis++)
        at[axis] = cell_index(x[axis], edge, axis_limit(dimension));
    return key_of(cells, level, at);
}

/* Of the sort. The cells come to stand in its spare room, the slots in that of the entries, once
 * these have been used. */
enum { SLOTS_LEAST = 64 };
static size_t room_for(int32_t count)
{
    return (size_t)(count > SLOTS_LEAST ? count : SLOTS_LEAST) * sizeof(struct keyed);
}

size_t cells_bytes(int32_t count)
{
    return (size_t)count * sizeof(struct cell_point) + 2 * room_for(count);
}

void cells_make(struct cells *cells, int dimension, double edge, struct cell_points points,
                struct scratch *scratch, int threads)
{
    const int32_t count = points.count;
    static_assert(sizeof(struct key_run) <= sizeof(struct keyed), "cells fit in the spare room");
    struct keyed *entry = scratch_part(scratch, room_for(count));
    struct keyed *spare = scratch_part(scratch, room_for(count));
    *cells = (struct cells){.dimension = dimension, .edge = edge, .points = count};
    cells->point = scratch_part(scratch, (size_t)count * sizeof *cells->point);
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int32_t i = 0; i < count; i++) {
        const struct cell_point point = points.point_of(points.context, i);
        entry[i] = (struct keyed){key_of_point(cells, &point), i};
    }
    radix_sort(entry, spare, count, threads);
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int32_t k = 0; k < count; k++)
        cells->point[k] = points.point_of(points.context, entry[k].index);
    cells->cell = (struct key_run *)spare;
    cells->count = radix_runs(entry, count, threads, cells->cell);
    cells->slots = SLOTS_LEAST;
    while (cells->slots < 2 * (uint64_t)cells->count) /* four a cell at most */
        cells->slots *= 2;
    cells->slot = (int32_t *)entry;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (uint64_t s = 0; s < cells->slots; s++)
        cells->slot[s] = 0;
    index_cells(cells, threads);
    for (int level = 0; level <= CELL_LEVELS; level++)
        cells->level_begin[level] = first_of_level(cells, level);
}

/* The range of cells of level OTHER that lie within range of a cell AT of LEVEL. Returns their
 * number. */
static double range_of(const struct cells *cells, int level, const int64_t at[3], int other,
                       int64_t low[3], int64_t high[3])
{
    double own = level_edge(cells, level), edge = level_edge(cells, other);
    double range = 0.5 * (own + edge), number = 1.0;
    int64_t limit = axis_limit(cells->dimension);
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = high[axis] = 0;
        if (axis >= cells->dimension)
            continue;
        if (level == other) {
            low[axis] = at[axis] - 1;
            high[axis] = at[axis] + 1;
        } else {
            low[axis] = cell_index((double)at[axis] * own - range, edge, limit);
            high[axis] = cell_index((double)(at[axis] + 1) * own + range, edge, limit);
        }
        /* What lies beyond the countable cells sits in the outermost ones, which have no outer
         * end. */
        low[axis] = low[axis] < -limit || at[axis] == -limit ? -limit : low[axis];
        high[axis] = high[axis] >= limit || at[axis] == limit - 1 ? limit - 1 : high[axis];
        number *= (double)(high[axis] - low[axis] + 1);
    }
    return number;
}

static void run_cell(const struct cells *cells, int32_t cell, cells_run *run, void *context)
{
    run(context, cells->point + cells->cell[cell].first, cells->cell[cell].count);
}

void cells_around(const struct cells *cells, int32_t cell, cells_run *run, void *context)
{
    uint64_t key = cells->cell[cell].key;
    int level = level_of_key(cells, key), bits = axis_bits(cells->dimension);
    int64_t at[3] = {0, 0, 0};
    for (int axis = cells->dimension - 1; axis >= 0; axis--, key >>= bits)
        at[axis] = (int64_t)(key & (((uint64_t)1 << bits) - 1)) - axis_limit(cells->dimension);
    for (int other = 0; other < CELL_LEVELS; other++) {
        int32_t begin = cells->level_begin[other], end = cells->level_begin[other + 1];
        if (begin == end)
            continue;
        int64_t low[3], high[3], a[3];
        if (range_of(cells, level, at, other, low, high) > (double)(end - begin)) {
            for (int32_t c = begin; c < end; c++)
                run_cell(cells, c, run, context);
            continue;
        }
        for (a[0] = low[0]; a[0] <= high[0]; a[0]++)
            for (a[1] = low[1]; a[1] <= high[1]; a[1]++)
                for (a[2] = low[2]; a[2] <= high[2]; a[2]++) {
                    int32_t found = find_cell(cells, key_of(cells, other, a));
                    if (found >= 0)
                        run_cell(cells, found, run, context);
                }
    }
}
