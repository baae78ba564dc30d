/* The population of solvers whose members are particles. */
#ifndef BOLIDE_PARTICLE_POPULATION_H
#define BOLIDE_PARTICLE_POPULATION_H

#include "model/simulation.h"

struct particles;

extern const struct population_class particle_population;

/* The particles that a population is of. */
BOLIDE_INLINE struct particles *particles_in(const struct population_source *population)
{
    assert(population->type == &particle_population);
    return (struct particles *)population->store;
}

struct population population_of_particles(const struct particles *particles);

/* Gives SIMULATION the population "particles", none yet, in cells of edge CELL, with the core's
 * fields and COUNT more. *PARTICLES is the caller's, to be freed with particles_drop. */
struct error *particles_add(struct simulation *simulation, double cell,
                            const struct field_declaration *more, int count,
                            struct particles **particles);
void particles_drop(struct particles *particles);

/* Collective: plans the exchange of GHOSTS, the particles of other ranks within LINK diameters of
 * those of POPULATION, and takes down what they are. Nothing crosses periodic faces. Free them also
 * after an error. */
struct error *particles_see(const struct population *population, const double *diameter,
                            double link, struct ghosts *ghosts);

#endif
