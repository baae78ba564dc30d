/* Sections: each pixel shows the nearest particle. A pixel is material where it is within `fill`
 * diameters of a particle, and at free surfaces not farther than EDGE: gaps between neighbours that
 * are stretched or compressed close, cracks wider than a particle stay open (of material points:
 * wider than a cell and a half, as their grid sees no others). */
#include <stdlib.h>

#include "base/memory.h"
#include "picture/scene.h"

static const float BLEND = 0.8f, EDGE = 0.55f;
/* Particles of few pixels are squares: the rims of discs would be ragged. */
static const float FEW = 6.0f;
/* Cells lie behind particles. */
static const float CELL_DEPTH = 16.0f;

/* An item on the page, in pixels. */
struct mark {
    float x, y, diameter;
};

struct drawing {
    struct drawing_of of;
    float fill, usual; /* see above; the largest diameter at the start, pixels */
    struct mark *mark;
    struct row_bands bands;
    float *depth, *value; /* of each pixel */
    int32_t *nearest;     /* item; -1: none */
    int32_t *empty;       /* square of the distance to the nearest empty one, pixels */
    bool *filled;
    struct pixel_box covered; /* all that marks reach, and a pixel more */
};

static const struct scene_item *item_of(const struct drawing *d, int32_t mark)
{
    return drawing_item(&d->of, mark);
}

/* Diameters up to which a particle fills; what has come apart is not stretched. */
static float fill_of(const struct drawing *d, int32_t m)
{
    return item_of(d, m)->apart || d->mark[m].diameter > 1.25f * d->usual ? BLEND : d->fill;
}

/* How far from its middle an item colours pixels. */
static float reach_of(const struct drawing *d, int32_t m)
{
    const float diameter = d->mark[m].diameter;
    return item_of(d, m)->cell ? 0.5f * diameter
                               : maximum(fill_of(d, m) * diameter, 0.5f * d->of.dot);
}

static struct span place_mark(void *context, int64_t number, const double at[3])
{
    const struct drawing *d = context;
    const struct view *v = d->of.view;
    const struct projection *projection = d->of.projection;
    const struct scene_item *item = item_of(d, (int32_t)number);
    struct mark *mark = &d->mark[number];
    const double x = 0.5 * (v->window[v->across].low + v->window[v->across].high),
                 y = 0.5 * (v->window[v->up].low + v->window[v->up].high);
    mark->x = (float)(projection->x + projection->scale * (at[v->across] - x));
    mark->y = (float)(projection->y - v->up_sign * projection->scale * (at[v->up] - y));
    mark->diameter = (float)(projection->scale * item->diameter);
    const float reach = reach_of(d, (int32_t)number) + 1.0f + 0.6f * item->cell * mark->diameter;
    const bool seen = mark->x + reach > 0.0f && mark->x - reach < (float)d->of.width;
    return seen ? (struct span){mark->y - reach, mark->y + reach} : (struct span){1.0f, 0.0f};
}

static void find_covered(struct drawing *d)
{
    struct span across = {INFINITY, -INFINITY}, down = {INFINITY, -INFINITY};
    for (int band = 0; band < d->bands.count; band++)
        for (int64_t k = d->bands.begin[band]; k < d->bands.begin[band + 1]; k++) {
            const int32_t m = d->bands.item[k];
            const struct mark *mark = &d->mark[m];
            const float reach = reach_of(d, m) + 0.6f * mark->diameter;
            across.top = minimum(across.top, mark->x - reach);
            across.bottom = maximum(across.bottom, mark->x + reach);
            down.top = minimum(down.top, mark->y - reach);
            down.bottom = maximum(down.bottom, mark->y + reach);
        }
    const int right = d->of.width - 1, bottom = d->of.height - 1;
    d->covered = (struct pixel_box){(int)maximum(minimum(across.top - 3.0f, right), 0),
                                    (int)maximum(minimum(across.bottom + 3.0f, right), 0),
                                    (int)maximum(minimum(down.top - 3.0f, bottom), 0),
                                    (int)maximum(minimum(down.bottom + 3.0f, bottom), 0)};
}

