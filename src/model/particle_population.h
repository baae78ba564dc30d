/* The population of solvers whose members are particles. */
#ifndef BOLIDE_PARTICLE_POPULATION_H
#define BOLIDE_PARTICLE_POPULATION_H

#include "model/simulation.h"
#include "particle/particles.h"

extern const struct population_class particle_population;

/* The particles of SIMULATION, which has them. */
BOLIDE_INLINE struct particles *particles_of(const struct simulation *simulation)
{
    assert(simulation->members == &particle_population);
    return (struct particles *)simulation->store;
}

struct population population_of_particles(const struct particles *particles);

/* Gives SIMULATION particles, none yet, in cells of edge CELL, with the core's fields and COUNT more. */
struct error *particles_add(struct simulation *simulation, double cell,
                            const struct field_declaration *more, int count);

#endif
