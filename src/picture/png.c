/* PNG files by libpng, see png.h. */
#include "picture/png.h"

#include <errno.h>
#include <png.h>
#include <setjmp.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* Colours that agree in the upper five bits of each channel share a bin, and a bin its commonest
 * colour: the one that is left by a majority vote (Boyer and Moore 1991). */
enum { BINS = 1 << 15, PALETTE_MAX = 256 };
struct palette {
    uint32_t chosen[BINS];
    int64_t votes[BINS];
    unsigned char index[BINS];
    png_color colour[PALETTE_MAX];
    int count;
};

static uint32_t bin_of(uint32_t colour)
{
    return (colour >> 9 & 0x7c00) | (colour >> 6 & 0x3e0) | (colour >> 3 & 0x1f);
}

/* The first pixel at or after X that differs from the one at X. */
static int run_end(const uint32_t *row, int x, int width)
{
    const uint32_t first = row[x];
    while (x < width && row[x] == first)
        x++;
    return x;
}

static const uint32_t *row_of(const struct png_image *image, int y)
{
    return (const uint32_t *)(const void *)(image->data + (size_t)y * image->stride);
}

static void vote(struct palette *palette, const struct png_image *image)
{
    for (int y = 0; y < image->height; y++) {
        const uint32_t *row = row_of(image, y);
        for (int x = 0, end; x < image->width; x = end) {
            end = run_end(row, x, image->width);
            const uint32_t colour = row[x] & 0xffffff, bin = bin_of(colour);
            if (palette->votes[bin] == 0)
                palette->chosen[bin] = colour;
            palette->votes[bin] += palette->chosen[bin] == colour ? end - x : x - end;
            if (palette->votes[bin] < 0) {
                palette->chosen[bin] = colour;
                palette->votes[bin] = -palette->votes[bin];
            }
            palette->index[bin] = 1;
        }
    }
}

/* NULL where IMAGE is not flat, has too many colours, or memory ends: it then keeps its pixels. */
static struct palette *palette_of(const struct png_image *image)
{
    struct palette *palette = image->flat ? memory_allocate(sizeof *palette) : NULL;
    if (!palette)
        return NULL;
    vote(palette, image);
    for (int bin = 0; bin < BINS; bin++) {
        if (!palette->index[bin])
            continue;
        if (palette->count == PALETTE_MAX) {
            free(palette);
            return NULL;
        }
        const uint32_t colour = palette->chosen[bin];
        palette->colour[palette->count] = (png_color){
            (png_byte)(colour >> 16), (png_byte)(colour >> 8 & 255), (png_byte)(colour & 255)};
        palette->index[bin] = (unsigned char)palette->count++;
    }
    return palette;
}

static void put_row(png_structp png, const struct png_image *image, int y,
                    const struct palette *palette, unsigned char *indices)
{
    const uint32_t *row = row_of(image, y);
    if (!palette) {
        png_write_row(png, (png_const_bytep)row);
        return;
    }
    for (int x = 0, end; x < image->width; x = end) {
        end = run_end(row, x, image->width);
        memset(indices + x, palette->index[bin_of(row[x])], (size_t)(end - x));
    }
    png_write_row(png, indices);
}

static void put_rows(png_structp png, png_infop info, const struct png_image *image,
                     const struct palette *palette, unsigned char *indices)
{
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, 8,
                 palette ? PNG_COLOR_TYPE_PALETTE : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (palette)
        png_set_PLTE(png, info, palette->colour, palette->count);
    /* the difference from the row above is zero for most of a plot: the fastest level will do */
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
    png_set_compression_level(png, 1);
    png_write_info(png, info);
    if (!palette) {
        png_set_filler(png, 0, PNG_FILLER_AFTER);
        png_set_bgr(png);
    }
    for (int y = 0; y < image->height; y++)
        put_row(png, image, y, palette, indices);
    png_write_end(png, info);
}

bool png_put(FILE *file, const struct png_image *image)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    struct palette *const palette = palette_of(image);
    unsigned char *const indices = palette ? memory_allocate((size_t)image->width) : NULL;
    volatile bool written = false;
    errno = info ? 0 : ENOMEM;
    if (info && !setjmp(png_jmpbuf(png))) {
        png_init_io(png, file);
        put_rows(png, info, image, indices ? palette : NULL, indices);
        written = true;
    }
    if (!written && errno == 0) /* libpng tells no more */
        errno = EIO;
    const int why = errno;
    png_destroy_write_struct(&png, &info);
    free(indices);
    free(palette);
    errno = why;
    return written;
}

bool png_write(const char *path, const struct png_image *image)
{
    FILE *file = fopen(path, "wb");
    bool written = file && png_put(file, image);
    if (file)
        written = !fclose(file) && written;
    return written;
}
