/* The catalogue: everything that a case can name, by kind. */
#ifndef BOLIDE_CATALOGUE_H
#define BOLIDE_CATALOGUE_H

#include "base/parameter.h"

/* The kinds solver, eos, strength, shape, exact, probe and measure. */
extern const struct catalogue bolide_catalogue;

#endif
