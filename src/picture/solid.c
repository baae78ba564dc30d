/* Perspectives: spheres, and cells as cubes, with a z-buffer, smoothed to surfaces, with light,
 * ambient occlusion (how much of the surroundings is in front) and outlines. Where a corner is cut
 * away, rays start at the cut: its faces are flat and closed. Values are blended between the
 * particles of a body, and between cells. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "picture/solid.h"

static const float FAR = 1e30f;
enum { SMOOTH_MAX = 40, SMOOTH_TAPS = 10 /* on each side */ };

static struct span place_mark(void *context, int64_t number, const double at[3])
{
    const struct drawing *d = context;
    const struct view *view = d->of.view;
    struct mark *mark = &d->mark[number];
    double x, y;
    const bool before = view_project(view, d->of.projection, at, &x, &y);
    mark->place = vector_of(at);
    mark->depth = dot(minus(mark->place, d->eye), d->away);
    mark->x = (float)x;
    mark->y = (float)y;
    mark->metres = SPHERE * item_of(d, (int32_t)number)->diameter;
    mark->radius = (float)d->of.projection->scale * mark->metres;
    mark->radius /= view->parallel ? 1.0f : mark->depth;
    const float widest = item_of(d, (int32_t)number)->cell ? BLEND : DISC;
    const float reach = maximum(mark->radius * widest / SPHERE, 0.5f * d->of.dot) + 1.0f;
    const bool seen = before && mark->depth > 2.0f * mark->metres && mark->x + reach > 0.0f &&
                      mark->x - reach < (float)d->of.width;
    return seen ? (struct span){mark->y - reach, mark->y + reach} : (struct span){1.0f, 0.0f};
}

/* The radius that is drawn, in pixels and in metres. */
static float drawn_radius(const struct drawing *d, const struct mark *mark)
{
    return maximum(mark->radius, 0.5f * d->of.dot);
}
static float drawn_metres(const struct drawing *d, const struct mark *mark)
{
    return mark->metres * drawn_radius(d, mark) / maximum(mark->radius, 1e-6f);
}

static struct pixel_box box_of(const struct drawing *d, int32_t m, int band)
{
    const struct mark *mark = &d->mark[m];
    const float widest = item_of(d, m)->cell ? BLEND / SPHERE
                         : d->of.view->cuts  ? DISC / SPHERE
                                             : 1.0f;
    const float reach = drawn_radius(d, mark) * widest;
    return row_bands_box(mark->x, mark->y, reach, band, d->of.width, d->of.height);
}

/* Of two faces that are equally deep, as all of a cut are, the nearer particle is seen. */
static bool is_nearer(const struct sample *sample, const struct meeting *meeting, float metres)
{
    const float tie = 1e-4f * metres;
    if (meeting->face >= 0 && sample->face == meeting->face &&
        fabsf(meeting->depth - sample->depth) < tie)
        return meeting->distance < sample->value;
    return meeting->depth < sample->depth;
}

static void find_nearest(struct drawing *d, int band)
{
    for (int64_t k = d->bands.begin[band]; k < d->bands.begin[band + 1]; k++) {
        const int32_t m = d->bands.item[k];
        const struct mark *mark = &d->mark[m];
        const struct pixel_box box = box_of(d, m, band);
        const bool cell = item_of(d, m)->cell;
        for (int y = box.top; y <= box.bottom; y++)
            for (int x = box.left; x <= box.right; x++) {
                struct sample *sample = &d->sample[(int64_t)y * d->of.width + x];
                struct meeting meeting;
                if (mark->depth - (cell ? 1.4f : 1.0f) * mark->metres > sample->depth)
                    continue;
                if ((cell ? meet_cell : meet)(d, mark, x, y, &meeting) &&
                    is_nearer(sample, &meeting, mark->metres))
                    *sample = (struct sample){.depth = meeting.depth,
                                              .value = meeting.distance,
                                              .item = m,
                                              .face = meeting.face};
            }
    }
}

