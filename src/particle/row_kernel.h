/* The neighbours of one point among candidates: what building rows spends its time on. */
#ifndef BOLIDE_PARTICLE_ROW_KERNEL_H
#define BOLIDE_PARTICLE_ROW_KERNEL_H

#include <stdint.h>

enum { CANDIDATES_STEP = 16 };

/* Points that may be neighbours of one, COUNT of them, with room for CANDIDATES_STEP more. Keys say
 * in which order neighbours stand in a row, entries what it keeps of them; no two keys are
 * alike. */
struct candidates {
    int32_t count;
    double *x, *y, *z, *reach;
    uint32_t *key, *entry;
};

struct row_point {
    double x, y, z, reach;
    uint32_t key; /* that of the point itself, which is no neighbour */
};

/* Writes to ROW the entries of the candidates nearer to OWN than the sum of both reaches, by key,
 * and returns how many. ROW and the scratch KEY and ENTRY have room for COUNT + CANDIDATES_STEP.
 * Each candidate array is written on behind its COUNT elements. */
int32_t row_find(const struct candidates *candidates, const struct row_point *own, uint32_t *key,
                 uint32_t *entry, uint32_t *row);

#endif
