/* Which rank owns which blocks, and how particles get there: the curve that runs through all blocks in the order of
 * their keys is cut into as many parts as there are ranks. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "parallel/exchange.h"
#include "particle/particles.h"

/* Blocks are divided anew when a rank has worked this much longer than the mean of all. */
static const double imbalance_limit = 1.1;

struct weight {
    uint64_t key;
    double work;
};

static struct error *out_of_memory(void)
{
    return error_new(ERROR_SYSTEM, "out of memory while particles go to other ranks");
}

static int compare_weights(const void *a, const void *b)
{
    uint64_t x = ((const struct weight *)a)->key, y = ((const struct weight *)b)->key;
    return x < y ? -1 : x > y;
}

/* A block goes to the part that its middle falls into. The blocks at one place of the curve may still belong to several
 * ranks. */
static void cut_curve(uint64_t *cut, int parts, struct weight *weight, int64_t count)
{
    double total = 0.0, before = 0.0;
    qsort(weight, (size_t)count, sizeof *weight, compare_weights);
    for (int64_t k = 0; k < count; k++)
        total += weight[k].work;
    int part = 0;
    cut[0] = 0;
    for (int64_t k = 0, next; k < count; k = next) {
        double work = 0.0;
        for (next = k; next < count && weight[next].key == weight[k].key; next++)
            work += weight[next].work;
        while (part + 1 < parts && (before + 0.5 * work) * parts >= total * (part + 1))
            cut[++part] = weight[k].key;
        before += work;
    }
    while (part < parts)
        cut[++part] = UINT64_MAX;
}

/* The work of the blocks as the particles lie now, from what the rank has spent on each of its own. */
static struct error *divide(struct particles *p)
{
    const struct ranks *ranks = p->ranks;
    double each = p->work > 0.0 && p->count ? p->work / p->count : 0.0;
    bool measured = ranks_minimum(ranks, p->count && each <= 0.0 ? 0.0 : 1.0) > 0.0;
    struct weight *own = memory_allocate((size_t)p->blocks * sizeof *own), *all = NULL;
    int64_t count = 0;
    if (!p->cut)
        p->cut = memory_allocate(((size_t)ranks->size + 1) * sizeof *p->cut);
    struct error *error = ranks_agree(ranks, own && p->cut ? NULL : out_of_memory());
    for (int32_t b = 0; b < p->blocks && !error; b++)
        own[b] = (struct weight){p->block[b].key, p->block[b].count * (measured ? each : 1.0)};
    if (!error)
        error = ranks_gather(ranks, -1, own, p->blocks, sizeof *own, (void **)&all, &count);
    if (!error)
        cut_curve(p->cut, ranks->size, all, count);
    free(own);
    free(all);
    p->work = 0.0;
    return error;
}

int particles_owner(const struct particles *p, uint64_t key)
{
    if (!p->cut)
        return p->ranks->rank;
    int low = 0, high = p->ranks->size; /* cut[low] <= key < cut[high] */
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (p->cut[middle] <= key)
            low = middle;
        else
            high = middle;
    }
    return low;
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

/* The particles that leave, and where they go. `sent` are gone, and what comes has taken the places of `filled` of
 * them. */
struct leaving {
    int64_t capacity;
    int32_t count, sent, filled;
    struct send_item *send;
};

static struct error *find_leaving(struct particles *p, struct leaving *leaving)
{
    for (int32_t i = 0; i < p->count; i++) {
        int32_t owner = particles_owner(p, particles_block_key(p, p->position[i]));
        if (owner == p->ranks->rank)
            continue;
        if (!memory_reserve((void **)&leaving->send, &leaving->capacity, leaving->count + 1,
                            leaving->count, sizeof *leaving->send))
            return out_of_memory();
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
        ranks_agree(p->ranks, coming ? exchange_reserve(exchange, bytes) : out_of_memory());
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

static struct error *migrate(struct particles *p)
{
    struct leaving leaving = {0};
    struct exchange exchange = {0};
    struct error *error = ranks_agree(p->ranks, find_leaving(p, &leaving));
    while (!error && ranks_maximum(p->ranks, leaving.count - leaving.sent) > 0.0)
        error = send_some(p, &exchange, &leaving);
    for (int32_t k = leaving.filled; k < leaving.sent; k++)
        particles_delete(p, leaving.send[k].item);
    exchange_free(&exchange);
    free(leaving.send);
    return error ? error : ranks_agree(p->ranks, particles_commit(p));
}

/* The ranks' work since the cut differs by too much. */
static bool unbalanced(const struct particles *p)
{
    double most = ranks_maximum(p->ranks, p->work), mean = 0.0;
    struct exact_sum sum = {0};
    exact_sum_add(&sum, p->work);
    ranks_sum_exact(p->ranks, &sum, 1);
    mean = exact_sum_value(&sum) / p->ranks->size;
    return mean > 0.01 && most > imbalance_limit * mean;
}

struct error *particles_distribute(struct particles *particles, double seconds, bool recut)
{
    if (!particles->ranks->joined)
        return particles_sort(particles);
    particles->work += seconds;
    if (!particles->cut || recut || unbalanced(particles)) {
        TRY(ranks_agree(particles->ranks, particles_sort(particles)));
        TRY(divide(particles));
    }
    return migrate(particles);
}
