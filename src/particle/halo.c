/* Which particles other ranks must see; see halo.h. */
#include "particle/halo.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "parallel/periodic.h"

/* Rounding must lose no pair at the edge of its range. */
static const double margin = 1.0 + 1e-9;

/* Errands in the making. */
struct list {
    struct send_item *send;
    int64_t capacity;
    int32_t count;
};

static struct region empty_region(void)
{
    return (struct region){.low = {INFINITY, INFINITY, INFINITY},
                           .high = {-INFINITY, -INFINITY, -INFINITY}};
}

static void include(struct region *region, const double low[3], const double high[3], double reach)
{
    for (int axis = 0; axis < 3; axis++) {
        region->low[axis] = minimum(region->low[axis], low[axis]);
        region->high[axis] = maximum(region->high[axis], high[axis]);
    }
    region->reach = maximum(region->reach, reach);
}

/* The gap along AXIS between a region and what lies between LOW and HIGH, at the nearest of the
 * places where it repeats. */
static double gap_along(const struct region *region, const struct mirrors *mirrors, int axis,
                        double low, double high)
{
    double gap = maximum(region->low[axis] - high, low - region->high[axis]);
    if (mirrors && images_repeat(mirrors, axis)) {
        const double period = periodic_period(mirrors, axis);
        gap = minimum(
            gap, maximum(region->low[axis] - high - period, low + period - region->high[axis]));
        gap = minimum(
            gap, maximum(region->low[axis] - high + period, low - period - region->high[axis]));
    }
    return gap;
}

static bool within(const struct region *region, const struct mirrors *mirrors, const double low[3],
                   const double high[3], double reach)
{
    double sum = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        const double gap = gap_along(region, mirrors, axis, low[axis], high[axis]);
        sum += gap > 0.0 ? square(gap) : 0.0;
    }
    return sum <= square(margin * (region->reach + reach));
}

/* The regions of this rank's blocks, and in WHOLE what they fill together. */
static struct region *own_regions(const struct particles *p, struct reach reach, double skin,
                                  struct region *whole)
{
    struct region *region = memory_allocate((size_t)p->blocks * sizeof *region);
    *whole = empty_region();
    if (!region)
        return NULL;
#pragma omp parallel for schedule(dynamic) num_threads(*p->threads)
    for (int32_t b = 0; b < p->blocks; b++) {
        region[b] = empty_region();
        region[b].key = p->block[b].key;
        region[b].rank = p->ranks->rank;
        for (int32_t i = p->block[b].first; i < p->block[b].first + p->block[b].count; i++)
            include(&region[b], p->position[i], p->position[i],
                    (1.0 + skin) * reach.smoothing * reach.diameter[i]);
    }
    for (int32_t b = 0; b < p->blocks; b++)
        include(whole, region[b].low, region[b].high, region[b].reach);
    return region;
}

static bool add_send(struct list *list, int32_t rank, int32_t item)
{
    if (!memory_reserve((void **)&list->send, &list->capacity, list->count + 1, list->count,
                        sizeof *list->send))
        return false;
    list->send[list->count++] = (struct send_item){rank, item};
    return true;
}

/* How far particles reach, in supports of SKIN more than that, and where they repeat. */
struct seen {
    const struct mirrors *mirrors;
    struct reach reach;
    double skin;
};

/* The particles of block B that the NEAR regions, in the order of their ranks, must see. */
static bool add_block(const struct particles *p, const struct block *block, struct seen seen,
                      const struct region *const *near, int64_t count, struct list *list)
{
    for (int32_t i = block->first; i < block->first + block->count; i++) {
        double own = (1.0 + seen.skin) * seen.reach.smoothing * seen.reach.diameter[i];
        int32_t last = -1;
        for (int64_t k = 0; k < count; k++) {
            if (near[k]->rank == last ||
                !within(near[k], seen.mirrors, p->position[i], p->position[i], own))
                continue;
            last = near[k]->rank;
            if (!add_send(list, last, i))
                return false;
        }
    }
    return true;
}

static struct error *find_send_items(const struct particles *p, struct seen seen,
                                     const struct halo *halo, const struct region *own,
                                     const struct region *whole, struct list *list)
{
    const struct region **near = memory_allocate(2 * (size_t)halo->regions * sizeof *near);
    if (!near)
        return out_of_memory_for("the particles of other ranks");
    int64_t candidates = 0;
    for (int64_t k = 0; k < halo->regions && p->count; k++)
        if (halo->region[k].rank != p->ranks->rank &&
            within(&halo->region[k], seen.mirrors, whole->low, whole->high, whole->reach))
            near[candidates++] = &halo->region[k];
    bool done = true;
    for (int32_t b = 0; b < p->blocks && done && candidates; b++) {
        const struct region **of_block = near + candidates;
        int64_t count = 0;
        for (int64_t k = 0; k < candidates; k++)
            if (within(near[k], seen.mirrors, own[b].low, own[b].high, own[b].reach))
                of_block[count++] = near[k];
        done = add_block(p, &p->block[b], seen, of_block, count, list);
    }
    free(near);
    return done ? NULL : out_of_memory_for("the particles of other ranks");
}

/* Tells the others what the particles are that they must see, and learns the same of theirs. */
static struct error *introduce(const struct particles *p, struct reach reach, struct ghosts *ghosts)
{
    struct remote *own = memory_allocate((size_t)p->count * sizeof *own);
    free(ghosts->remote);
    ghosts->remote = memory_allocate((size_t)ghosts->exchange.comes * sizeof *ghosts->remote);
    struct error *error = own && ghosts->remote ? exchange_reserve(&ghosts->exchange, sizeof *own)
                                                : out_of_memory_for("the particles of other ranks");
    error = ranks_agree(p->ranks, error);
    for (int32_t i = 0; i < p->count && !error; i++) {
        const double *x = p->position[i];
        own[i] = (struct remote){
            {x[0], x[1], x[2]}, reach.smoothing * reach.diameter[i], p->id[i], p->body[i]};
    }
    if (!error) {
        exchange_start(&ghosts->exchange, own, sizeof *own, ghosts->remote);
        exchange_finish(&ghosts->exchange);
        ghosts->remotes = ghosts->exchange.comes;
    }
    free(own);
    return error;
}

struct error *halo_plan(const struct particles *particles, const struct mirrors *mirrors,
                        struct reach reach, double skin, struct ghosts *ghosts, struct halo *halo)
{
    const struct ranks *ranks = particles->ranks;
    *halo = (struct halo){0};
    if (!ranks->joined)
        return NULL;
    struct region whole, *own = own_regions(particles, reach, skin, &whole);
    struct error *error =
        ranks_agree(ranks, own ? NULL : out_of_memory_for("the particles of other ranks"));
    if (!error)
        error = ranks_gather(ranks, -1, own, particles->blocks, sizeof *own, (void **)&halo->region,
                             &halo->regions);
    struct list list = {0};
    if (!error)
        error = ranks_agree(ranks, find_send_items(particles, (struct seen){mirrors, reach, skin},
                                                   halo, own, &whole, &list));
    free(own);
    if (!error)
        error = exchange_plan(&ghosts->exchange, ranks, list.send, list.count);
    free(list.send);
    return error ? error : introduce(particles, reach, ghosts);
}

void halo_free(struct halo *halo)
{
    free(halo->region);
    *halo = (struct halo){0};
}
