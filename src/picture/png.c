/* PNG files by libpng, see png.h. */
#include "picture/png.h"

#include <errno.h>
#include <png.h>
#include <setjmp.h>

static void put_rows(png_structp png, png_infop info, const struct png_image *image)
{
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, 8,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    /* the difference from the row above is zero for most of a plot: the fastest level will do */
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
    png_set_compression_level(png, 1);
    png_write_info(png, info);
    png_set_filler(png, 0, PNG_FILLER_AFTER);
    png_set_bgr(png);
    for (int y = 0; y < image->height; y++)
        png_write_row(png, image->data + (size_t)y * image->stride);
    png_write_end(png, info);
}

bool png_put(FILE *file, const struct png_image *image)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    volatile bool written = false;
    errno = info ? 0 : ENOMEM;
    if (info && !setjmp(png_jmpbuf(png))) {
        png_init_io(png, file);
        put_rows(png, info, image);
        written = true;
    }
    if (!written && errno == 0) /* libpng tells no more */
        errno = EIO;
    const int why = errno;
    png_destroy_write_struct(&png, &info);
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
