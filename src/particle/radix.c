/* Least significant digit first, eleven bits a digit; see radix.h. */
#include "particle/radix.h"

#include <string.h>

enum { DIGIT_BITS = 11, DIGITS = 6, BUCKETS = 1 << DIGIT_BITS };

void radix_sort(struct keyed *entry, struct keyed *scratch, int64_t count)
{
    uint64_t some = 0, all = ~(uint64_t)0;
    for (int64_t i = 0; i < count; i++) {
        some |= entry[i].key;
        all &= entry[i].key;
    }
    uint64_t varying = count ? some & ~all : 0;
    struct keyed *from = entry, *to = scratch;
    for (int digit = 0; digit < DIGITS; digit++) {
        int shift = digit * DIGIT_BITS;
        if (!(varying >> shift & (BUCKETS - 1)))
            continue;
        int64_t place[BUCKETS] = {0};
        for (int64_t i = 0; i < count; i++)
            place[from[i].key >> shift & (BUCKETS - 1)]++;
        int64_t sum = 0;
        for (int b = 0; b < BUCKETS; b++) {
            int64_t here = place[b];
            place[b] = sum;
            sum += here;
        }
        for (int64_t i = 0; i < count; i++)
            to[place[from[i].key >> shift & (BUCKETS - 1)]++] = from[i];
        struct keyed *swap = from;
        from = to;
        to = swap;
    }
    if (from != entry)
        memcpy(entry, from, (size_t)count * sizeof *entry);
}
