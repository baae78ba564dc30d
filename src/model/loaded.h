/* Checks a loaded state: later code relies on its indices and numbers. */
#ifndef BOLIDE_LOADED_H
#define BOLIDE_LOADED_H

#include "model/simulation.h"

/* Collective. ERROR_SYSTEM names the first array, row and number of SIMULATION, just loaded, that
 * cannot be of its case: a material, body or site that the case does not have, a mass or density
 * that is not positive, a number that is not finite or not what its field can be (enum
 * field_kind), a place that light cannot have reached, an id that two members have. Checks the
 * members of this rank. */
struct error *simulation_check_loaded(const struct simulation *simulation);

#endif
