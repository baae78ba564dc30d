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
    int64_t from[3], to[3];   /* cells of it whose sums are wanted, from its lowest on */
    const int32_t *number;    /* of each cell of the box, the first axis fastest, that of its sums;
                               * -1: it has none. NULL: all have, in this order */
    bool keeps; /* what would go beyond the box goes to its border; else it is not summed */
};

/* The particles of all ranks that give to cells; its memory stays for the next time. */
struct crowd {
    struct smeared *particle;
    int64_t count;
    struct keyed *order, *spare; /* by id: so they are summed */
    int32_t *place;              /* of each in this order, its cell along an axis */
    int64_t capacity, order_capacity, spare_capacity, place_capacity;
    struct picked picked;
};

/* Collective: the particles of all ranks that WANTED takes, which is called by several threads. */
struct error *crowd_gather(struct crowd *crowd, const struct mpm *mpm, const struct gas_view *view,
                           const struct simulation *simulation,
                           bool (*wanted)(void *context, int32_t i), void *context);
void crowd_free(struct crowd *crowd);

/* Adds what all particles of CROWD have to SUMS, with THREADS threads; the bits do not depend on
 * their number. */
void smear_crowd(const struct smear *smear, const struct crowd *crowd, int threads,
                 struct smear_sums *sums);

#endif
