/* The exponential function as a formula, which a compiler turns into vectors: the same bits in every lane, for
 * every instruction set, within two units in the last place of the library's. */
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
    /* In pairs, then pairs of pairs: a chain of products would be what a contact problem waits for. */
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

#endif
