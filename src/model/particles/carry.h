/* The particles of a run that another one has left, for a case that begins with them. */
#ifndef BOLIDE_CARRY_H
#define BOLIDE_CARRY_H

#include "model/simulation.h"

/* Replaces in SIMULATION, which has been filled, the bodies that BEFORE has too by the particles of
 * BEFORE, with all of their state. BODY and MATERIAL give for each body and material of BEFORE that
 * of SIMULATION, -1: it is left out. Collective. */
struct error *carry_particles(struct simulation *simulation, const struct simulation *before,
                              const int *body, const int *material);

#endif
