/* Blasts in gas that cells are too coarse for, before a run. */
#ifndef BOLIDE_RUN_BLAST_CELLS_H
#define BOLIDE_RUN_BLAST_CELLS_H

#include "model/findings.h"

/* Finds gauges and rigid bodies with so few cells between them and a charge that the peaks there
 * are known to be too low; nothing with a solver without cells of gas. */
void blast_cells(struct findings *findings);

#endif
