/* What cells of gas get of the particles around them: each particle gives to the cells of a box
 * with weights that fall off as shape functions at their nodes do, N_Ic N_I(x) summed over these,
 * where a node gives to the cells beside it in equal parts. Private to couple/. */
#ifndef BOLIDE_SMEAR_H
#define BOLIDE_SMEAR_H

#include "couple/part.h"

/* Sums over the particles of a cell; the materials are those of the gas solver. */
struct smear_sums {
    double volume[2], mass[2], energy[2], momentum[3], kinetic;
};

struct smear {
    const struct particles *particles;
    enum grid_shape shape;
    double edge;
    int dimension;
    int64_t low[3], count[3]; /* the box */
    const int32_t *number;    /* of each cell of the box, the first axis fastest, that of its sums;
                               * -1: it has none. NULL: all have, in this order */
    bool keeps; /* what would go beyond the box goes to its border; else it is not summed */
};

/* Adds particle I of the gas solver's material WHICH, of half the size HALF in cells, to SUMS. */
void smear_particle(const struct smear *smear, int32_t i, int which, double half,
                    struct smear_sums *sums);

/* The indices of particles that WANTED takes, in the order of their ids; *count of them, which the
 * caller frees. NULL: out of memory. */
int32_t *smear_order(const struct particles *particles, bool (*wanted)(void *context, int32_t i),
                     void *context, int32_t *count);

#endif
