/* The population of solvers whose members are particles; see population.h. */
#include "model/particles/population.h"

#include <stdlib.h>

#include "base/memory.h"
#include "particle/halo.h"

struct population population_of_particles(const struct particles *particles)
{
    return (struct population){.kind = POPULATION_OF_PARTICLES,
                               .dimension = particles->dimension,
                               .threads = *particles->threads,
                               .count = particles->count,
                               .order = particles->order,
                               .id = particles->id,
                               .material = particles->material,
                               .body = particles->body,
                               .mass = particles->mass,
                               .density = particles->density,
                               .energy = particles->energy,
                               .pressure = particles->pressure,
                               .position = (const double(*)[3])particles->position,
                               .velocity = (const double(*)[3])particles->velocity,
                               .deviator = (const double(*)[6])particles->deviator,
                               .fields = particles->fields,
                               .field = particles->field};
}

static struct population members(const void *store) { return population_of_particles(store); }

static void add(void *store, const struct field_declaration *more, int count)
{
    particles_declare(store, more, count);
}

static bool changed(const void *store)
{
    const struct particles *particles = store;
    return particles->pending > 0 || particles->deleted > 0;
}

static struct error *commit(void *store) { return particles_commit(store); }

static struct error *distribute(void *store) { return particles_distribute(store, true); }

static struct error *visit(void *store, struct visitor *visitor)
{
    return particles_visit(store, visitor);
}

static uint64_t hash(const void *store) { return particles_hash(store); }

const struct population_class particle_population = {.members = members,
                                                     .add = add,
                                                     .changed = changed,
                                                     .commit = commit,
                                                     .distribute = distribute,
                                                     .visit = visit,
                                                     .hash = hash};

struct error *particles_add(struct simulation *simulation, double cell,
                            const struct field_declaration *more, int count,
                            struct particles **made)
{
    struct particles *particles = memory_allocate(sizeof *particles);
    *made = particles;
    if (!particles)
        return out_of_memory();
    TRY(particles_create(simulation->problem->dimension, cell, more, count, particles));
    simulation_add_population(simulation, "particles", &particle_population, particles);
    if (!simulation->ranks) /* no run */
        return NULL;
    particles->ranks = simulation->ranks;
    particles->partition = &simulation->partition;
    particles->threads = &simulation->threads;
    return NULL;
}

void particles_drop(struct particles *particles)
{
    if (particles)
        particles_destroy(particles);
    free(particles);
}

struct error *particles_see(const struct population *population, const double *diameter,
                            double link, struct ghosts *ghosts)
{
    struct halo halo = {0};
    struct error *error = halo_plan(particles_in(population->source), NULL,
                                    (struct reach){diameter, link}, 0.0, ghosts, &halo);
    halo_free(&halo);
    return error;
}
