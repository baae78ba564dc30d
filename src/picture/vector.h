/* Vectors in single precision, as pictures need them. Private to the pictures. */
#ifndef BOLIDE_PICTURE_VECTOR_H
#define BOLIDE_PICTURE_VECTOR_H

#include <math.h>

#include "base/base.h"

struct vector {
    float x, y, z;
};

BOLIDE_INLINE struct vector vector_of(const double *at)
{
    return (struct vector){(float)at[0], (float)at[1], (float)at[2]};
}
BOLIDE_INLINE struct vector plus(struct vector a, struct vector b)
{
    return (struct vector){a.x + b.x, a.y + b.y, a.z + b.z};
}
BOLIDE_INLINE struct vector minus(struct vector a, struct vector b)
{
    return (struct vector){a.x - b.x, a.y - b.y, a.z - b.z};
}
BOLIDE_INLINE struct vector times(struct vector a, float s)
{
    return (struct vector){a.x * s, a.y * s, a.z * s};
}
BOLIDE_INLINE float dot(struct vector a, struct vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
BOLIDE_INLINE struct vector cross(struct vector a, struct vector b)
{
    return (struct vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
BOLIDE_INLINE struct vector unit(struct vector a)
{
    return times(a, 1.0f / sqrtf(dot(a, a) + 1e-30f));
}

#endif
