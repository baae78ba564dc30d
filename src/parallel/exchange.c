/* Exchanges between ranks; see exchange.h. */
#include "parallel/exchange.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* Sorts ERRANDS by rank; TO counts those of each. */
static void sort_items(struct exchange *x, int ranks, const struct send_item *sends, int32_t count,
                       const int32_t *to, int32_t *next)
{
    int32_t first = 0;
    for (int r = 0; r < ranks; r++) {
        next[r] = first;
        first += to[r];
    }
    for (int32_t k = 0; k < count; k++)
        x->send[next[sends[k].rank]++] = sends[k];
}

static void add_messages(struct exchange *x, int ranks, const int32_t *counts, bool comes)
{
    for (int r = 0; r < ranks; r++)
        if (counts[r])
            x->message[x->messages++] = (struct message){r, comes, NULL, counts[r]};
}

static int partners_of(int ranks, const int32_t *counts, int32_t *items)
{
    int partners = 0;
    *items = 0;
    for (int r = 0; r < ranks; r++) {
        partners += counts[r] != 0;
        *items += counts[r];
    }
    return partners;
}

/* COUNTS is room for three numbers a rank. */
static struct error *plan(struct exchange *x, const struct ranks *ranks,
                          const struct send_item *sends, int32_t count, int32_t *counts)
{
    int32_t *to = counts, *from = counts + ranks->size, *next = from + ranks->size;
    for (int32_t k = 0; k < count; k++)
        to[sends[k].rank]++;
    ranks_swap_counts(ranks, to, from);
    int partners =
        partners_of(ranks->size, to, &x->goes) + partners_of(ranks->size, from, &x->comes);
    x->send = memory_allocate((size_t)count * sizeof *x->send);
    x->message = memory_allocate((size_t)partners * sizeof *x->message);
    x->requests = memory_allocate((size_t)partners * ranks_request_size());
    if (!x->send || !x->message || !x->requests)
        return out_of_memory_for("an exchange between ranks");
    sort_items(x, ranks->size, sends, count, to, next);
    add_messages(x, ranks->size, from, true);
    add_messages(x, ranks->size, to, false);
    return NULL;
}

struct error *exchange_plan(struct exchange *exchange, const struct ranks *ranks,
                            const struct send_item *sends, int32_t count)
{
    exchange_free(exchange);
    int32_t *counts = memory_allocate(3 * (size_t)ranks->size * sizeof *counts);
    TRY(ranks_agree(ranks, counts ? NULL : out_of_memory_for("an exchange between ranks")));
    struct error *error = plan(exchange, ranks, sends, count, counts);
    free(counts);
    return ranks_agree(ranks, error);
}

struct error *exchange_reserve(struct exchange *exchange, size_t bytes)
{
    int64_t needed = (int64_t)exchange->goes * (int64_t)bytes;
    return memory_reserve(&exchange->buffer, &exchange->buffer_bytes, needed, 0, 1)
               ? NULL
               : out_of_memory_for("an exchange between ranks");
}

void exchange_start(struct exchange *exchange, const void *items, size_t bytes, void *received)
{
    char *out = exchange->buffer, *in = received;
    assert((int64_t)exchange->goes * (int64_t)bytes <= exchange->buffer_bytes);
    for (int32_t k = 0; k < exchange->goes && items; k++)
        memcpy(out + (size_t)k * bytes,
               (const char *)items + (size_t)exchange->send[k].item * bytes, bytes);
    for (int i = 0; i < exchange->messages; i++) {
        struct message *m = &exchange->message[i];
        char **at = m->comes ? &in : &out;
        m->data = *at;
        *at += (size_t)m->items * bytes;
    }
    ranks_start(exchange->message, exchange->messages, bytes, exchange->requests);
}

void exchange_advance(struct exchange *exchange)
{
    ranks_advance(exchange->messages, exchange->requests);
}

void exchange_finish(struct exchange *exchange)
{
    ranks_finish(exchange->messages, exchange->requests);
}

/* EXCHANGE is planned. */
static struct error *pass(struct exchange *exchange, const struct ranks *ranks, const void *items,
                          size_t bytes, void **received)
{
    *received = memory_allocate((size_t)exchange->comes * bytes);
    TRY(ranks_agree(ranks, *received ? exchange_reserve(exchange, bytes)
                                     : out_of_memory_for("an exchange between ranks")));
    exchange_start(exchange, items, bytes, *received);
    exchange_finish(exchange);
    return NULL;
}

struct error *exchange_once(const struct ranks *ranks, const struct send_item *sends, int32_t count,
                            const void *items, size_t bytes, void **received, int32_t *came)
{
    *received = NULL;
    *came = count;
    if (!ranks->joined) {
        char *copy = *received = memory_allocate((size_t)count * bytes);
        for (int32_t k = 0; k < count && copy; k++)
            memcpy(copy + (size_t)k * bytes, (const char *)items + (size_t)sends[k].item * bytes,
                   bytes);
        return copy ? NULL : out_of_memory_for("an exchange between ranks");
    }
    struct exchange exchange = {0};
    struct error *error = exchange_plan(&exchange, ranks, sends, count);
    if (!error)
        error = pass(&exchange, ranks, items, bytes, received);
    *came = error ? 0 : exchange.comes;
    exchange_free(&exchange);
    return error;
}

void exchange_free(struct exchange *exchange)
{
    free(exchange->message);
    free(exchange->send);
    free(exchange->requests);
    free(exchange->buffer);
    *exchange = (struct exchange){0};
}
