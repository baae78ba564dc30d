/* Sweeps along a row of gas cells, compiled once an instruction set as kernels are, so that they
 * can be judged before a solver calls them. */
#ifndef BOLIDE_SPEED_GAS_KERNEL_H
#define BOLIDE_SPEED_GAS_KERNEL_H

#include "gas/lax_wendroff.h"
#include "gas/muscl_hancock.h"

void gas_lax_wendroff(struct gas_row *row, const struct lax_wendroff *scheme, double r,
                      struct gas_numbers *flux);
void gas_muscl_hancock(struct gas_row *row, double r, struct gas_numbers *flux);

#endif
