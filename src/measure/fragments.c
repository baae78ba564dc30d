/* The fragments of broken bodies; see fragments.h. Every particle goes to the rank that its
 * fragment's label chooses, which sums in the order of the ids: so the sums have the same bits for
 * any order, threads and ranks. A particle is a cube (square) of its diameter D, whose moment of
 * inertia about an axis is m D^2/6. */
#include "measure/fragments.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/connected.h"
#include "measure/spin.h"

/* A particle on its way to where its fragment is summed. */
struct member {
    uint64_t label, id;
    double mass, diameter, at[3], velocity[3];
    int32_t body;
};

static int compare_members(const void *first, const void *second)
{
    const struct member *a = first, *b = second;
    if (a->label != b->label)
        return a->label > b->label ? 1 : -1;
    return (a->id > b->id) - (a->id < b->id);
}

static int compare_fragments(const void *first, const void *second)
{
    const struct fragment *a = first, *b = second;
    if (a->mass != b->mass)
        return a->mass < b->mass ? 1 : -1;
    return (a->label > b->label) - (a->label < b->label);
}

static void find_center(const struct member *member, int64_t count, struct fragment *fragment)
{
    for (int64_t i = 0; i < count; i++) {
        fragment->mass += member[i].mass;
        for (int k = 0; k < 3; k++) {
            fragment->center[k] += member[i].mass * member[i].at[k];
            fragment->velocity[k] += member[i].mass * member[i].velocity[k];
        }
    }
    for (int k = 0; k < 3; k++) {
        fragment->center[k] /= fragment->mass;
        fragment->velocity[k] /= fragment->mass;
    }
}

static void find_spin(const struct member *member, int64_t count, int dimension,
                      struct fragment *fragment)
{
    struct sym3 inertia = {0};
    struct vec3 angular = {0};
    for (int64_t i = 0; i < count; i++) {
        const double mass = member[i].mass, own = mass * square(member[i].diameter) / 6.0;
        const struct vec3 x = vec3_sub(vector_at(member[i].at), vector_at(fragment->center));
        const struct vec3 u =
            vec3_sub(vector_at(member[i].velocity), vector_at(fragment->velocity));
        const struct sym3 part = {own + mass * (x.y * x.y + x.z * x.z),
                                  own + mass * (x.z * x.z + x.x * x.x),
                                  own + mass * (x.x * x.x + x.y * x.y),
                                  -mass * x.x * x.y,
                                  -mass * x.y * x.z,
                                  -mass * x.z * x.x};
        inertia = sym3_add(inertia, part);
        angular = vec3_add(angular, vec3_scale(mass, vec3_cross(x, u)));
    }
    const struct vec3 spin = spin_of(inertia, angular, dimension);
    fragment->spin[0] = spin.x;
    fragment->spin[1] = spin.y;
    fragment->spin[2] = spin.z;
}

static void find_extent(const struct member *member, int64_t count, int dimension, bool round,
                        struct fragment *fragment)
{
    double volume = 0.0;
    for (int k = 0; k < 3; k++) {
        fragment->low[k] = INFINITY;
        fragment->high[k] = -INFINITY;
    }
    for (int64_t i = 0; i < count; i++) {
        const double width = member[i].diameter, edge = 0.5 * width;
        const double section = dimension == 1 ? width : square(width);
        volume += round            ? 2.0 * M_PI * member[i].at[0] * section
                  : dimension == 3 ? section * width
                                   : section;
        for (int k = 0; k < 3; k++) {
            fragment->low[k] = minimum(fragment->low[k], member[i].at[k] - edge);
            fragment->high[k] = maximum(fragment->high[k], member[i].at[k] + edge);
        }
    }
    if (round)
        fragment->low[0] = maximum(fragment->low[0], 0.0);
    fragment->size = round || dimension == 3 ? cbrt(6.0 / M_PI * volume)
                     : dimension == 2        ? 2.0 * sqrt(volume / M_PI)
                                             : volume;
}

