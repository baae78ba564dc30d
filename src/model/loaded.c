/* A checkpoint may have been edited, its checksums made to fit; see loaded.h. */
#include "model/loaded.h"

#include <stdlib.h>

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

static struct error *check_field(const struct simulation *simulation, int64_t first,
                                 const struct field *field)
{
    const struct population population = simulation_population(simulation);
    const int components = field->declaration.components;
    const double *number = field->data;
    const bool positive = number == population.mass || number == population.density;
    /* a cell that an obstacle blocks has neither */
    const double *mass = population.mass, *density = population.density;
    const bool cells = population.kind == POPULATION_OF_CELLS;
    for (int64_t k = 0; k < (int64_t)population.count * components; k++)
        if (!isfinite(number[k]) ||
            (positive && number[k] <= 0.0 && !(cells && mass[k] == 0.0 && density[k] == 0.0)))
            return error_new(
                ERROR_SYSTEM, "row %lld of %s is %g, %s", (long long)(first + k / components),
                field->declaration.name, number[k],
                positive ? "where a positive number is wanted" : "where a finite number is wanted");
    return NULL;
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
    struct error *error =
        sites ? check_indices(simulation, first, sites) : error_new(ERROR_SYSTEM, "out of memory");
    free(sites);
    for (int k = 0; k < population.fields && !error; k++) {
        const struct field_declaration *field = &population.field[k].declaration;
        if (field->kind & FIELD_STATE && field->number == NUMBER_DOUBLE)
            error = check_field(simulation, first, &population.field[k]);
    }
    return error;
}
