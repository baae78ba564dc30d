/* Blocks of other ranks: each rank finds the sums at all nodes that its particles reach, from its
 * own patches and from those of other ranks that cover the same nodes. These come as they are, and
 * are added in the order of block keys with the others, so that all ranks find the same bits. */
#include <omp.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "mpm/mpm_internal.h"

/* A bin as the other ranks hear of it. */
struct far_bin {
    uint64_t key;
    int32_t layer, rank;
};

/* Calls ACT with the key of each block about KEY, itself included, RANGE blocks away at most, until
 * it returns false. */
static bool for_blocks_about(uint64_t key, int dimension, int64_t range,
                             bool (*act)(void *context, uint64_t key), void *context)
{
    const int64_t ry = dimension > 1 ? range : 0, rz = dimension > 2 ? range : 0;
    int64_t own[3];
    bool goes_on = true;
    block_coordinates(key, own);
    for (int64_t x = -range; x <= range; x++)
        for (int64_t y = -ry; y <= ry; y++)
            for (int64_t z = -rz; z <= rz && goes_on; z++) {
                const int64_t at[3] = {own[0] + x, own[1] + y, own[2] + z};
                goes_on = act(context, block_key(at));
            }
    return goes_on;
}

/* Own bins that other ranks are to hear of. */
struct telling {
    const struct partition *partition;
    int32_t bin, first; /* the bin, and its first item */
    struct send_item *send;
    int64_t capacity;
    int32_t count;
};

/* The rank that owns the block of KEY hears of the bin, once. */
static bool tell(void *context, uint64_t key)
{
    struct telling *t = context;
    const int owner = partition_owner(t->partition, key);
    bool told = owner == t->partition->ranks->rank;
    for (int32_t k = t->first; k < t->count && !told; k++)
        told = t->send[k].rank == owner;
    if (told)
        return true;
    if (!memory_reserve((void **)&t->send, &t->capacity, t->count + 1, t->count, sizeof *t->send))
        return false;
    t->send[t->count++] = (struct send_item){owner, t->bin};
    return true;
}

/* Collective: the bins of other ranks that may lie RANGE blocks from own ones at most, by rank,
 * layer and key: each rank tells of its bins to those that own the blocks about them. */
static struct error *hear_of_bins(const struct mpm *mpm, const struct simulation *simulation,
                                  int64_t range, struct far_bin **heard, int32_t *count)
{
    const struct bins *bins = &mpm->bins;
    struct telling telling = {.partition = &simulation->partition};
    struct far_bin *own = memory_allocate(((size_t)bins->count + 1) * sizeof *own);
    bool room = own != NULL;
    for (int g = 0; g < mpm->layers && room; g++)
        for (int32_t b = bins->begin[g]; b < bins->begin[g + 1] && room; b++) {
            own[b] = (struct far_bin){bins->bin[b].key, g, simulation->ranks->rank};
            telling.bin = b;
            telling.first = telling.count;
            room = for_blocks_about(bins->bin[b].key, mpm->layer[0].grid.dimension, range, tell,
                                    &telling);
        }
    struct error *error =
        ranks_agree(simulation->ranks, room ? NULL : out_of_memory_for("blocks of other ranks"));
    if (!error)
        error = exchange_once(simulation->ranks, telling.send, telling.count, own, sizeof *own,
                              (void **)heard, count);
    free(telling.send);
    free(own);
    return error;
}

/* What one walk over the bins that were heard of finds. */
struct meeting {
    struct block_table table; /* of the keys of own bins */
    int32_t *first;           /* of each key, the first own bin of it; -1 ends a list */
    int32_t *next;            /* of each own bin, the next one of its key */
    int32_t *told;            /* of each own bin, the last rank that needs it */
    struct send_item *send;
    int64_t send_capacity, far_capacity;
    int32_t sends, fars;
    struct far_bin *far;
};

static bool index_own(const struct mpm *mpm, struct meeting *m)
{
    const int32_t count = mpm->bins.count;
    m->first = memory_allocate((size_t)count * sizeof *m->first);
    m->next = memory_allocate((size_t)count * sizeof *m->next);
    m->told = memory_allocate((size_t)count * sizeof *m->told);
    if (!m->first || !m->next || !m->told || !block_table_clear(&m->table, count))
        return false;
    for (int32_t b = 0; b < count; b++) {
        const int32_t before = m->table.count,
                      key = block_table_add(&m->table, mpm->bins.bin[b].key);
        m->next[b] = m->table.count > before ? -1 : m->first[key];
        m->first[key] = b;
        m->told[b] = -1;
    }
    return true;
}

/* Rank RANK needs the own bins at a block beside one of its own. */
struct meeting_bin {
    struct meeting *meeting;
    int32_t rank;
    bool met;
};

