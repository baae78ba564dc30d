/* Exact sums of many numbers at once, in vectors. */
#ifndef BOLIDE_EXACT_BLOCK_H
#define BOLIDE_EXACT_BLOCK_H

#include "parallel/exact_sum.h"

/* Adds COUNT values to SUM, to the same bits as exact_sum_add of each. */
void exact_sum_add_all(struct exact_sum *sum, const double *value, int count);

#endif
