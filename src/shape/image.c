/* The pixels of a picture whose grey value is in a range, each a square; 2-D. Bodies that take
 * ranges of the same picture side by side touch and do not overlap. */
#include <stdlib.h>

#include "base/file.h"
#include "shape/kinds.h"
#include "shape/pixels.h"

const struct parameter shape_image_table[] = {
    PARAMETER(TEXT, struct shape_image, file, REQUIRED, "a PNG file, from this file's folder",
              .is_path = true),
    PARAMETER(NUMBER, struct shape_image, pixel, REQUIRED, "edge of a pixel", .unit = "m",
              .above = 0.0, .below = INFINITY),
    PARAMETER(VECTOR, struct shape_image, grey, REQUIRED,
              "the lowest and the highest grey value of the shape, 0 (black) to 255 (white); "
              "colors count by their brightness, and transparent pixels belong to no shape",
              .unit = ""),
    PARAMETER(VECTOR, struct shape_image, from, OPTIONAL,
              "the corner of the picture with the low coordinates; default: the origin",
              .unit = "m", .owned = offsetof(struct shape_image, pixels)),
    PARAMETER_END,
};

static bool inside(const void *shape, struct vec3 point)
{
    const struct shape_image *image = shape;
    const struct pixels *pixels = image->pixels;
    const struct vec3 from = vec3_of(&image->from);
    const double x = floor((point.x - from.x) / image->pixel);
    const double y = floor((point.y - from.y) / image->pixel);
    if (!(x >= 0.0 && x < (double)pixels->width && y >= 0.0 && y < (double)pixels->height))
        return false;
    const double grey =
        pixels->grey[(pixels->height - 1 - (int64_t)y) * pixels->width + (int64_t)x];
    return grey >= image->grey.at[0] && grey <= image->grey.at[1];
}

/* Of the whole picture: the lattice is the same for every range of grey. A point where there is
 * none. */
static struct bounds bounds(const void *shape)
{
    const struct shape_image *image = shape;
    const struct vec3 low = vec3_of(&image->from);
    if (!image->pixels)
        return (struct bounds){low, low};
    const struct vec3 extent = vec3_make((double)image->pixels->width * image->pixel,
                                         (double)image->pixels->height * image->pixel, 0.0);
    return (struct bounds){low, vec3_add(low, extent)};
}

static const char *wrong(const void *shape, int dimension)
{
    const struct shape_image *image = shape;
    const double *grey = image->grey.at;
    if (dimension != 2 || (image->from.count != 0 && image->from.count != 2))
        return "an image needs two dimensions, and two numbers in `from`";
    if (image->grey.count != 2 || !(0.0 <= grey[0] && grey[0] <= grey[1] && grey[1] <= 255.0))
        return "`grey` of an image is two numbers from 0 (black) to 255 (white), the lower one "
               "first";
    return NULL;
}

static bool has_pixel(const struct shape_image *image)
{
    const struct pixels *pixels = image->pixels;
    for (int64_t i = 0; i < pixels->width * pixels->height; i++)
        if (pixels->grey[i] >= image->grey.at[0] && pixels->grey[i] <= image->grey.at[1])
            return true;
    return false;
}

static const char *prepare(void *shape, int dimension)
{
    (void)dimension;
    struct shape_image *image = shape;
    if (image->pixels)
        return NULL;
    enum { MOST_BYTES = 1 << 28 };
    char *content;
    size_t size;
    const char *text = file_read_input(image->file, MOST_BYTES, &content, &size);
    if (!text)
        text = pixels_read(content, size, &image->pixels);
    free(content);
    if (!text && !has_pixel(image)) {
        free(image->pixels);
        image->pixels = NULL;
        text = "no pixel of this image is in the range of `grey`";
    }
    return text;
}

const struct shape_class shape_image_class = {inside, bounds, wrong, NULL, NULL, prepare, NULL};
