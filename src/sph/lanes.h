/* Sums over the neighbours of a particle in eight lanes: what the kernels of this room share.
 *
 * A row is compressed to the neighbours within support, their records are turned into eight lanes a field, and
 * lane k sums the neighbours k, k + 8, ...; lanes are added in a fixed order. So a sum depends on the row's
 * neighbours in support and their order alone. For the files that are compiled once an instruction set. */
#ifndef BOLIDE_SPH_LANES_H
#define BOLIDE_SPH_LANES_H

#include <string.h>

#include "particle/neighbours.h"

enum { LANES = 8, LANES_CHUNK = 512, PLACE_STRIDE = 4 };

#define ALIGNED __attribute__((aligned(64)))
/* A kernel is instantiated by inlining all of it with its kind as a constant. Sanitized builds call instead: they
 * check the same code once, and compile in seconds. */
#if defined(BOLIDE_SANITIZE)
#define INLINE static __attribute__((unused))
#else
#define INLINE static inline __attribute__((always_inline))
#endif

#if defined(__AVX512F__)
typedef double vector8 __attribute__((vector_size(64)));

/* Turns eight rows of eight into eight columns. */
INLINE void transpose(const double *const row[LANES], int offset, double (*column)[LANES])
{
    vector8 a[8], b[8];
    for (int k = 0; k < 8; k++)
        memcpy(&a[k], row[k] + offset, sizeof a[k]);
    for (int k = 0; k < 8; k += 2) {
        b[k] = __builtin_shufflevector(a[k], a[k + 1], 0, 8, 2, 10, 4, 12, 6, 14);
        b[k + 1] = __builtin_shufflevector(a[k], a[k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
    }
    for (int k = 0; k < 8; k += 4)
        for (int m = 0; m < 2; m++) {
            a[k + m] = __builtin_shufflevector(b[k + m], b[k + m + 2], 0, 1, 8, 9, 4, 5, 12, 13);
            a[k + m + 2] =
                __builtin_shufflevector(b[k + m], b[k + m + 2], 2, 3, 10, 11, 6, 7, 14, 15);
        }
    for (int k = 0; k < 4; k++) {
        vector8 first = __builtin_shufflevector(a[k], a[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
        vector8 second = __builtin_shufflevector(a[k], a[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
        memcpy(column[k], &first, sizeof first);
        memcpy(column[k + 4], &second, sizeof second);
    }
}
#else
INLINE void transpose(const double *const row[LANES], int offset, double (*column)[LANES])
{
    for (int k = 0; k < LANES; k++)
        for (int f = 0; f < 8; f++)
            column[f][k] = row[k][offset + f];
}
#endif

INLINE double across_lanes(const double lane[LANES])
{
    return ((lane[0] + lane[4]) + (lane[2] + lane[6])) +
           ((lane[1] + lane[5]) + (lane[3] + lane[7]));
}

/* The sums over lanes of COUNT accumulators, a multiple of eight, each in the order of across_lanes. */
INLINE void lanes_totals(double (*lane)[LANES], int count, double *total)
{
    for (int first = 0; first < count; first += LANES) {
        const double *row[LANES];
        double of[LANES][LANES] ALIGNED;
        for (int k = 0; k < LANES; k++)
            row[k] = lane[first + k];
        transpose(row, 0, of);
        for (int k = 0; k < LANES; k++)
            total[first + k] = ((of[0][k] + of[4][k]) + (of[2][k] + of[6][k])) +
                               ((of[1][k] + of[5][k]) + (of[3][k] + of[7][k]));
    }
}

/* Records as a kernel walks them: STRIDE doubles each, a multiple of eight, position first, the diameter right
 * behind it. The record at `empty` adds nothing to a sum; it fills up the last lanes. Where records are long, `place` has
 * position and diameter once more, closer together: most of a row is looked at and left. */
struct lane_records {
    const double *record;
    int stride, dimension;
    int32_t empty;
    double smoothing;    /* support = smoothing (D_i + D_j) */
    const double *place; /* PLACE_STRIDE doubles each, or NULL */
};

/* Turns the records of the eight neighbours of LIST into lanes, stride fields. */
INLINE void lanes_stage(struct lane_records records, const int32_t *list, double (*field)[LANES])
{
    const double *row[LANES];
    for (int k = 0; k < LANES; k++) /* NOLINTNEXTLINE(clang-analyzer-core.*): it is filled up */
        row[k] = records.record + (size_t)list[k] * (size_t)records.stride;
    for (int offset = 0; offset < records.stride; offset += 8)
        transpose(row, offset, field + offset);
}

/* Appends to LIST the neighbours of ENTRY within support of the particle, and returns how many. */
INLINE int lanes_compress(struct lane_records records, const double *own, const uint32_t *entry,
                          int count, int32_t *list)
{
    int kept = 0;
    for (int q = 0; q < count; q++) {
        int32_t j = (int32_t)(entry[q] & ENTRY_INDEX);
        const double *other = records.place ? records.place + (size_t)j * PLACE_STRIDE
                                            : records.record + (size_t)j * (size_t)records.stride;
        double sum = square(other[0] - own[0]);
        if (records.dimension > 1)
            sum += square(other[1] - own[1]);
        if (records.dimension > 2)
            sum += square(other[2] - own[2]);
        list[kept] = j;
        kept +=
            sum < square(records.smoothing * (own[records.dimension] + other[records.dimension]));
    }
    return kept;
}

/* The neighbours in support of one part of a row, chunk by chunk, in groups of eight that begin in lane zero:
 * the first neighbour of a part in support always stands in lane zero. */
struct lane_walk {
    int32_t list[LANES_CHUNK + 2 * LANES];
    int looked_at, ready, waiting;
};

/* Makes `ready` neighbours of ENTRY ready, a multiple of eight, for the particle of record OWN; false when
 * nothing is left. WALK begins with its three numbers zero; the caller takes all that is ready. */
INLINE bool lanes_walk(struct lane_walk *walk, struct lane_records records, const double *own,
                       const uint32_t *entry, int count)
{
    if (walk->looked_at >= count)
        return false;
    memmove(walk->list, walk->list + walk->ready, (size_t)walk->waiting * sizeof *walk->list);
    int left = count - walk->looked_at, length = left < LANES_CHUNK ? left : LANES_CHUNK;
    walk->waiting +=
        lanes_compress(records, own, entry + walk->looked_at, length, walk->list + walk->waiting);
    walk->looked_at += length;
    if (walk->looked_at == count)
        while (walk->waiting % LANES)
            walk->list[walk->waiting++] = records.empty;
    walk->ready = walk->waiting / LANES * LANES;
    walk->waiting -= walk->ready;
    return true;
}

#endif
