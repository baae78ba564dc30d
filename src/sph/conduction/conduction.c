/* Heat conduction: records from states, the heat loop, and the largest stable step; see
 * conduction.h. */
#include "sph/conduction/conduction.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "material/material.h"
#include "sph/conduction/kernel.h"
#include "sph/scheme.h"

bool conduction_on(const struct sph_parameters *parameters)
{
    return parameters->conduction != SPH_CONDUCTION_NONE;
}

/* The source's 0.35 is for a line. An explicit step on a square or cubic lattice turns unstable at
 * 0.37 and 0.33 for smoothing 1, and keeps a temperature between those about it up to 0.29 and
 * 0.23. */
static double standard_limit(int conduction, int dimension)
{
    if (conduction == SPH_CONDUCTION_HARMONIC)
        return 0.15;
    return dimension == 1 ? 0.35 : 0.2;
}

static double limit_of(const struct sph_parameters *parameters, int dimension)
{
    return isnan(parameters->conduction_limit) ? standard_limit(parameters->conduction, dimension)
                                               : parameters->conduction_limit;
}

double conduction_step(const struct sph_parameters *parameters, int dimension,
                       const struct heat *heat, double density, double diameter)
{
    if (!conduction_on(parameters))
        return (double)INFINITY;
    double diffusivity = heat->conductivity / (density * heat->capacity);
    return limit_of(parameters, dimension) * square(parameters->smoothing * diameter) / diffusivity;
}

static struct error *check_material(const struct simulation *simulation, int m)
{
    const struct simulation_case *input = simulation->problem->input;
    const struct material *material = &simulation->problem->material[m];
    const char *name = input->materials.names[m];
    const char *wrong = heat_wrong(&material->heat, &material->eos);
    if (wrong)
        return input_error(input, "materials", name,
                           "conduction needs the material's temperature, but %s", wrong);
    if (isnan(material->heat.conductivity))
        return input_error(input, "materials", name,
                           "conduction needs `heat: {conductivity: ...}`; 0 W/(m*K) for none");
    return NULL;
}

struct error *conduction_create(struct sph *sph, const struct simulation *simulation)
{
    const struct sph_parameters *parameters = &sph->parameters;
    if (!conduction_on(parameters))
        return NULL;
    sph->conduction.limit = limit_of(parameters, simulation->problem->dimension);
    struct error *error = NULL;
    for (int m = 0; m < simulation->problem->materials; m++)
        error = error_join(error, check_material(simulation, m));
    return error;
}

struct error *conduction_reserve(struct sph *sph)
{
    int64_t count = (int64_t)sph->particles->count + sph->neighbours.ghosts.count + 1;
    if (!memory_reserve((void **)&sph->conduction.record, &sph->conduction.capacity, count, 0,
                        HEAT_STRIDE * sizeof(double)))
        return out_of_memory_for("the heat of %lld particles", (long long)count);
    return exchange_reserve(&sph->neighbours.ghosts.exchange, HEAT_STRIDE * sizeof(double));
}

/* Record of particle I; see kernel.h for the order. */
static void pack_owned(const struct simulation *simulation, const struct sph_fields *f, bool deep,
                       int32_t i, double *record)
{
    const struct particles *p = f->particles;
    const struct material *material = &simulation->problem->material[p->material[i]];
    const struct heat *heat = &material->heat;
    int k = 0;
    for (int axis = 0; axis < simulation->problem->dimension; axis++)
        record[k++] = p->position[i][axis];
    record[k++] = sph_support(f, i);
    record[k++] = sph_volume(simulation, f, i);
    record[k++] = heat_temperature(heat, &material->eos, p->density[i], p->energy[i]);
    record[k++] = heat->conductivity;
    record[k++] = sqrt(heat->conductivity / (p->density[i] * heat->capacity)); /* (1.52) */
    if (deep)
        record[k++] = sph_depth(simulation, f, i);
    while (k < HEAT_STRIDE)
        record[k++] = 0.0;
}

/* An image has the temperature of its particle: walls are adiabatic. */
static void reflect(const struct sph *sph, const struct simulation *simulation, image_code image,
                    double *record)
{
    (void)sph;
    sph_reflect_place(simulation, image, record);
    if (sph_axisymmetric(simulation) && image % 3 == 1) /* the other side of the axis */
        record[heat_record_depth(2)] *= -1.0;
}

/* dt = beta h^2/a (1.49) with h = alpha D_i. */
static struct ranked limit_of_particle(const struct sph *sph, const struct simulation *simulation,
                                       const void *context, int32_t i)
{
    const struct sph_fields *f = context;
    const int q = heat_record_diffusivity(simulation->problem->dimension);
    const double root = sph->conduction.record[(size_t)i * HEAT_STRIDE + (size_t)q];
    return (struct ranked){sph->conduction.limit *
                               square(sph->parameters.smoothing * f->diameter[i] / root),
                           0, SPH_LIMIT_CONDUCTION};
}

static void rates_of_block(const void *of, const struct block *blocks, int32_t b)
{
    heat_loop_run(of, blocks[b].first, blocks[b].first + blocks[b].count);
}

void conduction_prepare(struct sph *sph, struct simulation *simulation,
                        const struct sph_fields *fields, struct limit *limit)
{
    const struct particles *p = sph->particles;
    const struct sph_records records = {sph->conduction.record, HEAT_STRIDE, reflect, NULL};
    const struct heat_loop loop = {.kind = {simulation->problem->dimension, sph_deep(simulation),
                                            sph->parameters.conduction == SPH_CONDUCTION_CONTACT
                                                ? HEAT_CONTACT
                                                : HEAT_HARMONIC},
                                   .record = records.first,
                                   .empty = p->count + sph->neighbours.ghosts.count,
                                   .smoothing = sph->parameters.smoothing,
                                   .neighbours = &sph->neighbours,
                                   .density = p->density,
                                   .rate = fields->heat_rate};
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++)
        pack_owned(simulation, fields, loop.kind.depth, i, records.first + (size_t)i * HEAT_STRIDE);
    sph_records_start(sph, simulation, &records);
    sph_sweep(sph, simulation, &records, &(struct sph_sweep){rates_of_block, &loop, 4, "heat"});
    const struct limit own = sph_smallest_limit(sph, simulation, limit_of_particle, fields);
    if (own.dt < limit->dt)
        *limit = own;
}

void conduction_destroy(struct sph *sph) { free(sph->conduction.record); }
