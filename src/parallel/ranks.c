/* One process alone; see ranks.h. */
#include "parallel/ranks.h"

struct ranks ranks_alone(void)
{
    struct ranks alone = {0, 1};
    return alone;
}

struct slice ranks_slice(const struct ranks *ranks, int64_t total)
{
    int64_t share = total / ranks->size, rest = total % ranks->size, rank = ranks->rank;
    struct slice slice;
    slice.begin = rank * share + (rank < rest ? rank : rest);
    slice.end = slice.begin + share + (rank < rest);
    return slice;
}

double ranks_minimum(const struct ranks *ranks, double value)
{
    (void)ranks;
    return value;
}

double ranks_maximum(const struct ranks *ranks, double value)
{
    (void)ranks;
    return value;
}

int64_t ranks_sum(const struct ranks *ranks, int64_t value)
{
    (void)ranks;
    return value;
}

void ranks_sum_exact(const struct ranks *ranks, struct exact_sum *sums, int count)
{
    (void)ranks;
    (void)sums;
    (void)count;
}

struct error *ranks_agree(const struct ranks *ranks, struct error *error)
{
    (void)ranks;
    return error;
}
