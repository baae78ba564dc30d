/* The ranks that compute one case together. Every collective function of the library takes a
 * struct ranks; this is the form of one process, and a transport adds the others. */
#ifndef BOLIDE_RANKS_H
#define BOLIDE_RANKS_H

#include "base/error.h"
#include "parallel/exact_sum.h"

struct ranks {
    int rank, size;
};

/* This process alone. */
struct ranks ranks_alone(void);

/* The part of TOTAL items that a rank generates or writes. */
struct slice {
    int64_t begin, end;
};
struct slice ranks_slice(const struct ranks *ranks, int64_t total);

/* Collective: the smallest or largest VALUE, the sum of counts, and exact sums over all ranks. */
double ranks_minimum(const struct ranks *ranks, double value);
double ranks_maximum(const struct ranks *ranks, double value);
int64_t ranks_sum(const struct ranks *ranks, int64_t value);
void ranks_sum_exact(const struct ranks *ranks, struct exact_sum *sums, int count);

/* Collective: NULL when no rank has an error; else every rank gets one, the lowest rank's. Called
 * before any other collective call that an error would keep a rank from. Takes ERROR. */
struct error *ranks_agree(const struct ranks *ranks, struct error *error);

#endif
