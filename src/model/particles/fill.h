/* The particles of the bodies of a case. */
#ifndef BOLIDE_FILL_H
#define BOLIDE_FILL_H

#include "model/simulation.h"

struct particles;

/* Collective. Appends the particles of all bodies to PARTICLES, each rank its slice of every
 * lattice, with id, body, material, mass, density, energy, position and velocity, and commits.
 * Fails as generate_count does. A particle's mass is rho times the volume of its site. In
 * axisymmetry x is the radius: bodies are cut at the axis. */
struct error *generate_particles(const struct simulation *simulation, struct particles *particles);

#endif
