/* Connected particles; see connected.h. */
#include "measure/connected.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/near_points.h"
#include "model/particles/population.h"

static struct error *no_room(int32_t particles)
{
    return out_of_memory_for("the connections of %d particles", (int)particles);
}

bool connected_has_diameters(const struct population *population)
{
    int component;
    return column_find(population, "diameter", &component) &&
           population->kind == POPULATION_OF_PARTICLES;
}

struct error *connected_diameters(const struct population *population, double **diameter)
{
    const int32_t count = population->count;
    int component;
    const struct column *column = column_find(population, "diameter", &component);
    *diameter = memory_allocate(((size_t)count + 1) * sizeof **diameter);
    if (!*diameter)
        return no_room(count);
    column_read(population, column, 0, count, *diameter);
    return NULL;
}

struct error *connected_failures(const struct population *population, bool **failed)
{
    static const char *const names[] = {"damage", "tensile_damage"};
    const int32_t count = population->count;
    double *damage = memory_allocate(((size_t)count + 1) * sizeof *damage);
    *failed = memory_allocate(((size_t)count + 1) * sizeof **failed);
    if (!damage || !*failed) {
        free(damage);
        free(*failed);
        *failed = NULL;
        return no_room(count);
    }
    for (size_t k = 0; k < COUNT_OF(names); k++) {
        int component;
        const struct column *column = column_find(population, names[k], &component);
        if (!column)
            continue;
        column_read(population, column, 0, count, damage);
        for (int32_t i = 0; i < count; i++)
            (*failed)[i] = (*failed)[i] || damage[i] >= 1.0;
    }
    free(damage);
    return NULL;
}

/* A search for the particles that are connected with point `index`. Points are the particles of
 * this rank that count, then those of other ranks near them. */
struct piece_search {
    int32_t own, count, index;
    int32_t *particle;       /* of an own point */
    double (*at)[3], *reach; /* reach: link D */
    uint64_t *label; /* of the point that stands for a set, the lowest id of it that is known */
    uint16_t *body;
    int32_t *parent; /* the point's own index where it stands for a set, -1: not counted */
};

static bool search_allocate(struct piece_search *search, int32_t own, int32_t remotes)
{
    const size_t room = (size_t)own + (size_t)remotes + 1;
    search->particle = memory_allocate(room * sizeof *search->particle);
    search->at = memory_allocate(room * sizeof *search->at);
    search->reach = memory_allocate(room * sizeof *search->reach);
    search->label = memory_allocate(room * sizeof *search->label);
    search->body = memory_allocate(room * sizeof *search->body);
    search->parent = memory_allocate(room * sizeof *search->parent);
    return search->particle && search->at && search->reach && search->label && search->body &&
           search->parent;
}

static void search_free(struct piece_search *search)
{
    free(search->particle);
    free(search->at);
    free(search->reach);
    free(search->label);
    free(search->body);
    free(search->parent);
}

/* The points of this rank; LABEL becomes the id of those that count. */
static void take_own(struct piece_search *search, const struct population *p,
                     const double *diameter, const bool *failed,
                     const struct connection *connection, uint64_t *label)
{
    for (int32_t i = 0; i < p->count; i++) {
        const bool counts = (connection->body < 0 || p->body[i] == connection->body) &&
                            (connection->failed || !failed || !failed[i]);
        label[i] = counts ? p->id[i] : CONNECTED_NONE;
        if (!counts)
            continue;
        const int32_t k = search->own++;
        search->particle[k] = i;
        memcpy(search->at[k], p->position[i], sizeof search->at[k]);
        search->reach[k] = connection->link * diameter[i];
        search->label[k] = p->id[i];
        search->body[k] = p->body[i];
        search->parent[k] = k;
    }
    search->count = search->own;
}

/* Those of other ranks, whose labels CAME. */
static void take_remote(struct piece_search *search, const struct ghosts *ghosts,
                        const uint64_t *came)
{
    for (int32_t g = 0; g < ghosts->remotes; g++) {
        if (came[g] == CONNECTED_NONE)
            continue;
        const struct remote *remote = &ghosts->remote[g];
        const int32_t k = search->count++;
        search->particle[k] = g;
        memcpy(search->at[k], remote->place, sizeof search->at[k]);
        search->reach[k] = remote->reach;
        search->label[k] = came[g];
        search->body[k] = remote->body;
        search->parent[k] = k;
    }
}

