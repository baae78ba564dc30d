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

void smear_particle(const struct smear *smear, const struct smeared *particle,
                    struct smear_sums *sums)
{
    enum { REACH = 2, SPAN = 2 * REACH + 1 };
    const double *x = particle->position, *u = particle->velocity;
    const int64_t which = particle->which;
    int64_t cell[3] = {0, 0, 0};
    double w[3][SPAN], speed = 0.0;
    int span[3] = {1, 1, 1}, reach[3] = {0, 0, 0};
    for (int axis = 0; axis < 3; axis++) {
        w[axis][0] = 1.0;
        speed += square(u[axis]);
        if (axis >= smear->dimension)
            continue;
        const double place = x[axis] / smear->edge;
        cell[axis] = (int64_t)floor(place) - smear->low[axis];
        span[axis] = SPAN;
        reach[axis] = REACH;
        for (int k = 0; k < SPAN; k++)
            w[axis][k] = weight(smear->shape, place - floor(place) - 0.5 - (double)(k - REACH),
                                particle->half);
    }
    for (int c = 0; c < span[2]; c++)
        for (int b = 0; b < span[1] && w[2][c] != 0.0; b++)
            for (int a = 0; a < span[0] && w[1][b] != 0.0; a++) {
                const double part = w[0][a] * w[1][b] * w[2][c];
                int64_t at[3] = {cell[0] + a - reach[0], cell[1] + b - reach[1],
                                 cell[2] + c - reach[2]};
                if (part == 0.0 || !place_in(smear, at))
                    continue;
                const int64_t n = at[0] + smear->count[0] * (at[1] + smear->count[1] * at[2]);
                const int64_t k = smear->number ? smear->number[n] : n;
                if (k < 0)
                    continue;
                const double mass = part * particle->mass;
                sums[k].volume[which] += mass / particle->density;
                sums[k].mass[which] += mass;
                sums[k].energy[which] += mass * particle->energy;
                sums[k].kinetic += 0.5 * mass * speed;
                for (int axis = 0; axis < 3; axis++)
                    sums[k].momentum[axis] += mass * u[axis];
            }
}

static int by_id(const void *left, const void *right)
{
    const struct smeared *a = left, *b = right;
    return (a->id > b->id) - (a->id < b->id);
}

struct error *smear_gather(const struct mpm *mpm, const struct gas_view *view,
                           const struct ranks *ranks, bool (*wanted)(void *context, int32_t i),
                           void *context, struct smeared **all, int64_t *count)
{
    const struct particles *p = mpm_particles(mpm);
    struct smeared *own = memory_allocate(((size_t)p->count + 1) * sizeof *own);
    int64_t taken = 0;
    for (int32_t i = 0; own && i < p->count; i++) {
        if (!wanted(context, i))
            continue;
        struct smeared *one = &own[taken++];
        *one = (struct smeared){.id = p->id[i],
                                .mass = p->mass[i],
                                .density = p->density[i],
                                .energy = p->energy[i],
                                .half = mpm_half_size(mpm, p->body[i]),
                                .which = view->layout->two && p->material[i] == view->material[1]};
        memcpy(one->position, p->position[i], sizeof one->position);
        memcpy(one->velocity, p->velocity[i], sizeof one->velocity);
    }
    struct error *error = ranks_agree(ranks, own ? NULL : owned_error());
    if (!error)
        error = ranks_gather(ranks, -1, own, taken, sizeof *own, (void **)all, count);
    free(own);
    if (!error)
        qsort(*all, (size_t)*count, sizeof **all, by_id);
    return error;
}
