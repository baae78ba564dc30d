/* What of a blast on a structure the cells of a coupling are too coarse for: a plate, a charge, the
 * stand-off between them. Private to couple/. */
#ifndef BOLIDE_COARSE_H
#define BOLIDE_COARSE_H

#include "model/findings.h"

/* Finds what cells of EDGE are too coarse for. */
void coarse_cells(struct findings *findings, double edge);
/* The same of gases that pass between cells and particles: one particle a cell is too few. */
void coarse_gases(struct findings *findings, double edge);

#endif
