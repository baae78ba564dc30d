/* The state of the material point method and the parts of its step. Private to this room. */
#ifndef BOLIDE_MPM_INTERNAL_H
#define BOLIDE_MPM_INTERNAL_H

#include "mpm/mpm.h"
#include "mpm/transfer.h"

/* A node on a wall or, where shape functions reach beyond walls, next to one. */
struct wall_node {
    double *node, *back; /* in the two fields */
    int64_t at[3];
    double sum[NODE_STRIDE]; /* of the particles alone, before what is behind the wall is added */
};

struct mpm {
    struct mpm_parameters parameters;
    double edge;       /* of a cell, m */
    double *half_size; /* of the particles of each body, in cells */
    double *gauge;     /* of each material, Pa */
    double least_mass; /* of a node whose velocity counts in strain, kg */
    int64_t plane[3][2];
    bool has_plane[3][2]; /* node index of the low and the high wall across each axis */
    struct bins bins;
    struct grid grid;
    struct grid_field main, back;
    struct wall_node *wall;
    int32_t walls;
    int64_t wall_capacity;
    double **rate; /* of the particles of a bin, one a thread */
    int threads;
    int64_t rate_capacity;
    double work; /* seconds that the particles had taken when they were last distributed */
};

/* What the case leaves to the method. */
struct mpm_parameters mpm_settled(const struct mpm_parameters *parameters,
                                  const struct simulation *simulation);

struct transfer mpm_transfer_of(struct mpm *mpm, const struct simulation *simulation);

/* Finds the planes of nodes that the walls lie on; a located error when they lie between. */
struct error *mpm_find_planes(struct mpm *mpm, const struct simulation *simulation);

/* Sums of patches at all nodes; mass, momentum and force then know of walls. */
struct error *mpm_sum_nodes(struct mpm *mpm, const struct simulation *simulation);
/* Adds to the forces at nodes those that stand in the patches of the second field. */
void mpm_add_forces(struct mpm *mpm, const struct simulation *simulation);
/* The step of the nodes (2-13), and what walls push in it. */
void mpm_advance_nodes(struct mpm *mpm, struct simulation *simulation, double dt);
/* Velocities of the second field: of momenta summed from its patches, or with PLAIN of those in the main field. */
void mpm_find_velocities(struct mpm *mpm, const struct simulation *simulation, bool plain);

/* Mean modes of shear in cells of fluid lose force (2-46)-(2-48), and what that takes in DT heats the particles. */
void mpm_damp_shear(struct mpm *mpm, struct simulation *simulation, double dt);

/* Rates RATE of the particles of BIN bring their states to the next level in a step of DT. Returns the index of the one
 * with the smallest id whose new state is impossible, -1 for none. */
int32_t mpm_update_points(const struct mpm *mpm, struct simulation *simulation, int32_t bin,
                          double dt, const double *rate);

/* Pressure and sound speeds of all particles as they stand. */
void mpm_evaluate(struct simulation *simulation);

#endif
