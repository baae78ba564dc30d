/* pieces: into how many pieces bodies are broken. Two particles of one body hang together when they
 * are nearer than link (D_i + D_j). Particles of different bodies do not, however close. A piece
 * may lie on many ranks. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/measure.h"
#include "measure/near_points.h"
#include "model/particles/population.h"

const struct parameter measure_pieces_table[] = {
    PARAMETER(NUMBER, struct measure_pieces, link, "0.8",
              "distance up to which two particles are connected, over the sum of their diameters",
              .below = INFINITY),
    PARAMETER_END,
};

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    int component;
    if (!column_find(measurement->population, "diameter", &component) ||
        measurement->population->kind != POPULATION_OF_PARTICLES)
        return measure_error(measurement, "the particles of this solver have no diameter");
    *unit = "";
    return NULL;
}

/* A search for the particles that hang together with point `index`. Points are the particles of
 * this rank, then those of others that are near them. */
struct search {
    int32_t own, count, index;
    double (*at)[3], *reach; /* reach: link D */
    uint64_t *id,
        *label; /* label: of the point that stands for a piece, the lowest id of it that is known */
    uint16_t *body;
    int32_t *parent; /* the point's own index where it stands for a piece, -1: not counted */
};

static bool search_allocate(struct search *search, int32_t own, int32_t remotes)
{
    const size_t room = (size_t)own + (size_t)remotes + 1;
    search->own = own;
    search->count = own + remotes;
    search->at = memory_allocate(room * sizeof *search->at);
    search->reach = memory_allocate(room * sizeof *search->reach);
    search->id = memory_allocate(room * sizeof *search->id);
    search->label = memory_allocate(room * sizeof *search->label);
    search->body = memory_allocate(room * sizeof *search->body);
    search->parent = memory_allocate(room * sizeof *search->parent);
    return search->at && search->reach && search->id && search->label && search->body &&
           search->parent;
}

static void search_free(struct search *search)
{
    free(search->at);
    free(search->reach);
    free(search->id);
    free(search->label);
    free(search->body);
    free(search->parent);
}

static void take_points(struct search *search, const struct population *p, const double *diameter,
                        double link, const struct remote *remote, int only)
{
    for (int32_t i = 0; i < search->count; i++) {
        const struct remote *other = i < search->own ? NULL : &remote[i - search->own];
        memcpy(search->at[i], other ? other->place : p->position[i], sizeof search->at[i]);
        search->reach[i] = other ? other->reach : link * diameter[i];
        search->id[i] = search->label[i] = other ? other->id : p->id[i];
        search->body[i] = other ? other->body : p->body[i];
        search->parent[i] = only < 0 || search->body[i] == only ? i : -1;
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
    struct search *s = context;
    const int32_t i = s->index, j = (int32_t)other;
    if (j <= i || s->parent[j] < 0 || s->body[i] != s->body[j])
        return;
    const double *a = s->at[i], *b = s->at[j];
    if (square(a[0] - b[0]) + square(a[1] - b[1]) + square(a[2] - b[2]) <
        square(s->reach[i] + s->reach[j]))
        s->parent[root_of(s->parent, i)] = root_of(s->parent, j);
}

/* Joins what hangs together as far as this rank sees it. */
static struct error *join(struct search *search)
{
    struct near_points near;
    double largest = 0.0;
    for (int32_t i = 0; i < search->count; i++)
        largest = maximum(largest, search->reach[i]);
    TRY(near_points_make((const double(*)[3])search->at, search->count, 2.0 * largest, &near));
    for (search->index = 0; search->index < search->own; search->index++)
        if (search->parent[search->index] >= 0)
            near_points_about(&near, search->at[search->index], try_link, search);
    near_points_free(&near);
    for (int32_t i = 0; i < search->count; i++)
        if (search->parent[i] >= 0) {
            uint64_t *label = &search->label[root_of(search->parent, i)];
            *label = search->id[i] < *label ? search->id[i] : *label;
        }
    return NULL;
}

/* Tells the ranks that see the same points what these are part of, until nobody learns anything
 * new. Lowest ids wander along a piece from rank to rank. TOLD has room for a number a point. */
static void settle(struct search *search, const struct ranks *ranks, struct exchange *exchange,
                   uint64_t *told)
{
    for (bool learnt = ranks->joined; learnt;) {
        for (int32_t i = 0; i < search->own; i++)
            told[i] = search->parent[i] < 0 ? 0 : search->label[root_of(search->parent, i)];
        exchange_start(exchange, told, sizeof *told, told + search->own);
        exchange_finish(exchange);
        learnt = false;
        for (int32_t i = search->own; i < search->count; i++) {
            if (search->parent[i] < 0)
                continue;
            uint64_t *label = &search->label[root_of(search->parent, i)];
            learnt |= told[i] < *label;
            *label = told[i] < *label ? told[i] : *label;
        }
        learnt = ranks_maximum(ranks, learnt) > 0.0;
    }
}

/* A piece counts where its lowest id is. */
static int64_t count_pieces(struct search *search)
{
    int64_t pieces = 0;
    for (int32_t i = 0; i < search->own; i++)
        pieces +=
            search->parent[i] >= 0 && search->label[root_of(search->parent, i)] == search->id[i];
    return pieces;
}

/* GHOSTS are planned. */
static struct error *find_pieces(const struct measurement *measurement, const double *diameter,
                                 struct ghosts *ghosts, double *value)
{
    const struct measure_pieces *parameters = measurement->check->measure.value;
    const struct simulation *simulation = measurement->simulation;
    const struct population *particles = measurement->population;
    struct search search = {0};
    struct error *error = NULL;
    bool made = search_allocate(&search, particles->count, ghosts->remotes);
    uint64_t *told = memory_allocate(((size_t)search.count + 1) * sizeof *told);
    if (!made || !told)
        error = out_of_memory_for("a check of %d particles", (int)search.count);
    if (!error) {
        take_points(&search, particles, diameter, parameters->link, ghosts->remote,
                    measure_body(measurement));
        error = join(&search);
    }
    error = ranks_agree(simulation->ranks, error);
    if (!error) {
        settle(&search, simulation->ranks, &ghosts->exchange, told);
        *value = (double)ranks_sum(simulation->ranks, count_pieces(&search));
    }
    free(told);
    search_free(&search);
    return error;
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_pieces *parameters = measurement->check->measure.value;
    const struct population *particles = measurement->population;
    int component;
    const struct column *column = column_find(particles, "diameter", &component);
    double *diameter = memory_allocate(((size_t)particles->count + 1) * sizeof *diameter);
    struct ghosts ghosts = {0};
    struct error *error = NULL;
    if (!diameter)
        error = out_of_memory_for("a check of %d particles", (int)particles->count);
    error = ranks_agree(measurement->simulation->ranks, error);
    if (!error) {
        column_read(particles, column, 0, particles->count, diameter);
        error = particles_see(particles, diameter, parameters->link, &ghosts);
    }
    if (!error)
        error = find_pieces(measurement, diameter, &ghosts, value);
    ghosts_free(&ghosts);
    free(diameter);
    return error;
}

const struct measure_class measure_pieces = {.unit = unit, .measure = measure, .of_bodies = true};
