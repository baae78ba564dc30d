/* What a solver computes with, as everything that watches a run sees it: its members, each with
 * an id, a place, a mass, a density and a velocity. Measures, totals, histories and pictures
 * know no more of a solver than this and its views. */
#ifndef BOLIDE_POPULATION_H
#define BOLIDE_POPULATION_H

#include "particle/particles.h"

/* The members that this rank owns. A handful of pointers, to be asked for again after each step. */
struct population {
    int dimension;
    int threads; /* for loops over the members */
    int32_t count;
    uint64_t order; /* an index means the same member while it stays */
    const uint64_t *id;
    const uint16_t *material, *body;
    const double *mass, *density, *energy, *pressure; /* energy in J/kg */
    const double (*position)[3], (*velocity)[3], (*deviator)[6];
};

BOLIDE_INLINE struct population population_of_particles(const struct particles *particles)
{
    struct population population;
    population.dimension = particles->dimension;
    population.threads = particles->threads;
    population.count = particles->count;
    population.order = particles->order;
    population.id = particles->id;
    population.material = particles->material;
    population.body = particles->body;
    population.mass = particles->mass;
    population.density = particles->density;
    population.energy = particles->energy;
    population.pressure = particles->pressure;
    population.position = (const double(*)[3])particles->position;
    population.velocity = (const double(*)[3])particles->velocity;
    population.deviator = (const double(*)[6])particles->deviator;
    return population;
}

#endif
