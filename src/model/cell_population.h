/* The population of solvers whose members are cells. */
#ifndef BOLIDE_CELL_POPULATION_H
#define BOLIDE_CELL_POPULATION_H

#include "grid/cell_blocks.h"
#include "model/simulation.h"

extern const struct population_class cell_population;

#endif
