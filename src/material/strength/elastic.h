/* The elastic part of every strength model, a hypoelastic solid:
 *
 *   dS/dt = 2 G (strain rate - trace/3)   (1.54)-(1.56)
 *   rotation of S by the spin             (1.59), (1.60), by the exact rotation matrix
 *
 * Source: Parshikov (2013), sections 1.3 and 1.5. The source's rotation matrix is linear in dt and
 * not quite orthogonal; the exact one differs from it in second order. */
#ifndef BOLIDE_STRENGTH_ELASTIC_H
#define BOLIDE_STRENGTH_ELASTIC_H

#include "base/exponential.h"
#include "material/point.h"

/* The tensor S turned by the angle |angle| about the axis ANGLE (radians): R S R^T, by Rodrigues'
 * formula applied to the columns of S, then to the rows. */
BOLIDE_INLINE struct sym3 sym3_rotate(struct sym3 s, struct vec3 angle)
{
    double turn2 = vec3_dot(angle, angle);
    /* sin(t)/t and (1 - cos t)/t^2 by series: a step turns by far less than half a radian. */
    double a = 1.0 - turn2 / 6.0 * (1.0 - turn2 / 20.0 * (1.0 - turn2 / 42.0));
    double b = 0.5 * (1.0 - turn2 / 12.0 * (1.0 - turn2 / 30.0 * (1.0 - turn2 / 56.0)));
    /* R = I + a [angle]x + b [angle]x^2 */
    double x = angle.x, y = angle.y, z = angle.z;
    double r11 = 1.0 - b * (y * y + z * z), r12 = b * x * y - a * z, r13 = b * x * z + a * y;
    double r21 = b * x * y + a * z, r22 = 1.0 - b * (x * x + z * z), r23 = b * y * z - a * x;
    double r31 = b * x * z - a * y, r32 = b * y * z + a * x, r33 = 1.0 - b * (x * x + y * y);
    /* M = R S, then M R^T. */
    double m11 = r11 * s.xx + r12 * s.xy + r13 * s.zx, m12 = r11 * s.xy + r12 * s.yy + r13 * s.yz,
           m13 = r11 * s.zx + r12 * s.yz + r13 * s.zz;
    double m21 = r21 * s.xx + r22 * s.xy + r23 * s.zx, m22 = r21 * s.xy + r22 * s.yy + r23 * s.yz,
           m23 = r21 * s.zx + r22 * s.yz + r23 * s.zz;
    double m31 = r31 * s.xx + r32 * s.xy + r33 * s.zx, m32 = r31 * s.xy + r32 * s.yy + r33 * s.yz,
           m33 = r31 * s.zx + r32 * s.yz + r33 * s.zz;
    struct sym3 turned;
    turned.xx = m11 * r11 + m12 * r12 + m13 * r13;
    turned.yy = m21 * r21 + m22 * r22 + m23 * r23;
    turned.zz = m31 * r31 + m32 * r32 + m33 * r33;
    turned.xy = m11 * r21 + m12 * r22 + m13 * r23;
    turned.yz = m21 * r31 + m22 * r32 + m23 * r33;
    turned.zx = m31 * r11 + m32 * r12 + m33 * r13;
    return turned;
}

/* The deviator after a step in which nothing yields. */
BOLIDE_INLINE struct sym3 strength_elastic(double shear_modulus, const struct motion *motion,
                                           struct sym3 deviator)
{
    double twice = 2.0 * shear_modulus * motion->dt;
    double third = sym3_trace(motion->strain_rate) / 3.0;
    struct sym3 s = deviator;
    s.xx += twice * (motion->strain_rate.xx - third);
    s.yy += twice * (motion->strain_rate.yy - third);
    s.zz += twice * (motion->strain_rate.zz - third);
    s.xy += twice * motion->strain_rate.xy;
    s.yz += twice * motion->strain_rate.yz;
    s.zx += twice * motion->strain_rate.zx;
    return sym3_rotate(s, vec3_scale(motion->dt, motion->spin));
}

