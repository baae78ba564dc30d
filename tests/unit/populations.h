/* The particles of a simulation, as tests reach them, and particles without a solver. */
#ifndef BOLIDE_TEST_POPULATIONS_H
#define BOLIDE_TEST_POPULATIONS_H

#include <stdlib.h>

#include "model/particles/population.h"
#include "particle/particles.h"

/* The particles of SIMULATION, whose first population they are. */
static inline struct particles *particles_of(const struct simulation *simulation)
{
    return particles_in(&simulation->population[0]);
}

/* The problem of SIMULATION, for tests to change; an empty one where there was none. */
static inline struct problem *problem_of(struct simulation *simulation)
{
    if (!simulation->problem)
        simulation->problem = calloc(1, sizeof *simulation->problem);
    if (!simulation->problem)
        abort();
    return (struct problem *)simulation->problem;
}

/* Gives SIMULATION particles that no solver owns. */
static inline struct error *give_particles(struct simulation *simulation, double cell,
                                           const struct field_declaration *more, int count)
{
    struct particles *particles;
    return particles_add(simulation, cell, more, count, &particles);
}

/* Takes them away again; nothing where there are none. */
static inline void free_particles(struct simulation *simulation)
{
    if (!simulation->populations)
        return;
    struct particles *particles = particles_of(simulation);
    simulation_remove_population(simulation, particles);
    particles_drop(particles);
}

/* Ends SIMULATION and the particles that no solver owns. */
static inline void end_simulation(struct simulation *simulation)
{
    free_particles(simulation);
    simulation_destroy(simulation);
}

#endif
