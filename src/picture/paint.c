/* Painting particles straight into the pixels of an image: a vector drawing of a million particles
 * takes minutes. */
#include "picture/internal.h"

static uint32_t pack(struct colour colour)
{
    return (uint32_t)(colour.red * 255.0 + 0.5) << 16 |
           (uint32_t)(colour.green * 255.0 + 0.5) << 8 | (uint32_t)(colour.blue * 255.0 + 0.5);
}

static int clamp(double value, int low, int high)
{
    return (int)minimum(maximum(value, low), high);
}

/* Neighbours round their common edge alike, so that packed squares leave no gap. */
void paint_square(const struct pixels *pixels, double x, double y, double edge,
                  struct colour colour)
{
    uint32_t packed = pack(colour);
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
            pixels->data[(row - pixels->first_row) * pixels->stride + column] = packed;
}

static uint32_t blend(uint32_t behind, uint32_t front, double part)
{
    uint32_t weight = (uint32_t)(part * 256.0), rest = 256 - weight;
    uint32_t red_blue = ((front & 0xff00ff) * weight + (behind & 0xff00ff) * rest) >> 8;
    uint32_t green = ((front & 0x00ff00) * weight + (behind & 0x00ff00) * rest) >> 8;
    return (red_blue & 0xff00ff) | (green & 0x00ff00);
}

void paint_disc(const struct pixels *pixels, double x, double y, double diameter,
                struct colour colour)
{
    enum { square_below = 4 };
    if (diameter < square_below) {
        paint_square(pixels, x, y, diameter, colour);
        return;
    }
    uint32_t packed = pack(colour);
    double radius = 0.5 * diameter, reach = radius + 1.0;
    int first = clamp(floor(x - reach), pixels->left, pixels->right);
    int end = clamp(ceil(x + reach), first, pixels->right);
    int last_row = clamp(ceil(y + reach), pixels->top, pixels->bottom);
    for (int row = clamp(floor(y - reach), pixels->top, pixels->bottom); row < last_row; ++row) {
        uint32_t *line = pixels->data + (row - pixels->first_row) * pixels->stride;
        for (int column = first; column < end; ++column) {
            double distance = hypot(column + 0.5 - x, row + 0.5 - y);
            double cover = minimum(radius + 0.5 - distance, 1.0);
            if (cover > 0.0)
                line[column] = blend(line[column], packed, cover);
        }
    }
}
