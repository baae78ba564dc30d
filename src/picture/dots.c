/* Painting dots on all ranks; see dots.h. A rank gets the dots that touch its rows; rows are dealt
 * so that all ranks have about as many dots. */
#include "picture/dots.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "parallel/exchange.h"
#include "particle/radix.h"

/* Diameters of squares and discs over those of the particles. Small particles of one body should
 * read as a solid: squares behind them fill the gaps, which a lattice of discs has at its corners,
 * and wherever it is compressed along one axis. */
static const double square_factor = 1.3, disc_factor = 1.05;

/* Cells touch; their places are rounded to floats. */
static const double cell_factor = 1.001;

struct rows {
    int first, end;
};

/* The rows that DOT may touch, its smooth rim included; one at least. */
static struct rows rows_of(const struct viewport *viewport, const struct dot *dot)
{
    double y = viewport->y - dot->up * viewport->scale;
    double reach = 0.5 * square_factor * dot->diameter * viewport->scale + 2.0;
    double last = viewport->bottom - 1;
    return (struct rows){(int)minimum(maximum(floor(y - reach), viewport->top), last),
                         1 + (int)minimum(maximum(floor(y + reach), viewport->top), last)};
}

/* Deals the rows of EASEL: rank r gets those from cut[r] to cut[r + 1] - 1. COUNT has room for a
 * number a row. */
static void deal_rows(const struct ranks *ranks, const struct dots *dots,
                      const struct viewport *viewport, int64_t *count, int *cut)
{
    const int height = viewport->bottom - viewport->top;
    int64_t total = 0, before = 0;
    for (int64_t i = 0; i < dots->count; ++i) {
        struct rows rows = rows_of(viewport, &dots->dot[i]);
        ++count[(rows.first + rows.end) / 2 - viewport->top];
    }
    ranks_sum_of(ranks, count, height);
    for (int row = 0; row < height; ++row)
        total += count[row];
    int rank = 0;
    cut[0] = viewport->top;
    for (int row = 0; row < height; ++row) {
        while (rank + 1 < ranks->size && before * ranks->size >= total * (rank + 1))
            cut[++rank] = viewport->top + row;
        before += count[row];
    }
    while (rank < ranks->size)
        cut[++rank] = viewport->bottom;
}

/* Which ranks get which dots. */
static struct error *find_send_items(const struct ranks *ranks, const struct dots *dots,
                                     const struct viewport *viewport, const int *cut,
                                     struct send_item **sends, int32_t *count)
{
    int64_t room = 0;
    for (int64_t i = 0; i < dots->count; ++i) {
        struct rows rows = rows_of(viewport, &dots->dot[i]);
        int low = 0, high = ranks->size; /* cut[low] <= rows.first < cut[high] */
        while (high - low > 1) {
            int middle = (low + high) / 2;
            if (cut[middle] <= rows.first)
                low = middle;
            else
                high = middle;
        }
        for (int rank = low; rank < ranks->size && cut[rank] < rows.end; ++rank) {
            if (cut[rank] == cut[rank + 1])
                continue;
            if (!memory_reserve((void **)sends, &room, *count + 1, *count, sizeof **sends))
                return out_of_memory_for("a picture");
            (*sends)[(*count)++] = (struct send_item){rank, (int32_t)i};
        }
    }
    return NULL;
}

/* The dots become those that touch the rows of this rank, FIRST to END - 1. */
static struct error *pass_dots(const struct ranks *ranks, struct dots *dots,
                               const struct viewport *viewport, int *first, int *end)
{
    int *cut = memory_allocate(((size_t)ranks->size + 1) * sizeof *cut);
    int64_t *count = memory_allocate((size_t)(viewport->bottom - viewport->top) * sizeof *count);
    struct send_item *sends = NULL;
    int32_t goes = 0, comes;
    void *received;
    struct error *error = ranks_agree(ranks, cut && count ? NULL : out_of_memory_for("a picture"));
    if (!error) {
        deal_rows(ranks, dots, viewport, count, cut);
        *first = cut[ranks->rank];
        *end = cut[ranks->rank + 1];
        error = ranks_agree(ranks, find_send_items(ranks, dots, viewport, cut, &sends, &goes));
    }
    if (!error)
        error = exchange_once(ranks, sends, goes, dots->dot, sizeof *dots->dot, &received, &comes);
    free(sends);
    free(cut);
    free(count);
    if (error)
        return error;
    free(dots->dot);
    dots->dot = received;
    dots->count = dots->capacity = comes;
    return NULL;
}

/* DEPTH as a whole number of the same order. */
static uint64_t key_of_depth(float depth)
{
    const float clean = depth + 0.0f; /* no negative zero */
    uint32_t bits;
    memcpy(&bits, &clean, sizeof bits);
    return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

/* The order in which the dots are painted, in fresh memory; NULL when it is out. */
static struct keyed *sort_dots(const struct dots *dots)
{
    const size_t count = (size_t)dots->count;
    struct keyed *order = memory_allocate((2 * count + 1) * sizeof *order);
    if (!order)
        return NULL;
    for (size_t k = 0; k < count; ++k)
        order[k] = (struct keyed){dots->dot[k].order, (int32_t)k};
    radix_sort(order, order + count, dots->count, 1);
    for (size_t k = 0; k < count; ++k)
        order[k].key = key_of_depth(dots->dot[order[k].index].depth);
    radix_sort(order, order + count, dots->count, 1);
    return order;
}

/* Paints every dot at FACTOR times its diameter by PAINT_ONE. */
static void paint_layer(const struct pixels *pixels, const struct viewport *viewport,
                        const struct dots *dots, const struct keyed *order, double factor,
                        paint_function *paint_one)
{
    for (int64_t k = 0; k < dots->count; ++k) {
        const struct dot *dot = &dots->dot[order[k].index];
        double diameter = factor * dot->diameter * viewport->scale;
        struct colour colour = viewport->colours ? colour_of(viewport->colours, dot->value)
                                                 : colour_of_category((int)dot->value);
        paint_one(pixels, viewport->x + dot->across * viewport->scale,
                  viewport->y - dot->up * viewport->scale, diameter, colour);
    }
}

struct error *dots_paint(const struct ranks *ranks, struct dots *dots,
                         const struct viewport *viewport, uint32_t **image)
{
    int first = viewport->top, end = viewport->bottom;
    int64_t total;
    *image = NULL;
    if (ranks->joined)
        TRY(pass_dots(ranks, dots, viewport, &first, &end));
    const size_t bytes = (size_t)viewport->right * sizeof(uint32_t);
    const size_t size = (size_t)(end - first) * bytes;
    uint32_t *own = memory_allocate(size);
    struct keyed *order = sort_dots(dots);
    struct error *error = ranks_agree(ranks, own && order ? NULL : out_of_memory_for("a picture"));
    if (!error) {
        memset(own, 0xff, size); /* white */
        const struct pixels pixels = {.data = own,
                                      .stride = viewport->right,
                                      .first_row = first,
                                      .left = viewport->left,
                                      .right = viewport->right,
                                      .top = first,
                                      .bottom = end};
        if (viewport->squares)
            paint_layer(&pixels, viewport, dots, order,
                        viewport->cells ? cell_factor : square_factor, paint_square);
        if (!viewport->cells)
            paint_layer(&pixels, viewport, dots, order, disc_factor, paint_disc);
        error = ranks_gather(ranks, 0, own, end - first, bytes, (void **)image, &total);
    }
    free(own);
    free(order);
    return error;
}