static struct fragment sum_fragment(const struct problem *problem, const struct member *member,
                                    int64_t count)
{
    const int dimension = problem->dimension;
    const bool round = problem->geometry == GEOMETRY_AXISYMMETRIC;
    struct fragment fragment = {
        .particles = count, .label = member[0].label, .body = member[0].body};
    find_center(member, count, &fragment);
    find_extent(member, count, dimension, round, &fragment);
    if (!round)
        find_spin(member, count, dimension, &fragment);
    return fragment;
}

/* Sums the fragments of the COUNT members that came, which it sorts; *ITEM is fresh. */
static struct error *sum_all(const struct problem *problem, struct member *member, int32_t count,
                             struct fragment **item, int64_t *items)
{
    *items = 0;
    qsort(member, (size_t)count, sizeof *member, compare_members);
    for (int32_t i = 0; i < count; i++)
        *items += i == 0 || member[i].label != member[i - 1].label;
    *item = memory_allocate(((size_t)*items + 1) * sizeof **item);
    if (!*item)
        return out_of_memory_for("fragments");
    int64_t made = 0;
    for (int32_t first = 0, end; first < count; first = end) {
        for (end = first; end < count && member[end].label == member[first].label;)
            end++;
        (*item)[made++] = sum_fragment(problem, member + first, end - first);
    }
    return NULL;
}

/* The owned particles that have a LABEL, and to which rank each goes. */
static int32_t take_members(const struct ranks *ranks, const struct population *p,
                            const double *diameter, const uint64_t *label, struct member *member,
                            struct send_item *send)
{
    int32_t count = 0;
    for (int32_t i = 0; i < p->count; i++) {
        if (label[i] == CONNECTED_NONE)
            continue;
        send[count] = (struct send_item){(int32_t)(label[i] % (uint64_t)ranks->size), count};
        struct member *taken = &member[count++];
        *taken = (struct member){.label = label[i],
                                 .id = p->id[i],
                                 .mass = p->mass[i],
                                 .diameter = diameter[i],
                                 .body = p->body[i]};
        memcpy(taken->at, p->position[i], sizeof taken->at);
        memcpy(taken->velocity, p->velocity[i], sizeof taken->velocity);
    }
    return count;
}

/* Collective: this rank's members to the ranks that sum them. */
static struct error *send_members(const struct ranks *ranks, const struct population *population,
                                  const double *diameter, const uint64_t *label,
                                  struct member **came, int32_t *count)
{
    const size_t room = (size_t)population->count + 1;
    struct member *own = memory_allocate(room * sizeof *own);
    struct send_item *send = memory_allocate(room * sizeof *send);
    void *received = NULL;
    struct error *error = ranks_agree(ranks, own && send ? NULL : out_of_memory_for("fragments"));
    if (!error) {
        assert(own && send);
        const int32_t sent = take_members(ranks, population, diameter, label, own, send);
        error = exchange_once(ranks, send, sent, own, sizeof *own, &received, count);
    }
    free(send);
    free(own);
    *came = received;
    return error;
}

/* The failed particles of BODY together. */
static void sum_dust(const struct ranks *ranks, const struct population *p, const bool *failed,
                     int body, struct fragment *dust)
{
    enum { MASS, PLACE, MOTION = PLACE + 3, SUMS = MOTION + 3 };
    struct exact_sum sums[SUMS] = {{{0}, 0, false}};
    *dust = (struct fragment){.body = body};
    for (int32_t i = 0; i < p->count; i++) {
        if (!failed[i] || (body >= 0 && p->body[i] != body))
            continue;
        dust->particles++;
        exact_sum_add(&sums[MASS], p->mass[i]);
        for (int k = 0; k < 3; k++) {
            exact_sum_add(&sums[PLACE + k], p->mass[i] * p->position[i][k]);
            exact_sum_add(&sums[MOTION + k], p->mass[i] * p->velocity[i][k]);
        }
    }
    ranks_sum_exact(ranks, sums, SUMS);
    dust->particles = ranks_sum(ranks, dust->particles);
    dust->mass = exact_sum_value(&sums[MASS]);
    for (int k = 0; k < 3; k++) {
        dust->center[k] = exact_sum_value(&sums[PLACE + k]) / dust->mass;
        dust->velocity[k] = exact_sum_value(&sums[MOTION + k]) / dust->mass;
    }
}

