/* The population of solvers whose members are particles; see particle_population.h. */
#include "model/particle_population.h"

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

static bool changed(const void *store)
{
    const struct particles *particles = store;
    return particles->pending > 0 || particles->deleted > 0;
}

static struct error *commit(void *store) { return particles_commit(store); }

static struct error *distribute(void *store) { return particles_distribute(store, 0.0, true); }

static struct error *visit(void *store, struct visitor *visitor)
{
    return particles_visit(store, visitor);
}

static uint64_t hash(const void *store) { return particles_hash(store); }

static void destroy(void *store) { particles_destroy(store); }

const struct population_class particle_population = {.size = sizeof(struct particles),
                                                     .members = members,
                                                     .changed = changed,
                                                     .commit = commit,
                                                     .distribute = distribute,
                                                     .visit = visit,
                                                     .hash = hash,
                                                     .destroy = destroy};

struct error *particles_add(struct simulation *simulation, double cell,
                            const struct field_declaration *more, int count)
{
    TRY(simulation_populate(simulation, &particle_population));
    struct particles *particles = particles_of(simulation);
    TRY(particles_create(simulation->dimension, cell, more, count, particles));
    if (!simulation->ranks) /* no run */
        return NULL;
    particles->ranks = simulation->ranks;
    particles->partition = &simulation->partition;
    particles->threads = &simulation->threads;
    return NULL;
}
