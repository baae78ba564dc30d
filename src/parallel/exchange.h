/* An exchange between ranks that is made again and again: which of this rank's items go to which
 * ranks, and how many come from whom. Items that come stand in the order of their ranks, each
 * rank's in the order in which it sends them. */
#ifndef BOLIDE_EXCHANGE_H
#define BOLIDE_EXCHANGE_H

#include "parallel/ranks.h"

/* ITEM goes to RANK. */
struct send_item {
    int32_t rank, item;
};

struct exchange {
    int32_t goes, comes; /* items in all */
    int messages;
    struct message *message; /* data: not yet */
    struct send_item *send;  /* by rank */
    void *buffer, *requests;
    int64_t buffer_bytes;
};

/* Collective: plans COUNT items to send, in any order of ranks; items of one rank keep their order.
 * Replaces an earlier plan. */
struct error *exchange_plan(struct exchange *exchange, const struct ranks *ranks,
                            const struct send_item *sends, int32_t count);

/* Room for items of BYTES each. */
struct error *exchange_reserve(struct exchange *exchange, size_t bytes);

/* Sends the planned ones of ITEMS, BYTES each, for which there must be room (NULL: the caller has
 * put them into the buffer, in the order of the items to send), and takes what comes to RECEIVED,
 * which holds it once exchange_finish returns. ITEMS may change before. Who computes meanwhile
 * calls exchange_advance from time to time, see ranks_advance. */
void exchange_start(struct exchange *exchange, const void *items, size_t bytes, void *received);
void exchange_advance(struct exchange *exchange);
void exchange_finish(struct exchange *exchange);

void exchange_free(struct exchange *exchange);

/* Collective, for what is sent once: the planned ones of ITEMS, BYTES each, go to their ranks;
 * *came come, in fresh memory at *received (free it). A rank alone gets what it sends. */
struct error *exchange_once(const struct ranks *ranks, const struct send_item *sends, int32_t count,
                            const void *items, size_t bytes, void **received, int32_t *came);

#endif
