/* From particles to cells, see smear.h. */
#include "couple/smear.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* The weight of a particle at R, in cells from the centre of the cell, along one axis. */
static double weight(enum grid_shape shape, double r, double half)
{
    return 0.5 * (shape_value(shape, r - 0.5, half) + shape_value(shape, r + 0.5, half));
}

/* The place AT in the box; false where it has none. */
static bool place_in(const struct smear *smear, int64_t at[3])
{
    bool inside = true;
    for (int axis = 0; axis < 3; axis++) {
        const int64_t last = smear->count[axis] - 1;
        if (smear->keeps)
            at[axis] = at[axis] < 0 ? 0 : at[axis] > last ? last : at[axis];
        inside &= at[axis] >= 0 && at[axis] <= last;
    }
    return inside;
}

enum { REACH = 2, SPAN = 2 * REACH + 1 };

/* The cells along an axis that a particle at PLACE, in cells, gives to, and its weights. */
struct span {
    int64_t first;
    int count;
    double weight[SPAN];
};

static struct span span_at(const struct smear *smear, double place, double half)
{
    struct span span = {(int64_t)floor(place) - REACH, 0, {0.0}};
    const double within = place - floor(place) - 0.5;
    for (int k = 0; k < SPAN; k++) {
        const double w = weight(smear->shape, within - (double)(k - REACH), half);
        if (w == 0.0 && span.count == 0)
            span.first++;
        else if (w != 0.0)
            span.weight[span.count++] = w;
    }
    return span;
}

void smear_particle(const struct smear *smear, const struct smeared *particle,
                    struct smear_sums *sums)
{
    const double *u = particle->velocity, m = particle->mass;
    const int64_t which = particle->which;
    struct span span[3];
    for (int axis = 0; axis < 3; axis++)
        span[axis] = axis < smear->dimension
                         ? span_at(smear, particle->position[axis] / smear->edge, particle->half)
                         : (struct span){smear->low[axis], 1, {1.0}};
    const struct smear_sums own = {.kinetic =
                                       0.5 * m * (square(u[0]) + square(u[1]) + square(u[2])),
                                   .momentum = {m * u[0], m * u[1], m * u[2]}};
    const double volume = m / particle->density, energy = m * particle->energy;
    for (int c = 0; c < span[2].count; c++)
        for (int b = 0; b < span[1].count; b++)
            for (int a = 0; a < span[0].count; a++) {
                const double part = span[0].weight[a] * span[1].weight[b] * span[2].weight[c];
                int64_t at[3] = {span[0].first + a - smear->low[0],
                                 span[1].first + b - smear->low[1],
                                 span[2].first + c - smear->low[2]};
                if (!place_in(smear, at))
                    continue;
                const int64_t n = at[0] + smear->count[0] * (at[1] + smear->count[1] * at[2]);
                const int64_t k = smear->number ? smear->number[n] : n;
                if (k < 0)
                    continue;
                struct smear_sums *sum = &sums[k];
                sum->volume[which] += part * volume;
                sum->mass[which] += part * m;
                sum->energy[which] += part * energy;
                sum->kinetic += part * own.kinetic;
                for (int axis = 0; axis < 3; axis++)
                    sum->momentum[axis] += part * own.momentum[axis];
            }
}

/* The order of the ids of COUNT particles at ALL, which the caller frees. */
static struct error *find_order(const struct smeared *all, int64_t count, struct keyed **order)
{
    struct keyed *key = memory_allocate(((size_t)count + 1) * sizeof *key);
    struct keyed *scratch = memory_allocate(((size_t)count + 1) * sizeof *scratch);
    for (int64_t k = 0; k < count && key && scratch; k++)
        key[k] = (struct keyed){all[k].id, (int32_t)k};
    struct error *error = key && scratch ? NULL : owned_error();
    if (!error)
        radix_sort(key, scratch, count, 1);
    free(scratch);
    *order = key;
    return error;
}

struct error *smear_gather(const struct mpm *mpm, const struct gas_view *view,
                           const struct ranks *ranks, bool (*wanted)(void *context, int32_t i),
                           void *context, struct smeared **all, int64_t *count,
                           struct keyed **order)
{
    const struct particles *p = mpm_particles(mpm);
    int32_t *taken = memory_allocate(((size_t)p->count + 1) * sizeof *taken);
    int64_t near = 0;
    for (int32_t i = 0; taken && i < p->count; i++)
        if (wanted(context, i))
            taken[near++] = i;
    struct smeared *own = memory_allocate(((size_t)near + 1) * sizeof *own);
    for (int64_t k = 0; taken && own && k < near; k++) {
        const int32_t i = taken[k];
        own[k] =
            (struct smeared){.id = p->id[i],
                             .mass = p->mass[i],
                             .density = p->density[i],
                             .energy = p->energy[i],
                             .half = mpm_half_size(mpm, p->body[i]),
                             .which = view->layout->two && p->material[i] == view->material[1]};
        memcpy(own[k].position, p->position[i], sizeof own[k].position);
        memcpy(own[k].velocity, p->velocity[i], sizeof own[k].velocity);
    }
    struct error *error = ranks_agree(ranks, taken && own ? NULL : owned_error());
    free(taken);
    if (!error && ranks->size < 2) {
        *all = own;
        *count = near;
        return find_order(*all, *count, order);
    }
    if (!error)
        error = ranks_gather(ranks, -1, own, near, sizeof *own, (void **)all, count);
    free(own);
    return error ? error : find_order(*all, *count, order);
}
