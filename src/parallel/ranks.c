/* What needs no transport; see ranks.h. */
#include "parallel/ranks.h"

struct ranks ranks_alone(void)
{
    struct ranks alone = {0, 1, false};
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
    return -ranks_maximum(ranks, -value);
}

struct error *ranks_agree(const struct ranks *ranks, struct error *error)
{
    return ranks_agree_on(ranks, error, NULL, 0);
}

double ranks_maximum(const struct ranks *ranks, double value)
{
    ranks_maximum_of(ranks, &value, 1);
    return value;
}
