/* PNG files of pictures, quickly: cairo's own spend most of a small run on compression. */
#ifndef BOLIDE_PNG_H
#define BOLIDE_PNG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Rows of pixels 0xRRGGBB from the top, as CAIRO_FORMAT_RGB24 has them on machines of little
 * endian: the upper byte is unused, and rows are STRIDE bytes apart. A flat image, of lines and
 * text, becomes one of a palette, where shades at edges may be off by 7 of 255. */
struct png_image {
    int width, height;
    size_t stride;
    const unsigned char *data;
    bool flat;
};

/* Writes the file PATH, or to FILE; on failure errno says why. */
bool png_write(const char *path, const struct png_image *image);
bool png_put(FILE *file, const struct png_image *image);

#endif
