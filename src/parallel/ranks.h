/* The ranks that compute one case together. Every collective function of the library takes a struct
 * ranks; a process alone needs no transport, and one that has joined others speaks to them by MPI
 * (ranks_mpi.c; a build without MPI has ranks_alone.c in its place). */
#ifndef BOLIDE_RANKS_H
#define BOLIDE_RANKS_H

#include "base/error.h"
#include "parallel/exact_sum.h"

struct ranks {
    int rank, size;
    bool joined; /* to the others of the world that a launcher has started */
};

/* This process alone. */
struct ranks ranks_alone(void);

/* All processes that were started together by mpirun or its like; this process alone where it was
 * started by itself. Call once, before any other call; ranks_leave before the end. */
struct ranks ranks_join(void);
void ranks_leave(const struct ranks *ranks);

/* Ends all processes with STATUS: for an error that the others do not know of. */
void ranks_abort(const struct ranks *ranks, int status);

/* The part of TOTAL items that a rank generates or reads. */
struct slice {
    int64_t begin, end;
};
struct slice ranks_slice(const struct ranks *ranks, int64_t total);

/* Collective: the smallest or largest VALUE, the sum of counts, and exact sums over all ranks. */
double ranks_minimum(const struct ranks *ranks, double value);
double ranks_maximum(const struct ranks *ranks, double value);
int64_t ranks_sum(const struct ranks *ranks, int64_t value);
void ranks_sum_exact(const struct ranks *ranks, struct exact_sum *sums, int count);

/* A value that a member has (a particle, a cell), the member's id, and what the value is: an index
 * of the caller's. */
struct ranked {
    double value;
    uint64_t id;
    int64_t what;
};

/* Whether A comes before B: by the smaller value, of equal values by the smaller id. Not a number
 * comes before all numbers, so that it is not lost. */
BOLIDE_INLINE bool ranked_before(const struct ranked *a, const struct ranked *b)
{
    if (isnan(a->value) || isnan(b->value))
        return isnan(a->value) && (!isnan(b->value) || a->id < b->id);
    return a->value < b->value || (a->value == b->value && a->id < b->id);
}

/* Collective: OWN becomes the one of all ranks that comes first. */
void ranks_first(const struct ranks *ranks, struct ranked *own);

/* Collective: each of COUNT values becomes its largest over all ranks. */
void ranks_maximum_of(const struct ranks *ranks, double *values, int count);

/* Collective: each of COUNT values becomes its sum over all ranks. */
void ranks_sum_of(const struct ranks *ranks, int64_t *values, int count);

/* Collective: how many ranks, this one among them, share the memory of this machine. */
int ranks_beside(const struct ranks *ranks);

/* Collective: the sum of VALUE over the lower ranks. */
int64_t ranks_before(const struct ranks *ranks, int64_t value);

/* Collective: BYTES at DATA become those of rank FROM. */
void ranks_broadcast(const struct ranks *ranks, int from, void *data, int64_t bytes);

/* Collective: the COUNT items of BYTES each at OWN of every rank, one rank's behind the other's, in
 * fresh memory at *ALL (free it), *TOTAL of them. With TO a rank alone gets them, the others none;
 * with TO = -1 all do. */
struct error *ranks_gather(const struct ranks *ranks, int to, const void *own, int64_t count,
                           size_t bytes, void **all, int64_t *total);

/* One number to every rank, and one from each: arrays of ranks->size. */
void ranks_swap_counts(const struct ranks *ranks, const int32_t *to, int32_t *from);

/* Part of an exchange: ITEMS at DATA go to RANK, or come from it. */
struct message {
    int32_t rank;
    bool comes;
    void *data;
    int64_t items;
};

/* Starts COUNT messages of items of BYTES each, lets them proceed, and waits for them. REQUESTS has
 * room for them (ranks_request_size() each). A large message proceeds only while both ranks are in
 * calls: who computes meanwhile calls ranks_advance from time to time, on the first thread. */
size_t ranks_request_size(void);
void ranks_start(const struct message *messages, int count, size_t bytes, void *requests);
void ranks_advance(int count, void *requests);
void ranks_finish(int count, void *requests);

/* Collective: NULL when no rank has an error; else every rank gets one, the lowest rank's. Called
 * before any other collective call that an error would keep a rank from. Takes ERROR. */
struct error *ranks_agree(const struct ranks *ranks, struct error *error);

/* The same, and ranks_maximum_of, in one call. */
struct error *ranks_agree_on(const struct ranks *ranks, struct error *error, double *values,
                             int count);

#endif
