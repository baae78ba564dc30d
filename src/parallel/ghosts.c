/* The plan of ghosts; see ghosts.h. */
#include "parallel/ghosts.h"

#include <omp.h>
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

/* The images of a place, by axis. */
struct images {
    int count[3];
    image_code code[3][3];
};

static struct images images_of(struct near_walls walls, const double x[3])
{
    struct images images = {{1, 1, 1}, {{0}}};
    for (int axis = 0; axis < walls.dimension; axis++)
        images.count[axis] =
            images_along(walls.mirrors, axis, x[axis], walls.distance, images.code[axis]);
    return images;
}

/* How many there are, less the place itself. */
static int32_t number_of(const struct images *images)
{
    return images->count[0] * images->count[1] * images->count[2] - 1;
}

/* Plans those of the particle whose record is SOURCE, as ghosts from G on. Returns the next
 * ghost. */
static int32_t plan_images(const struct images *images, int32_t source, struct ghosts *ghosts,
                           int32_t g)
{
    for (int c = 0; c < images->count[2]; c++)
        for (int b = 0; b < images->count[1]; b++)
            for (int a = 0; a < images->count[0]; a++) {
                if (!a && !b && !c)
                    continue;
                ghosts->source[g] = source;
                ghosts->image[g++] = (image_code)(images->code[0][a] + 3 * images->code[1][b] +
                                                  9 * images->code[2][c]);
            }
    return g;
}

static bool reserve(struct ghosts *ghosts, int64_t needed)
{
    int64_t capacity = ghosts->capacity;
    if (!memory_reserve((void **)&ghosts->source, &capacity, needed, ghosts->count,
                        sizeof *ghosts->source))
        return false;
    capacity = ghosts->capacity;
    if (!memory_reserve((void **)&ghosts->image, &capacity, needed, ghosts->count,
                        sizeof *ghosts->image))
        return false;
    ghosts->capacity = capacity;
    return true;
}

/* COUNT places X, STRIDE doubles apart, whose records are those from SOURCE on. */
struct places {
    const double *x;
    size_t stride;
    int32_t source, count;
};

/* Plans the images of places: each thread counts those of a part of the places, and writes them
 * after those of the parts before. */
static bool plan_part(struct near_walls walls, struct places places, int threads,
                      struct ghosts *ghosts)
{
    enum { PARTS = 64 };
    int32_t number[PARTS + 1] = {0};
    bool room = true;
#pragma omp parallel num_threads(threads < PARTS ? threads : PARTS)
    {
        const int parts = omp_get_num_threads(), part = omp_get_thread_num();
        const int32_t begin = (int32_t)((int64_t)places.count * part / parts);
        const int32_t end = (int32_t)((int64_t)places.count * (part + 1) / parts);
        int32_t own = 0;
        for (int32_t i = begin; i < end; i++) {
            struct images images = images_of(walls, places.x + (size_t)i * places.stride);
            own += number_of(&images);
        }
        number[part + 1] = own;
#pragma omp barrier
#pragma omp single
        {
            number[0] = ghosts->count;
            for (int k = 0; k < parts; k++)
                number[k + 1] += number[k];
            room = reserve(ghosts, number[parts]);
            ghosts->count = room ? number[parts] : ghosts->count;
        }
        for (int32_t i = begin, g = number[part]; i < end && room && own > 0; i++) {
            struct images images = images_of(walls, places.x + (size_t)i * places.stride);
            g = plan_images(&images, places.source + i, ghosts, g);
        }
    }
    return room;
}

struct error *ghosts_plan(struct near_walls walls, int32_t count, const double (*position)[3],
                          int threads, struct ghosts *ghosts)
{
    const size_t stride = sizeof *ghosts->remote / sizeof(double);
    static_assert(sizeof(struct remote) % sizeof(double) == 0, "places lie doubles apart");
    ghosts->count = 0;
    bool room = reserve(ghosts, ghosts->remotes);
    for (int32_t g = 0; g < ghosts->remotes && room; g++) {
        ghosts->source[g] = count + g;
        ghosts->image[g] = 0;
    }
    ghosts->count = ghosts->remotes;
    room = room && plan_part(walls, (struct places){(const double *)position, 3, 0, count}, threads,
                             ghosts);
    ghosts->early = ghosts->count;
    room = room && plan_part(walls,
                             (struct places){(const double *)ghosts->remote, stride, count,
                                             ghosts->remotes},
                             threads, ghosts);
    return room ? NULL : out_of_memory_for("the images of %d particles", count);
}

void ghosts_start(struct ghosts *ghosts, double *record, int32_t owned, size_t bytes)
{
    exchange_start(&ghosts->exchange, record, bytes, (char *)record + (size_t)owned * bytes);
}

void ghosts_finish(struct ghosts *ghosts) { exchange_finish(&ghosts->exchange); }

void ghosts_free(struct ghosts *ghosts)
{
    free(ghosts->source);
    free(ghosts->image);
    free(ghosts->remote);
    exchange_free(&ghosts->exchange);
    *ghosts = (struct ghosts){0};
}