/* Where a label is among the fragments. */
struct numbered {
    uint64_t label;
    int64_t number;
};

static int compare_numbered(const void *first, const void *second)
{
    const struct numbered *a = first, *b = second;
    return (a->label > b->label) - (a->label < b->label);
}

static struct error *number_members(const uint64_t *label, struct fragments *fragments)
{
    struct numbered *known = memory_allocate(((size_t)fragments->count + 1) * sizeof *known);
    fragments->of_member =
        memory_allocate(((size_t)fragments->members + 1) * sizeof *fragments->of_member);
    if (!known || !fragments->of_member) {
        free(known);
        return out_of_memory_for("fragments");
    }
    for (int64_t k = 0; k < fragments->count; k++)
        known[k] = (struct numbered){fragments->item[k].label, k};
    qsort(known, (size_t)fragments->count, sizeof *known, compare_numbered);
    for (int32_t i = 0; i < fragments->members; i++) {
        const struct numbered wanted = {label[i], 0};
        const struct numbered *found = label[i] == CONNECTED_NONE
                                           ? NULL
                                           : bsearch(&wanted, known, (size_t)fragments->count,
                                                     sizeof *known, compare_numbered);
        fragments->of_member[i] = found ? found->number : FRAGMENT_NONE;
    }
    free(known);
    return NULL;
}

/* Collective: the fragments of the particles with LABEL. */
static struct error *gather(const struct ranks *ranks, const struct population *population,
                            const double *diameter, const uint64_t *label,
                            struct fragments *fragments)
{
    struct member *came = NULL;
    struct fragment *own = NULL;
    int64_t items = 0;
    int32_t count = 0;
    void *all = NULL;
    struct error *error = send_members(ranks, population, diameter, label, &came, &count);
    if (!error)
        error = ranks_agree(ranks, sum_all(population->problem, came, count, &own, &items));
    free(came);
    if (!error)
        error = ranks_gather(ranks, -1, own, items, sizeof *own, &all, &fragments->count);
    free(own);
    if (error)
        return error;
    fragments->item = all;
    qsort(fragments->item, (size_t)fragments->count, sizeof *fragments->item, compare_fragments);
    return ranks_agree(ranks, number_members(label, fragments));
}

struct error *fragments_find(const struct ranks *ranks, const struct population *population,
                             int body, double link, struct fragments *fragments)
{
    const struct connection connection = {link, body, false};
    double *diameter = NULL;
    bool *failed = NULL;
    *fragments = (struct fragments){.members = population->count};
    uint64_t *label = memory_allocate(((size_t)fragments->members + 1) * sizeof *label);
    struct error *error = label ? NULL : out_of_memory_for("fragments");
    if (!error)
        error = connected_diameters(population, &diameter);
    if (!error)
        error = connected_failures(population, &failed);
    error = ranks_agree(ranks, error);
    if (!error)
        error = connected_find(ranks, population, diameter, failed, &connection, label);
    if (!error) {
        sum_dust(ranks, population, failed, body, &fragments->dust);
        error = gather(ranks, population, diameter, label, fragments);
    }
    free(failed);
    free(diameter);
    free(label);
    return error;
}

void fragments_free(struct fragments *fragments)
{
    free(fragments->item);
    free(fragments->of_member);
    *fragments = (struct fragments){0};
}
