/* Levels of cells; see cells.h. A level's edge is at least the sum of the reaches of two of its points, so that points of one level are found in adjacent cells; between levels the range is the mean of the two edges. */
#include "particle/cells.h"

#include <stdlib.h>

#include "base/memory.h"
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

static void index_cells(struct cells *cells)
{
    for (int32_t c = 0; c < cells->count; c++) {
        uint64_t s = slot_of(cells, cells->cell[c].key);
        while (cells->slot[s])
            s = (s + 1) & (cells->slots - 1);
        cells->slot[s] = c + 1;
    }
    int32_t c = 0;
    for (int level = 0; level <= CELL_LEVELS; level++) {
        while (c < cells->count && level_of_key(cells, cells->cell[c].key) < level)
            c++;
        cells->level_begin[level] = c;
    }
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

static struct error *out_of_memory(int32_t count)
{
    return error_new(ERROR_SYSTEM, "out of memory in the neighbour search of %d points", count);
}

static struct error *fill_cells(struct cells *cells, const struct cell_point *points,
                                struct keyed *entry, struct keyed *scratch)
{
    for (int32_t i = 0; i < cells->points; i++)
        entry[i] = (struct keyed){key_of_point(cells, &points[i]), i};
    radix_sort(entry, scratch, cells->points);
    for (int32_t i = 0; i < cells->points; i++) {
        cells->point[i] = points[entry[i].index];
        cells->count += i == 0 || entry[i].key != entry[i - 1].key;
    }
    cells->slots = 64;
    while (cells->slots < 2 * (uint64_t)cells->count)
        cells->slots *= 2;
    cells->cell = memory_allocate((size_t)cells->count * sizeof *cells->cell);
    cells->slot = memory_allocate(cells->slots * sizeof *cells->slot);
    if (!cells->cell || !cells->slot)
        return out_of_memory(cells->points);
    int32_t c = -1;
    for (int32_t i = 0; i < cells->points; i++) {
        if (i == 0 || entry[i].key != entry[i - 1].key)
            cells->cell[++c] = (struct cell){entry[i].key, i, 0};
        cells->cell[c].count++;
    }
    index_cells(cells);
    return NULL;
}

struct error *cells_make(struct cells *cells, int dimension, double edge,
                         const struct cell_point *points, int32_t count)
{
    *cells = (struct cells){.dimension = dimension, .edge = edge, .points = count};
    struct keyed *entry = memory_allocate((size_t)count * sizeof *entry);
    struct keyed *scratch = memory_allocate((size_t)count * sizeof *scratch);
    cells->point = memory_allocate((size_t)count * sizeof *cells->point);
    struct error *error = !entry || !scratch || !cells->point
                              ? out_of_memory(count)
                              : fill_cells(cells, points, entry, scratch);
    free(entry);
    free(scratch);
    return error;
}

void cells_free(struct cells *cells)
{
    free(cells->point);
    free(cells->cell);
    free(cells->slot);
    *cells = (struct cells){0};
}

int cell_level(const struct cells *cells, int32_t cell)
{
    return level_of_key(cells, cells->cell[cell].key);
}

/* The range of cells of level OTHER that lie within range of a cell AT of LEVEL. Returns their number. */
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
        /* What lies beyond the countable cells sits in the outermost ones, which have no outer end. */
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
