/* A stable sort of 64-bit keys with a 32-bit load, and what lies together once it is done. */
#ifndef BOLIDE_RADIX_H
#define BOLIDE_RADIX_H

#include "base/base.h"

struct keyed {
    uint64_t key;
    int32_t index;
};

/* Sorts COUNT entries by key with THREADS threads; entries of one key keep their order, so that the
 * result does not depend on the number of threads. SCRATCH has room for COUNT more. Passes over
 * digits that are alike in all keys are skipped. */
void radix_sort(struct keyed *entry, struct keyed *scratch, int64_t count, int threads);

/* Entries first .. first + count - 1, which have one key. */
struct key_run {
    uint64_t key;
    int32_t first, count;
};

/* Writes the runs of equal keys of COUNT entries, in their order, and returns how many. RUN has
 * room for COUNT. */
int32_t radix_runs(const struct keyed *entry, int32_t count, int threads, struct key_run *run);

#endif
