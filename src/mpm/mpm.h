/* The material point method: particles carry the material, a grid that is forgotten after each step
 * carries the forces. Source: Cui, dissertation (2014), chapter 2, and the public practice of the
 * codes of the same group. */
#ifndef BOLIDE_MPM_H
#define BOLIDE_MPM_H

#include "model/solver.h"

enum mpm_scheme { MPM_MUSL, MPM_USL, MPM_USF };
enum mpm_transfer { MPM_FLIP, MPM_APIC, MPM_TPIC };
enum mpm_rotation { MPM_EXACT, MPM_JAUMANN };
enum mpm_quadrature { MPM_PARTICLES, MPM_FACES };
enum mpm_energy { MPM_ENERGY_CONSERVED, MPM_ENERGY_WORK };
enum mpm_damping { MPM_DAMPING_PLAIN, MPM_DAMPING_SYMMETRIC };

struct mpm_parameters {
    double cell; /* NAN: twice the spacing of particles */
    int shape;   /* enum grid_shape */
    int scheme, transfer;
    int64_t order; /* of velocities of nodes */
    double flip;
    double courant; /* NAN: by the materials */
    int quadrature, energy;
    int rotation;
    double viscosity_quadratic, viscosity_linear, viscosity_unresolved; /* NAN: see mpm_table */
    double shock_mixing;
    double shear_damping;
    int damping;
    double gauge_pressure;
};

/* `solver: {mpm: {...}}`. */
extern const struct parameter mpm_table[];
extern const struct solver_class mpm_class;

/* Those of the class, for couplings whose parameters begin with those of mpm. */
double mpm_bytes(const void *parameters, int dimension);
double mpm_step_beside_gas(const void *parameters, const struct simulation_case *input,
                           const struct material *material, const struct point *point,
                           double diameter);
void mpm_coarsen(void *parameters, double factor);

/* Why its total energy drifts, for couplings, too. */
extern const char mpm_energy_lost[];

#endif