/* Eigenvalues below this are none: their cubes are zero as numbers. */
BOLIDE_INLINE double sym3_least(void) { return 1e-100; }

/* The largest eigenvalue of a deviator, and the smallest if SIGN is -1 in place of 1 (Smith,
 * Commun. ACM 4 (1961) 168). */
BOLIDE_INLINE double sym3_extreme(struct sym3 s, double sign)
{
    double radius = sqrt(sym3_square(s) / 6.0);
    if (!(radius > sym3_least()))
        return 0.0;
    double determinant = s.xx * (s.yy * s.zz - s.yz * s.yz) - s.xy * (s.xy * s.zz - s.yz * s.zx) +
                         s.zx * (s.xy * s.yz - s.yy * s.zx);
    double half = 0.5 * sign * determinant / (radius * square(radius));
    return 2.0 * sign * radius * cosine_of_third(maximum(-1.0, minimum(1.0, half)));
}
BOLIDE_INLINE double sym3_largest(struct sym3 s) { return sym3_extreme(s, 1.0); }

/* (S - a)(S - b) SCALE of a symmetric tensor S, symmetric as well. */
BOLIDE_INLINE struct sym3 sym3_between(struct sym3 s, double a, double b, double scale)
{
    const double less = a + b, both = a * b;
    const struct sym3 p = {s.xx * s.xx + s.xy * s.xy + s.zx * s.zx - less * s.xx + both,
                           s.xy * s.xy + s.yy * s.yy + s.yz * s.yz - less * s.yy + both,
                           s.zx * s.zx + s.yz * s.yz + s.zz * s.zz - less * s.zz + both,
                           s.xx * s.xy + s.xy * s.yy + s.zx * s.yz - less * s.xy,
                           s.xy * s.zx + s.yy * s.yz + s.yz * s.zz - less * s.yz,
                           s.xx * s.zx + s.xy * s.yz + s.zx * s.zz - less * s.zx};
    return sym3_scale(scale, p);
}

/* The tensile part of a stress: its eigenvectors with their eigenvalues where positive, else zero.
 * The eigenvector that alone has its sign is projected out, whatever the gap between the others. */
BOLIDE_INLINE struct sym3 sym3_tensile(struct sym3 s)
{
    const double mean = sym3_trace(s) / 3.0;
    const struct sym3 deviator = {s.xx - mean, s.yy - mean, s.zz - mean, s.xy, s.yz, s.zx};
    const double first = mean + sym3_extreme(deviator, 1.0);
    const double last = mean + sym3_extreme(deviator, -1.0), middle = 3.0 * mean - first - last;
    if (first <= sym3_least())
        return (struct sym3){0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    if (last >= 0.0)
        return s;
    if (middle <= 0.0)
        return sym3_between(s, middle, last, first / ((first - middle) * (first - last)));
    const double scale = last / ((first - last) * (middle - last));
    return sym3_add(s, sym3_between(s, first, middle, -scale));
}

/* That of the components in the plane; those across it become zero. */
BOLIDE_INLINE struct sym3 sym3_tensile_in_plane(struct sym3 s)
{
    const double mean = 0.5 * (s.xx + s.yy), half = 0.5 * (s.xx - s.yy);
    const double radius = sqrt(square(half) + square(s.xy));
    const double first = maximum(mean + radius, 0.0), last = maximum(mean - radius, 0.0);
    const double turn = radius > 0.0 ? 0.5 * (first - last) / radius : 0.0;
    return (struct sym3){0.5 * (first + last) + turn * half,
                         0.5 * (first + last) - turn * half,
                         0.0,
                         turn * s.xy,
                         0.0,
                         0.0};
}

/* The equivalent strain rate of a deviator, sqrt(2/3 e:e), of STRAIN_RATE with its trace. */
BOLIDE_INLINE double strength_strain_rate(struct sym3 strain_rate)
{
    double third = sym3_trace(strain_rate) / 3.0;
    struct sym3 e = strain_rate;
    e.xx -= third;
    e.yy -= third;
    e.zz -= third;
    return sqrt(2.0 / 3.0 * sym3_square(e));
}

#endif
