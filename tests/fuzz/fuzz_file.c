/* The readers of images and meshes under libFuzzer: whatever the bytes, they return a shape or say
 * what is wrong, and give all memory back. A shape can be asked what it holds. */
#include <stdlib.h>

#include "shape/pixels.h"
#include "shape/triangles.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void insist(bool holds)
{
    if (!holds)
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    /* As a file is read: with a zero behind it. */
    char *bytes = malloc(size + 1);
    if (!bytes)
        return 0;
    for (size_t i = 0; i < size; i++)
        bytes[i] = (char)data[i];
    bytes[size] = '\0';

    struct pixels *pixels = NULL;
    const char *text = pixels_read(bytes, size, &pixels);
    insist(!text == !!pixels);
    for (int64_t i = 0; pixels && i < pixels->width * pixels->height; i++)
        insist(pixels->grey[i] >= PIXEL_CLEAR && pixels->grey[i] <= PIXEL_WHITE);
    free(pixels);

    struct triangles *triangles = NULL;
    text = stl_read(bytes, size, &triangles);
    insist(!text == !!triangles);
    for (int i = 0; triangles && i < 64; i++) {
        const struct vec3 low = triangles->bounds.low, high = triangles->bounds.high;
        const double part[3] = {(i % 4 + 0.5) / 4.0, (i / 4 % 4 + 0.5) / 4.0, i / 16 / 4.0};
        triangles_hold(triangles, vec3_make(low.x + part[0] * (high.x - low.x),
                                            low.y + part[1] * (high.y - low.y),
                                            low.z + part[2] * (high.z - low.z)));
    }
    free(triangles);
    free(bytes);
    return 0;
}
