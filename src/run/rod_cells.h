/* Rods that erode, with too few particles across, before a run. */
#ifndef BOLIDE_RUN_ROD_CELLS_H
#define BOLIDE_RUN_ROD_CELLS_H

#include "model/findings.h"

/* Finds long solid bodies that fly end on so fast that they erode, with so few particles across
 * their radius that their strength hardly acts at the nose. */
void rod_cells(struct findings *findings);

#endif
