/* What of a blast on a structure the cells of a coupling are too coarse for: a plate, a charge, the
 * stand-off between them. Private to couple/. */
#ifndef BOLIDE_COARSE_H
#define BOLIDE_COARSE_H

#include "case/case.h"

/* Messages, each located as an error would be; NULL: cells of EDGE are fine enough. */
struct error *coarse_cells(const struct simulation_case *input, double edge);
/* The same of gases that pass between cells and particles: one particle a cell is too few. */
struct error *coarse_gases(const struct simulation_case *input, double edge);

#endif
