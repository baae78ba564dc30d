/* What every file may rely on: the inline marker of point physics, and a few macros.
 * A header of point physics compiles as C17 and as CUDA C++. */
#ifndef BOLIDE_BASE_H
#define BOLIDE_BASE_H

#include <assert.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__CUDACC__)
#define BOLIDE_INLINE static __host__ __device__ __forceinline__
#elif defined(BOLIDE_SANITIZE) || defined(BOLIDE_TEST)
/* Calls instead, which compile in a fraction of the time. */
#define BOLIDE_INLINE static __attribute__((unused))
#else
#define BOLIDE_INLINE static inline __attribute__((always_inline, unused))
#endif

/* Before a loop of at most 32 passes: its passes stand one after the other. */
#if defined(__CUDACC__)
#define BOLIDE_UNROLL _Pragma("unroll")
#elif defined(__clang__)
#define BOLIDE_UNROLL _Pragma("clang loop unroll(full)")
#else
#define BOLIDE_UNROLL _Pragma("GCC unroll 32")
#endif

#if defined(__GNUC__)
#define BOLIDE_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define BOLIDE_PRINTF(text, first)
#endif

#define COUNT_OF(array) (sizeof(array) / sizeof((array)[0]))

BOLIDE_INLINE double minimum(double a, double b) { return a < b ? a : b; }
BOLIDE_INLINE double maximum(double a, double b) { return a > b ? a : b; }
BOLIDE_INLINE double square(double a) { return a * a; }

#endif
