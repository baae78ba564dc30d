/* Loops over the blocks and the particles of a rank. */
#include "sph/scheme.h"

void sph_sweep(struct sph *sph, struct simulation *simulation, const struct sph_records *records,
               const struct sph_sweep *sweep)
{
    const struct particles *p = sph->particles;
    for (int rest = 0; rest < 2; rest++) {
        if (rest) {
            simulation_end_phase(simulation, PHASE_BLOCKS, sweep->phase);
            sph_records_finish(sph, simulation, records);
        }
#pragma omp parallel for schedule(dynamic, sweep->chunk) num_threads(simulation->threads)
        for (int32_t b = 0; b < p->blocks; b++)
            if (neighbours_inner(&sph->neighbours, b) != rest)
                sweep->body(sweep->loop, p->block, b);
    }
    simulation_end_phase(simulation, PHASE_BLOCKS, sweep->phase);
}

static const char *const limit_reasons[] = {[SPH_LIMIT_SOUND] = "sound speed",
                                            [SPH_LIMIT_VOLUME_RATE] = "volume rate",
                                            [SPH_LIMIT_CONDUCTION] = "conduction",
                                            [SPH_LIMIT_SPREAD] = "failure wave"};

struct limit sph_smallest_limit(const struct sph *sph, const struct simulation *simulation,
                                sph_limit_of *limit_of, const void *context)
{
    const struct particles *p = sph->particles;
    struct ranked first = {(double)INFINITY, UINT64_MAX, SPH_LIMIT_SOUND};
#pragma omp parallel num_threads(simulation->threads)
    {
        struct ranked own = first;
#pragma omp for schedule(static)
        for (int32_t i = 0; i < p->count; i++) {
            struct ranked one = limit_of(sph, simulation, context, i);
            one.id = p->id[i];
            if (ranked_before(&one, &own))
                own = one;
        }
#pragma omp critical(bolide_sph_limit)
        if (ranked_before(&own, &first))
            first = own;
    }
    return limit_of_ranks(simulation->ranks, first, limit_reasons);
}
