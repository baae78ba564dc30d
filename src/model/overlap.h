/* Which bodies of a case may overlap a body, and what becomes of a place that lies in two of
 * them. */
#ifndef BOLIDE_OVERLAP_H
#define BOLIDE_OVERLAP_H

#include "model/place.h"

/* What becomes of a site that lies in another body too. */
enum overlap { OVERLAP_KEEP, OVERLAP_DROP, OVERLAP_MISTAKE };

struct rival {
    int body;
    enum overlap overlap;
    struct bounds bounds;
};

/* The bodies of a case, sorted by where they begin along an axis: a search tree, whose root is the
 * middle of the list, so that a body among thousands meets only its neighbours. */
struct overlaps {
    const struct place *place;
    struct bounds *bounds; /* of each body */
    int axis;
    int *order;      /* bodies by their lower end */
    double *highest; /* upper end of all in the subtree with its root here */
    struct replacements replacements;
};

bool bounds_meet(const struct bounds *a, const struct bounds *b);

/* Looks at the bodies of INPUT; overlaps_free in any case. */
struct error *overlaps_make(const struct place *place, struct overlaps *overlaps);
void overlaps_free(struct overlaps *overlaps);

/* The bodies that BODY does not simply replace and whose bounds meet its own, by their numbers.
 * Free *RIVALS. */
struct error *overlaps_rivals(const struct overlaps *overlaps, int body, struct rival **rivals,
                              int *count);

#endif
