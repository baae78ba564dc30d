/* Blasts in gas that cells are too coarse for, before a run. */
#ifndef BOLIDE_RUN_BLAST_CELLS_H
#define BOLIDE_RUN_BLAST_CELLS_H

#include "case/case.h"

/* Gauges and obstacles with so few cells between them and a charge that the peaks there are known
 * to be too low, as warnings; NULL: none, or a solver without cells of gas. */
struct error *blast_cells(const struct simulation_case *input);

#endif
