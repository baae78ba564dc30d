/* Loops over the blocks and the particles of a rank. */
#include "sph/scheme.h"

void sph_sweep(struct sph *sph, const struct simulation *simulation,
               const struct sph_records *records, const struct sph_sweep *sweep)
{
    const struct particles *p = &simulation->particles;
    for (int rest = 0; rest < 2; rest++) {
        if (rest)
            sph_records_finish(sph, simulation, records);
#pragma omp parallel for schedule(dynamic, sweep->chunk) num_threads(simulation->threads)
        for (int32_t b = 0; b < p->blocks; b++)
            if (neighbours_inner(&sph->neighbours, b) != rest)
                sweep->body(sweep->loop, p->block, b);
    }
}

static bool is_smaller(struct limit one, struct limit other)
{
    return one.dt < other.dt || (one.dt == other.dt && one.id < other.id);
}

struct limit sph_smallest_limit(const struct sph *sph, const struct simulation *simulation,
                                sph_limit_of *limit_of, const void *context)
{
    const struct particles *p = &simulation->particles;
    struct limit smallest = {(double)INFINITY, "nothing", UINT64_MAX};
#pragma omp parallel num_threads(simulation->threads)
    {
        struct limit own = smallest;
#pragma omp for schedule(static)
        for (int32_t i = 0; i < p->count; i++) {
            struct limit limit = limit_of(sph, simulation, context, i);
            limit.id = p->id[i];
            if (is_smaller(limit, own))
                own = limit;
        }
#pragma omp critical(bolide_sph_limit)
        if (is_smaller(own, smallest))
            smallest = own;
    }
    const double dt = ranks_minimum(simulation->ranks, smallest.dt);
    return smallest.dt > dt ? (struct limit){dt, "another rank", UINT64_MAX} : smallest;
}
