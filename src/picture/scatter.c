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

/* The points of a rank while all are brought together. */
struct cloud {
    struct drawn_point *point;
    int64_t count;
};

/* Sends COUNT items of BYTES each at DATA to rank OTHER, or with COMES receives them. */
static void pass(int other, bool comes, void *data, int64_t count, size_t bytes, void *request)
{
    const struct message message = {other, comes, data, count};
    ranks_start(&message, 1, bytes, request);
    ranks_finish(1, request);
}

/* Collective: every second rank of those that are STEP apart gives its points to the one before. */
static struct error *join_pairs(const struct ranks *ranks, int step, struct cloud *own)
{
    const int place = ranks->rank % (2 * step);
    const bool gives = place == step, takes = place == 0 && ranks->rank + step < ranks->size;
    const int other = gives ? ranks->rank - step : ranks->rank + step;
    int64_t more = own->count;
    void *request = memory_allocate(ranks_request_size() + 1);
    TRY(ranks_agree(ranks, request ? NULL : out_of_memory_for("a picture")));
    if (gives || takes)
        pass(other, takes, &more, 1, sizeof more, request);
    int64_t room = own->count;
    const bool fits = !takes || memory_reserve((void **)&own->point, &room, own->count + more,
                                               own->count, sizeof *own->point);
    struct error *error = ranks_agree(ranks, fits ? NULL : out_of_memory_for("a picture"));
    if (!error && (gives || takes))
        pass(other, takes, takes ? own->point + own->count : own->point, more, sizeof *own->point,
             request);
    if (!error && takes)
        own->count = thin(own->point, own->count + more);
    else if (gives)
        own->count = 0;
    free(request);
    return error;
}

/* Collective: rank 0 gets the points of all. They come together in pairs and are thinned each time,
 * so that no rank ever has more than those of two plots. */
static struct error *join_all(const struct ranks *ranks, struct cloud *own)
{
    struct error *error = NULL;
    for (int step = 1; step < ranks->size && !error; step *= 2)
        error = join_pairs(ranks, step, own);
    return error;
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
    struct cloud own;
    own.point = take_points(scatter, x, y, &own.count);
    struct error *error = ranks_agree(ranks, own.point ? NULL : out_of_memory_for("a picture"));
    if (!error)
        error = join_all(ranks, &own);
    scatter_free(scatter);
    if (!error && ranks->rank == 0) {
        if (scatter_allocate(scatter, own.count))
            for (int64_t k = 0; k < own.count; ++k) {
                scatter->x[k] = own.point[k].x;
                scatter->y[k] = own.point[k].y;
            }
        else
            error = out_of_memory_for("a picture");
    }
    free(own.point);
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