static void find_nearest(struct drawing *d, int band)
{
    for (int64_t k = d->bands.begin[band]; k < d->bands.begin[band + 1]; k++) {
        const int32_t m = d->bands.item[k];
        const struct mark *mark = &d->mark[m];
        const bool cell = item_of(d, m)->cell, square_shaped = cell || mark->diameter < FEW;
        const float reach = reach_of(d, m), per_square = 1.0f / (reach * reach);
        const struct pixel_box box =
            row_bands_box(mark->x, mark->y, reach, band, d->of.width, d->of.height);
        for (int y = box.top; y <= box.bottom; y++)
            for (int x = box.left; x <= box.right; x++) {
                const float dx = fabsf((float)x + 0.5f - mark->x),
                            dy = fabsf((float)y + 0.5f - mark->y);
                const float off = dx * dx + dy * dy;
                if (square_shaped ? maximum(dx, dy) > reach * 1.001f : off > reach * reach)
                    continue;
                /* in units of the reach, squared */
                const float distance = cell ? CELL_DEPTH : off * per_square;
                const int64_t p = (int64_t)y * d->of.width + x;
                if (distance < d->depth[p]) {
                    d->depth[p] = distance;
                    d->nearest[p] = m;
                }
            }
    }
}

/* Squares of distances to the nearest empty pixel, exactly, in two sweeps: A. Meijster, J. Roerdink
 * and W. Hesselink, "A general algorithm for computing distance transforms in linear time" (2000).
 * First along the columns X .. END - 1, each by itself. */
enum { FAR_OFF = 1 << 14 };

static void sweep_columns(struct drawing *d, int left, int end)
{
    const int64_t width = d->of.width;
    for (int64_t y = d->covered.top; y <= d->covered.bottom; y++) {
        const int32_t *nearest = d->nearest + y * width;
        int32_t *row = d->empty + y * width;
        for (int x = left; x < end; x++) {
            const int32_t above = y > d->covered.top ? row[x - width] : FAR_OFF;
            row[x] = nearest[x] < 0 ? 0 : above < FAR_OFF ? above + 1 : FAR_OFF;
        }
    }
    for (int64_t y = d->covered.bottom - 1; y >= d->covered.top; y--) {
        int32_t *row = d->empty + y * width;
        for (int x = left; x < end; x++)
            row[x] = row[x + width] < row[x] ? row[x + width] + 1 : row[x];
    }
}

/* Then along row Y: the lower envelope of parabolas, which begin at FROM and have their lowest
 * point at AT. Both have room for a row. */
static void sweep_row(struct drawing *d, int y, int *at, int *from, int64_t *square_of)
{
    int32_t *row = d->empty + (int64_t)y * d->of.width + d->covered.left;
    const int width = d->covered.right + 1 - d->covered.left;
    int last = 0;
    at[0] = from[0] = 0;
    for (int x = 0; x < width; x++)
        square_of[x] = (int64_t)row[x] * row[x];
#define HEIGHT(x, i) (((int64_t)(x) - (i)) * ((int64_t)(x) - (i)) + square_of[i])
    for (int x = 1; x < width; x++) {
        while (last >= 0 && HEIGHT(from[last], at[last]) > HEIGHT(from[last], x))
            last--;
        if (last < 0) {
            at[last = 0] = x;
            continue;
        }
        const int64_t i = at[last];
        const int64_t begin =
            1 + ((int64_t)x * x - i * i + square_of[x] - square_of[i]) / (2 * ((int64_t)x - i));
        if (begin < width) {
            at[++last] = x;
            from[last] = (int)begin;
        }
    }
    for (int x = width - 1; x >= 0; x--) {
        const int64_t height = HEIGHT(x, at[last]);
        row[x] = (int32_t)minimum(height, INT32_MAX);
        if (x == from[last])
            last--;
    }
#undef HEIGHT
}

