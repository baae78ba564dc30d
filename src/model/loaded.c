/* A checkpoint may have been edited, its checksums made to fit; see loaded.h. */
#include "model/loaded.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "model/generate.h"

static struct error *check_indices(const struct simulation *simulation, int64_t first,
                                   const double *sites)
{
    const struct population population = simulation_population(simulation), *p = &population;
    const int bodies = simulation->problem->input->bodies.count,
              materials = simulation->problem->materials;
    for (int32_t i = 0; i < p->count; i++) {
        const int of = (int)(p->id[i] >> PARTICLE_SITE_BITS);
        if (p->body[i] >= bodies)
            return error_new(ERROR_SYSTEM, "row %lld of body is %d, where the case has %d of them",
                             (long long)(first + i), p->body[i], bodies);
        if (p->material[i] >= materials)
            return error_new(ERROR_SYSTEM,
                             "row %lld of material is %d, where the case has %d of them",
                             (long long)(first + i), p->material[i], materials);
        if (p->kind == POPULATION_OF_CELLS)
            continue; /* their ids are places, which the solver knows */
        const bool created = p->id[i] & PARTICLE_CREATED;
        if (of >= bodies || (!created && (double)(p->id[i] & PARTICLE_SITE) >= sites[of]))
            return error_new(ERROR_SYSTEM, "row %lld of id is %llu, a site that no body has",
                             (long long)(first + i), (unsigned long long)p->id[i]);
    }
    return NULL;
}

/* What a number of a field can be, and in words. */
struct member_range {
    double least, most;
    const char *text;
};

/* Where nothing is faster than light, nothing is farther than light from where bodies began. */
static double farthest(const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    double reach = 0.0;
    for (int body = 0; body < input->bodies.count; body++) {
        const struct bounds bounds = body_bounds(input, body);
        for (int axis = 0; axis < 3; axis++)
            reach = maximum(
                reach, maximum(fabs(vec3_at(bounds.low, axis)), fabs(vec3_at(bounds.high, axis))));
    }
    return reach + SPEED_OF_LIGHT * simulation->time;
}

static struct member_range range_of(const struct simulation *simulation,
                                    const struct population *population, const struct field *field)
{
    static const double TINY = 1e-300, ROUNDING = 1e-3;
    const unsigned kind = field->declaration.kind;
    const void *numbers = field->data;
    if (kind & FIELD_POSITIVE)
        return (struct member_range){TINY, INFINITY, "a positive number"};
    if (kind & FIELD_NOT_NEGATIVE)
        return (struct member_range){0.0, INFINITY, "a number that is not negative"};
    if (kind & FIELD_FRACTION)
        return (struct member_range){-ROUNDING, 1.0 + ROUNDING, "a number from 0 to 1"};
    if (numbers == population->velocity)
        return (struct member_range){-SPEED_OF_LIGHT, SPEED_OF_LIGHT,
                                     "a speed below that of light"};
    if (numbers == population->position && population->kind == POPULATION_OF_PARTICLES) {
        const double reach = farthest(simulation);
        return (struct member_range){-reach, reach, "a place that light can have reached"};
    }
    return (struct member_range){-INFINITY, INFINITY, "a finite number"};
}

static struct error *check_field(const struct simulation *simulation, int64_t first,
                                 const struct field *field)
{
    const struct population population = simulation_population(simulation);
    const int components = field->declaration.components;
    const double *number = field->data;
    const struct member_range range = range_of(simulation, &population, field);
    /* a cell that an obstacle blocks has neither mass nor density */
    const double *mass = population.mass;
    const bool cells = population.kind == POPULATION_OF_CELLS && number == population.density;
    for (int64_t k = 0; k < (int64_t)population.count * components; k++)
        if (!(isfinite(number[k]) && number[k] >= range.least && number[k] <= range.most) &&
            !(cells && mass[k] == 0.0 && number[k] == 0.0))
            return error_new(ERROR_SYSTEM, "row %lld of %s is %g, where %s is wanted",
                             (long long)(first + k / components), field->declaration.name,
                             number[k], range.text);
    return NULL;
}

static int by_number(const void *left, const void *right)
{
    const uint64_t a = *(const uint64_t *)left, b = *(const uint64_t *)right;
    return (a > b) - (a < b);
}

/* Two members of one id would be one to neighbour lists and output. */
static struct error *check_doubled(const struct population *population)
{
    const size_t count = (size_t)population->count;
    uint64_t *id = memory_allocate((count + 1) * sizeof *id);
    struct error *error = id ? NULL : out_of_memory();
    if (id && count > 0) {
        memcpy(id, population->id, count * sizeof *id);
        qsort(id, count, sizeof *id, by_number);
    }
    for (size_t i = 1; i < count && !error; i++)
        if (id[i] == id[i - 1])
            error = error_new(ERROR_SYSTEM, "id %llu is there twice", (unsigned long long)id[i]);
    free(id);
    return error;
}

/* Sites of each body's lattice; free it. */
static double *count_sites(const struct simulation_case *input)
{
    double *sites = memory_allocate((size_t)input->bodies.count * sizeof *sites);
    for (int body = 0; sites && body < input->bodies.count; body++)
        sites[body] = body_lattice(input, body).sites;
    return sites;
}

struct error *simulation_check_loaded(const struct simulation *simulation)
{
    const struct population population = simulation_population(simulation);
    const int64_t first = ranks_before(simulation->ranks, population.count);
    if (!(simulation->time >= 0.0 && simulation->time <= simulation->problem->input->run.until))
        return error_new(ERROR_SYSTEM, "time is %g s, where the run goes from 0 to %g s",
                         simulation->time, simulation->problem->input->run.until);
    if (simulation->step < 0 || simulation->step > INT64_MAX / 2)
        return error_new(ERROR_SYSTEM, "step is %lld, which no run reaches",
                         (long long)simulation->step);
    double *sites = count_sites(simulation->problem->input);
    struct error *error = sites ? check_indices(simulation, first, sites) : out_of_memory();
    free(sites);
    if (!error)
        error = check_doubled(&population);
    for (int k = 0; k < population.fields && !error; k++) {
        const struct field_declaration *field = &population.field[k].declaration;
        if (field->kind & FIELD_STATE && field->number == NUMBER_DOUBLE)
            error = check_field(simulation, first, &population.field[k]);
    }
    return error;
}
