/* Which particles other ranks must see: those within reach of their particles, found from the boxes
 * that the blocks of all ranks fill. */
#ifndef BOLIDE_HALO_H
#define BOLIDE_HALO_H

#include "particle/neighbours.h"

/* What a block's particles fill, and how far they reach, skin included. */
struct region {
    uint64_t key;
    double low[3], high[3], reach;
    int32_t rank;
};

/* The regions of all ranks, by key. */
struct halo {
    struct region *region;
    int64_t regions;
};

/* Collective: plans the exchange of GHOSTS and takes down what its particles are. Particles are
 * seen across the periodic faces of MIRRORS too; NULL: there are none. Free HALO also after an
 * error. A rank alone has no ghosts of others and no regions. */
struct error *halo_plan(const struct particles *particles, const struct mirrors *mirrors,
                        struct reach reach, double skin, struct ghosts *ghosts, struct halo *halo);
void halo_free(struct halo *halo);

#endif
