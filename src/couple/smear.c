/* From particles to cells, see smear.h. */
#include "couple/smear.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { REACH = 2, SPAN = 2 * REACH + 1 };

/* Cells of the box along one axis. */
struct smear_range {
    int axis;
    int64_t from, to;
};

/* The cells of the box along an axis that a particle gives to, and its weights. */
struct span {
    int count;
    int64_t cell[SPAN];
    double weight[SPAN];
};

/* Those of RANGE for a particle at PLACE, in cells. */
static struct span span_at(const struct smear *smear, const struct smear_range *range, double place,
                           double half)
{
    const int64_t last = smear->count[range->axis] - 1,
                  first = (int64_t)floor(place) - REACH - smear->low[range->axis];
    const double within = place - floor(place) - 0.5;
    struct span span = {.count = 0};
    double node[SPAN + 1]; /* before each cell, and behind the last */
    for (int k = 0; k <= SPAN; k++)
        node[k] = shape_value(smear->shape, within + 0.5 - (double)(k - REACH), half);
    for (int k = 0; k < SPAN; k++) {
        const double w = 0.5 * (node[k] + node[k + 1]);
        int64_t cell = first + k;
        if (smear->keeps)
            cell = cell < 0 ? 0 : cell > last ? last : cell;
        if (w == 0.0 || cell < range->from || cell >= range->to)
            continue;
        span.cell[span.count] = cell;
        span.weight[span.count++] = w;
    }
    return span;
}

/* Adds what PARTICLE has to SUMS, of the cells in RANGE. */
static void smear_particle(const struct smear *smear, const struct smeared *particle,
                           const struct smear_range range[3], struct smear_sums *sums)
{
    enum { NUMBERS = sizeof(struct smear_sums) / sizeof(double) };
    const double *u = particle->velocity, m = particle->mass;
    struct smear_sums own = {.momentum = {m * u[0], m * u[1], m * u[2]},
                             .kinetic = 0.5 * m * (square(u[0]) + square(u[1]) + square(u[2]))};
    own.volume[particle->which] = m / particle->density;
    own.mass[particle->which] = m;
    own.energy[particle->which] = m * particle->energy;
    double number[NUMBERS];
    memcpy(number, &own, sizeof own);
    struct span span[3] = {[2] = {1, {0}, {1.0}}, [1] = {1, {0}, {1.0}}};
    for (int axis = 0; axis < smear->dimension; axis++)
        span[axis] =
            span_at(smear, &range[axis], particle->position[axis] / smear->edge, particle->half);
    for (int c = 0; c < span[2].count; c++)
        for (int b = 0; b < span[1].count; b++) {
            const int64_t row =
                smear->count[0] * (span[1].cell[b] + smear->count[1] * span[2].cell[c]);
            for (int a = 0; a < span[0].count; a++) {
                const double part = span[0].weight[a] * span[1].weight[b] * span[2].weight[c];
                const int64_t n = row + span[0].cell[a], k = smear->number ? smear->number[n] : n;
                if (k < 0)
                    continue;
                double *sum = (double *)&sums[k];
#pragma omp simd
                for (int q = 0; q < NUMBERS; q++)
                    sum[q] += part * number[q];
            }
        }
}

/* Asks for the K-th particle, if there is one: they lie in another order than that of the sums. */
static void crowd_fetch(const struct crowd *crowd, int64_t k)
{
    if (k < crowd->count)
        __builtin_prefetch(&crowd->particle[crowd->order[k].index]);
}

/* The longest axis of what is wanted of the box. */
static int longest(const struct smear *smear)
{
    int axis = 0;
    for (int k = 1; k < smear->dimension; k++)
        if (smear->to[k] - smear->from[k] > smear->to[axis] - smear->from[axis])
            axis = k;
    return axis;
}

