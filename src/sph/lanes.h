/* Sums over the neighbours of a particle in eight lanes: what the kernels of SPH share.
 *
 * A row is compressed to the neighbours within support, their records are turned into eight lanes a
 * field, and lane k sums the neighbours k, k + 8, ...; lanes are added in a fixed order. So a sum
 * depends on the row's neighbours in support and their order alone. For the files that are compiled
 * once an instruction set. */
#ifndef BOLIDE_SPH_LANES_H
#define BOLIDE_SPH_LANES_H

#include <string.h>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#include "base/lanes.h"
#include "base/wide.h"
#include "particle/neighbours.h"

enum { LANES_CHUNK = 512, PLACE_STRIDE = 4 };

#if defined(__AVX512F__)
/* Turns eight rows of four into four columns. Halves of registers are put together while they are
 * loaded, which leaves less to the one port that shuffles. */
BOLIDE_INLINE void transpose_four(const double *const row[LANES], int offset, vector8 column[4])
{
    vector8 pair[4], half[4];
    for (int k = 0; k < 4; k++) {
        const double *first = row[k] + offset, *second = row[k + 4] + offset;
        pair[k] = _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(first)),
                                     _mm256_loadu_pd(second), 1);
    }
    for (int k = 0; k < 4; k += 2) {
        half[k] = __builtin_shufflevector(pair[k], pair[k + 1], 0, 8, 2, 10, 4, 12, 6, 14);
        half[k + 1] = __builtin_shufflevector(pair[k], pair[k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
    }
    for (int k = 0; k < 2; k++) {
        column[k] = __builtin_shufflevector(half[k], half[k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
        column[k + 2] = __builtin_shufflevector(half[k], half[k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
}

#elif defined(__AVX2__)
/* Two numbers each of two rows. */
BOLIDE_INLINE __m256d two_of_each(const double *first, const double *second)
{
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(first)), _mm_loadu_pd(second),
                                1);
}

/* The same for four rows, a half of the columns. */
BOLIDE_INLINE void transpose_half(const double *const row[4], int offset, __m256d column[4])
{
    for (int f = 0; f < 4; f += 2) {
        const __m256d even = two_of_each(row[0] + offset + f, row[2] + offset + f),
                      odd = two_of_each(row[1] + offset + f, row[3] + offset + f);
        column[f] = _mm256_unpacklo_pd(even, odd);
        column[f + 1] = _mm256_unpackhi_pd(even, odd);
    }
}

#endif

/* Turns four columns of eight rows, from OFFSET on, into lanes. */
BOLIDE_INLINE void transpose(const double *const row[LANES], int offset, double (*column)[LANES])
{
#if defined(__AVX512F__)
    vector8 four[4];
    transpose_four(row, offset, four);
    memcpy(column, four, sizeof four);
#elif defined(__AVX2__)
    for (int k = 0; k < LANES; k += 4) {
        __m256d half[4];
        transpose_half(row + k, offset, half);
        for (int f = 0; f < 4; f++)
            _mm256_storeu_pd(column[f] + k, half[f]);
    }
#else
    for (int k = 0; k < LANES; k++)
        for (int f = 0; f < 4; f++)
            column[f][k] = row[k][offset + f];
#endif
}

BOLIDE_INLINE double across_lanes(const double lane[LANES])
{
    return ((lane[0] + lane[4]) + (lane[2] + lane[6])) +
           ((lane[1] + lane[5]) + (lane[3] + lane[7]));
}

/* The sums over lanes of COUNT accumulators, a multiple of eight, each in the order of
 * across_lanes. */
#if defined(__AVX512F__)
BOLIDE_INLINE void lanes_totals(double (*lane)[LANES], int count, double *total)
{
    for (int first = 0; first < count; first += LANES) {
        vector8 a[8], half[4], quarter[2];
        memcpy(a, lane + first, sizeof a);
        for (int k = 0; k < 4; k++) /* of two accumulators each */
            half[k] = __builtin_shufflevector(a[k], a[k + 4], 0, 1, 2, 3, 8, 9, 10, 11) +
                      __builtin_shufflevector(a[k], a[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
        for (int k = 0; k < 2; k++) /* of four */
            quarter[k] = __builtin_shufflevector(half[k], half[k + 2], 0, 1, 8, 9, 4, 5, 12, 13) +
                         __builtin_shufflevector(half[k], half[k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
        /* quarter[m] has those of m, m + 2, m + 4, m + 6, two lanes each */
        const vector8 all =
            __builtin_shufflevector(quarter[0], quarter[1], 0, 8, 2, 10, 4, 12, 6, 14) +
            __builtin_shufflevector(quarter[0], quarter[1], 1, 9, 3, 11, 5, 13, 7, 15);
        memcpy(total + first, &all, sizeof all);
    }
}
#elif defined(__AVX2__)
/* Lanes k + 4 of two accumulators added to lanes k, then lanes k + 2 of that to lanes k. */
BOLIDE_INLINE __m256d two_of_two(const double first[LANES], const double second[LANES])
{
    const __m256d a = _mm256_add_pd(_mm256_loadu_pd(first), _mm256_loadu_pd(first + 4)),
                  b = _mm256_add_pd(_mm256_loadu_pd(second), _mm256_loadu_pd(second + 4));
    return _mm256_add_pd(_mm256_permute2f128_pd(a, b, 0x20), _mm256_permute2f128_pd(a, b, 0x31));
}

BOLIDE_INLINE void lanes_totals(double (*lane)[LANES], int count, double *total)
{
    for (int k = 0; k < count; k += 4) {
        const __m256d even = two_of_two(lane[k], lane[k + 2]),
                      odd = two_of_two(lane[k + 1], lane[k + 3]);
        _mm256_storeu_pd(
            total + k, _mm256_add_pd(_mm256_unpacklo_pd(even, odd), _mm256_unpackhi_pd(even, odd)));
    }
}
#else
BOLIDE_INLINE void lanes_totals(double (*lane)[LANES], int count, double *total)
{
    for (int k = 0; k < count; k++)
        total[k] = across_lanes(lane[k]);
}
#endif

/* Records as a kernel walks them: STRIDE doubles each, a multiple of eight, position first, the
 * diameter right behind it. The record at `empty` adds nothing to a sum; it fills up the last
 * lanes. Where records are long, `place` has position and diameter once more, closer together: most
 * of a row is looked at and left. */
struct lane_records {
    const double *record;
    int stride, dimension;
    int32_t empty;
    double smoothing;    /* support = smoothing (D_i + D_j) */
    const double *place; /* PLACE_STRIDE doubles each, or NULL */
};

/* Finds the records of the eight neighbours of LIST. */
BOLIDE_INLINE void lanes_rows(struct lane_records records, const uint32_t *list,
                              const double *row[LANES])
{
    for (int k = 0; k < LANES; k++) /* NOLINTNEXTLINE(clang-analyzer-core.*): it is filled up */
        row[k] = records.record + (size_t)list[k] * (size_t)records.stride;
}

/* Turns the records of the eight neighbours of LIST into lanes, stride fields. */
BOLIDE_INLINE void lanes_stage(struct lane_records records, const uint32_t *list,
                               double (*field)[LANES])
{
    const double *row[LANES];
    lanes_rows(records, list, row);
    for (int offset = 0; offset < records.stride; offset += 4)
        transpose(row, offset, field + offset);
}

/* Writes to LIST what bits BITS hold of the entries within support of the particle, and returns how
 * many. */
BOLIDE_INLINE int lanes_compress(struct lane_records records, const double *own,
                                 const uint32_t *entry, int count, uint32_t bits, uint32_t *list)
{
    const double *place = records.place ? records.place : records.record;
    const size_t stride = records.place ? PLACE_STRIDE : (size_t)records.stride;
    int kept = 0;
    for (int q = 0; q < count; q++) {
        int32_t j = (int32_t)(entry[q] & ENTRY_INDEX);
        const double *other = place + (size_t)j * stride;
        double sum = square(other[0] - own[0]);
        if (records.dimension > 1)
            sum += square(other[1] - own[1]);
        if (records.dimension > 2)
            sum += square(other[2] - own[2]);
        list[kept] = entry[q] & bits;
        kept +=
            sum < square(records.smoothing * (own[records.dimension] + other[records.dimension]));
    }
    return kept;
}

#if defined(__AVX512F__)
/* The same, eight at once; rows of a line are too short for it. */
BOLIDE_INLINE int lanes_compress_wide(struct lane_records records, const double *own,
                                      const uint32_t *entry, int count, uint32_t bits,
                                      uint32_t *list)
{
    const double *place = records.place ? records.place : records.record;
    const size_t stride = records.place ? PLACE_STRIDE : (size_t)records.stride;
    int kept = 0;
    for (int q = 0; q < count; q += LANES) {
        const __mmask8 all = (__mmask8)(count - q < LANES ? (1 << (count - q)) - 1 : 0xff);
        const __m256i entries = _mm256_maskz_loadu_epi32(all, entry + q);
        const __m256i held = _mm256_and_si256(entries, _mm256_set1_epi32((int)bits));
        uint32_t last[LANES];
        const uint32_t *at =
            entry + q; /* loaded one by one: cheaper than to take a register apart */
        const double *row[LANES];
        vector8 column[4];
        if (count - q < LANES) {
            _mm256_storeu_si256((__m256i *)last, entries);
            at = last;
        }
        for (int k = 0; k < LANES; k++)
            row[k] = place + (size_t)(at[k] & ENTRY_INDEX) * stride;
        transpose_four(row, 0, column);
        vector8 apart = column[0] - own[0], sum = apart * apart;
        for (int axis = 1; axis < records.dimension; axis++) {
            apart = column[axis] - own[axis];
            sum += apart * apart;
        }
        const vector8 support =
            records.smoothing * (own[records.dimension] + column[records.dimension]);
        const __mmask8 near = _mm512_mask_cmp_pd_mask(all, sum, support * support, _CMP_LT_OQ);
        _mm256_storeu_si256((__m256i *)(list + kept), _mm256_maskz_compress_epi32(near, held));
        kept += __builtin_popcount(near);
    }
    return kept;
}
#endif

#if defined(__AVX2__) && !defined(__AVX512F__)
/* Which of four records, of which PLACE has position and diameter, are within support of OWN, a
 * bit each. */
BOLIDE_INLINE int lanes_near(struct lane_records records, const double *own,
                             const double *const place[4])
{
    __m256d column[4];
    transpose_half(place, 0, column);
    __m256d apart = _mm256_sub_pd(column[0], _mm256_set1_pd(own[0])),
            sum = _mm256_mul_pd(apart, apart);
    for (int axis = 1; axis < records.dimension; axis++) {
        apart = _mm256_sub_pd(column[axis], _mm256_set1_pd(own[axis]));
        sum = _mm256_add_pd(sum, _mm256_mul_pd(apart, apart));
    }
    const __m256d support = _mm256_mul_pd(
        _mm256_set1_pd(records.smoothing),
        _mm256_add_pd(_mm256_set1_pd(own[records.dimension]), column[records.dimension]));
    return _mm256_movemask_pd(_mm256_cmp_pd(sum, _mm256_mul_pd(support, support), _CMP_LT_OQ));
}

/* The same as lanes_compress, four at once. */
BOLIDE_INLINE int lanes_compress_wide(struct lane_records records, const double *own,
                                      const uint32_t *entry, int count, uint32_t bits,
                                      uint32_t *list)
{
    const double *place = records.place ? records.place : records.record;
    const size_t stride = records.place ? PLACE_STRIDE : (size_t)records.stride;
    int kept = 0;
    for (int q = 0; q < count; q += 4) {
        const int some = count - q < 4 ? count - q : 4;
        const double *row[4];
        uint32_t held[4];
        for (int k = 0; k < 4; k++)
            held[k] = entry[q + (k < some ? k : 0)];
        for (int k = 0; k < 4; k++)
            row[k] = place + (size_t)(held[k] & ENTRY_INDEX) * stride;
        const int near = lanes_near(records, own, row) & ((1 << some) - 1);
        for (int k = 0; k < 4; k++) {
            list[kept] = held[k] & bits;
            kept += near >> k & 1;
        }
    }
    return kept;
}
#endif

/* The better of both; LIST has room for COUNT + LANES. */
BOLIDE_INLINE int lanes_keep(struct lane_records records, const double *own, const uint32_t *entry,
                             int count, uint32_t bits, uint32_t *list)
{
#if defined(__AVX2__)
    if (records.dimension > 1)
        return lanes_compress_wide(records, own, entry, count, bits, list);
#endif
    return lanes_compress(records, own, entry, count, bits, list);
}

/* Where the part PART of a row ends that begins at BEGIN; most rows have but one, and the parts of
 * the others are contiguous. */
BOLIDE_INLINE int lanes_part(const uint32_t *entry, int begin, int count, unsigned part)
{
    if (begin < count && entry[count - 1] >> ENTRY_PART_SHIFT == part)
        return count;
    for (int end = count; begin < end;) {
        const int middle = begin + (end - begin) / 2;
        if (entry[middle] >> ENTRY_PART_SHIFT == part)
            begin = middle + 1;
        else
            end = middle;
    }
    return begin;
}

/* The neighbours in support of one part of a row, chunk by chunk, in groups of eight that begin in
 * lane zero: the first neighbour of a part in support always stands in lane zero. */
struct lane_walk {
    uint32_t list[LANES_CHUNK + 2 * LANES];
    int looked_at, ready, waiting;
};

/* Makes `ready` neighbours of ENTRY ready, a multiple of eight, for the particle of record OWN;
 * false when nothing is left. WALK begins with its three numbers zero; the caller takes all that is
 * ready. */
BOLIDE_INLINE bool lanes_walk(struct lane_walk *walk, struct lane_records records,
                              const double *own, const uint32_t *entry, int count)
{
    if (walk->looked_at >= count)
        return false;
    memmove(walk->list, walk->list + walk->ready, (size_t)walk->waiting * sizeof *walk->list);
    int left = count - walk->looked_at, length = left < LANES_CHUNK ? left : LANES_CHUNK;
    const uint32_t *part = entry + walk->looked_at;
    uint32_t *end = walk->list + walk->waiting;
    walk->waiting += lanes_keep(records, own, part, length, ENTRY_INDEX, end);
    walk->looked_at += length;
    if (walk->looked_at == count) { /* filled up without a branch that the length decides */
        for (int k = 0; k < LANES; k++)
            walk->list[walk->waiting + k] = (uint32_t)records.empty;
        walk->waiting = (walk->waiting + LANES - 1) / LANES * LANES;
    }
    walk->ready = walk->waiting / LANES * LANES;
    walk->waiting -= walk->ready;
    return true;
}

#endif