static bool meet_at(void *context, uint64_t key)
{
    struct meeting_bin *of = context;
    struct meeting *m = of->meeting;
    const int32_t at = block_table_find(&m->table, key);
    for (int32_t b = at < 0 ? -1 : m->first[at]; b >= 0; b = m->next[b]) {
        of->met = true;
        if (m->told[b] == of->rank)
            continue;
        m->told[b] = of->rank;
        if (!memory_reserve((void **)&m->send, &m->send_capacity, m->sends + 1, m->sends,
                            sizeof *m->send))
            return false;
        m->send[m->sends++] = (struct send_item){of->rank, b};
    }
    return true;
}

/* Takes down that a bin of another rank and the own ones about it need each other; RANGE is how far
 * apart in blocks. */
static bool meet_bin(const struct mpm *mpm, struct meeting *m, const struct far_bin *far,
                     int64_t range)
{
    struct meeting_bin of = {.meeting = m, .rank = far->rank};
    if (!for_blocks_about(far->key, mpm->layer[0].grid.dimension, range, meet_at, &of))
        return false;
    if (!of.met)
        return true;
    if (!memory_reserve((void **)&m->far, &m->far_capacity, m->fars + 1, m->fars, sizeof *m->far))
        return false;
    m->far[m->fars++] = *far;
    return true;
}

static int compare_sends(const void *a, const void *b)
{
    const struct send_item *x = a, *y = b;
    if (x->rank != y->rank)
        return x->rank < y->rank ? -1 : 1;
    return x->item < y->item ? -1 : x->item > y->item;
}

static int compare_bins(const void *a, const void *b)
{
    const struct far_bin *x = a, *y = b;
    if (x->layer != y->layer)
        return x->layer < y->layer ? -1 : 1;
    return x->key < y->key ? -1 : x->key > y->key;
}

/* Puts own bins and those of other ranks in the order of layers and keys. */
static bool merge(struct mpm *mpm, const struct meeting *m)
{
    struct halo *halo = &mpm->halo;
    const struct bins *own = &mpm->bins;
    const int64_t count = (int64_t)own->count + m->fars;
    struct far_bin *far = memory_allocate((size_t)m->fars * sizeof *far);
    int32_t *place = memory_allocate((size_t)own->count * sizeof *place);
    if (far && m->fars)
        memcpy(far, m->far, (size_t)m->fars * sizeof *far);
    if (far && m->fars > 1)
        qsort(far, (size_t)m->fars, sizeof *far, compare_bins);
    bool done =
        far && place &&
        memory_reserve((void **)&halo->bin, &halo->bin_capacity, count + 1, 0, sizeof *halo->bin) &&
        memory_reserve((void **)&halo->far, &halo->far_capacity, count + 1, 0, sizeof *halo->far) &&
        memory_reserve((void **)&halo->near, &halo->near_capacity, count + 1, 0,
                       sizeof *halo->near) &&
        memory_reserve((void **)&halo->goes, &halo->goes_capacity, m->sends, 0,
                       sizeof *halo->goes) &&
        memory_reserve((void **)&halo->comes, &halo->comes_capacity, m->fars, 0,
                       sizeof *halo->comes);
    int32_t b = 0, f = 0, to = 0;
    for (int g = 0; g < mpm->layers && done; g++) {
        halo->begin[g] = to;
        while (b < own->begin[g + 1] || (f < m->fars && far[f].layer == g)) {
            const bool is_far = f < m->fars && far[f].layer == g &&
                                (b == own->begin[g + 1] || far[f].key < own->bin[b].key);
            halo->far[to] = is_far;
            halo->near[to] = false;
            if (is_far) {
                halo->bin[to] = (struct bin){.key = far[f++].key};
            } else {
                place[b] = to;
                halo->bin[to] = own->bin[b++];
            }
            to++;
        }
        halo->begin[g + 1] = to;
    }
    for (int32_t k = 0; k < m->sends && done; k++) {
        halo->goes[k] = place[m->send[k].item];
        halo->near[halo->goes[k]] = true;
    }
    for (int32_t k = 0; k < m->fars && done; k++) {
        int32_t at = halo->begin[m->far[k].layer];
        while (!halo->far[at] || halo->bin[at].key != m->far[k].key)
            at++;
        halo->comes[k] = at;
    }
    free(far);
    free(place);
    return done;
}

static void meeting_free(struct meeting *m)
{
    free(m->first);
    free(m->next);
    free(m->told);
    free(m->send);
    free(m->far);
    block_table_free(&m->table);
}

/* Plans anew whose patches come and go. */
static struct error *plan_halo(struct mpm *mpm, const struct simulation *simulation)
{
    struct meeting m = {0};
    struct far_bin *heard = NULL;
    int32_t count = 0;
    const int64_t range = mpm->layer[0].grid.reach > 0 ? 2 : 1;
    TRY(hear_of_bins(mpm, simulation, range, &heard, &count));
    bool done = index_own(mpm, &m);
    for (int32_t k = 0; k < count && done; k++)
        done = meet_bin(mpm, &m, &heard[k], range);
    free(heard);
    if (done && m.sends > 1)
        qsort(m.send, (size_t)m.sends, sizeof *m.send, compare_sends);
    done = done && merge(mpm, &m);
    struct error *error =
        ranks_agree(simulation->ranks, done ? NULL : out_of_memory_for("blocks of other ranks"));
    if (!error)
        error = exchange_plan(&mpm->halo.exchange, simulation->ranks, m.send, m.sends);
    assert(error || mpm->halo.exchange.comes == m.fars);
    meeting_free(&m);
    return error;
}