void smear_crowd(const struct smear *smear, const struct crowd *crowd, int threads,
                 struct smear_sums *sums)
{
    enum { AHEAD = 8 };
    const int axis = longest(smear);
    const int64_t last = smear->count[axis] - 1, wanted = smear->to[axis] - smear->from[axis];
    /* Each part has cells of its own, and sums in one order, whatever the number of parts. */
#pragma omp parallel num_threads(threads)
    {
#pragma omp for schedule(static)
        for (int64_t k = 0; k < crowd->count; k++) {
            const struct smeared *particle = &crowd->particle[crowd->order[k].index];
            const double place = floor(particle->position[axis] / smear->edge);
            crowd->place[k] = (int32_t)minimum(
                maximum(place - (double)smear->low[axis], -(double)SPAN), (double)(last + SPAN));
        }
#pragma omp for schedule(static)
        for (int part = 0; part < threads; part++) {
            struct smear_range range[3];
            for (int k = 0; k < 3; k++)
                range[k] = (struct smear_range){k, smear->from[k], smear->to[k]};
            range[axis].from = smear->from[axis] + wanted * part / threads;
            range[axis].to = smear->from[axis] + wanted * (part + 1) / threads;
            /* the border of the box gets what goes beyond */
            const int64_t from = range[axis].from == 0 ? -SPAN : range[axis].from - REACH,
                          to = range[axis].to > last ? last + SPAN + 1 : range[axis].to + REACH;
            for (int64_t k = 0; k < crowd->count; k++) {
                crowd_fetch(crowd, k + AHEAD);
                if (crowd->place[k] >= from && crowd->place[k] < to)
                    smear_particle(smear, &crowd->particle[crowd->order[k].index], range, sums);
            }
        }
    }
}

static bool reserve_order(struct crowd *crowd)
{
    const int64_t needed = crowd->count + 1;
    return memory_reserve((void **)&crowd->order, &crowd->order_capacity, needed, 0,
                          sizeof *crowd->order) &&
           memory_reserve((void **)&crowd->spare, &crowd->spare_capacity, needed, 0,
                          sizeof *crowd->spare) &&
           memory_reserve((void **)&crowd->place, &crowd->place_capacity, needed, 0,
                          sizeof *crowd->place);
}

/* Copies what the particles of this rank have that were picked. */
static void copy_picked(struct crowd *crowd, const struct mpm *mpm, const struct gas_view *view,
                        int threads)
{
    const struct particles *p = mpm_particles(mpm);
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int64_t k = 0; k < crowd->count; k++) {
        const int32_t i = crowd->picked.index[k];
        struct smeared *own = &crowd->particle[k];
        *own = (struct smeared){.id = p->id[i],
                                .mass = p->mass[i],
                                .density = p->density[i],
                                .energy = p->energy[i],
                                .half = mpm_half_size(mpm, p->body[i]),
                                .which = view->layout->two && p->material[i] == view->material[1]};
        memcpy(own->position, p->position[i], sizeof own->position);
        memcpy(own->velocity, p->velocity[i], sizeof own->velocity);
    }
}

struct error *crowd_gather(struct crowd *crowd, const struct mpm *mpm, const struct gas_view *view,
                           const struct simulation *simulation,
                           bool (*wanted)(void *context, int32_t i), void *context)
{
    const struct ranks *ranks = simulation->ranks;
    const int threads = simulation->threads;
    bool fits = part_pick(&crowd->picked, mpm_particles(mpm)->count, threads, wanted, context);
    crowd->count = crowd->picked.count;
    fits = fits && memory_reserve((void **)&crowd->particle, &crowd->capacity, crowd->count + 1, 0,
                                  sizeof *crowd->particle);
    TRY(ranks_agree(ranks, fits ? NULL : out_of_memory_for("the coupling")));
    copy_picked(crowd, mpm, view, threads);
    if (ranks->size > 1) {
        struct smeared *all;
        TRY(ranks_gather(ranks, -1, crowd->particle, crowd->count, sizeof *all, (void **)&all,
                         &crowd->count));
        free(crowd->particle);
        crowd->particle = all;
        crowd->capacity = crowd->count;
    }
    TRY(ranks_agree(ranks, reserve_order(crowd) ? NULL : out_of_memory_for("the coupling")));
    for (int64_t k = 0; k < crowd->count; k++)
        crowd->order[k] = (struct keyed){crowd->particle[k].id, (int32_t)k};
    radix_sort(crowd->order, crowd->spare, crowd->count, threads);
    return NULL;
}

void crowd_free(struct crowd *crowd)
{
    free(crowd->particle);
    free(crowd->order);
    free(crowd->spare);
    free(crowd->place);
    free(crowd->picked.index);
    *crowd = (struct crowd){.count = 0};
}
