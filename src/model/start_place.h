/* Where particles stood at the start. Nobody keeps it: the id names the body and the site of its
 * lattice. */
#ifndef BOLIDE_START_PLACE_H
#define BOLIDE_START_PLACE_H

#include "model/simulation.h"

/* PLACE, one for each of the particles BEGIN .. END - 1, m. */
void start_places(const struct population *particles, int64_t begin, int64_t end,
                  double (*place)[3]);

#endif
