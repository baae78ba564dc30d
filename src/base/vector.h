/* Vectors and symmetric tensors of three dimensions, by value.
 * A symmetric tensor keeps xx, yy, zz, xy, yz, zx in this order, in memory as in files. */
#ifndef BOLIDE_VECTOR_H
#define BOLIDE_VECTOR_H

#include "base/base.h"

struct vec3 {
    double x, y, z;
};

struct sym3 {
    double xx, yy, zz, xy, yz, zx;
};

BOLIDE_INLINE struct vec3 vec3_make(double x, double y, double z)
{
    struct vec3 v = {x, y, z};
    return v;
}
BOLIDE_INLINE struct vec3 vector_at(const double v[3]) { return vec3_make(v[0], v[1], v[2]); }

/* A component of a vector. */
BOLIDE_INLINE double vec3_at(struct vec3 v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

BOLIDE_INLINE struct vec3 vec3_add(struct vec3 a, struct vec3 b)
{
    return vec3_make(a.x + b.x, a.y + b.y, a.z + b.z);
}

BOLIDE_INLINE struct vec3 vec3_sub(struct vec3 a, struct vec3 b)
{
    return vec3_make(a.x - b.x, a.y - b.y, a.z - b.z);
}

BOLIDE_INLINE struct vec3 vec3_scale(double s, struct vec3 a)
{
    return vec3_make(s * a.x, s * a.y, s * a.z);
}

BOLIDE_INLINE double vec3_dot(struct vec3 a, struct vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

BOLIDE_INLINE struct vec3 vec3_cross(struct vec3 a, struct vec3 b)
{
    return vec3_make(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* From and to six numbers in memory. */
BOLIDE_INLINE struct sym3 sym3_make(const double *of)
{
    struct sym3 s = {of[0], of[1], of[2], of[3], of[4], of[5]};
    return s;
}

BOLIDE_INLINE void sym3_store(struct sym3 s, double *to)
{
    to[0] = s.xx;
    to[1] = s.yy;
    to[2] = s.zz;
    to[3] = s.xy;
    to[4] = s.yz;
    to[5] = s.zx;
}

BOLIDE_INLINE double sym3_trace(struct sym3 s) { return s.xx + s.yy + s.zz; }

/* The double contraction s:s over all nine components. */
BOLIDE_INLINE double sym3_square(struct sym3 s)
{
    return s.xx * s.xx + s.yy * s.yy + s.zz * s.zz +
           2.0 * (s.xy * s.xy + s.yz * s.yz + s.zx * s.zx);
}

BOLIDE_INLINE struct sym3 sym3_scale(double a, struct sym3 s)
{
    struct sym3 r = {a * s.xx, a * s.yy, a * s.zz, a * s.xy, a * s.yz, a * s.zx};
    return r;
}

BOLIDE_INLINE struct sym3 sym3_add(struct sym3 a, struct sym3 b)
{
    struct sym3 r = {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.yz + b.yz, a.zx + b.zx};
    return r;
}

/* s.v, the traction of a stress s on a plane of normal v. */
BOLIDE_INLINE struct vec3 sym3_dot(struct sym3 s, struct vec3 v)
{
    return vec3_make(s.xx * v.x + s.xy * v.y + s.zx * v.z, s.xy * v.x + s.yy * v.y + s.yz * v.z,
                     s.zx * v.x + s.yz * v.y + s.zz * v.z);
}

/* Equivalent (von Mises) stress of a deviator: sqrt(3/2 s:s). */
BOLIDE_INLINE double sym3_mises(struct sym3 deviator) { return sqrt(1.5 * sym3_square(deviator)); }

#endif
