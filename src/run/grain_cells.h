/* Granular beds with too few particles across a grain, before a run. */
#ifndef BOLIDE_RUN_GRAIN_CELLS_H
#define BOLIDE_RUN_GRAIN_CELLS_H

#include "model/findings.h"

/* Particles across the grains of BODY; false where it does not consist of grains. */
struct grain_cells {
    double smallest, mean; /* smallest NAN: not known */
    bool loose;            /* with voids between them, as far as the case tells */
};
bool grain_cells_of(const struct simulation_case *input, int body, struct grain_cells *cells);

/* Finds beds with voids between grains, and too few particles across these. */
void grain_cells(struct findings *findings);

#endif
