/* Damage that spreads through a material: the gradient that its strength asks for, by a pass of its
 * own over the neighbours of a step. Private to SPH. */
#ifndef BOLIDE_SPH_SPREAD_H
#define BOLIDE_SPH_SPREAD_H

#include "model/particles/population.h"
#include "model/solver.h"

struct sph;
struct sph_fields;

struct spread {
    double pace; /* the diameter of a particle over the step that fronts allow, m/s; 0: any */
    double *record;
    int64_t capacity; /* in records */
};

void spread_create(struct sph *sph, const struct simulation *simulation);

/* Room for the records of all particles and ghosts. */
struct error *spread_reserve(struct sph *sph);

/* Collective: gradients of the damage of all particles as they stand. */
void spread_prepare(struct sph *sph, struct simulation *simulation,
                    const struct sph_fields *fields);

void spread_destroy(struct sph *sph);

#endif
