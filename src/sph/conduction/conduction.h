/* Heat conduction: a pass of its own over the neighbours of a step, beside that of a scheme.
 * Private to SPH. Source: Parshikov (2013), section 1.3. */
#ifndef BOLIDE_SPH_CONDUCTION_H
#define BOLIDE_SPH_CONDUCTION_H

#include "model/particles/population.h"
#include "model/solver.h"

struct sph;
struct sph_parameters;
struct sph_fields;

struct conduction {
    double limit; /* beta of dt = beta rho C_V h^2/lambda (1.49) */
    double *record;
    int64_t capacity; /* in records */
};

bool conduction_on(const struct sph_parameters *parameters);

/* The step that conduction allows a particle of DIAMETER at DENSITY, INFINITY when it is off. */
double conduction_step(const struct sph_parameters *parameters, int dimension,
                       const struct heat *heat, double density, double diameter);

/* ERROR_INPUT at a material that lacks what conduction needs. */
struct error *conduction_create(struct sph *sph, const struct simulation *simulation);

/* Room for the records of all particles and ghosts. */
struct error *conduction_reserve(struct sph *sph);

/* Collective: heat rates of all particles as they stand, and lowers LIMIT to what they allow. */
void conduction_prepare(struct sph *sph, struct simulation *simulation,
                        const struct sph_fields *fields, struct limit *limit);

void conduction_destroy(struct sph *sph);

#endif
