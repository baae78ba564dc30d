#include "shape/pixels.h"

#include <cairo.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "shape/palette.h"

/* A file begins with this and the size of the picture, two big-endian numbers of four bytes. */
static const unsigned char signature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n',
                                          0,    0,   0,   13,  'I',  'H',  'D',  'R'};
enum { HEADER_BYTES = sizeof signature + 8 };

/* Along one edge, and in all. */
static const int64_t most_along = 30000, most_pixels = 100000000;

struct stream {
    const unsigned char *bytes;
    size_t size, used;
};

static cairo_status_t read_bytes(void *closure, unsigned char *data, unsigned int length)
{
    struct stream *stream = closure;
    if (length > stream->size - stream->used)
        return CAIRO_STATUS_READ_ERROR;
    memcpy(data, stream->bytes + stream->used, length);
    stream->used += length;
    return CAIRO_STATUS_SUCCESS;
}

static int64_t big_endian(const unsigned char *bytes)
{
    return (int64_t)bytes[0] << 24 | bytes[1] << 16 | bytes[2] << 8 | bytes[3];
}

/* Colors are multiplied by the opacity where there is one. */
static int16_t grey_of(uint32_t pixel, bool has_opacity)
{
    const uint32_t opacity = has_opacity ? pixel >> 24 : 255;
    if (opacity < 128)
        return PIXEL_CLEAR;
    const uint32_t red = pixel >> 16 & 255, green = pixel >> 8 & 255, blue = pixel & 255;
    const uint32_t bright = 299 * red + 587 * green + 114 * blue;
    const uint32_t grey = (bright * 255 / opacity + 500) / 1000;
    return (int16_t)(grey > PIXEL_WHITE ? PIXEL_WHITE : grey);
}

static struct pixels *copy_pixels(cairo_surface_t *surface)
{
    const int64_t width = cairo_image_surface_get_width(surface);
    const int64_t height = cairo_image_surface_get_height(surface);
    struct pixels *pixels =
        memory_allocate(sizeof *pixels + (size_t)(width * height) * sizeof(int16_t));
    if (!pixels)
        return NULL;
    const bool has_opacity = cairo_image_surface_get_format(surface) == CAIRO_FORMAT_ARGB32;
    const int stride = cairo_image_surface_get_stride(surface);
    const unsigned char *data = cairo_image_surface_get_data(surface);
    pixels->width = width;
    pixels->height = height;
    for (int64_t y = 0; y < height; y++)
        for (int64_t x = 0; x < width; x++) {
            uint32_t pixel;
            memcpy(&pixel, data + y * stride + 4 * x, sizeof pixel);
            pixels->grey[y * width + x] = grey_of(pixel, has_opacity);
        }
    return pixels;
}

/* The pixels of a whole image, or what is wrong with it. */
static const char *decode(const unsigned char *bytes, size_t size, struct pixels **made)
{
    struct stream stream = {bytes, size, 0};
    cairo_surface_t *surface = cairo_image_surface_create_from_png_stream(read_bytes, &stream);
    const cairo_status_t status = cairo_surface_status(surface);
    const cairo_format_t format = cairo_image_surface_get_format(surface);
    const char *text = NULL;
    if (status == CAIRO_STATUS_NO_MEMORY)
        text = "this PNG image is damaged, or there is no memory for it";
    else if (status != CAIRO_STATUS_SUCCESS)
        text = "this PNG image is damaged or cut off";
    else if (format != CAIRO_FORMAT_ARGB32 && format != CAIRO_FORMAT_RGB24)
        text = "this PNG image has more than 8 bits a channel: convert it to 8-bit grey";
    else if (!(*made = copy_pixels(surface)))
        text = "there is no memory for this image";
    cairo_surface_destroy(surface);
    return text;
}

/* Whether pixels differ with what follows the palette: they name that. */
static bool names_missing_entry(const unsigned char *bytes, size_t size)
{
    struct pixels *pixels[2] = {NULL, NULL};
    for (int k = 0; k < 2; k++) {
        unsigned char *filled;
        size_t filled_size;
        if (palette_fill(bytes, size, k ? PIXEL_WHITE : 0, &filled, &filled_size) && filled)
            decode(filled, filled_size, &pixels[k]);
        free(filled);
    }
    const bool differs =
        pixels[0] && pixels[1] &&
        memcmp(pixels[0]->grey, pixels[1]->grey,
               (size_t)(pixels[0]->width * pixels[0]->height) * sizeof *pixels[0]->grey) != 0;
    free(pixels[0]);
    free(pixels[1]);
    return differs;
}

const char *pixels_read(const char *bytes, size_t size, struct pixels **made)
{
    struct stream stream = {(const unsigned char *)bytes, size, 0};
    if (size == 0)
        return "this `file` is empty";
    if (size < sizeof signature || memcmp(bytes, signature, sizeof signature) != 0)
        return "this `file` is not a PNG image: convert it";
    if (size < HEADER_BYTES)
        return "this PNG image is damaged or cut off";
    const int64_t width = big_endian(stream.bytes + sizeof signature);
    const int64_t height = big_endian(stream.bytes + sizeof signature + 4);
    if (width > most_along || height > most_along || width * height > most_pixels)
        return "this image is too large: at most 30000 pixels along an edge, and 100 million";
    const char *text = decode(stream.bytes, size, made);
    if (!text && names_missing_entry(stream.bytes, size)) {
        free(*made);
        *made = NULL;
        text = "pixels of this PNG image name colors that its palette lacks: save it anew, without "
               "a palette";
    }
    return text;
}
