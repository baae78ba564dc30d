/* Points of all ranks for a plot, without those that would coincide in it. */
#include <stdlib.h>

#include "base/memory.h"
#include "picture/picture.h"
#include "picture/scale.h"

/* The plot is divided into this many cells along each axis, about one a pixel; only the first point
 * in each is kept. */
enum { CELLS = 1024 };

struct drawn_point {
    uint32_t cell;
    double x, y;
};

static int compare_points(const void *first, const void *second)
{
    const struct drawn_point *a = first, *b = second;
    if (a->cell != b->cell)
        return a->cell > b->cell ? 1 : -1;
    if (a->x != b->x)
        return a->x > b->x ? 1 : -1;
    return (a->y > b->y) - (a->y < b->y);
}

static uint32_t cell_of(struct range range, double value)
{
    double cell = floor((value - range.low) / (range.high - range.low) * CELLS);
    return (uint32_t)(cell > 0.0 ? minimum(cell, CELLS - 1) : 0.0);
}

/* Sorts COUNT points, keeps one in each cell, and returns how many remain. */
static int64_t thin(struct drawn_point *point, int64_t count)
{
    int64_t kept = 0;
    qsort(point, (size_t)count, sizeof *point, compare_points);
    for (int64_t i = 0; i < count; ++i)
        if (kept == 0 || point[i].cell != point[kept - 1].cell)
            point[kept++] = point[i];
    return kept;
}

/* The points of this rank that can be drawn, thinned; NULL when memory is out. */
static struct drawn_point *take_points(const struct scatter *scatter, struct range x,
                                       struct range y, int64_t *count)
{
    struct drawn_point *point = memory_allocate(((size_t)scatter->count + 1) * sizeof *point);
    *count = 0;
    for (int64_t i = 0; i < scatter->count && point; ++i)
        if (isfinite(scatter->x[i]) && isfinite(scatter->y[i])) {
            const uint32_t cell = cell_of(x, scatter->x[i]) * CELLS + cell_of(y, scatter->y[i]);
            point[(*count)++] = (struct drawn_point){cell, scatter->x[i], scatter->y[i]};
        }
    if (point)
        *count = thin(point, *count);
    return point;
}

struct error *scatter_gather(const struct ranks *ranks, struct scatter *scatter)
{
    struct range x = range_empty(), y = range_empty();
    for (int64_t i = 0; i < scatter->count; ++i)
        if (isfinite(scatter->x[i]) && isfinite(scatter->y[i])) {
            range_include(&x, scatter->x[i]);
            range_include(&y, scatter->y[i]);
        }
    x = range_of_all(ranks, x);
    y = range_of_all(ranks, y);
    int64_t count;
    struct drawn_point *all = NULL, *own = take_points(scatter, x, y, &count);
    struct error *error = ranks_agree(ranks, own ? NULL : out_of_memory_for("a picture"));
    if (!error)
        error = ranks_gather(ranks, 0, own, count, sizeof *own, (void **)&all, &count);
    free(own);
    scatter_free(scatter);
    if (!error && ranks->rank == 0) {
        count = thin(all, count);
        if (scatter_allocate(scatter, count))
            for (int64_t k = 0; k < count; ++k) {
                scatter->x[k] = all[k].x;
                scatter->y[k] = all[k].y;
            }
        else
            error = out_of_memory_for("a picture");
    }
    free(all);
    return ranks_agree(ranks, error);
}

bool scatter_allocate(struct scatter *scatter, int64_t count)
{
    const size_t bytes = ((size_t)count + 1) * sizeof(double);
    scatter->count = count;
    scatter->x = memory_allocate(bytes);
    scatter->y = memory_allocate(bytes);
    return scatter->x && scatter->y;
}

void scatter_free(struct scatter *scatter)
{
    free(scatter->x);
    free(scatter->y);
    *scatter = (struct scatter){0};
}
