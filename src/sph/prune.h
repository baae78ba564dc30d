/* Near rows from the rows: of each the entries whose records lie nearer than (1 + near skin) times
 * the support, in the same order. */
#ifndef BOLIDE_PRUNE_H
#define BOLIDE_PRUNE_H

#include "particle/neighbours.h"

struct prune_loop {
    const double *record; /* as lanes.h has them */
    int stride, dimension;
    const double *place;
    double smoothing;
    const struct neighbours *neighbours; /* whose near rows and their counts are written */
};

/* Finds the near rows of the particles of block B, if they are asked for, with the best instruction
 * set of this processor. */
void prune_loop_run(const struct prune_loop *loop, const struct block *block, int32_t b);

#endif
