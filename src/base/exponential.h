/* The exponential function, the logarithm, powers and roots as formulas, which a compiler turns
 * into vectors: the same bits in every lane, for every instruction set and on a device. Point
 * physics and kernels use these and never the library's. Errors stay below 2.5 units in the last
 * place; those of a power grow with its logarithm. */
#ifndef BOLIDE_EXPONENTIAL_H
#define BOLIDE_EXPONENTIAL_H

#include <string.h>

#include "base/base.h"

/* x = k ln 2 + r, |r| <= ln 2/2, and the series of e^r. Beyond +-700 it stays what it is there. */
BOLIDE_INLINE double exponential(double x)
{
    const double per_ln2 = 1.4426950408889634, ln2_high = 6.93147180369123816490e-01,
                 ln2_low = 1.90821492927058770002e-10;
    const double rounding = 6755399441055744.0; /* 1.5 2^52: its sum has k in the last bits */
    x = maximum(minimum(x, 700.0), -700.0);
    double shifted = x * per_ln2 + rounding, k = shifted - rounding;
    double r = (x - k * ln2_high) - k * ln2_low;
    /* In pairs, then pairs of pairs: a chain of products would be what a Riemann problem waits
     * for. */
    double r2 = r * r, r4 = r2 * r2;
    double t2 = 0.5 + r * (1.0 / 6.0), t4 = 1.0 / 24.0 + r * (1.0 / 120.0);
    double t6 = 1.0 / 720.0 + r * (1.0 / 5040.0), t8 = 1.0 / 40320.0 + r * (1.0 / 362880.0);
    double t10 = 1.0 / 3628800.0 + r * (1.0 / 39916800.0);
    double t12 = 1.0 / 479001600.0 + r * (1.0 / 6227020800.0);
    double tail = (t2 + r2 * t4) + r4 * ((t6 + r2 * t8) + r4 * (t10 + r2 * t12));
    double value = 1.0 + (r + r2 * tail), power;
    uint64_t bits;
    memcpy(&bits, &shifted, sizeof bits);
    bits = (bits + 1023) << 52;
    memcpy(&power, &bits, sizeof power); /* 2^k */
    return value * power;
}

/* x = 2^k m, m between sqrt(1/2) and sqrt(2), and the series ln m = 2 artanh s, s = (m - 1)/(m +
 * 1). X is positive and not subnormal; of zero it is some -709. */
BOLIDE_INLINE double logarithm(double x)
{
    const double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
    const uint64_t root = 0x3fe6a09e667f3bcdu, one = 0x3ff0000000000000u; /* sqrt(1/2), 1 */
    const uint64_t shift = 0x4330000000000000u; /* 2^52: the last bits of its sum with k are k */
    uint64_t bits, whole;
    double m, k;
    memcpy(&bits, &x, sizeof bits);
    bits += one - root;
    whole = bits >> 52 | shift;
    bits = (bits & 0xfffffffffffffu) + root;
    memcpy(&m, &bits, sizeof m);
    memcpy(&k, &whole, sizeof k);
    k -= 4503599627370496.0 + 1023.0;
    double f = m - 1.0, s = f / (m + 1.0), z = s * s, z2 = z * z, z4 = z2 * z2;
    double t1 = 1.0 / 3.0 + z * (1.0 / 5.0), t3 = 1.0 / 7.0 + z * (1.0 / 9.0);
    double t5 = 1.0 / 11.0 + z * (1.0 / 13.0), t7 = 1.0 / 15.0 + z * (1.0 / 17.0);
    double t9 = 1.0 / 19.0 + z * (1.0 / 21.0);
    double tail = 2.0 * z * ((t1 + z2 * t3) + z4 * ((t5 + z2 * t7) + z4 * t9));
    /* 2 s = f - s f, and f is exact */
    return k * ln2_high + (f - (s * (f - tail) - k * ln2_low));
}

/* x^n of n > 0 and of x as the logarithm takes it, or zero. */
BOLIDE_INLINE double power(double x, double n)
{
    const double value = exponential(n * logarithm(x));
    return x > 0.0 ? value : 0.0;
}

/* e^x - 1, as exact for small x: with x = k ln 2 + r it is 2^k (e^r - 1) + (2^k - 1). */
BOLIDE_INLINE double exponential_minus_one(double x)
{
    const double per_ln2 = 1.4426950408889634, ln2_high = 6.93147180369123816490e-01,
                 ln2_low = 1.90821492927058770002e-10;
    const double rounding = 6755399441055744.0; /* as in the exponential function */
    x = maximum(minimum(x, 700.0), -700.0);
    double shifted = x * per_ln2 + rounding, k = shifted - rounding;
    double r = (x - k * ln2_high) - k * ln2_low;
    double r2 = r * r, r4 = r2 * r2;
    double t2 = 0.5 + r * (1.0 / 6.0), t4 = 1.0 / 24.0 + r * (1.0 / 120.0);
    double t6 = 1.0 / 720.0 + r * (1.0 / 5040.0), t8 = 1.0 / 40320.0 + r * (1.0 / 362880.0);
    double t10 = 1.0 / 3628800.0 + r * (1.0 / 39916800.0);
    double t12 = 1.0 / 479001600.0 + r * (1.0 / 6227020800.0);
    double tail = (t2 + r2 * t4) + r4 * ((t6 + r2 * t8) + r4 * (t10 + r2 * t12)), power;
    uint64_t bits;
    memcpy(&bits, &shifted, sizeof bits);
    bits = (bits + 1023) << 52;
    memcpy(&power, &bits, sizeof power); /* 2^k */
    return power * (r + r2 * tail) + (power - 1.0);
}

/* The cube root of x, which is as the logarithm takes it, or zero: a step of Newton's method from
 * the power. */
BOLIDE_INLINE double cube_root(double x)
{
    const double y = exponential(logarithm(x) * (1.0 / 3.0));
    return x > 0.0 ? y - (y * y * y - x) / (3.0 * y * y) : 0.0;
}

/* cos(arccos(c)/3) of c in [-1, 1]: the largest root of 4 y^3 - 3 y = c, and twice that the largest
 * root of a cubic with three real ones. With y = 1/2 + z it is 6 z^2 + 4 z^3 = 1 + c, where
 * Newton's method meets no double root: z grows as s = sqrt((1 + c)/6). */
BOLIDE_INLINE double cosine_of_third(double c)
{
    const double d = 1.0 + c, s = sqrt(d * (1.0 / 6.0));
    double z = s * (1.0 - s * (1.0 / 3.0 - s * 0.2)); /* within two percent */
    for (int k = 0; k < 3; k++)
        z -= (z * z * (6.0 + 4.0 * z) - d) / maximum(12.0 * z * (1.0 + z), 1e-300);
    return 0.5 + z;
}

#endif
