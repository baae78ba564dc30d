/* Damage that spreads: records from states and the spread loop; see spread.h. */
#include "sph/spread/spread.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "material/material.h"
#include "sph/scheme.h"
#include "sph/spread/kernel.h"

void spread_create(struct sph *sph, const struct simulation *simulation)
{
    for (int m = 0; m < simulation->problem->materials; m++)
        sph->spread.pace =
            maximum(sph->spread.pace,
                    1.0 / strength_spread_step(&simulation->problem->material[m].strength, 1.0));
}

struct error *spread_reserve(struct sph *sph)
{
    const int64_t count = (int64_t)sph->particles->count + sph->neighbours.ghosts.count + 1;
    if (!memory_reserve((void **)&sph->spread.record, &sph->spread.capacity, count, 0,
                        SPREAD_STRIDE * sizeof(double)))
        return out_of_memory_for("the damage of %lld particles", (long long)count);
    return exchange_reserve(&sph->neighbours.ghosts.exchange, SPREAD_STRIDE * sizeof(double));
}

/* Record of particle I; see kernel.h for the order. */
static void pack_owned(const struct simulation *simulation, const struct sph_fields *f, int32_t i,
                       double *record)
{
    const struct particles *p = f->particles;
    int k = 0;
    for (int axis = 0; axis < simulation->problem->dimension; axis++)
        record[k++] = p->position[i][axis];
    record[k++] = sph_support(f, i);
    record[k++] = sph_volume(simulation, f, i);
    record[k++] = p->history[HISTORY_damage][i];
    record[k++] = p->body[i];
    while (k < SPREAD_STRIDE)
        record[k++] = 0.0;
}

/* An image has the damage of its particle. */
static void reflect(const struct sph *sph, const struct simulation *simulation, image_code image,
                    double *record)
{
    (void)sph;
    sph_reflect_place(simulation, image, record);
}

static void gradients_of_block(const void *of, const struct block *blocks, int32_t b)
{
    spread_loop_run(of, blocks[b].first, blocks[b].first + blocks[b].count);
}

void spread_prepare(struct sph *sph, struct simulation *simulation, const struct sph_fields *fields)
{
    const struct particles *p = sph->particles;
    const struct sph_records records = {sph->spread.record, SPREAD_STRIDE, reflect, NULL};
    bool spreads[MATERIALS_MAX];
    for (int m = 0; m < simulation->problem->materials; m++)
        spreads[m] = strength_spreads(&simulation->problem->material[m].strength);
    const struct spread_loop loop = {.dimension = simulation->problem->dimension,
                                     .record = records.first,
                                     .empty = p->count + sph->neighbours.ghosts.count,
                                     .smoothing = sph->parameters.smoothing,
                                     .neighbours = &sph->neighbours,
                                     .spreads = spreads,
                                     .material = p->material,
                                     .gradient = fields->damage_gradient};
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++)
        pack_owned(simulation, fields, i, records.first + (size_t)i * SPREAD_STRIDE);
    sph_records_start(sph, simulation, &records);
    sph_sweep(sph, simulation, &records,
              &(struct sph_sweep){gradients_of_block, &loop, 4, "damage"});
}

void spread_destroy(struct sph *sph) { free(sph->spread.record); }
