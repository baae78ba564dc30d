/* Rows from all ranks to one; see rows.h. */
#include "output/rows.h"

#include <stdlib.h>

#include "base/memory.h"

enum { ROWS_AT_ONCE = 1 << 18 };

static int64_t piece_from(int64_t begin, int64_t count)
{
    return count - begin < ROWS_AT_ONCE ? count - begin : ROWS_AT_ONCE;
}

static void send(int to, const struct rows *rows, void *piece, void *request)
{
    for (int64_t begin = 0; begin < rows->count; begin += ROWS_AT_ONCE) {
        int64_t some = piece_from(begin, rows->count);
        rows->fill(rows->context, begin, begin + some, piece);
        const struct message message = {to, false, piece, some};
        ranks_start(&message, 1, rows->bytes, request);
        ranks_finish(1, request);
    }
}

/* What rank 0 takes rows with. */
struct taking {
    const struct rows *own;
    void *piece, *request; /* room for some rows, and for a message */
    int64_t at;            /* the next row of all */
    rows_put *put;
    void *sink;
    struct error *error; /* the first: it ends the calls of put */
};

/* The COUNT rows of rank FROM. */
static void receive(struct taking *taking, int from, int64_t count)
{
    const struct rows *rows = taking->own;
    for (int64_t begin = 0; begin < count; begin += ROWS_AT_ONCE) {
        int64_t some = piece_from(begin, count);
        if (from == 0) {
            rows->fill(rows->context, begin, begin + some, taking->piece);
        } else {
            const struct message message = {from, true, taking->piece, some};
            ranks_start(&message, 1, rows->bytes, taking->request);
            ranks_finish(1, taking->request);
        }
        if (!taking->error)
            taking->error = taking->put(taking->sink, taking->at + begin, some, taking->piece);
    }
    taking->at += count;
}

struct error *rows_pass(const struct ranks *ranks, const struct rows *rows, rows_put *put,
                        void *sink, struct error *error)
{
    void *counts = NULL;
    int64_t number = 0, most = (int64_t)ranks_maximum(ranks, (double)rows->count);
    void *request = memory_allocate(ranks_request_size() + 1);
    void *piece = memory_allocate((size_t)piece_from(0, most) * rows->space);
    struct error *failure =
        ranks_agree(ranks, request && piece ? NULL : out_of_memory_for("an output"));
    if (!failure)
        failure = ranks_gather(ranks, 0, &rows->count, 1, sizeof rows->count, &counts, &number);
    if (!failure && ranks->rank != 0)
        send(0, rows, piece, request);
    struct taking taking = {rows, piece, request, 0, put, sink, error};
    for (int r = 0; r < (int)number && piece; r++)
        receive(&taking, r, ((int64_t *)counts)[r]);
    free(counts);
    free(request);
    free(piece);
    return error_join(taking.error, failure);
}
