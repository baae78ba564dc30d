/* Percentiles of values by mass, so that a few strays set neither window nor colours. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "particle/radix.h"
#include "picture/album_internal.h"

/* A whole number of the same order as VALUE. */
static uint32_t order_of(float value)
{
    const float clean = value + 0.0f; /* no negative zero */
    uint32_t bits;
    memcpy(&bits, &clean, sizeof bits);
    return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

/* A member alone is a stray, however few there are. */
static const double STRAYS = 1.5;
enum { FEW = 20 };

/* The percentiles of the sorted members begin .. end - 1 of ORDER. */
static void take_group(const float *value, const float *mass, const struct keyed *order,
                       int64_t begin, int64_t end, double low, double high, struct range *range)
{
    double total = 0.0, sum = 0.0;
    bool begun = false;
    if (end - begin > FEW) {
        low = maximum(low, minimum(STRAYS / (double)(end - begin), 0.5));
        high = minimum(high, 1.0 - low);
    }
    for (int64_t k = begin; k < end; k++)
        total += mass[order[k].index];
    for (int64_t k = begin; k < end; k++) {
        sum += mass[order[k].index];
        if (!begun && sum > low * total) {
            range_include(range, value[order[k].index]);
            begun = true;
        }
        if (sum >= high * total || k == end - 1) {
            range_include(range, value[order[k].index]);
            return;
        }
    }
}

struct error *spread_find(const float *value, const float *mass, const uint8_t *group,
                          int64_t count, double low, double high, struct range *percentiles,
                          struct range *extremes)
{
    struct keyed *order = memory_allocate((size_t)(2 * count) * sizeof *order + 1);
    int64_t finite = 0;
    if (!order)
        return out_of_memory_for("a picture");
    for (int64_t i = 0; i < count; i++) {
        range_include(extremes, value[i]);
        if (isfinite(value[i]) && isfinite(mass[i]))
            order[finite++] =
                (struct keyed){(uint64_t)group[i] << 32 | order_of(value[i]), (int32_t)i};
    }
    radix_sort(order, order + count, finite, 1);
    for (int64_t begin = 0, end; begin < finite; begin = end) {
        for (end = begin; end < finite && order[end].key >> 32 == order[begin].key >> 32;)
            end++;
        take_group(value, mass, order, begin, end, low, high, percentiles);
    }
    free(order);
    return NULL;
}
