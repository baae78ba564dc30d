/* The search for the neighbours of one point; see row_kernel.h. It compiles as CUDA device code
 * too. */
#ifndef BOLIDE_PARTICLE_ROW_BODY_H
#define BOLIDE_PARTICLE_ROW_BODY_H

#include <string.h>

#include "base/wide.h"
#include "particle/row_kernel.h"

/* Keys and entries of the candidates in range. Every candidate is written, and the next one
 * overwrites it unless it counts: no branch to mispredict. */
BOLIDE_INLINE int32_t row_keep(const struct candidates *c, const struct row_point *own,
                               uint32_t *key, uint32_t *entry)
{
    int32_t kept = 0;
    for (int32_t k = 0; k < c->count; k++) {
        double dx = c->x[k] - own->x, dy = c->y[k] - own->y, dz = c->z[k] - own->z;
        double range = own->reach + c->reach[k];
        key[kept] = c->key[k];
        entry[kept] = c->entry[k];
        kept += (dx * dx + dy * dy + dz * dz < range * range) & (c->key[k] != own->key);
    }
    return kept;
}

/* Writes the entries to ROW in the order of their keys. Each one's place is the number of keys
 * below its own: for rows of some dozens that is faster than any exchange. KEY has room for
 * CANDIDATES_STEP more. */
BOLIDE_INLINE void row_order(uint32_t *key, const uint32_t *entry, int32_t count, uint32_t *row)
{
    memset(key + count, 0, CANDIDATES_STEP * sizeof *key);
    for (int32_t first = 0; first < count; first += CANDIDATES_STEP) {
        keys16 own, below;
        uint32_t place[CANDIDATES_STEP];
        memcpy(&own, key + first, sizeof own);
        memset(&below, 0, sizeof below);
        for (int32_t k = 0; k < count; k++)
            keys16_count_below(&below, &own, key[k]);
        memcpy(place, &below, sizeof place);
        for (int32_t k = 0; k < CANDIDATES_STEP && first + k < count; k++)
            row[place[k]] = entry[first + k];
    }
}

#endif
