/* Populations; see population.h. */
#include "model/population.h"

struct population population_of_particles(const struct particles *particles)
{
    return (struct population){.dimension = particles->dimension,
                               .threads = particles->threads,
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
                               .deviator = (const double(*)[6])particles->deviator};
}
