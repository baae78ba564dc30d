/* The plan of ghosts; see ghosts.h. */
#include "parallel/ghosts.h"

#include <stdlib.h>

#include "base/memory.h"

/* The images along one axis: always itself, then those behind near walls. Returns how many. */
static int images_along(const struct mirrors *mirrors, int axis, double x, double distance,
                        image_code image[3])
{
    int count = 1;
    image[0] = 0;
    if (x - mirrors->low[axis] < distance)
        image[count++] = 1;
    if (mirrors->high[axis] - x < distance)
        image[count++] = 2;
    return count;
}

static struct error *reserve(void **array, int64_t *capacity, int64_t needed, int64_t kept,
                             size_t element)
{
    if (!memory_reserve(array, capacity, needed, kept, element))
        return error_new(ERROR_SYSTEM, "out of memory for %lld images", (long long)needed);
    return NULL;
}

static struct error *plan_add(struct ghosts *ghosts, int32_t source, image_code image)
{
    int64_t needed = (int64_t)ghosts->count + 1, capacity = ghosts->capacity;
    if (needed > capacity) {
        TRY(reserve((void **)&ghosts->source, &capacity, needed, ghosts->count,
                    sizeof *ghosts->source));
        capacity = ghosts->capacity;
        TRY(reserve((void **)&ghosts->image, &capacity, needed, ghosts->count,
                    sizeof *ghosts->image));
        ghosts->capacity = capacity;
    }
    ghosts->source[ghosts->count] = source;
    ghosts->image[ghosts->count++] = image;
    return NULL;
}

struct error *ghosts_plan(const struct mirrors *mirrors, int dimension, int32_t count,
                          const double (*position)[3], double distance, struct ghosts *ghosts)
{
    ghosts->count = 0;
    for (int32_t i = 0; i < count; i++) {
        image_code image[3][3] = {{0}};
        int images[3] = {1, 1, 1};
        for (int axis = 0; axis < dimension; axis++)
            images[axis] = images_along(mirrors, axis, position[i][axis], distance, image[axis]);
        for (int z = 0; z < images[2]; z++)
            for (int y = 0; y < images[1]; y++)
                for (int x = 0; x < images[0]; x++)
                    if (x || y || z)
                        TRY(plan_add(
                            ghosts, i,
                            (image_code)(image[0][x] + 3 * image[1][y] + 9 * image[2][z])));
    }
    return NULL;
}

void ghosts_free(struct ghosts *ghosts)
{
    free(ghosts->source);
    free(ghosts->image);
    *ghosts = (struct ghosts){0};
}
