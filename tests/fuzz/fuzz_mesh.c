/* The reader of meshes under libFuzzer: whatever the bytes, it returns a closed surface or says
 * what is wrong, and frees all memory. A surface tells which points it encloses. */
#include "fuzz.h"
#include "shape/triangles.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *bytes = fuzz_file(data, size);
    if (!bytes)
        return 0;

    struct triangles *triangles = NULL;
    char said[MESH_TEXT];
    const char *text = stl_read(bytes, size, said, &triangles);
    insist(!text == !!triangles, "neither a mesh nor an error, or both");
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