static int32_t root_of(int32_t *parent, int32_t i)
{
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static void try_link(void *context, int64_t other)
{
    struct piece_search *s = context;
    const int32_t i = s->index, j = (int32_t)other;
    if (j <= i || s->body[i] != s->body[j])
        return;
    const double *a = s->at[i], *b = s->at[j];
    if (square(a[0] - b[0]) + square(a[1] - b[1]) + square(a[2] - b[2]) <
        square(s->reach[i] + s->reach[j]))
        s->parent[root_of(s->parent, i)] = root_of(s->parent, j);
}

/* Joins what is connected as far as this rank sees it. */
static struct error *join(struct piece_search *search)
{
    struct near_points near;
    double largest = 0.0;
    for (int32_t i = 0; i < search->count; i++)
        largest = maximum(largest, search->reach[i]);
    TRY(near_points_make((const double(*)[3])search->at, search->count, 2.0 * largest, &near));
    for (search->index = 0; search->index < search->own; search->index++)
        near_points_about(&near, search->at[search->index], try_link, search);
    near_points_free(&near);
    for (int32_t i = 0; i < search->count; i++) {
        uint64_t *label = &search->label[root_of(search->parent, i)];
        *label = search->label[i] < *label ? search->label[i] : *label;
    }
    return NULL;
}

/* The labels of this rank's particles as they are known now. */
static void read_labels(struct piece_search *search, uint64_t *label)
{
    for (int32_t k = 0; k < search->own; k++)
        label[search->particle[k]] = search->label[root_of(search->parent, k)];
}

/* Exchanges labels with the ranks that see the same points until no rank learns anything new: the
 * lowest id of a set spreads from rank to rank. CAME has room for a number a ghost. */
static void settle(struct piece_search *search, const struct ranks *ranks,
                   struct exchange *exchange, uint64_t *label, uint64_t *came)
{
    for (bool learnt = ranks->joined; learnt;) {
        read_labels(search, label);
        exchange_start(exchange, label, sizeof *label, came);
        exchange_finish(exchange);
        learnt = false;
        for (int32_t k = search->own; k < search->count; k++) {
            uint64_t *known = &search->label[root_of(search->parent, k)];
            const uint64_t told = came[search->particle[k]];
            learnt |= told < *known;
            *known = told < *known ? told : *known;
        }
        learnt = ranks_maximum(ranks, learnt) > 0.0;
    }
    read_labels(search, label);
}

/* Learns which particles of other ranks count, joins and settles. GHOSTS are planned. */
static struct error *search_all(struct piece_search *search, const struct ranks *ranks,
                                struct ghosts *ghosts, uint64_t *label, uint64_t *came)
{
    if (ranks->joined) {
        exchange_start(&ghosts->exchange, label, sizeof *label, came);
        exchange_finish(&ghosts->exchange);
        take_remote(search, ghosts, came);
    }
    TRY(ranks_agree(ranks, join(search)));
    settle(search, ranks, &ghosts->exchange, label, came);
    return NULL;
}

struct error *connected_find(const struct ranks *ranks, const struct population *population,
                             const double *diameter, const bool *failed,
                             const struct connection *connection, uint64_t *label)
{
    struct ghosts ghosts = {0};
    struct piece_search search = {0};
    uint64_t *came = NULL;
    struct error *error = particles_see(population, diameter, connection->link, &ghosts);
    if (!error) {
        came = memory_allocate(((size_t)ghosts.remotes + 1) * sizeof *came);
        const bool made = search_allocate(&search, population->count, ghosts.remotes) && came;
        error = ranks_agree(ranks, made ? NULL : no_room(population->count));
    }
    if (!error) {
        take_own(&search, population, diameter, failed, connection, label);
        error = search_all(&search, ranks, &ghosts, label, came);
    }
    search_free(&search);
    free(came);
    ghosts_free(&ghosts);
    return error;
}
