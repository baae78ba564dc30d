/* Ghosts: records of particles that a rank does not own but must see. One plan, made with the neighbour
 * list, says of each ghost which record it copies and how it is reflected. First come particles of other ranks,
 * whose records arrive by an exchange; then images behind mirror walls, of owned particles and of those. */
#ifndef BOLIDE_GHOSTS_H
#define BOLIDE_GHOSTS_H

#include "base/vector.h"
#include "parallel/exchange.h"

/* Rigid slip walls normal to the axes: at most a low and a high one an axis, NAN where there is none.
 * Source of the reflection: Parshikov (2013), sections 2.8 and 3.1. */
struct mirrors {
    double low[3], high[3];
};

/* Which image of a particle a ghost is: a base-3 number, per axis 0 itself, 1 behind the low wall, 2
 * behind the high wall. Zero is the particle itself. */
typedef uint8_t image_code;
enum { IMAGE_CODES = 27 };

/* What a particle of another rank was when the plan was made. */
struct remote {
    double place[3], reach;
    uint64_t id;
    uint16_t body;
};

/* Ghost g copies record source[g]: an owned particle below the number of these, ghost source[g] less that number
 * above. The first `remotes` ghosts come from other ranks and are their own sources; those from there to `early` - 1 are
 * images of owned particles, those behind of others. */
struct ghosts {
    int32_t count;
    int64_t capacity;
    int32_t *source;
    image_code *image;
    int32_t remotes, early;
    struct remote *remote;
    struct exchange exchange;
};

/* -1 for the axes that IMAGE reflects, 1 for the others. */
BOLIDE_INLINE struct vec3 image_sign(image_code image)
{
    return vec3_make(image % 3 ? -1.0 : 1.0, image / 3 % 3 ? -1.0 : 1.0, image / 9 ? -1.0 : 1.0);
}

/* Place of image IMAGE of a particle at X: x' = 2 X_wall - x on each reflected axis. */
BOLIDE_INLINE struct vec3 image_position(const struct mirrors *mirrors, image_code image,
                                         struct vec3 x)
{
    int ix = image % 3, iy = image / 3 % 3, iz = image / 9;
    if (ix)
        x.x = 2.0 * (ix == 1 ? mirrors->low[0] : mirrors->high[0]) - x.x;
    if (iy)
        x.y = 2.0 * (iy == 1 ? mirrors->low[1] : mirrors->high[1]) - x.y;
    if (iz)
        x.z = 2.0 * (iz == 1 ? mirrors->low[2] : mirrors->high[2]) - x.z;
    return x;
}

/* A place has images behind each wall that is nearer than DISTANCE, and behind the corners of such
 * walls. */
struct near_walls {
    const struct mirrors *mirrors;
    int dimension;
    double distance;
};

/* Makes the plan for COUNT particles at POSITION and those of other ranks, which are planned before,
 * with THREADS threads, whose number does not change the plan. */
struct error *ghosts_plan(struct near_walls walls, int32_t count, const double (*position)[3],
                          int threads, struct ghosts *ghosts);

/* Collective: brings the records of other ranks' particles, BYTES each, behind the OWNED ones at RECORD; they are there
 * when ghosts_finish returns. Images are the caller's. Needs exchange_reserve for records of that size. */
void ghosts_start(struct ghosts *ghosts, double *record, int32_t owned, size_t bytes);
void ghosts_finish(struct ghosts *ghosts);

void ghosts_free(struct ghosts *ghosts);

#endif
