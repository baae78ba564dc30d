/* Exact sums of many numbers; see exact_block.h. */
#include "parallel/exact_block.h"

#include <stdlib.h>
#include <string.h>

/* A sum of so many multiples of the last bit of 42 is exact. */
enum { EXACT_SUM_BLOCK = 512 };

/* Two numbers at once, as every processor has them. */
typedef double pair __attribute__((vector_size(16)));
typedef int64_t pair_bits __attribute__((vector_size(16)));

/* The largest magnitude of COUNT values; those that are not numbers do not count. */
static double largest_of(const double *value, int count)
{
    const pair_bits magnitude = {INT64_MAX, INT64_MAX};
    pair most = {0.0, 0.0};
    for (int i = 0; i < count; i += 2) {
        pair v;
        memcpy(&v, value + i, sizeof v);
        const pair_bits size = (pair_bits)v & magnitude, more = (pair)size > most;
        most = (pair)((size & more) | ((pair_bits)most & ~more));
    }
    return most[0] > most[1] ? most[0] : most[1];
}

/* Takes from each of COUNT values, below 2^EXPONENT, what a number of 42 bits fewer can hold, and
 * returns the sum of that, which is exact: multiples of 2^(EXPONENT - 42), 512 of them at most.
 * MORE: something is left. (The splitting of Rump, Ogita and Oishi, SIAM J. Sci. Comput. 31 (2008)
 * 189.) */
static double take_high(double *value, int count, int exponent, bool *more)
{
    const double carrier = ldexp(1.5, exponent + 10);
    pair sum = {0.0, 0.0};
    pair_bits left = {0, 0};
    for (int i = 0; i < count; i += 2) {
        pair v;
        memcpy(&v, value + i, sizeof v);
        const pair high = (v + carrier) - carrier, rest = v - high;
        sum += high;
        left |= (pair_bits)rest;
        memcpy(value + i, &rest, sizeof rest);
    }
    *more = ((left[0] | left[1]) & INT64_MAX) != 0;
    return sum[0] + sum[1];
}

/* COUNT is a multiple of two. */
static void add_block(struct exact_sum *sum, const double *value, int count)
{
    enum { LARGEST = 900, BITS = 42 };
    double rest[EXACT_SUM_BLOCK];
    int exponent;
    bool more = true;
    frexp(largest_of(value, count), &exponent);
    memcpy(rest, value, (size_t)count * sizeof *rest);
    for (; more && abs(exponent) < LARGEST; exponent -= BITS) {
        const double high = take_high(rest, count, exponent, &more);
        if (!isfinite(high)) { /* one is not a number */
            sum->not_finite = true;
            return;
        }
        exact_sum_add(sum, high);
    }
    for (int i = 0; i < count && more; i++)
        exact_sum_add(sum, rest[i]);
}

void exact_sum_add_all(struct exact_sum *sum, const double *value, int count)
{
    int begin = 0;
    for (; begin + 2 <= count; begin += EXACT_SUM_BLOCK) {
        const int left = (count - begin) / 2 * 2;
        add_block(sum, value + begin, left < EXACT_SUM_BLOCK ? left : EXACT_SUM_BLOCK);
    }
    for (int i = count / 2 * 2; i < count; i++)
        exact_sum_add(sum, value[i]);
}
