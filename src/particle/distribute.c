/* How particles get to the rank that owns their block. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "parallel/exchange.h"
#include "particle/particles.h"

/* Divides the blocks as the particles lie now. */
static struct error *divide(struct particles *p, bool anyway)
{
    struct block_weight *own = memory_allocate((size_t)p->blocks * sizeof *own);
    struct error *error =
        ranks_agree(p->ranks, own ? NULL : out_of_memory_for("particles that go to other ranks"));
    for (int32_t b = 0; b < p->blocks && !error; b++)
        own[b] = (struct block_weight){p->block[b].key, p->block[b].count};
    bool anew;
    if (!error)
        error = partition_divide(p->partition, own, p->blocks, anyway, &anew);
    free(own);
    return error;
}

/* Nothing of what does not move. */
static size_t bytes_of(const struct field *field)
{
    if (field->declaration.kind & FIELD_PASSING)
        return 0;
    return number_size(field->declaration.number) * (size_t)field->declaration.components;
}

/* Of the fields that go with a particle. */
static size_t bytes_that_go(const struct particles *p)
{
    size_t bytes = 0;
    for (int k = 0; k < p->fields; k++)
        bytes += bytes_of(&p->field[k]);
    return bytes;
}

static void pack(const struct particles *p, int32_t i, char *out)
{
    for (int k = 0; k < p->fields; k++) {
        size_t bytes = bytes_of(&p->field[k]);
        memcpy(out, (const char *)p->field[k].data + (size_t)i * bytes, bytes);
        out += bytes;
    }
}

static void unpack(struct particles *p, int32_t i, const char *in)
{
    for (int k = 0; k < p->fields; k++) {
        size_t bytes = bytes_of(&p->field[k]);
        memcpy((char *)p->field[k].data + (size_t)i * bytes, in, bytes);
        in += bytes;
    }
}

/* The particles that leave, and where they go. `sent` are gone, and what comes has taken the places
 * of `filled` of them. */
struct leaving {
    int64_t capacity;
    int32_t count, sent, filled;
    struct send_item *send;
};

static struct error *find_leaving(struct particles *p, struct leaving *leaving)
{
    for (int32_t i = 0; i < p->count; i++) {
        int32_t owner = partition_owner(p->partition, particles_block_key(p, p->position[i]));
        if (owner == p->ranks->rank)
            continue;
        if (!memory_reserve((void **)&leaving->send, &leaving->capacity, leaving->count + 1,
                            leaving->count, sizeof *leaving->send))
            return out_of_memory_for("particles that go to other ranks");
        leaving->send[leaving->count++] = (struct send_item){owner, i};
    }
    return NULL;
}

/* Takes in the COUNT particles that came. */
static struct error *take_in(struct particles *p, struct leaving *leaving, const char *came,
                             int32_t count)
{
    const size_t bytes = bytes_that_go(p);
    int32_t k = 0, first;
    for (; k < count && leaving->filled < leaving->sent; k++)
        unpack(p, leaving->send[leaving->filled++].item, came + (size_t)k * bytes);
    TRY(particles_append(p, count - k, &first));
    for (; k < count; k++)
        unpack(p, first++, came + (size_t)k * bytes);
    return NULL;
}

/* Sends some of those that are left, so that memory stays small however many move. */
static struct error *send_some(struct particles *p, struct exchange *exchange,
                               struct leaving *leaving)
{
    enum { AT_ONCE = 1 << 15 };
    const size_t bytes = bytes_that_go(p);
    int32_t some = leaving->count - leaving->sent;
    some = some < AT_ONCE ? some : AT_ONCE;
    TRY(exchange_plan(exchange, p->ranks, leaving->send + leaving->sent, some));
    char *coming = memory_allocate((size_t)exchange->comes * bytes);
    struct error *error =
        ranks_agree(p->ranks, coming ? exchange_reserve(exchange, bytes)
                                     : out_of_memory_for("particles that go to other ranks"));
    if (!error) {
        for (int32_t k = 0; k < exchange->goes; k++)
            pack(p, exchange->send[k].item, (char *)exchange->buffer + (size_t)k * bytes);
        exchange_start(exchange, NULL, bytes, coming);
        exchange_finish(exchange);
        leaving->sent += some;
        error = ranks_agree(p->ranks, take_in(p, leaving, coming, exchange->comes));
    }
    free(coming);
    return error;
}

/* Collective: those that leave go; those that come are in their places, and behind all others. */
static struct error *send_all(struct particles *p, struct leaving *leaving)
{
    struct exchange exchange = {0};
    struct error *error = NULL;
    while (!error && ranks_maximum(p->ranks, leaving->count - leaving->sent) > 0.0)
        error = send_some(p, &exchange, leaving);
    exchange_free(&exchange);
    return error;
}

static struct error *migrate(struct particles *p)
{
    struct leaving leaving = {0};
    struct error *error = ranks_agree(p->ranks, find_leaving(p, &leaving));
    if (!error)
        error = send_all(p, &leaving);
    for (int32_t k = leaving.filled; k < leaving.sent; k++)
        particles_delete(p, leaving.send[k].item);
    free(leaving.send);
    return error ? error : ranks_agree(p->ranks, particles_commit(p));
}

static int by_item(const void *a, const void *b)
{
    const struct send_item *x = a, *y = b;
    return (x->item > y->item) - (x->item < y->item);
}

/* The last particles move to the places that are left empty, COUNT of them by index. Storage ends
 * where they end. */
static void close_gaps(struct particles *p, const struct send_item *gap, int32_t count)
{
    int32_t total = p->count + p->pending, last = count - 1;
    for (int32_t k = 0; k <= last; k++) {
        for (; last >= k && gap[last].item == total - 1; last--)
            total--;
        if (last < k)
            break;
        total--;
        for (int f = 0; f < p->fields; f++) {
            const size_t bytes = field_bytes(&p->field[f]);
            char *data = p->field[f].data;
            memcpy(data + (size_t)gap[k].item * bytes, data + (size_t)total * bytes, bytes);
        }
    }
    p->count = total;
    p->pending = 0;
    while (p->blocks > 0 && p->block[p->blocks - 1].first >= total)
        p->blocks--;
    if (p->blocks > 0)
        p->block[p->blocks - 1].count = total - p->block[p->blocks - 1].first;
}

struct error *particles_hand_over(struct particles *particles, struct send_item *leaving,
                                  int32_t count)
{
    struct leaving all = {.count = count, .send = leaving};
    TRY(send_all(particles, &all));
    const int32_t empty = all.sent - all.filled;
    if (empty > 1)
        qsort(leaving + all.filled, (size_t)empty, sizeof *leaving, by_item);
    close_gaps(particles, leaving + all.filled, empty);
    particles->order++;
    return ranks_agree(particles->ranks, particles->blocks == 0 && particles->count > 0
                                             ? particles_sort(particles)
                                             : NULL);
}

struct error *particles_distribute(struct particles *particles, bool recut)
{
    if (!particles->ranks->joined)
        return particles_sort(particles);
    if (recut || partition_is_uneven(particles->partition)) {
        TRY(ranks_agree(particles->ranks, particles_sort(particles)));
        TRY(divide(particles, recut));
    }
    return migrate(particles);
}
