/* Which bodies are in contact at the start, directly or through others. Those that are not act on
 * each other once they touch; which ones these are belongs to the state of a run. */
#include <stdlib.h>

#include "base/memory.h"
#include "sph/scheme.h"

/* Bodies as a forest: PARENT of each, a smaller number or its own. */
static int root_of(const int *parent, int body)
{
    while (parent[body] != body)
        body = parent[body];
    return body;
}

static bool unite(int *parent, int first, int second)
{
    first = root_of(parent, first);
    second = root_of(parent, second);
    if (first < second)
        parent[second] = first;
    else
        parent[first] = second;
    return first != second;
}

/* Where a neighbour is, its reach and body. */
struct beside {
    struct vec3 x;
    double reach;
    int body;
};

static struct beside beside_of(const struct sph *sph, const struct mirrors *mirrors,
                               struct reach reach, int32_t entry)
{
    const struct particles *p = sph->particles;
    const struct ghosts *ghosts = &sph->neighbours.ghosts;
    const int32_t from = entry < p->count ? entry : ghosts->source[entry - p->count];
    const struct remote *remote = from < p->count ? NULL : &ghosts->remote[from - p->count];
    const double *place = remote ? remote->place : p->position[from];
    struct beside beside = {vec3_make(place[0], place[1], place[2]),
                            remote ? remote->reach : reach.smoothing * reach.diameter[from],
                            remote ? remote->body : p->body[from]};
    if (entry >= p->count + ghosts->remotes)
        beside.x = image_position(mirrors, ghosts->image[entry - p->count], beside.x);
    return beside;
}

/* Unites the bodies of which owned particles are in contact with others. */
static void unite_neighbours(const struct sph *sph, const struct mirrors *mirrors,
                             struct reach reach, int *parent)
{
    const struct particles *p = sph->particles;
    const double per_sum = 0.5 * SPH_START_CONTACT / reach.smoothing;
    for (int32_t i = 0; i < p->count; i++) {
        const uint32_t *entry = neighbours_row(&sph->neighbours, i);
        const struct beside own = beside_of(sph, mirrors, reach, i);
        for (uint32_t k = 0; k < sph->neighbours.row[i].count; k++) {
            const struct beside other =
                beside_of(sph, mirrors, reach, (int32_t)(entry[k] & ENTRY_INDEX));
            const struct vec3 x = vec3_sub(other.x, own.x);
            if (other.body != own.body &&
                vec3_dot(x, x) < square(per_sum * (own.reach + other.reach)))
                unite(parent, own.body, other.body);
        }
    }
}

/* Collective: unites what ranks have united. FIRST has room for a number a body. */
static void unite_ranks(const struct sph *sph, const struct ranks *ranks, int *parent,
                        double *first)
{
    for (double changed = 1.0; changed > 0.0;) {
        changed = 0.0;
        for (int b = 0; b < sph->bodies; b++)
            first[b] = -root_of(parent, b);
        ranks_maximum_of(ranks, first, sph->bodies);
        for (int b = 0; b < sph->bodies; b++)
            if (unite(parent, b, (int)-first[b]))
                changed = 1.0;
        changed = ranks_maximum(ranks, changed);
    }
}

struct error *sph_find_clusters(struct sph *sph, struct simulation *simulation)
{
    const size_t bodies = (size_t)sph->bodies;
    int *parent = memory_allocate(bodies * sizeof *parent);
    double *first = memory_allocate(bodies * sizeof *first);
    struct error *error = ranks_agree(simulation->ranks, parent && first ? NULL : out_of_memory());
    bool apart = false;
    for (int b = 0; b < sph->bodies && !error; b++)
        parent[b] = b;
    if (!error) {
        unite_neighbours(sph, &simulation->problem->images, sph_reach(sph, simulation), parent);
        unite_ranks(sph, simulation->ranks, parent, first);
    }
    for (int b = 0; b < sph->bodies && !error; b++) {
        sph->cluster[b] = (uint16_t)root_of(parent, b);
        apart |= sph->cluster[b] != sph->cluster[0];
    }
    free(parent);
    free(first);
    return !error && apart ? sph_rebuild_lists(sph, simulation) : error;
}
