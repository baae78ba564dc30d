/* What cells of gas get of the particles around them: each particle gives to the cells of a box
 * with weights that fall off as shape functions at their nodes do, N_Ic N_I(x) summed over these,
 * where a node gives to the cells beside it in equal parts. Private to couple/. */
#ifndef BOLIDE_SMEAR_H
#define BOLIDE_SMEAR_H

#include "couple/part.h"
#include "particle/radix.h"

/* Sums over the particles of a cell; the materials are those of the gas solver. */
struct smear_sums {
    double volume[2], mass[2], energy[2], momentum[3], kinetic;
};

/* A particle as all ranks get it. */
struct smeared {
    uint64_t id;
    double position[3], velocity[3], mass, density, energy;
    double half;   /* of its size, in cells */
    int64_t which; /* of the materials of the gas */
};

struct smear {
    enum grid_shape shape;
    double edge;
    int dimension;
    int64_t low[3], count[3]; /* the box */
    const int32_t *number;    /* of each cell of the box, the first axis fastest, that of its sums;
                               * -1: it has none. NULL: all have, in this order */
    bool keeps; /* what would go beyond the box goes to its border; else it is not summed */
};

/* Adds what PARTICLE has to SUMS. */
void smear_particle(const struct smear *smear, const struct smeared *particle,
                    struct smear_sums *sums);

/* Collective: the particles of all ranks that WANTED takes, *count of them at *ALL, and the ORDER
 * of their ids, in which they are to be summed; the caller frees both. */
struct error *smear_gather(const struct mpm *mpm, const struct gas_view *view,
                           const struct ranks *ranks, bool (*wanted)(void *context, int32_t i),
                           void *context, struct smeared **all, int64_t *count,
                           struct keyed **order);

#endif
