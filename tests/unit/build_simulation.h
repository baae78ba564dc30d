/* A simulation of a few particles, made by hand, for the tests of output. */
#ifndef BOLIDE_TEST_BUILD_SIMULATION_H
#define BOLIDE_TEST_BUILD_SIMULATION_H

#include <stdlib.h>

#include "populations.h"

/* COUNT particles on a line of spacing 1 mm, each with values of its own. Free with
 * drop_simulation. */
static inline struct simulation *build_simulation(int32_t count)
{
    static const struct ranks alone = {0, 1, false};
    struct simulation *simulation = calloc(1, sizeof *simulation);
    simulation->ranks = &alone;
    simulation->threads = 1;
    problem_of(simulation)->dimension = 3;
    simulation->time = 1.5e-6;
    simulation->step = 42;
    int32_t first;
    if (give_particles(simulation, 0.004, NULL, 0))
        abort();
    struct particles *particles = particles_of(simulation);
    if ((count && (particles_append(particles, count, &first) || particles_commit(particles))))
        abort();
    for (int32_t i = 0; i < count; i++) {
        particles->id[i] = particle_id(i % 2, i);
        particles->material[i] = (uint16_t)(i % 3);
        particles->body[i] = (uint16_t)(i % 2);
        particles->mass[i] = 2.0;
        particles->density[i] = 1000.0 + i;
        particles->energy[i] = 10.0 * i;
        particles->pressure[i] = 1e9 / (1.0 + i);
        particles->position[i][0] = 1e-3 * (i + 0.5);
        particles->position[i][1] = 0.1;
        particles->velocity[i][0] = 3.0;
        particles->velocity[i][1] = 4.0 * (i % 2);
        for (int k = 0; k < 6; k++)
            particles->deviator[i][k] = 1e6 * (k + 1) * (k == 2 ? -1.0 : 1.0);
    }
    return simulation;
}

static inline void drop_simulation(struct simulation *simulation)
{
    end_simulation(simulation);
    free(simulation);
}

#endif
