/* The transport of ranks by MPI, over all processes that the launcher has started; see ranks.h.
 * Messages count items of a type of their own, so that none is too long for MPI's counts. */
#include <mpi.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/memory.h"
#include "parallel/ranks.h"

/* What the launchers of Open MPI, MPICH and Slurm leave in the environment of the processes that
 * they start. A process without pays nothing for MPI. */
static bool was_launched(void)
{
    static const char *const marks[] = {"OMPI_COMM_WORLD_SIZE", "PMI_RANK", "PMIX_RANK"};
    for (size_t i = 0; i < COUNT_OF(marks); i++)
        if (getenv(marks[i]))
            return true;
    return false;
}

struct ranks ranks_join(void)
{
    struct ranks ranks = ranks_alone();
    int provided;
    if (!was_launched() || MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &provided))
        return ranks;
    MPI_Comm_rank(MPI_COMM_WORLD, &ranks.rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks.size);
    ranks.joined = true;
    return ranks;
}

void ranks_leave(const struct ranks *ranks)
{
    if (ranks->joined)
        MPI_Finalize();
}

void ranks_abort(const struct ranks *ranks, int status)
{
    if (ranks->joined)
        MPI_Abort(MPI_COMM_WORLD, status);
}

int64_t ranks_sum(const struct ranks *ranks, int64_t value)
{
    if (ranks->joined)
        MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    return value;
}

static MPI_Datatype items_of(size_t bytes)
{
    MPI_Datatype type;
    MPI_Type_contiguous((int)bytes, MPI_BYTE, &type);
    MPI_Type_commit(&type);
    return type;
}

/* The signature is MPI's, COUNT not const. IN and INOUT are arrays of COUNT items. */
// NOLINTNEXTLINE(readability-non-const-parameter)
static void take_first(void *in, void *inout, int *count, MPI_Datatype *type)
{
    const struct ranked *a = in;
    struct ranked *b = inout;
    (void)type;
    for (int k = 0; k < *count; k++)
        if (ranked_before(&a[k], &b[k]))
            b[k] = a[k];
}

void ranks_first(const struct ranks *ranks, struct ranked *own)
{
    MPI_Op first;
    if (!ranks->joined)
        return;
    MPI_Datatype type = items_of(sizeof *own);
    MPI_Op_create(take_first, 1, &first);
    MPI_Allreduce(MPI_IN_PLACE, own, 1, type, first, MPI_COMM_WORLD);
    MPI_Op_free(&first);
    MPI_Type_free(&type);
}

