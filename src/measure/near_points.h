/* Points sorted into cells, to find which are near a place. */
#ifndef BOLIDE_NEAR_POINTS_H
#define BOLIDE_NEAR_POINTS_H

#include "base/error.h"

struct near_point {
    uint64_t cell;
    int64_t index;
};

struct near_points {
    int64_t count;
    struct near_point *point; /* by cell; owned */
    double low[3], cell;
};

/* Sorts the COUNT points AT into cells of edge REACH, m, or more where they lie very far apart. */
struct error *near_points_make(const double (*at)[3], int64_t count, double reach,
                               struct near_points *near);
void near_points_free(struct near_points *near);

/* Calls FOUND with the index of every point that is within the reach of PLACE, and of others about
 * it. */
void near_points_about(const struct near_points *near, const double place[3],
                       void (*found)(void *context, int64_t index), void *context);

#endif