static struct error *find_distances(struct drawing *d)
{
    enum { COLUMNS = 64 };
    bool failed = false;
#pragma omp parallel for schedule(dynamic, 1) num_threads(d->of.threads)
    for (int x = d->covered.left; x <= d->covered.right; x += COLUMNS)
        sweep_columns(d, x, x + COLUMNS <= d->covered.right ? x + COLUMNS : d->covered.right + 1);
#pragma omp parallel num_threads(d->of.threads)
    {
        const size_t room = (size_t)d->of.width;
        int64_t *scratch = memory_allocate(room * (sizeof(int64_t) + 2 * sizeof(int)));
        int *at = scratch ? (int *)(void *)(scratch + room) : NULL;
        if (!scratch)
#pragma omp atomic write
            failed = true;
#pragma omp for schedule(dynamic, 16)
        for (int y = d->covered.top; y <= d->covered.bottom; y++)
            if (scratch)
                sweep_row(d, y, at, at + room, scratch);
        free(scratch);
    }
    return failed ? out_of_memory_for("a picture") : NULL;
}

/* Whether pixel (x, y) is not farther from MARK than a free surface is. */
static bool is_at_surface(const struct mark *mark, int x, int y)
{
    const float dx = fabsf((float)x + 0.5f - mark->x), dy = fabsf((float)y + 0.5f - mark->y);
    const float edge = EDGE * mark->diameter;
    return mark->diameter < FEW ? maximum(dx, dy) <= edge : dx * dx + dy * dy <= edge * edge;
}

static void find_filled(struct drawing *d, int band)
{
    const int end = (band + 1) * BAND_ROWS;
    for (int y = band * BAND_ROWS; y < end && y < d->of.height; y++)
        for (int x = 0; x < d->of.width; x++) {
            const int64_t p = (int64_t)y * d->of.width + x;
            const int32_t m = d->nearest[p];
            if (m < 0)
                continue;
            const float diameter = d->mark[m].diameter, fill = fill_of(d, m);
            d->filled[p] = d->depth[p] >= CELL_DEPTH || fill * diameter < 0.5f * d->of.dot ||
                           is_at_surface(&d->mark[m], x, y) ||
                           (float)d->empty[p] > square((fill - EDGE) * diameter);
        }
}

/* The mean of the values around each pixel, of particles of the body that it shows. */
static void blend(struct drawing *d, int band, float *sum, float *weights)
{
    const int first = band * BAND_ROWS;
    for (int i = 0; i < BAND_ROWS * d->of.width; i++)
        sum[i] = weights[i] = 0.0f;
    for (int64_t k = d->bands.begin[band]; k < d->bands.begin[band + 1]; k++) {
        const int32_t m = d->bands.item[k];
        const struct mark *mark = &d->mark[m];
        const struct scene_item *item = item_of(d, m);
        const float reach =
            item->cell ? mark->diameter : maximum(BLEND * mark->diameter, 0.5f * d->of.dot);
        const struct pixel_box box =
            row_bands_box(mark->x, mark->y, reach, band, d->of.width, d->of.height);
        const float per = 1.0f / reach;
        if (isnan(item->value))
            continue;
        for (int y = box.top; y <= box.bottom; y++)
            for (int x = box.left; x <= box.right; x++) {
                const int64_t p = (int64_t)y * d->of.width + x;
                if (d->nearest[p] < 0 || item_of(d, d->nearest[p])->body != item->body ||
                    item_of(d, d->nearest[p])->cell != item->cell)
                    continue;
                const float dx = fabsf((float)x + 0.5f - mark->x) * per;
                const float dy = fabsf((float)y + 0.5f - mark->y) * per;
                const float near = 1.0f - (dx * dx + dy * dy);
                float weight = near > 0.0f ? near * near + 1e-4f : 0.0f;
                if (item->cell)
                    weight = dx < 1.0f && dy < 1.0f ? (1.0f - dx) * (1.0f - dy) : 0.0f;
                sum[(y - first) * d->of.width + x] += weight * item->value;
                weights[(y - first) * d->of.width + x] += weight;
            }
    }
    for (int y = first; y < first + BAND_ROWS && y < d->of.height; y++)
        for (int x = 0; x < d->of.width; x++) {
            const int64_t p = (int64_t)y * d->of.width + x, q = (y - first) * d->of.width + x;
            if (d->nearest[p] >= 0)
                d->value[p] =
                    weights[q] > 0.0f ? sum[q] / weights[q] : item_of(d, d->nearest[p])->value;
        }
}

