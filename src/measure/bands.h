/* Bands: points that stand near together along a line count as one, with the means of what they
 * carry. */
#ifndef BOLIDE_BANDS_H
#define BOLIDE_BANDS_H

#include "parallel/ranks.h"

/* A point, or a band of them: where it stands, and two values. */
struct band {
    double at, first, second;
};

struct bands {
    int64_t count;
    struct band *band; /* by place; owned */
};

/* Collective: the bands of the COUNT points OWN of every rank, which it sorts; those whose place is
 * not finite are left out. A band begins at the lowest place that is in none yet, and holds the
 * points that stand less than WIDTH behind it; its values are exact means. All ranks get all bands:
 * they are to be few. Free them also after an error. */
struct error *bands_make(const struct ranks *ranks, struct band *own, int64_t count, double width,
                         struct bands *bands);
void bands_free(struct bands *bands);

#endif
