/* The faces of a place as particles see them, and what of a case's boundaries a solver cannot
 * do. */
#ifndef BOLIDE_BOUNDARIES_H
#define BOLIDE_BOUNDARIES_H

#include "model/solver.h"

/* FACE as mirrors and periods of particles. */
struct mirrors boundaries_images(const struct face face[3][2]);

/* Finds boundaries that a solver without those of SUPPORTED, bits of solver_class.boundaries, does
 * not have; of particles also faces that do not bound the bodies. */
void boundaries_refuse(struct findings *findings, unsigned supported);
void boundaries_refuse_of_particles(struct findings *findings, unsigned supported);

#endif
