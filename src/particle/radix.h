/* A stable sort of 64-bit keys with a 32-bit load. */
#ifndef BOLIDE_RADIX_H
#define BOLIDE_RADIX_H

#include "base/base.h"

struct keyed {
    uint64_t key;
    int32_t index;
};

/* Sorts COUNT entries by key; entries of one key keep their order. SCRATCH has room for COUNT more. Passes
 * over digits that are alike in all keys are skipped. */
void radix_sort(struct keyed *entry, struct keyed *scratch, int64_t count);

#endif