void ranks_maximum_of(const struct ranks *ranks, double *values, int count)
{
    if (ranks->joined)
        MPI_Allreduce(MPI_IN_PLACE, values, count, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
}

void ranks_sum_of(const struct ranks *ranks, int64_t *values, int count)
{
    if (ranks->joined)
        MPI_Allreduce(MPI_IN_PLACE, values, count, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
}

int ranks_beside(const struct ranks *ranks)
{
    MPI_Comm machine;
    int size = 1;
    if (!ranks->joined)
        return 1;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, ranks->rank, MPI_INFO_NULL, &machine);
    MPI_Comm_size(machine, &size);
    MPI_Comm_free(&machine);
    return size;
}

int64_t ranks_before(const struct ranks *ranks, int64_t value)
{
    int64_t sum = 0;
    if (ranks->joined)
        MPI_Exscan(&value, &sum, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    return ranks->rank == 0 ? 0 : sum;
}

/* A sum as a row of whole numbers that may be added: its digits without carries, and whether it is
 * not finite. */
enum { SUM_NUMBERS = EXACT_SUM_DIGITS + 1, SUMS_AT_ONCE = 32 };

void ranks_sum_exact(const struct ranks *ranks, struct exact_sum *sums, int count)
{
    if (!ranks->joined)
        return;
    int64_t rows[SUMS_AT_ONCE][SUM_NUMBERS];
    for (int begin = 0; begin < count; begin += SUMS_AT_ONCE) {
        int some = count - begin < SUMS_AT_ONCE ? count - begin : SUMS_AT_ONCE;
        for (int k = 0; k < some; k++) {
            struct exact_sum tidy = {0};
            exact_sum_join(&tidy, &sums[begin + k]);
            memcpy(rows[k], tidy.digit, sizeof tidy.digit);
            rows[k][EXACT_SUM_DIGITS] = tidy.not_finite;
        }
        MPI_Allreduce(MPI_IN_PLACE, rows, some * SUM_NUMBERS, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
        for (int k = 0; k < some; k++) {
            struct exact_sum *sum = &sums[begin + k];
            memcpy(sum->digit, rows[k], sizeof sum->digit);
            sum->pending = ranks->size;
            sum->not_finite = rows[k][EXACT_SUM_DIGITS] != 0;
        }
    }
}

/* Bytes in pieces that MPI can count. */
void ranks_broadcast(const struct ranks *ranks, int from, void *data, int64_t bytes)
{
    enum { PIECE = 1 << 30 };
    char *at = data;
    for (; ranks->joined && bytes > 0; at += PIECE, bytes -= PIECE)
        MPI_Bcast(at, bytes < PIECE ? (int)bytes : PIECE, MPI_BYTE, from, MPI_COMM_WORLD);
}

/* A gather of items of BYTES each, of TYPE, to rank TO or with -1 to all; room for how many come
 * from each rank, and where to. */
struct gathering {
    int to;
    MPI_Datatype type;
    size_t bytes;
    int *counts, *places;
};

static struct error *gather(const struct ranks *ranks, struct gathering g, const void *own,
                            int64_t count, void **all, int64_t *total)
{
    const bool wanted = g.to < 0 || g.to == ranks->rank;
    int mine = (int)count;
    MPI_Allgather(&mine, 1, MPI_INT, g.counts, 1, MPI_INT, MPI_COMM_WORLD);
    int64_t sum = 0;
    for (int r = 0; r < ranks->size; r++) {
        g.places[r] = (int)sum;
        sum += g.counts[r];
    }
    *total = wanted ? sum : 0;
    *all = memory_allocate((size_t)*total * g.bytes + 1);
    struct error *error = NULL;
    if (!*all)
        error = out_of_memory_for("%lld items of all ranks", (long long)sum);
    else if (sum > INT32_MAX)
        error = error_new(ERROR_SYSTEM, "%lld items are too many for one rank", (long long)sum);
    TRY(ranks_agree(ranks, error));
    if (g.to < 0)
        MPI_Allgatherv(own, mine, g.type, *all, g.counts, g.places, g.type, MPI_COMM_WORLD);
    else
        MPI_Gatherv(own, mine, g.type, *all, g.counts, g.places, g.type, g.to, MPI_COMM_WORLD);
    return NULL;
}

struct error *ranks_gather(const struct ranks *ranks, int to, const void *own, int64_t count,
                           size_t bytes, void **all, int64_t *total)
{
    *all = NULL;
    if (!ranks->joined) {
        *total = count;
        *all = memory_allocate((size_t)count * bytes + 1);
        if (!*all)
            return out_of_memory();
        if (count)
            memcpy(*all, own, (size_t)count * bytes);
        return NULL;
    }
    int *counts = memory_allocate((size_t)ranks->size * sizeof *counts);
    int *places = memory_allocate((size_t)ranks->size * sizeof *places);
    struct error *error = ranks_agree(ranks, counts && places ? NULL : out_of_memory());
    if (!error) {
        MPI_Datatype type = items_of(bytes);
        const struct gathering gathering = {to, type, bytes, counts, places};
        error = gather(ranks, gathering, own, count, all, total);
        MPI_Type_free(&type);
    }
    free(counts);
    free(places);
    return error;
}

void ranks_swap_counts(const struct ranks *ranks, const int32_t *to, int32_t *from)
{
    if (ranks->joined)
        MPI_Alltoall(to, 1, MPI_INT32_T, from, 1, MPI_INT32_T, MPI_COMM_WORLD);
    else
        from[0] = to[0];
}

size_t ranks_request_size(void) { return sizeof(MPI_Request); }

void ranks_start(const struct message *messages, int count, size_t bytes, void *requests)
{
    MPI_Request *request = requests;
    if (count == 0)
        return;
    MPI_Datatype type = items_of(bytes);
    for (int i = 0; i < count; i++) {
        const struct message *m = &messages[i];
        if (m->comes)
            MPI_Irecv(m->data, (int)m->items, type, m->rank, 0, MPI_COMM_WORLD, &request[i]);
        else
            MPI_Isend(m->data, (int)m->items, type, m->rank, 0, MPI_COMM_WORLD, &request[i]);
    }
    MPI_Type_free(&type);
}

void ranks_advance(int count, void *requests)
{
    int done;
    if (count)
        MPI_Testall(count, requests, &done, MPI_STATUSES_IGNORE);
}

void ranks_finish(int count, void *requests)
{
    if (count)
        MPI_Waitall(count, requests, MPI_STATUSES_IGNORE);
}

/* The messages of ERROR as texts that end with a zero each, one behind the other. */
static char *texts_of(const struct error *error, int64_t *bytes)
{
    *bytes = 0;
    for (int i = 0; i < error_count(error); i++)
        *bytes += (int64_t)strlen(error_message(error, i)) + 1;
    char *texts = memory_allocate((size_t)*bytes), *at = texts;
    for (int i = 0; texts && i < error_count(error); i++) {
        strcpy(at, error_message(error, i));
        at += strlen(at) + 1;
    }
    return texts;
}

/* ERROR becomes that of rank FIRST. */
static struct error *share_error(const struct ranks *ranks, int first, struct error *error)
{
    int64_t head[2] = {0, 0};
    char *texts = NULL;
    if (first == ranks->rank) {
        texts = texts_of(error, &head[1]);
        head[0] = error_kind(error);
        head[1] = texts ? head[1] : 0;
    }
    ranks_broadcast(ranks, first, head, sizeof head);
    if (first != ranks->rank)
        texts = memory_allocate((size_t)head[1] + 1);
    /* A rank without memory for the words takes part all the same. */
    if (!texts)
        head[1] = 0;
    int64_t bytes = -head[1];
    MPI_Allreduce(MPI_IN_PLACE, &bytes, 1, MPI_INT64_T, MPI_MAX, MPI_COMM_WORLD);
    if (bytes)
        ranks_broadcast(ranks, first, texts, -bytes);
    if (first != ranks->rank) {
        error_free(error);
        error = bytes ? NULL : error_new((enum error_kind)head[0], "out of memory");
        for (char *at = texts; bytes && at < texts - bytes; at += strlen(at) + 1)
            error = error_join(error, error_new((enum error_kind)head[0], "%s", at));
    }
    free(texts);
    return error_known_to_all(error);
}

/* The largest VALUE, which others may only have once they have written files: after a millisecond,
 * who waits leaves its core to them, which they need where ranks are more than cores. */
static double maximum_in_time(double value)
{
    const double at_once = 1e-3; /* s */
    const struct timespec pause = {.tv_nsec = 200000};
    MPI_Request request;
    int done = 0;
    MPI_Iallreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD, &request);
    for (double began = MPI_Wtime(); MPI_Test(&request, &done, MPI_STATUS_IGNORE), !done;)
        if (MPI_Wtime() - began > at_once)
            nanosleep(&pause, NULL);
    /* MPI_Test has completed the request; the checker only knows MPI_Wait. */
    return value; // NOLINT(clang-analyzer-optin.mpi.MPI-Checker)
}

struct error *ranks_agree_on(const struct ranks *ranks, struct error *error, double *values,
                             int count)
{
    enum { AT_MOST = 8 };
    double numbers[1 + AT_MOST] = {-(double)(error ? ranks->rank : ranks->size)};
    assert(count <= AT_MOST);
    if (!ranks->joined)
        return error;
    if (count) {
        memcpy(numbers + 1, values, (size_t)count * sizeof *values);
        ranks_maximum_of(ranks, numbers, 1 + count);
        memcpy(values, numbers + 1, (size_t)count * sizeof *values);
    } else {
        numbers[0] = maximum_in_time(numbers[0]);
    }
    int first = -(int)numbers[0];
    return first == ranks->size ? NULL : share_error(ranks, first, error);
}
