/* The plan of ghosts; see ghosts.h. */
#include "parallel/ghosts.h"

#include <stdlib.h>

#include "base/clock.h"
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

/* The images of the particle at X whose record is SOURCE. */
static struct error *plan_images(const struct mirrors *mirrors, int dimension, int32_t source,
                                 const double x[3], double distance, struct ghosts *ghosts)
{
    image_code image[3][3] = {{0}};
    int images[3] = {1, 1, 1};
    for (int axis = 0; axis < dimension; axis++)
        images[axis] = images_along(mirrors, axis, x[axis], distance, image[axis]);
    for (int c = 0; c < images[2]; c++)
        for (int b = 0; b < images[1]; b++)
            for (int a = 0; a < images[0]; a++)
                if (a || b || c)
                    TRY(plan_add(ghosts, source,
                                 (image_code)(image[0][a] + 3 * image[1][b] + 9 * image[2][c])));
    return NULL;
}

struct error *ghosts_plan(const struct mirrors *mirrors, int dimension, int32_t count,
                          const double (*position)[3], double distance, struct ghosts *ghosts)
{
    ghosts->count = 0;
    for (int32_t g = 0; g < ghosts->remotes; g++)
        TRY(plan_add(ghosts, count + g, 0));
    for (int32_t i = 0; i < count; i++)
        TRY(plan_images(mirrors, dimension, i, position[i], distance, ghosts));
    ghosts->early = ghosts->count;
    for (int32_t g = 0; g < ghosts->remotes; g++)
        TRY(plan_images(mirrors, dimension, count + g, ghosts->remote[g].place, distance, ghosts));
    return NULL;
}

void ghosts_start(struct ghosts *ghosts, double *record, int32_t owned, size_t bytes)
{
    exchange_start(&ghosts->exchange, record, bytes, (char *)record + (size_t)owned * bytes);
}

void ghosts_finish(struct ghosts *ghosts)
{
    double begin = clock_seconds();
    exchange_finish(&ghosts->exchange);
    ghosts->waited += clock_seconds() - begin;
}

void ghosts_free(struct ghosts *ghosts)
{
    free(ghosts->source);
    free(ghosts->image);
    free(ghosts->remote);
    exchange_free(&ghosts->exchange);
    *ghosts = (struct ghosts){0};
}
