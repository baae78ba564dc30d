/* The particles of all ranks in one place, for what cannot be told from parts: a front, pieces, a picture. */
#ifndef BOLIDE_WHOLE_H
#define BOLIDE_WHOLE_H

#include "model/views.h"

/* On rank 0 SIMULATION and VIEWS show all particles, as a process alone would have them; the other ranks are not HERE
 * and must look at nothing. */
struct whole {
    bool here;
    const struct simulation *simulation;
    const struct views *views;
    struct gathered *own; /* NULL for a process alone */
};

/* Collective. Free it also after an error. */
struct error *whole_make(const struct simulation *simulation, const struct views *views,
                         struct whole *whole);
void whole_free(struct whole *whole);

/* Collective: all ranks get the COUNT numbers that rank 0 has, unless a rank has an ERROR, which all get then. Takes
 * ERROR. */
struct error *whole_tell(const struct simulation *simulation, struct error *error, double *numbers,
                         int count);

#endif
