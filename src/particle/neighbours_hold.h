/* How long neighbour rows hold: the motion of blocks since the rows were built. Private to this room. */
#ifndef BOLIDE_NEIGHBOURS_HOLD_H
#define BOLIDE_NEIGHBOURS_HOLD_H

#include "particle/halo.h"

/* Collective: takes down places and reaches at the time of building; images were planned within DISTANCE of walls, the
 * blocks of all ranks are those of HALO. */
struct error *motion_start(struct neighbours *neighbours, const struct particles *particles,
                           struct reach reach,
                           const struct mirrors *mirrors, double distance,
                           const struct halo *halo, int threads);
void motion_free(struct neighbours *neighbours);

#endif
