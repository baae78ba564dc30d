/* Points sorted into cells; see near_points.h. */
#include "measure/near_points.h"

#include <stdlib.h>

#include "base/memory.h"

/* A cell's number has 20 bits an axis, x lowest, so that a row of cells is one range of numbers.
 * Cells are counted from one: the neighbours of the first and the last have numbers too. */
enum { AXIS_BITS = 20, CELLS_MOST = (1 << AXIS_BITS) - 3 };

static uint64_t cell_number(const int64_t cell[3])
{
    return (uint64_t)cell[2] << (2 * AXIS_BITS) | (uint64_t)cell[1] << AXIS_BITS |
           (uint64_t)cell[0];
}

/* What lies outside all cells counts to the nearest: it has no neighbours that this would hide. */
static void find_cell(const struct near_points *near, const double place[3], int64_t cell[3])
{
    for (int k = 0; k < 3; k++) {
        double number = floor((place[k] - near->low[k]) / near->cell);
        cell[k] = 1 + (int64_t)minimum(maximum(number, -1.0), CELLS_MOST);
        cell[k] = cell[k] < 1 ? 1 : cell[k];
    }
}

static int compare_points(const void *first, const void *second)
{
    const struct near_point *a = first, *b = second;
    return (a->cell > b->cell) - (a->cell < b->cell);
}

struct error *near_points_make(const double (*at)[3], int64_t count, double reach,
                               struct near_points *near)
{
    *near = (struct near_points){.count = count, .cell = reach};
    near->point = memory_allocate(((size_t)count + 1) * sizeof *near->point);
    if (!near->point)
        return out_of_memory_for("a check of %lld particles", (long long)count);
    for (int k = 0; k < 3; k++) {
        double low = INFINITY, high = -INFINITY;
        for (int64_t i = 0; i < count; i++) {
            low = minimum(low, at[i][k]);
            high = maximum(high, at[i][k]);
        }
        near->low[k] = count > 0 ? low : 0.0;
        near->cell = maximum(near->cell, count > 0 ? (high - low) / CELLS_MOST : 0.0);
    }
    for (int64_t i = 0; i < count; i++) {
        int64_t cell[3];
        find_cell(near, at[i], cell);
        near->point[i] = (struct near_point){cell_number(cell), i};
    }
    qsort(near->point, (size_t)count, sizeof *near->point, compare_points);
    return NULL;
}

void near_points_free(struct near_points *near)
{
    free(near->point);
    *near = (struct near_points){0};
}

/* The first point whose cell is CELL or comes after it. */
static int64_t first_from(const struct near_points *near, uint64_t cell)
{
    int64_t low = 0, high = near->count;
    while (low < high) {
        int64_t middle = low + (high - low) / 2;
        if (near->point[middle].cell < cell)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

void near_points_about(const struct near_points *near, const double place[3],
                       void (*found)(void *context, int64_t index), void *context)
{
    int64_t middle[3];
    find_cell(near, place, middle);
    for (int64_t z = middle[2] - 1; z <= middle[2] + 1; z++)
        for (int64_t y = middle[1] - 1; y <= middle[1] + 1; y++) {
            uint64_t last = cell_number((const int64_t[3]){middle[0] + 1, y, z});
            for (int64_t i = first_from(near, last - 2);
                 i < near->count && near->point[i].cell <= last; i++)
                found(context, near->point[i].index);
        }
}