static void blend(struct drawing *d, int band)
{
    const int first = band * BAND_ROWS * d->of.width, end = (band + 1) * BAND_ROWS * d->of.width;
    for (int p = first; p < end && p < d->of.width * d->of.height; p++)
        d->sample[p].value = d->sample[p].weight = 0.0f;
    for (int64_t k = d->bands.begin[band]; k < d->bands.begin[band + 1]; k++) {
        const int32_t m = d->bands.item[k];
        const struct mark *mark = &d->mark[m];
        const struct scene_item *item = item_of(d, m);
        const struct pixel_box box = box_of(d, m, band);
        if (isnan(item->value))
            continue;
        for (int y = box.top; y <= box.bottom; y++)
            for (int x = box.left; x <= box.right; x++) {
                struct sample *sample = &d->sample[(int64_t)y * d->of.width + x];
                struct meeting meeting;
                if (sample->item < 0 || item_of(d, sample->item)->body != item->body ||
                    item_of(d, sample->item)->cell != item->cell ||
                    mark->depth - 2.0f * mark->metres > sample->depth)
                    continue;
                if (item->cell) {
                    meeting.distance = cell_distance(mark, place_of(d, x, y, sample->depth));
                    if (meeting.distance >= 1.0f)
                        continue;
                } else if (!meet(d, mark, x, y, &meeting) ||
                           meeting.depth >
                               sample->depth + (meeting.face >= 0 ? 1e-3f : 0.6f) * mark->metres)
                    continue;
                const float near = maximum(1.0f - meeting.distance, 0.0f);
                const float weight = near * near + 1e-4f;
                sample->value += weight * item->value;
                sample->weight += weight;
            }
    }
    for (int p = first; p < end && p < d->of.width * d->of.height; p++)
        if (d->sample[p].item >= 0)
            d->sample[p].value = d->sample[p].weight > 0.0f
                                     ? d->sample[p].value / d->sample[p].weight
                                     : item_of(d, d->sample[p].item)->value;
}

/* NULL outside the raster. */
static const struct sample *sample_at(const struct drawing *d, int x, int y)
{
    const bool inside = x >= 0 && y >= 0 && x < d->of.width && y < d->of.height;
    return inside ? &d->sample[(int64_t)y * d->of.width + x] : NULL;
}

static bool is_sphere(const struct sample *sample) { return sample->item >= 0 && sample->face < 0; }

/* The depth of row or column neighbours, averaged where they belong to the same surface: SURFACE
 * has the depths of spheres, and FAR elsewhere. */
static float smoothed(const struct drawing *d, const float *surface, int x, int y, bool rows)
{
    const int64_t p = (int64_t)y * d->of.width + x, stride = rows ? d->of.width : 1;
    const struct mark *mark = &d->mark[d->sample[p].item];
    const int reach = (int)minimum(SMOOTH_MAX, 2.0f * drawn_radius(d, mark)),
              step = 1 + reach / SMOOTH_TAPS;
    const int at = rows ? y : x, most = (rows ? d->of.height : d->of.width) - 1;
    const int before = at < reach ? at : reach, behind = most - at < reach ? most - at : reach;
    const float thin = 1.0f / (2.4f * drawn_metres(d, mark)), short_of = 1.0f / (float)(reach + 1);
    float sum = 0.0f, weights = 0.0f;
    for (int j = -(before / step) * step; j <= behind; j += step) {
        /* parabolas that end at the reach, and where another surface begins */
        const float depth = surface[p + j * stride], off = (depth - surface[p]) * thin;
        const float part = (float)j * short_of, same = 1.0f - off * off;
        const float weight = (1.0f - part * part) * (same > 0.0f ? same : 0.0f);
        sum += weight * weight * depth;
        weights += weight * weight;
    }
    return weights > 0.0f ? sum / weights : surface[p];
}

static void smooth(struct drawing *d)
{
    const int64_t pixels = (int64_t)d->of.width * d->of.height;
    float *const plane[2] = {d->surface, d->scratch};
    for (int64_t p = 0; p < pixels; p++) {
        d->sample[p].smooth = d->sample[p].depth;
        plane[0][p] = is_sphere(&d->sample[p]) ? d->sample[p].depth : FAR;
    }
    for (int round = 0; round < 4; round++) { /* the last one fills plane 0 */
        const float *surface = plane[round % 2];
        float *next = plane[1 - round % 2];
#pragma omp parallel for schedule(dynamic, 16) num_threads(d->of.threads)
        for (int y = 0; y < d->of.height; y++)
            for (int x = 0; x < d->of.width; x++) {
                const int64_t p = (int64_t)y * d->of.width + x;
                next[p] =
                    is_sphere(&d->sample[p]) ? smoothed(d, surface, x, y, round % 2) : surface[p];
            }
    }
    for (int64_t p = 0; p < pixels; p++)
        if (is_sphere(&d->sample[p]))
            d->sample[p].smooth = plane[0][p];
}

