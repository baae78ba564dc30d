/* What a coupling uses of the material point method beside the functions of its class: its
 * particles, the forces of what is outside a box, and particles that come in. */
#ifndef BOLIDE_MPM_PHASES_H
#define BOLIDE_MPM_PHASES_H

#include "grid/grid_shape.h"
#include "mpm/mpm.h"
#include "particle/particles.h"

struct mpm;

/* What is outside has done to a node in a step: the impulse, the outward area of the particles'
 * surface times the step, and the mean velocity of the node. Of all ranks together they are in
 * ORDER, compared number by number. */
struct mpm_push {
    int64_t at[3];
    double impulse[3], area[3], velocity[3];
    uint64_t order[3];
};
double mpm_push_work(const struct mpm_push *push); /* J */

/* A box of cells with a fluid outside its open faces, which pushes on the surface of the particles
 * there. Gives the pressure, less that of the gauge, at the node AT near an open face, of its force
 * along COMPONENT; takes down what this rank's nodes get in a step, in order. Called by one
 * thread. */
struct mpm_outside {
    int64_t low[3], high[3]; /* nodes of its faces */
    bool open[3][2];         /* faces */
    void *of;
    double (*pressure)(void *of, const int64_t at[3], int component);
    void (*pushed)(void *of, const struct mpm_push *push);
};

/* OUTSIDE must last; NULL: nothing is outside. */
void mpm_surround(struct mpm *mpm, const struct mpm_outside *outside);

/* From now on the speeds of sound that limit the step are means at nodes, see limit.c. */
void mpm_limit_by_nodes(struct mpm *mpm);

struct particles *mpm_particles(const struct mpm *mpm);
/* Half the size of the particles of BODY, in cells, and how their shape functions fall off. */
double mpm_half_size(const struct mpm *mpm, int body);
enum grid_shape mpm_shape(const struct mpm *mpm);
/* The ambient pressure of MATERIAL that forces leave out, Pa. */
double mpm_gauge(const struct mpm *mpm, int material);

/* Particle I, appended with body, material, mass, density, energy, position and velocity, gets all
 * that follows from them. */
void mpm_welcome(const struct mpm *mpm, const struct simulation *simulation, int32_t i);

#endif
