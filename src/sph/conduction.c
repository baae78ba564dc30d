/* Heat conduction: records from states, the heat loop, and the largest stable step; see conduction.h. */
#include "sph/conduction.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "sph/heat_kernel.h"
#include "sph/sph_internal.h"

bool conduction_on(const struct sph *sph)
{
    return sph->parameters.conduction != SPH_CONDUCTION_NONE;
}

/* The source's 0.35 is for a line. An explicit step on a square or cubic lattice turns unstable at 0.37 and 0.33
 * for smoothing 1, and keeps a temperature between those about it up to 0.29 and 0.23. */
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
    if (parameters->conduction == SPH_CONDUCTION_NONE)
        return (double)INFINITY;
    double diffusivity = heat->conductivity / (density * heat->capacity);
    return limit_of(parameters, dimension) * square(parameters->smoothing * diameter) / diffusivity;
}

static struct error *check_material(const struct simulation *simulation, int m)
{
    const struct simulation_case *input = simulation->input;
    const struct material *material = &simulation->material[m];
    const char *name = input->materials.names[m];
    const char *wrong = heat_wrong(&material->heat, &material->eos);
    if (wrong)
        return input_error(input, "materials", name,
                           "conduction wants the material's temperature, but %s", wrong);
    if (isnan(material->heat.conductivity))
        return input_error(input, "materials", name,
                           "conduction wants `heat: {conductivity: ...}`; 0 W/(m*K) for none");
    return NULL;
}

struct error *conduction_create(struct sph *sph, const struct simulation *simulation)
{
    const struct sph_parameters *parameters = &sph->parameters;
    if (!conduction_on(sph))
        return parameters->motion == SPH_MOTION_NONE
                   ? input_error(simulation->input, "solver", "sph.motion",
                                 "nothing happens without motion unless heat flows: give "
                                 "`conduction` as well")
                   : NULL;
    sph->conduction.limit = limit_of(parameters, simulation->dimension);
    struct error *error = NULL;
    for (int m = 0; m < simulation->materials; m++)
        error = error_join(error, check_material(simulation, m));
    return error;
}

struct error *conduction_reserve(struct sph *sph, const struct simulation *simulation)
{
    int64_t count = (int64_t)simulation->particles.count + sph->neighbours.ghosts.count + 1;
    if (!memory_reserve((void **)&sph->conduction.record, &sph->conduction.capacity, count, 0,
                        HEAT_STRIDE * sizeof(double)))
        return error_new(ERROR_SYSTEM, "out of memory for the heat of %lld particles",
                         (long long)count);
    return exchange_reserve(&sph->neighbours.ghosts.exchange, HEAT_STRIDE * sizeof(double));
}

/* Record of particle I; see heat_kernel.h for the order. */
static void pack_owned(const struct simulation *simulation, const struct sph_fields *f, bool deep,
                       int32_t i, double *record)
{
    const struct particles *p = &simulation->particles;
    const struct material *material = &simulation->material[p->material[i]];
    const struct heat *heat = &material->heat;
    int k = 0;
    for (int axis = 0; axis < simulation->dimension; axis++)
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

/* The records of ghosts BEGIN .. END - 1, which are images. An image has the temperature of its particle: walls are
 * adiabatic. */
static void pack_images(struct sph *sph, const struct simulation *simulation, int32_t begin,
                        int32_t end)
{
    const struct ghosts *ghosts = &sph->neighbours.ghosts;
    double *record = sph->conduction.record;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t g = begin; g < end; g++) {
        double *image = record + (size_t)(simulation->particles.count + g) * HEAT_STRIDE,
               x[3] = {0.0};
        memcpy(image, record + (size_t)ghosts->source[g] * HEAT_STRIDE,
               HEAT_STRIDE * sizeof *image);
        memcpy(x, image, (size_t)simulation->dimension * sizeof *x);
        struct vec3 place =
            image_position(&simulation->mirrors, ghosts->image[g], vec3_make(x[0], x[1], x[2]));
        double at[3] = {place.x, place.y, place.z};
        memcpy(image, at, (size_t)simulation->dimension * sizeof *at);
        if (sph_axisymmetric(simulation) && ghosts->image[g] % 3 == 1) /* behind the axis */
            image[heat_record_depth(2)] *= -1.0;
    }
}

static void pack(struct sph *sph, const struct simulation *simulation, const struct sph_fields *f)
{
    const struct particles *p = &simulation->particles;
    struct ghosts *ghosts = &sph->neighbours.ghosts;
    double *record = sph->conduction.record;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++)
        pack_owned(simulation, f, sph->kind.depth, i, record + (size_t)i * HEAT_STRIDE);
    ghosts_start(ghosts, record, p->count, HEAT_STRIDE * sizeof *record);
    pack_images(sph, simulation, ghosts->remotes, ghosts->early);
    memset(record + (size_t)(p->count + ghosts->count) * HEAT_STRIDE, 0,
           HEAT_STRIDE * sizeof *record);
}

/* dt = beta h^2/a (1.49) with h = alpha D_i, the smallest, of equal ones that of the smallest id. */
static void lower_limit(const struct sph *sph, const struct simulation *simulation,
                        const struct sph_fields *f, struct limit *limit)
{
    const struct particles *p = &simulation->particles;
    const int q = heat_record_diffusivity(simulation->dimension);
    struct limit smallest = {(double)INFINITY, "conduction", 0};
#pragma omp parallel num_threads(simulation->threads)
    {
        struct limit own = smallest;
#pragma omp for schedule(static)
        for (int32_t i = 0; i < p->count; i++) {
            double root = sph->conduction.record[(size_t)i * HEAT_STRIDE + (size_t)q];
            double dt =
                sph->conduction.limit * square(sph->parameters.smoothing * f->diameter[i] / root);
            if (dt < own.dt || (dt == own.dt && p->id[i] < own.id)) {
                own.dt = dt;
                own.id = p->id[i];
            }
        }
#pragma omp critical(bolide_conduction_limit)
        if (own.dt < smallest.dt || (own.dt == smallest.dt && own.id < smallest.id))
            smallest = own;
    }
    smallest = sph_least_limit(simulation, smallest);
    if (smallest.dt < limit->dt)
        *limit = smallest;
}

void conduction_prepare(struct sph *sph, struct simulation *simulation,
                        const struct sph_fields *fields, struct limit *limit)
{
    const struct particles *p = &simulation->particles;
    pack(sph, simulation, fields);
    struct heat_loop loop = {
        .dimension = simulation->dimension,
        .depth = sph->kind.depth,
        .form = sph->parameters.conduction == SPH_CONDUCTION_CONTACT ? HEAT_CONTACT : HEAT_HARMONIC,
        .record = sph->conduction.record,
        .empty = p->count + sph->neighbours.ghosts.count,
        .smoothing = sph->parameters.smoothing,
        .neighbours = &sph->neighbours,
        .density = p->density,
        .rate = fields->heat_rate};
    for (int rest = 0; rest < 2; rest++) {
        struct ghosts *ghosts = &sph->neighbours.ghosts;
        if (rest) {
            ghosts_finish(ghosts);
            pack_images(sph, simulation, ghosts->early, ghosts->count);
        }
#pragma omp parallel for schedule(dynamic, 4) num_threads(simulation->threads)
        for (int32_t b = 0; b < p->blocks; b++)
            if (neighbours_inner(&sph->neighbours, b) != rest)
                heat_loop_run(&loop, p->block[b].first, p->block[b].first + p->block[b].count);
    }
    lower_limit(sph, simulation, fields, limit);
}

void conduction_destroy(struct sph *sph) { free(sph->conduction.record); }
