/* Sorting what is drawn into bands of rows, so that threads share a picture and its bits do not
 * depend on how many there are. */
#include <stdlib.h>

#include "base/memory.h"
#include "picture/scene.h"

static bool band_range(const struct span *span, int count, int *first, int *last)
{
    const float low = span->top / BAND_ROWS, high = span->bottom / BAND_ROWS;
    if (!(span->top <= span->bottom) || high < 0.0f || low >= (float)count)
        return false;
    *first = low > 0.0f ? (int)low : 0;
    *last = high < (float)count ? (int)high : count - 1;
    return true;
}

static struct error *fill_bands(const struct span *span, int64_t count, int height,
                                struct row_bands *bands)
{
    int first, last;
    *bands = (struct row_bands){.count = (height + BAND_ROWS - 1) / BAND_ROWS};
    /* begin[band + 2] counts, then begin[band + 1] runs from the start of the band to its end. */
    int64_t *begin = memory_allocate(((size_t)bands->count + 2) * sizeof *begin);
    bands->begin = begin;
    if (!begin || count > INT32_MAX)
        return out_of_memory_for("a picture");
    for (int64_t i = 0; i < count; i++)
        if (band_range(&span[i], bands->count, &first, &last))
            for (int band = first; band <= last; band++)
                begin[band + 2]++;
    for (int band = 2; band <= bands->count + 1; band++)
        begin[band] += begin[band - 1];
    bands->item = memory_allocate((size_t)begin[bands->count + 1] * sizeof *bands->item + 1);
    if (!bands->item)
        return out_of_memory_for("a picture");
    for (int64_t i = 0; i < count; i++)
        if (band_range(&span[i], bands->count, &first, &last))
            for (int band = first; band <= last; band++)
                bands->item[begin[band + 1]++] = (int32_t)i;
    return NULL;
}

struct error *row_bands_make(const struct drawing_of *of, mark_place place, void *context,
                             struct row_bands *bands)
{
    const int64_t count = of->scene->count, marks = view_images(of->view) * count;
    struct span *span = memory_allocate((size_t)marks * sizeof *span + 1);
    if (!span)
        return out_of_memory_for("a picture");
#pragma omp parallel for schedule(static) num_threads(of->threads)
    for (int64_t m = 0; m < marks; m++) {
        double sign[3], at[3];
        view_image(of->view, (int)(m / count), sign);
        view_reflect(of->view, sign, of->scene->item[m % count].place, at);
        span[m] = place(context, m, at);
    }
    struct error *error = fill_bands(span, marks, of->height, bands);
    free(span);
    return error;
}

void row_bands_free(struct row_bands *bands)
{
    free(bands->begin);
    free(bands->item);
}

struct pixel_box row_bands_box(float x, float y, float reach, int band, int width, int height)
{
    const int low = band * BAND_ROWS, high = low + BAND_ROWS - 1;
    return (struct pixel_box){(int)maximum(floorf(x - reach), 0),
                              (int)minimum(ceilf(x + reach), width - 1),
                              (int)maximum(floorf(y - reach), low),
                              (int)minimum(ceilf(y + reach), high < height ? high : height - 1)};
}
