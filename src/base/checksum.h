/* A checksum of numbers: a sum over what each number and its place make, so that parts of an array
 * may be summed apart, in any order. It differs for certain when a single number has changed, and
 * but for one case in 2^64 when several have. */
#ifndef BOLIDE_CHECKSUM_H
#define BOLIDE_CHECKSUM_H

#include "base/base.h"

/* The part of COUNT numbers of BYTES each (1, 2 or 8) at DATA, which are those from FIRST on of
 * all, computed with THREADS. */
uint64_t checksum_of(const void *data, size_t bytes, int64_t first, int64_t count, int threads);

#endif
