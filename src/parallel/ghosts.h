/* Ghosts: records of particles that a rank does not own but must see. One plan, made with the
 * neighbour list, says of each ghost which record it copies and how it is reflected or shifted.
 * First come particles of other ranks, whose records arrive by an exchange; then images behind
 * mirror walls and periodic faces, of owned particles and of those. */
#ifndef BOLIDE_GHOSTS_H
#define BOLIDE_GHOSTS_H

#include "base/vector.h"
#include "parallel/exchange.h"

/* Rigid slip walls normal to the axes: at most a low and a high one an axis, NAN where there is
 * none. Source of the reflection: Parshikov (2013), sections 2.8 and 3.1. An axis with a `rounder`
 * is periodic instead: low and high are its two faces (periodic.h). */
struct mirrors {
    double low[3], high[3];
    double rounder[3];
};

BOLIDE_INLINE bool images_repeat(const struct mirrors *mirrors, int axis)
{
    return mirrors->rounder[axis] != 0.0;
}

/* Whether any axis repeats. */
BOLIDE_INLINE bool images_periodic(const struct mirrors *mirrors)
{
    return images_repeat(mirrors, 0) || images_repeat(mirrors, 1) || images_repeat(mirrors, 2);
}

/* Which image of a particle a ghost is: a base-3 number, per axis 0 itself, 1 that of a particle
 * near the low wall, behind it, 2 the same at the high wall. On a periodic axis 1 lies one period
 * above the particle, and 2 one below. Zero is the particle itself. */
typedef uint8_t image_code;
enum { IMAGE_CODES = 27 };

/* What a particle of another rank was when the plan was made. */
struct remote {
    double place[3], reach;
    uint64_t id;
    uint16_t body;
};

/* Ghost g copies record source[g]: an owned particle below the number of these, ghost source[g]
 * less that number above. The first `remotes` ghosts come from other ranks and are their own
 * sources; those from there to `early` - 1 are images of owned particles, those behind of
 * others. */
struct ghosts {
    int32_t count;
    int64_t capacity;
    int32_t *source;
    image_code *image;
    int32_t remotes, early;
    struct remote *remote;
    struct exchange exchange;
};

BOLIDE_INLINE int image_along(image_code image, int axis)
{
    return axis == 0 ? image % 3 : axis == 1 ? image / 3 % 3 : image / 9;
}

/* -1 for the axes that IMAGE reflects, 1 for the others. */
BOLIDE_INLINE struct vec3 image_sign(const struct mirrors *mirrors, image_code image)
{
    double sign[3];
    for (int axis = 0; axis < 3; axis++)
        sign[axis] = image_along(image, axis) && !images_repeat(mirrors, axis) ? -1.0 : 1.0;
    return vec3_make(sign[0], sign[1], sign[2]);
}

/* Place along AXIS of image IMAGE of a particle at X: x' = 2 X_wall - x behind a wall. */
BOLIDE_INLINE double image_place(const struct mirrors *mirrors, int image, int axis, double x)
{
    const double low = mirrors->low[axis], high = mirrors->high[axis];
    if (images_repeat(mirrors, axis))
        return image == 1 ? x + (high - low) : image == 2 ? x - (high - low) : x;
    return image == 1 ? 2.0 * low - x : image == 2 ? 2.0 * high - x : x;
}

BOLIDE_INLINE struct vec3 image_position(const struct mirrors *mirrors, image_code image,
                                         struct vec3 x)
{
    return vec3_make(image_place(mirrors, image_along(image, 0), 0, x.x),
                     image_place(mirrors, image_along(image, 1), 1, x.y),
                     image_place(mirrors, image_along(image, 2), 2, x.z));
}

/* IMAGE as a number by which the images of a particle are ordered. Along a periodic axis that is
 * the order of their places, which is the same for all particles that may be taken for the one that
 * is inside. */
BOLIDE_INLINE int image_order(const struct mirrors *mirrors, image_code image)
{
    int order = 0;
    for (int axis = 2; axis >= 0; axis--) {
        const int along = image_along(image, axis);
        order = 3 * order + (images_repeat(mirrors, axis) ? (along + 1) % 3 : along);
    }
    return order;
}

/* A place has images behind each wall and periodic face that is nearer than DISTANCE, and behind
 * the corners of such. */
struct near_walls {
    const struct mirrors *mirrors;
    int dimension;
    double distance;
};

/* Makes the plan for COUNT particles at POSITION and those of other ranks, which are planned
 * before, with THREADS threads, whose number does not change the plan. */
struct error *ghosts_plan(struct near_walls walls, int32_t count, const double (*position)[3],
                          int threads, struct ghosts *ghosts);

/* Collective: brings the records of other ranks' particles, BYTES each, behind the OWNED ones at
 * RECORD; they are there when ghosts_finish returns. Images are the caller's. Needs
 * exchange_reserve for records of that size. */
void ghosts_start(struct ghosts *ghosts, double *record, int32_t owned, size_t bytes);
void ghosts_finish(struct ghosts *ghosts);

void ghosts_free(struct ghosts *ghosts);

#endif
