/* Whether a state that was loaded can be one of the case: what follows believes its indices and its
 * numbers. */
#ifndef BOLIDE_LOADED_H
#define BOLIDE_LOADED_H

#include "model/simulation.h"

/* Collective. ERROR_SYSTEM names the first array, row and number of SIMULATION, just loaded, that
 * no run of its case writes: a material, body or site that the case has not, a mass or density that
 * is not positive, a number that is not finite. Of this rank's members. */
struct error *simulation_check_loaded(const struct simulation *simulation);

#endif
