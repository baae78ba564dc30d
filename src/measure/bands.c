/* Bands over the ranks; see bands.h. The places where bands begin are found some at a time, so that
 * no rank sees more than a few places of each. */
#include "measure/bands.h"

#include <stdlib.h>

#include "base/memory.h"

enum { AT_ONCE = 64 };

static int compare_bands(const void *first, const void *second)
{
    const struct band *a = first, *b = second;
    return (a->at > b->at) - (a->at < b->at);
}

static int compare_places(const void *first, const void *second)
{
    const double *a = first, *b = second;
    return (*a > *b) - (*a < *b);
}

static int64_t drop_lost(struct band *own, int64_t count)
{
    int64_t kept = 0;
    for (int64_t i = 0; i < count; i++)
        if (isfinite(own[i].at))
            own[kept++] = own[i];
    return kept;
}

/* The next different places of OWN from NEXT on; *known is the last up to which none is left
 * out. */
static int offer_places(const struct band *own, int64_t count, int64_t next, double *place,
                        double *known)
{
    int offered = 0;
    for (; next < count && offered < AT_ONCE; next++)
        if (offered == 0 || own[next].at != place[offered - 1])
            place[offered++] = own[next].at;
    *known = next < count ? place[offered - 1] : INFINITY;
    return offered;
}

/* Adds the bands that begin at one of COUNT sorted places up to KNOWN. */
static bool add_bands(struct bands *bands, int64_t *room, const double *place, int64_t count,
                      double known, double width)
{
    if (!memory_reserve((void **)&bands->band, room, bands->count + count, bands->count,
                        sizeof *bands->band))
        return false;
    for (int64_t k = 0; k < count && place[k] <= known; k++)
        if (bands->count == 0 || !(place[k] - bands->band[bands->count - 1].at < width))
            bands->band[bands->count++] = (struct band){place[k], NAN, NAN};
    return true;
}

static struct error *find_bands(const struct ranks *ranks, const struct band *own, int64_t count,
                                double width, struct bands *bands)
{
    int64_t next = 0, room = 0, places = 1;
    while (places > 0) {
        double offered[AT_ONCE], known, *place;
        int own_places = offer_places(own, count, next, offered, &known);
        TRY(ranks_gather(ranks, -1, offered, own_places, sizeof *offered, (void **)&place,
                         &places));
        known = ranks_minimum(ranks, known);
        qsort(place, (size_t)places, sizeof *place, compare_places);
        bool added = add_bands(bands, &room, place, places, known, width);
        free(place);
        TRY(ranks_agree(ranks, added ? NULL : out_of_memory_for("the bands of a check")));
        while (next < count && own[next].at - bands->band[bands->count - 1].at < width)
            next++;
    }
    return NULL;
}

/* The means of the bands from BEGIN on, at most AT_ONCE; OWN[*next] is the first point of them. */
static void average(const struct ranks *ranks, const struct band *own, int64_t count, int64_t *next,
                    struct bands *bands, int64_t begin)
{
    struct exact_sum sums[2 * AT_ONCE] = {{{0}, 0, false}};
    int64_t points[AT_ONCE] = {0};
    int some = (int)(bands->count - begin < AT_ONCE ? bands->count - begin : AT_ONCE);
    for (int k = 0; k < some; k++) {
        const bool last = begin + k + 1 == bands->count;
        const double end = last ? INFINITY : bands->band[begin + k + 1].at;
        for (; *next < count && own[*next].at < end; ++*next) {
            exact_sum_add(&sums[2 * k], own[*next].first);
            exact_sum_add(&sums[2 * k + 1], own[*next].second);
            points[k]++;
        }
    }
    ranks_sum_exact(ranks, sums, 2 * some);
    ranks_sum_of(ranks, points, some);
    for (int k = 0; k < some; k++) {
        struct band *band = &bands->band[begin + k];
        band->first = exact_sum_value(&sums[2 * k]) / (double)points[k];
        band->second = exact_sum_value(&sums[2 * k + 1]) / (double)points[k];
    }
}

struct error *bands_make(const struct ranks *ranks, struct band *own, int64_t count, double width,
                         struct bands *bands)
{
    *bands = (struct bands){0, NULL};
    count = drop_lost(own, count);
    qsort(own, (size_t)count, sizeof *own, compare_bands);
    TRY(find_bands(ranks, own, count, width, bands));
    int64_t next = 0;
    for (int64_t begin = 0; begin < bands->count; begin += AT_ONCE)
        average(ranks, own, count, &next, bands, begin);
    return NULL;
}

void bands_free(struct bands *bands)
{
    free(bands->band);
    *bands = (struct bands){0, NULL};
}
