/* What the spread loop does with one particle and eight of its neighbours: for the files that are
 * compiled once an instruction set, and for a device. */
#ifndef BOLIDE_SPH_SPREAD_BODY_H
#define BOLIDE_SPH_SPREAD_BODY_H

#include "sph/kernel.h"
#include "sph/lanes.h"
#include "sph/spread/kernel.h"

/* The sums of a particle: those of w (D_j - D_i) x, and of w x x^T in the order of a tensor. */
enum { SPREAD_SUMS = 9 };

/* Adds eight neighbours. */
BOLIDE_INLINE void add_lanes(int dimension, double smoothing, const double *own,
                             double (*field)[LANES], double (*sum)[LANES])
{
    const int d = dimension, v = spread_record_volume(dimension),
              q = spread_record_damage(dimension), body = spread_record_body(dimension);
#pragma omp simd simdlen(8)
    for (int k = 0; k < LANES; k++) {
        const double x = field[0][k] - own[0], y = dimension > 1 ? field[1][k] - own[1] : 0.0,
                     z = dimension > 2 ? field[2][k] - own[2] : 0.0;
        const double r = sqrt(maximum(square(x) + square(y) + square(z), 1e-200));
        const double inverse_h = 2.0 / (smoothing * (own[d] + field[d][k]));
        const double same = field[body][k] == own[body] ? 1.0 : 0.0;
        const double w = -same * field[v][k] * kernel_slope(r, inverse_h, dimension) / r;
        const double rise = w * (field[q][k] - own[q]);
        sum[0][k] += rise * x;
        sum[3][k] += w * x * x;
        if (dimension > 1) {
            sum[1][k] += rise * y;
            sum[4][k] += w * y * y;
            sum[6][k] += w * x * y;
        }
        if (dimension > 2) {
            sum[2][k] += rise * z;
            sum[5][k] += w * z * z;
            sum[7][k] += w * y * z;
            sum[8][k] += w * z * x;
        }
    }
}

/* |grad D| from the sums of a particle; those of one that has too few neighbours for M are not
 * corrected by it, but by its trace. */
BOLIDE_INLINE double gradient_of(int dimension, const double sum[SPREAD_SUMS])
{
    const struct vec3 g = {sum[0], sum[1], sum[2]};
    const double xx = sum[3], mean = (sum[3] + sum[4] + sum[5]) / dimension;
    const double yy = dimension > 1 ? sum[4] : mean, zz = dimension > 2 ? sum[5] : mean;
    const double xy = sum[6], yz = sum[7], zx = sum[8];
    const double a = yy * zz - yz * yz, b = yz * zx - xy * zz, c = xy * yz - yy * zx;
    const double determinant = xx * a + xy * b + zx * c;
    if (!(mean > 0.0))
        return 0.0;
    if (!(determinant > 1e-4 * mean * mean * mean))
        return sqrt(vec3_dot(g, g)) / mean;
    const double d = xx * zz - zx * zx, e = xy * zx - xx * yz, f = xx * yy - xy * xy;
    const struct vec3 v = {a * g.x + b * g.y + c * g.z, b * g.x + d * g.y + e * g.z,
                           c * g.x + e * g.y + f * g.z};
    return sqrt(vec3_dot(v, v)) / determinant;
}

#endif
