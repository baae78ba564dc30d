/* Eight numbers at once, each in a lane of its own; and what the files that are compiled once an
 * instruction set need. */
#ifndef BOLIDE_LANES_H
#define BOLIDE_LANES_H

#include "base/base.h"

enum { LANES = 8 };

#define ALIGNED __attribute__((aligned(64)))

/* What few particles need stays out of the way of what all do: of registers, and of the time to
 * compile. */
#if defined(__CUDACC__)
#define APART static __host__ __device__ __noinline__
#else
#define APART static __attribute__((noinline))
#endif

#endif