/* Takes the own bins of this step into the halo as planned; false when they are not those that it
 * was planned for. */
static bool renew_own(struct mpm *mpm)
{
    struct halo *halo = &mpm->halo;
    int32_t b = 0;
    for (int g = 0; g < mpm->layers; g++) {
        for (int32_t to = halo->begin[g]; to < halo->begin[g + 1]; to++) {
            if (halo->far[to])
                continue;
            if (b == mpm->bins.begin[g + 1] || mpm->bins.bin[b].key != halo->bin[to].key)
                return false;
            halo->bin[to] = mpm->bins.bin[b++];
        }
        if (b != mpm->bins.begin[g + 1])
            return false;
    }
    return true;
}

struct error *mpm_find_halo(struct mpm *mpm, const struct simulation *simulation,
                            struct error *error)
{
    double changed = error || !mpm->halo.far || !renew_own(mpm);
    TRY(ranks_agree_on(simulation->ranks, error, &changed, 1));
    if (changed > 0.0)
        TRY(plan_halo(mpm, simulation));
    for (int g = 0; g < mpm->layers; g++)
        mpm->layer[g].bins = (struct bins){.count = mpm->halo.begin[g + 1] - mpm->halo.begin[g],
                                           .list = mpm->bins.list,
                                           .bin = mpm->halo.bin + mpm->halo.begin[g]};
    return NULL;
}

struct error *mpm_reserve_halo(struct mpm *mpm)
{
    struct halo *halo = &mpm->halo;
    const size_t bytes = (size_t)(mpm->layer[0].grid.patch * NODE_STRIDE) * sizeof(double);
    TRY(exchange_reserve(&halo->exchange, bytes));
    return memory_reserve((void **)&halo->received, &halo->received_capacity, halo->exchange.comes,
                          0, bytes)
               ? NULL
               : out_of_memory_for("blocks of other ranks");
}

/* The patch of bin BIN of the halo, in the field at byte FIELD of its layer. */
static double *patch_of(struct mpm *mpm, int32_t bin, size_t field)
{
    int g = 0;
    while (bin >= mpm->halo.begin[g + 1])
        g++;
    struct layer *layer = &mpm->layer[g];
    return grid_patch(&layer->grid, (struct grid_field *)((char *)layer + field),
                      bin - mpm->halo.begin[g]);
}

static size_t patch_bytes(const struct mpm *mpm, size_t field)
{
    const struct grid_field *first =
        (const struct grid_field *)((const char *)&mpm->layer[0] + field);
    return (size_t)(mpm->layer[0].grid.patch * first->stride) * sizeof(double);
}

void mpm_exchange_start(struct mpm *mpm, struct simulation *simulation, size_t field)
{
    struct halo *halo = &mpm->halo;
    if (simulation->ranks->size < 2)
        return;
    const size_t bytes = patch_bytes(mpm, field);
    for (int32_t k = 0; k < halo->exchange.goes; k++)
        memcpy((char *)halo->exchange.buffer + (size_t)k * bytes,
               patch_of(mpm, halo->goes[k], field), bytes);
    exchange_start(&halo->exchange, NULL, bytes, halo->received);
    halo->under_way = true;
}

void mpm_exchange_advance(struct mpm *mpm)
{
    if (mpm->halo.under_way && omp_get_thread_num() == 0)
        exchange_advance(&mpm->halo.exchange);
}

void mpm_exchange_finish(struct mpm *mpm, struct simulation *simulation, size_t field)
{
    struct halo *halo = &mpm->halo;
    if (simulation->ranks->size < 2)
        return;
    const size_t bytes = patch_bytes(mpm, field);
    exchange_finish(&halo->exchange);
    halo->under_way = false;
    simulation_end_waiting(simulation);
    for (int32_t k = 0; k < halo->exchange.comes; k++)
        memcpy(patch_of(mpm, halo->comes[k], field), (char *)halo->received + (size_t)k * bytes,
               bytes);
}

void mpm_exchange(struct mpm *mpm, struct simulation *simulation, size_t field)
{
    mpm_exchange_start(mpm, simulation, field);
    if (simulation->ranks->size > 1)
        simulation_end_phase(simulation, PHASE_BLOCKS, "grid update");
    mpm_exchange_finish(mpm, simulation, field);
}

void mpm_free_halo(struct mpm *mpm)
{
    struct halo *halo = &mpm->halo;
    free(halo->bin);
    free(halo->far);
    free(halo->near);
    free(halo->goes);
    free(halo->comes);
    free(halo->received);
    exchange_free(&halo->exchange);
}
