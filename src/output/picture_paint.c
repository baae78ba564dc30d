/* Painting particles straight into the pixels of an image: a vector drawing of a million particles takes
 * minutes. */
#include "output/picture_internal.h"

static int clamp(double value, int low, int high)
{
    return (int)minimum(maximum(value, low), high);
}

/* A square with edges rounded to pixels, one at least. Neighbours round alike, so that packed squares
 * leave no gap. */
static void paint_square(const struct pixels *pixels, double x, double y, double edge,
                         uint32_t colour)
{
    double left = floor(x - 0.5 * edge + 0.5), right = floor(x + 0.5 * edge + 0.5);
    double top = floor(y - 0.5 * edge + 0.5), bottom = floor(y + 0.5 * edge + 0.5);
    if (right <= left)
        right = (left = floor(x)) + 1.0;
    if (bottom <= top)
        bottom = (top = floor(y)) + 1.0;
    int first = clamp(left, pixels->left, pixels->right), end = clamp(right, first, pixels->right);
    int last_row = clamp(bottom, pixels->top, pixels->bottom);
    for (int row = clamp(top, pixels->top, pixels->bottom); row < last_row; ++row)
        for (int column = first; column < end; ++column)
            pixels->data[row * pixels->stride + column] = colour;
}

static uint32_t blend(uint32_t behind, uint32_t front, double part)
{
    uint32_t weight = (uint32_t)(part * 256.0), rest = 256 - weight;
    uint32_t red_blue = ((front & 0xff00ff) * weight + (behind & 0xff00ff) * rest) >> 8;
    uint32_t green = ((front & 0x00ff00) * weight + (behind & 0x00ff00) * rest) >> 8;
    return (red_blue & 0xff00ff) | (green & 0x00ff00);
}

/* A disc with a smooth rim. */
static void paint_disc(const struct pixels *pixels, double x, double y, double diameter,
                       uint32_t colour)
{
    double radius = 0.5 * diameter, reach = radius + 1.0;
    int first = clamp(floor(x - reach), pixels->left, pixels->right);
    int end = clamp(ceil(x + reach), first, pixels->right);
    int last_row = clamp(ceil(y + reach), pixels->top, pixels->bottom);
    for (int row = clamp(floor(y - reach), pixels->top, pixels->bottom); row < last_row; ++row) {
        uint32_t *line = pixels->data + row * pixels->stride;
        for (int column = first; column < end; ++column) {
            double distance = hypot(column + 0.5 - x, row + 0.5 - y);
            double cover = minimum(radius + 0.5 - distance, 1.0);
            if (cover > 0.0)
                line[column] = blend(line[column], colour, cover);
        }
    }
}

void paint_particle(const struct pixels *pixels, double x, double y, double diameter,
                    struct colour colour)
{
    enum { square_below = 4 };
    uint32_t packed = (uint32_t)(colour.red * 255.0 + 0.5) << 16 |
                      (uint32_t)(colour.green * 255.0 + 0.5) << 8 |
                      (uint32_t)(colour.blue * 255.0 + 0.5);
    if (diameter < square_below)
        paint_square(pixels, x, y, diameter, packed);
    else
        paint_disc(pixels, x, y, diameter, packed);
}
