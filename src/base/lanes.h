/* Eight numbers at once, each in a lane of its own; and how the files that are compiled once an instruction set are
 * inlined. */
#ifndef BOLIDE_LANES_H
#define BOLIDE_LANES_H

enum { LANES = 8 };

#define ALIGNED __attribute__((aligned(64)))

/* A kernel is instantiated by inlining all of it with its kind as a constant. Sanitized builds call instead: they
 * check the same code once, and compile in seconds. */
#if defined(BOLIDE_SANITIZE)
#define INLINE static __attribute__((unused))
#else
#define INLINE static inline __attribute__((always_inline))
#endif

/* What few particles need stays out of the way of what all do: of registers, and of the time to compile. */
#define APART static __attribute__((noinline))

#endif
