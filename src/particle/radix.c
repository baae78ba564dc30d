/* Least significant digit first, eleven bits a digit; see radix.h. Each thread counts and moves a
 * part of the entries of its own: of one digit, those of the first part come first, so that their
 * order is kept. */
#include "particle/radix.h"

#include <omp.h>

enum {
    DIGIT_BITS = 11,
    DIGITS = 6,
    BUCKETS = 1 << DIGIT_BITS,
    PARTS = 64,           /* at most */
    PART_SHORTEST = 16384 /* entries that are worth a thread */
};

/* How many parts COUNT entries fall into. */
static int parts_of(int64_t count, int threads)
{
    int64_t parts = count / PART_SHORTEST + 1;
    parts = parts < threads ? parts : threads;
    return (int)(parts < PARTS ? parts : PARTS);
}

/* The bits in which keys differ. */
static uint64_t varying_bits(const struct keyed *entry, int64_t count, int threads)
{
    uint64_t some = 0, all = ~(uint64_t)0;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(| : some) reduction(& : all)
    for (int64_t i = 0; i < count; i++) {
        some |= entry[i].key;
        all &= entry[i].key;
    }
    return count ? some & ~all : 0;
}

/* Turns the parts' numbers of entries of each digit into where these begin. */
static void find_places(int64_t *const *place, int parts)
{
    int64_t sum = 0;
    for (int b = 0; b < BUCKETS; b++)
        for (int r = 0; r < parts; r++) {
            int64_t here = place[r][b];
            place[r][b] = sum;
            sum += here;
        }
}

/* Moves FROM to TO, sorted by the digit at SHIFT. */
static void sort_digit(const struct keyed *from, struct keyed *to, int64_t count, int shift,
                       int threads)
{
    int64_t *place[PARTS];
#pragma omp parallel num_threads(threads)
    {
        const int parts = omp_get_num_threads(), part = omp_get_thread_num();
        const int64_t begin = count * part / parts, end = count * (part + 1) / parts;
        int64_t own[BUCKETS] = {0};
        for (int64_t i = begin; i < end; i++)
            own[from[i].key >> shift & (BUCKETS - 1)]++;
        place[part] = own;
#pragma omp barrier
#pragma omp single
        find_places(place, parts);
        for (int64_t i = begin; i < end; i++)
            to[own[from[i].key >> shift & (BUCKETS - 1)]++] = from[i];
    }
}

void radix_sort(struct keyed *entry, struct keyed *scratch, int64_t count, int threads)
{
    threads = parts_of(count, threads);
    const uint64_t varying = varying_bits(entry, count, threads);
    struct keyed *from = entry, *to = scratch;
    for (int digit = 0; digit < DIGITS; digit++) {
        int shift = digit * DIGIT_BITS;
        if (!(varying >> shift & (BUCKETS - 1)))
            continue;
        sort_digit(from, to, count, shift, threads);
        struct keyed *swap = from;
        from = to;
        to = swap;
    }
    if (from == entry)
        return;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int64_t i = 0; i < count; i++)
        entry[i] = from[i];
}

static bool begins_run(const struct keyed *entry, int64_t i)
{
    return i == 0 || entry[i].key != entry[i - 1].key;
}

int32_t radix_runs(const struct keyed *entry, int32_t count, int threads, struct key_run *run)
{
    int32_t begins[PARTS + 1] = {0}, runs = 0;
#pragma omp parallel num_threads(parts_of(count, threads))
    {
        const int parts = omp_get_num_threads(), part = omp_get_thread_num();
        const int64_t begin = (int64_t)count * part / parts;
        const int64_t end = (int64_t)count * (part + 1) / parts;
        int32_t own = 0;
        for (int64_t i = begin; i < end; i++)
            own += begins_run(entry, i);
        begins[part + 1] = own;
#pragma omp barrier
#pragma omp single
        {
            for (int p = 0; p < parts; p++)
                begins[p + 1] += begins[p];
            runs = begins[parts];
        }
        int32_t to = begins[part];
        for (int64_t i = begin; i < end; i++)
            if (begins_run(entry, i))
                run[to++] = (struct key_run){entry[i].key, (int32_t)i, 0};
#pragma omp barrier
#pragma omp for schedule(static)
        for (int32_t r = 0; r < runs; r++)
            run[r].count = (r + 1 < runs ? run[r + 1].first : count) - run[r].first;
    }
    return runs;
}