/* What the pixel at P shows, for outlines: -1: nothing. */
static int body_at(const struct drawing *d, int64_t p)
{
    return d->filled[p] ? item_of(d, d->nearest[p])->body : -1;
}

/* Whether BODY goes on from (x, y) by STEP for as long as three of the smallest dots. */
static bool goes_on(const struct drawing *d, int x, int y, const int step[2], int body)
{
    const int most = (int)(3.0f * d->of.dot);
    for (int k = 1; k <= most; k++) {
        const int column = x + k * step[0], row = y + k * step[1];
        if (column < 0 || row < 0 || column >= d->of.width || row >= d->of.height)
            return true;
        if (body_at(d, (int64_t)row * d->of.width + column) != body)
            return false;
    }
    return true;
}

/* Whether (x, y) is at the edge of a body. What is no wider than a few dots has none: it would be
 * all edge. Of two bodies that touch one has the line. */
static bool is_outline(const struct drawing *d, int x, int y)
{
    static const int step[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    const struct scene_item *item = item_of(d, d->nearest[(int64_t)y * d->of.width + x]);
    if (!d->of.view->outlines || item->cell)
        return false;
    for (int k = 0; k < 4; k++) {
        const int column = x + step[k][0], row = y + step[k][1];
        const int inwards[2] = {-step[k][0], -step[k][1]};
        if (column < 0 || row < 0 || column >= d->of.width || row >= d->of.height)
            continue;
        const int other = body_at(d, (int64_t)row * d->of.width + column);
        if (other != item->body && goes_on(d, x, y, inwards, item->body) &&
            (other < item->body || !goes_on(d, column, row, step[k], other)))
            return true;
    }
    return false;
}

/* The steepness of the values at (x, y), by the pixels around that show the same body. */
static float gradient_at(const struct drawing *d, int x, int y)
{
    float sum = 0.0f;
    const int64_t p = (int64_t)y * d->of.width + x;
    for (int axis = 0; axis < 2; axis++) {
        const int at = axis ? y : x, most = axis ? d->of.height - 1 : d->of.width - 1;
        const int64_t stride = axis ? d->of.width : 1;
        int64_t low = p, high = p;
        if (at > 0 && body_at(d, p - stride) == body_at(d, p))
            low = p - stride;
        if (at < most && body_at(d, p + stride) == body_at(d, p))
            high = p + stride;
        if (high > low) {
            const float slope = (d->value[high] - d->value[low]) / (float)((high - low) / stride);
            sum += slope * slope;
        }
    }
    return sqrtf(sum);
}

static int by_size(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static struct error *find_steepest(const struct drawing *d, double *steepest)
{
    const int64_t pixels = (int64_t)d->of.width * d->of.height;
    float *slope = memory_allocate((size_t)pixels * sizeof *slope + 1);
    int64_t count = 0;
    if (!slope)
        return out_of_memory_for("a picture");
    for (int64_t p = 0; p < pixels; p++)
        if (d->filled[p]) {
            slope[count] = gradient_at(d, (int)(p % d->of.width), (int)(p / d->of.width));
            count += isfinite(slope[count]);
        }
    qsort(slope, (size_t)count, sizeof *slope, by_size);
    *steepest = count ? slope[(int64_t)(0.999 * (double)(count - 1))] : 0.0;
    free(slope);
    return NULL;
}

static struct colour colour_at(const struct drawing *d, int x, int y)
{
    const struct colouring *c = d->of.colouring;
    const int64_t p = (int64_t)y * d->of.width + x;
    if (!(c->schlieren > 0.0))
        return colouring_of(c, d->value[p]);
    const double part = c->steepest > 0.0 ? gradient_at(d, x, y) / c->steepest : 0.0;
    const double grey = exp(-0.2 * c->schlieren * part);
    return (struct colour){grey, grey, grey};
}

static void paint(const struct drawing *d, int band, struct raster *raster)
{
    const int end = (band + 1) * BAND_ROWS;
    for (int y = band * BAND_ROWS; y < end && y < d->of.height; y++)
        for (int x = 0; x < d->of.width; x++) {
            const int64_t p = (int64_t)y * d->of.width + x;
            if (!d->filled[p])
                continue;
            const double shade = is_outline(d, x, y) ? 0.25 : 1.0;
            raster->pixel[p] = pixel_of(colour_at(d, x, y), shade);
        }
}

static struct error *allocate(struct drawing *d)
{
    const size_t pixels = (size_t)d->of.width * (size_t)d->of.height;
    d->depth = memory_allocate(pixels * sizeof *d->depth);
    d->value = memory_allocate(pixels * sizeof *d->value);
    d->nearest = memory_allocate(pixels * sizeof *d->nearest);
    d->filled = memory_allocate(pixels * sizeof *d->filled);
    d->empty = memory_allocate(pixels * sizeof *d->empty);
    if (!d->empty || !d->depth || !d->value || !d->nearest || !d->filled)
        return out_of_memory_for("a picture");
    for (size_t p = 0; p < pixels; p++) {
        d->depth[p] = 1e29f;
        d->nearest[p] = -1;
    }
    d->mark = memory_allocate(
        (size_t)(view_images(d->of.view) * d->of.scene->count) * sizeof *d->mark + 1);
    if (!d->mark)
        return out_of_memory_for("a picture");
    TRY(row_bands_make(&d->of, place_mark, d, &d->bands));
    find_covered(d);
    return NULL;
}

/* Categories are not blended. */
static void take_values(struct drawing *d)
{
    for (int64_t p = 0; p < (int64_t)d->of.width * d->of.height; p++)
        if (d->nearest[p] >= 0)
            d->value[p] = item_of(d, d->nearest[p])->value;
}

static struct error *find_values(struct drawing *d)
{
    const bool blends = d->of.colouring->scale || d->of.colouring->schlieren > 0.0;
    bool failed = false;
    if (!blends) {
        take_values(d);
        return NULL;
    }
#pragma omp parallel num_threads(d->of.threads)
    {
        const size_t room = (size_t)(BAND_ROWS * d->of.width);
        float *sum = memory_allocate(2 * room * sizeof *sum);
        if (!sum)
#pragma omp atomic write
            failed = true;
#pragma omp for schedule(dynamic, 1)
        for (int band = 0; band < d->bands.count; band++)
            if (sum)
                blend(d, band, sum, sum + room);
        free(sum);
    }
    return failed ? out_of_memory_for("a picture") : NULL;
}

struct error *section_draw(const struct drawing_of *of, struct raster *raster, double *steepest)
{
    struct drawing d = {.of = *of,
                        .fill = (float)of->view->fill,
                        .usual = (float)(of->projection->scale * of->view->diameter)};
    const int threads = of->threads;
    struct error *error = allocate(&d);
    if (!error) {
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
        for (int band = 0; band < d.bands.count; band++)
            find_nearest(&d, band);
        error = find_distances(&d);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
        for (int band = 0; band < d.bands.count; band++)
            find_filled(&d, band);
        if (!error)
            error = find_values(&d);
    }
    if (!error && steepest)
        error = find_steepest(&d, steepest);
    if (!error && !steepest) {
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
        for (int band = 0; band < d.bands.count; band++)
            paint(&d, band, raster);
    }
    free(d.mark);
    free(d.depth);
    free(d.value);
    free(d.nearest);
    free(d.filled);
    free(d.empty);
    row_bands_free(&d.bands);
    return error;
}
