/* Ghosts: records of particles that a rank does not own but must see. One plan, made with the neighbour
 * list, says of each ghost which owned particle it copies and how it is reflected. Mirror walls are the one
 * source of ghosts of a rank alone. */
#ifndef BOLIDE_GHOSTS_H
#define BOLIDE_GHOSTS_H

#include "base/error.h"
#include "base/vector.h"

/* Rigid slip walls normal to the axes: at most a low and a high one an axis, NAN where there is none.
 * Source of the reflection: Parshikov (2013), sections 2.8 and 3.1. */
struct mirrors {
    double low[3], high[3];
};

/* Which image of a particle a ghost is: a base-3 number, per axis 0 itself, 1 behind the low wall, 2
 * behind the high wall. Zero is the particle itself. */
typedef uint8_t image_code;
enum { IMAGE_CODES = 27 };

struct ghosts {
    int32_t count;
    int64_t capacity;
    int32_t *source;
    image_code *image;
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

/* Makes the plan for COUNT particles at POSITION: an image behind each wall that is nearer to the particle
 * than DISTANCE, and behind the corners of such walls. */
struct error *ghosts_plan(const struct mirrors *mirrors, int dimension, int32_t count,
                          const double (*position)[3], double distance, struct ghosts *ghosts);
void ghosts_free(struct ghosts *ghosts);

#endif
