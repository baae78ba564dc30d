/* How long neighbour rows hold: the motion of blocks since the rows were built. Private to this room. */
#ifndef BOLIDE_NEIGHBOURS_HOLD_H
#define BOLIDE_NEIGHBOURS_HOLD_H

#include "particle/neighbours.h"

/* Takes down places and reaches at the time of building; images were planned within DISTANCE of walls. */
struct error *motion_start(struct neighbours *neighbours, const struct particles *particles,
                           struct reach reach, const struct mirrors *mirrors, double distance,
                           int threads);
void motion_free(struct neighbours *neighbours);

#endif