/* The slope of the surface from (x, y) to a neighbour on the page, the one that is less far. */
static struct vector slope_at(const struct drawing *d, int x, int y, bool down)
{
    const int64_t p = (int64_t)y * d->of.width + x;
    const struct sample *sample = &d->sample[p];
    const int at = down ? y : x, most = (down ? d->of.height : d->of.width) - 1;
    const int64_t stride = down ? d->of.width : 1;
    float jump[2] = {INFINITY, INFINITY};
    for (int side = 0; side < 2; side++) {
        const struct sample *other = &d->sample[p + (side ? stride : -stride)];
        if ((side ? at < most : at > 0) && is_sphere(other))
            jump[side] = fabsf(other->smooth - sample->smooth);
    }
    const int side = jump[1] <= jump[0], step = side ? 1 : -1;
    if (jump[side] > 2.0f * drawn_metres(d, &d->mark[sample->item]))
        return down ? times(d->top, -1.0f) : d->right;
    const float depth = d->sample[p + (side ? stride : -stride)].smooth;
    const struct vector other = place_of(d, down ? x : x + step, down ? y + step : y, depth);
    return times(minus(other, place_of(d, x, y, sample->smooth)), (float)step);
}

static struct vector normal_at(const struct drawing *d, int x, int y)
{
    const struct sample *sample = &d->sample[(int64_t)y * d->of.width + x];
    if (sample->face >= 0) {
        const int cell = sample->face - FACES;
        if (cell >= 0) {
            const struct vector axes[3] = {
                {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
            return times(axes[cell / 2], cell % 2 ? 1.0f : -1.0f);
        }
        const struct half_space *cut = &d->of.view->cut[(int)sample->face];
        struct vector normal = {0.0f, 0.0f, 0.0f};
        (&normal.x)[cut->axis] = (float)cut->sign;
        return normal;
    }
    const struct vector normal = unit(cross(slope_at(d, x, y, false), slope_at(d, x, y, true)));
    return dot(normal, d->away) > 0.0f ? times(normal, -1.0f) : normal;
}

/* How much of the surroundings of (x, y) is in front: 0 to 1. */
static float occlusion_at(const struct drawing *d, int x, int y, struct vector normal)
{
    const struct sample *sample = &d->sample[(int64_t)y * d->of.width + x];
    const struct vector place = place_of(d, x, y, sample->smooth);
    const float reach = 0.035f * d->size;
    const float pixels =
        (float)d->of.projection->scale * reach / (d->of.view->parallel ? 1.0f : sample->smooth);
    float sum = 0.0f;
    for (int j = 0; j < OCCLUSION_SAMPLES; j++) {
        const int column = x + (int)(d->around[j][0] * pixels);
        const int row = y + (int)(d->around[j][1] * pixels);
        const struct sample *other = sample_at(d, column, row);
        if (!other || other->item < 0)
            continue;
        const struct vector off = minus(place_of(d, column, row, other->smooth), place);
        const float length = sqrtf(dot(off, off)) + 1e-12f * d->size;
        const float above = maximum(dot(off, normal) / length - 0.12f, 0.0f);
        const float far = 2.0f * reach / length;
        sum += above * (far >= 1.0f ? 1.0f : far * far);
    }
    return sum / OCCLUSION_SAMPLES;
}

/* Whether the surface at (x, y) goes on by STEP for as long as three of the smallest dots. */
static bool goes_on(const struct drawing *d, int x, int y, const int step[2])
{
    const int most = (int)(3.0f * d->of.dot);
    const struct sample *last = &d->sample[(int64_t)y * d->of.width + x];
    const uint16_t body = item_of(d, last->item)->body;
    const float jump = 5.0f * drawn_metres(d, &d->mark[last->item]);
    for (int k = 1; k <= most; k++) {
        const struct sample *next = sample_at(d, x + k * step[0], y + k * step[1]);
        if (!next)
            return true;
        if (next->item < 0 || item_of(d, next->item)->body != body ||
            fabsf(next->smooth - last->smooth) > jump)
            return false;
        last = next;
    }
    return true;
}

/* Darkness of an outline at (x, y): where the depth jumps, and less where the body changes. What is
 * no wider than a few dots has none. */
static float outline_at(const struct drawing *d, int x, int y)
{
    static const int step[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    const struct sample *sample = &d->sample[(int64_t)y * d->of.width + x];
    const float jump = 5.0f * drawn_metres(d, &d->mark[sample->item]);
    float dark = 0.0f;
    if (!d->of.view->outlines)
        return 0.0f;
    for (int k = 0; k < 4; k++) {
        const int inwards[2] = {-step[k][0], -step[k][1]};
        const struct sample *other = sample_at(d, x + step[k][0], y + step[k][1]);
        if (!other)
            continue;
        const bool end = other->item < 0 || other->smooth - sample->smooth > jump;
        if (!end && item_of(d, other->item)->body == item_of(d, sample->item)->body)
            continue;
        if (goes_on(d, x, y, inwards))
            dark = end ? 1.0f : maximum(dark, 0.7f);
    }
    return dark;
}

/* Whether (x, y) shows a particle that is no more than a dot and no part of a surface: most of what
 * is around it is empty or far behind. It has no faces. */
static bool is_lone_dot(const struct drawing *d, int x, int y)
{
    static const int step[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    const struct sample *sample = &d->sample[(int64_t)y * d->of.width + x];
    const struct mark *mark = &d->mark[sample->item];
    const int off = 1 + (int)ceilf(d->of.dot);
    int alone = 0;
    if (mark->radius > 0.5f * d->of.dot || sample->face >= 0)
        return false;
    for (int k = 0; k < 4; k++) {
        const struct sample *other = sample_at(d, x + off * step[k][0], y + off * step[k][1]);
        alone += !other || other->item < 0 ||
                 fabsf(other->depth - sample->depth) > 6.0f * drawn_metres(d, mark);
    }
    return alone >= 2;
}

static void paint(const struct drawing *d, int y, struct raster *raster)
{
    for (int x = 0; x < d->of.width; x++) {
        const int64_t p = (int64_t)y * d->of.width + x;
        const struct sample *sample = &d->sample[p];
        if (sample->item < 0)
            continue;
        if (is_lone_dot(d, x, y)) {
            raster->pixel[p] = pixel_of(colouring_of(d->of.colouring, sample->value), 0.95);
            continue;
        }
        const struct vector normal = normal_at(d, x, y);
        /* flat faces show values: all have light enough for these to be read */
        const float ambient = sample->face >= 0 ? 0.76f : 0.42f;
        const float lit = ambient + (1.0f - ambient) * maximum(dot(normal, d->light), 0.0f);
        const float dark = minimum(1.6f * occlusion_at(d, x, y, normal), 0.75f);
        const float line = 1.0f - 0.6f * outline_at(d, x, y);
        raster->pixel[p] = pixel_of(colouring_of(d->of.colouring, sample->value),
                                    (double)(lit * (1.0f - dark) * line));
    }
}

static struct error *allocate(struct drawing *d)
{
    for (int j = 0; j < OCCLUSION_SAMPLES; j++) { /* points spiral outwards */
        const float angle = (float)j * 2.39996f;
        const float radius = sqrtf(((float)j + 0.5f) / OCCLUSION_SAMPLES);
        d->around[j][0] = cosf(angle) * radius;
        d->around[j][1] = sinf(angle) * radius;
    }
    const size_t pixels = (size_t)d->of.width * (size_t)d->of.height;
    d->sample = memory_allocate(pixels * sizeof *d->sample);
    d->scratch = memory_allocate(pixels * sizeof *d->scratch);
    d->surface = memory_allocate(pixels * sizeof *d->surface);
    if (!d->sample || !d->surface || !d->scratch)
        return out_of_memory_for("a picture");
    for (size_t p = 0; p < pixels; p++)
        d->sample[p] = (struct sample){.depth = INFINITY, .item = -1, .face = -1};
    d->mark = memory_allocate(
        (size_t)(view_images(d->of.view) * d->of.scene->count) * sizeof *d->mark + 1);
    return d->mark ? row_bands_make(&d->of, place_mark, d, &d->bands)
                   : out_of_memory_for("a picture");
}

static void take_values(struct drawing *d)
{
    for (int64_t p = 0; p < (int64_t)d->of.width * d->of.height; p++)
        if (d->sample[p].item >= 0)
            d->sample[p].value = item_of(d, d->sample[p].item)->value;
}

struct error *solid_draw(const struct drawing_of *of, struct raster *raster)
{
    const struct view *view = of->view;
    const int threads = of->threads;
    struct drawing d = {.of = *of,
                        .eye = vector_of(view->eye),
                        .away = times(vector_of(view->direction), -1.0f),
                        .right = vector_of(view->right),
                        .top = vector_of(view->top)};
    for (int axis = 0; axis < 3; axis++)
        d.size += (float)square(view->window[axis].high - view->window[axis].low);
    d.size = sqrtf(d.size);
    d.light = unit(plus(times(d.away, -1.0f), plus(times(d.top, 0.8f), times(d.right, -0.6f))));
    struct error *error = allocate(&d);
    if (!error) {
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
        for (int band = 0; band < d.bands.count; band++)
            find_nearest(&d, band);
        if (of->colouring->scale) {
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
            for (int band = 0; band < d.bands.count; band++)
                blend(&d, band);
        } else
            take_values(&d);
        smooth(&d);
#pragma omp parallel for schedule(dynamic, 8) num_threads(threads)
        for (int y = 0; y < d.of.height; y++)
            paint(&d, y, raster);
    }
    free(d.mark);
    free(d.sample);
    free(d.surface);
    free(d.scratch);
    row_bands_free(&d.bands);
    return error;
}
