/* Smaller copies of pictures, for pages. */
#include <stdio.h>

#include "base/memory.h"
#include "picture/internal.h"
#include "picture/picture.h"

/* The mean of FACTOR x FACTOR pixels of one colour, at SHIFT bits. */
static uint32_t mean_of(const uint32_t *from, int64_t stride, int factor, int shift)
{
    uint32_t sum = 0;
    for (int y = 0; y < factor; y++)
        for (int x = 0; x < factor; x++)
            sum += from[y * stride + x] >> shift & 255;
    return (sum + (uint32_t)(factor * factor / 2)) / (uint32_t)(factor * factor) << shift;
}

static void shrink(cairo_surface_t *from, cairo_surface_t *to, int factor)
{
    const uint32_t *source = (const uint32_t *)(const void *)cairo_image_surface_get_data(from);
    uint32_t *target = (uint32_t *)(void *)cairo_image_surface_get_data(to);
    const int64_t wide = cairo_image_surface_get_stride(from) / 4;
    const int64_t narrow = cairo_image_surface_get_stride(to) / 4;
    for (int64_t y = 0; y < cairo_image_surface_get_height(to); y++)
        for (int64_t x = 0; x < cairo_image_surface_get_width(to); x++) {
            const uint32_t *corner = source + y * factor * wide + x * factor;
            target[y * narrow + x] = mean_of(corner, wide, factor, 16) |
                                     mean_of(corner, wide, factor, 8) |
                                     mean_of(corner, wide, factor, 0);
        }
    cairo_surface_mark_dirty(to);
}

static bool put_shrunk(FILE *file, cairo_surface_t *whole, int factor)
{
    cairo_surface_t *part = cairo_image_surface_create(
        CAIRO_FORMAT_RGB24, (int)maximum(cairo_image_surface_get_width(whole) / factor, 1),
        (int)maximum(cairo_image_surface_get_height(whole) / factor, 1));
    bool written = cairo_surface_status(part) == CAIRO_STATUS_SUCCESS;
    if (written && cairo_image_surface_get_width(whole) >= factor &&
        cairo_image_surface_get_height(whole) >= factor)
        shrink(whole, part, factor);
    if (written) {
        const struct png_image image = canvas_image(part);
        written = png_put(file, &image);
    }
    cairo_surface_destroy(part);
    return written;
}

struct error *picture_shrink(const char *path, int factor, char **bytes, size_t *size)
{
    *bytes = NULL;
    *size = 0;
    cairo_surface_t *whole = cairo_image_surface_create_from_png(path);
    const cairo_status_t status = cairo_surface_status(whole);
    struct error *error = status == CAIRO_STATUS_SUCCESS
                              ? NULL
                              : error_new(ERROR_SYSTEM, "%s: cannot be read as a picture: %s", path,
                                          cairo_status_to_string(status));
    FILE *file = error ? NULL : open_memstream(bytes, size);
    if (!error && !file)
        error = out_of_memory_for("a picture");
    if (file) {
        const bool written = put_shrunk(file, whole, factor);
        if ((fclose(file) || !written) && !error)
            error = out_of_memory_for("a picture");
    }
    cairo_surface_destroy(whole);
    return error;
}
