/* The transport of a build without MPI: there is nobody else. */
#include <string.h>

#include "base/memory.h"
#include "parallel/ranks.h"

/* The types are those of ranks.h: with other ranks, functions write to `values`. */
// NOLINTBEGIN(readability-non-const-parameter)

struct ranks ranks_join(void) { return ranks_alone(); }

void ranks_leave(const struct ranks *ranks) { (void)ranks; }

void ranks_abort(const struct ranks *ranks, int status)
{
    (void)ranks;
    (void)status;
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

void ranks_maximum_of(const struct ranks *ranks, double *values, int count)
{
    (void)ranks;
    (void)values;
    (void)count;
}

void ranks_first(const struct ranks *ranks, struct ranked *own)
{
    (void)ranks;
    (void)own;
}

void ranks_sum_of(const struct ranks *ranks, int64_t *values, int count)
{
    (void)ranks;
    (void)values;
    (void)count;
}

int ranks_beside(const struct ranks *ranks)
{
    (void)ranks;
    return 1;
}

int64_t ranks_before(const struct ranks *ranks, int64_t value)
{
    (void)ranks;
    (void)value;
    return 0;
}

void ranks_broadcast(const struct ranks *ranks, int from, void *data, int64_t bytes)
{
    (void)ranks;
    (void)from;
    (void)data;
    (void)bytes;
}

struct error *ranks_gather(const struct ranks *ranks, int to, const void *own, int64_t count,
                           size_t bytes, void **all, int64_t *total)
{
    (void)ranks;
    (void)to;
    *total = count;
    *all = memory_allocate((size_t)count * bytes);
    if (!*all)
        return out_of_memory();
    if (count)
        memcpy(*all, own, (size_t)count * bytes);
    return NULL;
}

void ranks_swap_counts(const struct ranks *ranks, const int32_t *to, int32_t *from)
{
    (void)ranks;
    from[0] = to[0];
}

size_t ranks_request_size(void) { return 0; }

void ranks_start(const struct message *messages, int count, size_t bytes, void *requests)
{
    (void)messages;
    (void)bytes;
    (void)requests;
    (void)count;
    assert(count == 0);
}

void ranks_advance(int count, void *requests)
{
    (void)count;
    (void)requests;
}

void ranks_finish(int count, void *requests)
{
    (void)count;
    (void)requests;
}

struct error *ranks_agree_on(const struct ranks *ranks, struct error *error, double *values,
                             int count)
{
    (void)ranks;
    (void)values;
    (void)count;
    return error;
}

// NOLINTEND(readability-non-const-parameter)
