/* A surface that is pushed, and what its particles contribute to nodes; see outside.c. Private to
 * mpm/. */
#ifndef BOLIDE_MPM_SURFACE_H
#define BOLIDE_MPM_SURFACE_H

#include "mpm/mpm_internal.h"

/* The contributions of a particle to the values of its nodes: value n gets the sum over axes k of
 * by_slope[n][k] dN/dx_k, and of around[n] and what acts around the axis. With stresses on faces,
 * the slope along k includes the factors of the node's faces where k is filled[n], and what acts
 * around the axis those of its ring, so that a pressure balances the stress inside. */
struct given {
    double by_slope[3][3];
    int filled[3];
    double around[3];
    const double *force; /* of the particle itself, by shape functions; NULL: none */
};

/* A loaded surface, and the contributions of its particles. */
struct surface {
    int body;         /* -1: all */
    double low, high; /* range of nodes on the surface, in cells along AXIS */
    int axis;
    struct given (*of)(const struct mpm *, const struct simulation *, const struct surface *,
                       int32_t i);
    const struct load_input *load;
    int index;                       /* of the load */
    double pressure, traction[3];    /* of the load in the middle of the step */
    const double (*force)[3];        /* of particles, by a blast */
    const struct face *outflow;      /* NULL: it is none */
    int outflow_side;                /* enum face_side */
    const double *sound, *viscosity; /* of particles, at an outflow */
    const struct mpm_outside *outside;
    double reach; /* how far from a face its surface may be, in nodes */
};

/* The force of what is outside, at the node AT with AREA of the surface. */
void mpm_push_area(const struct mpm_outside *outside, const int64_t at[3], const double area[3],
                   double force[3]);

/* Adds the forces in the second field of LAYER, in which walls have no part yet, to those that
 * mpm_book_surfaces books under CAUSE; of what is outside, the areas. */
void mpm_note_pushed(struct layer *layer, enum surface_cause cause, int threads);

/* Books the forces in the second field of LAYER, in which walls have no part yet, as the impulse
 * that a load delivers in a step of DT. */
void mpm_book_load(const struct mpm *mpm, const struct layer *layer, double dt,
                   struct load_record *record);

#endif
