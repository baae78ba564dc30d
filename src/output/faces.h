/* What the maps of cells have on the faces of rigid bodies, as a table. */
#ifndef BOLIDE_FACES_H
#define BOLIDE_FACES_H

#include "model/simulation.h"

/* Why the case has no such table; NULL: it has. */
const char *faces_missing(const struct simulation *simulation);

/* Collective: writes the table to PATH: a row for each face of an open cell behind which a rigid
 * body blocks the next one. Rank 0 writes. The rows are the same, in the same order, on any number
 * of ranks. */
struct error *faces_write(const char *path, const struct simulation *simulation,
                          const struct ranks *ranks);

#endif
