/* Several numbers at once, which the compiler keeps in wide registers. In C they are vectors of
 * GCC and clang; to a C++ or CUDA compiler they are structs with the same elements and the same
 * operations, one element after the other: the bits are the same. */
#ifndef BOLIDE_WIDE_H
#define BOLIDE_WIDE_H

#include <string.h>

#include "base/base.h"

#if !defined(__cplusplus)

typedef double vector8 __attribute__((vector_size(64)));
typedef double vector4 __attribute__((vector_size(32)));

/* Keys are compared in pieces that the instruction set has: wider ones go key by key. */
#if defined(__AVX512F__)
typedef uint32_t keys_piece __attribute__((vector_size(64)));
#elif defined(__AVX2__)
typedef uint32_t keys_piece __attribute__((vector_size(32)));
#else
typedef uint32_t keys_piece __attribute__((vector_size(16)));
#endif
typedef struct {
    keys_piece at[16 * sizeof(uint32_t) / sizeof(keys_piece)];
} keys16;

/* Adds one to each element of BELOW where KEY is smaller than that of OWN. */
BOLIDE_INLINE void keys16_count_below(keys16 *below, const keys16 *own, uint32_t key)
{
    for (size_t k = 0; k < COUNT_OF(own->at); k++)
        below->at[k] -= (keys_piece)(own->at[k] > key);
}

#else

template <int N> struct wide {
    double at[N];
};
typedef wide<8> vector8;
typedef wide<4> vector4;
struct keys16 {
    uint32_t at[16];
};

template <int N> BOLIDE_INLINE wide<N> operator*(double factor, const wide<N> &a)
{
    wide<N> product;
    for (int k = 0; k < N; k++)
        product.at[k] = factor * a.at[k];
    return product;
}

template <int N> BOLIDE_INLINE wide<N> operator*(const wide<N> &a, const wide<N> &b)
{
    wide<N> product;
    for (int k = 0; k < N; k++)
        product.at[k] = a.at[k] * b.at[k];
    return product;
}

template <int N> BOLIDE_INLINE wide<N> operator-(const wide<N> &a, const wide<N> &b)
{
    wide<N> difference;
    for (int k = 0; k < N; k++)
        difference.at[k] = a.at[k] - b.at[k];
    return difference;
}

template <int N> BOLIDE_INLINE wide<N> operator+(const wide<N> &a, const wide<N> &b)
{
    wide<N> sum;
    for (int k = 0; k < N; k++)
        sum.at[k] = a.at[k] + b.at[k];
    return sum;
}

template <int N> BOLIDE_INLINE wide<N> &operator+=(wide<N> &a, const wide<N> &b)
{
    return a = a + b;
}

BOLIDE_INLINE void keys16_count_below(keys16 *below, const keys16 *own, uint32_t key)
{
    for (int k = 0; k < 16; k++)
        below->at[k] += own->at[k] > key;
}

#endif

/* As many numbers in memory, of any alignment, as one; and one that is added to them. */
BOLIDE_INLINE vector4 vector4_load(const double *from)
{
    vector4 v;
    memcpy(&v, from, sizeof v);
    return v;
}

BOLIDE_INLINE void vector4_add_to(double *to, vector4 more)
{
    const vector4 sum = vector4_load(to) + more;
    memcpy(to, &sum, sizeof sum);
}

BOLIDE_INLINE void vector4_clear(vector4 *sum, int count)
{
    const vector4 zero = {0.0};
    for (int k = 0; k < count; k++)
        sum[k] = zero;
}

#endif
