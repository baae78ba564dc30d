/* Smoothed particle hydrodynamics: contact (Riemann) SPH and, as its baseline, standard SPH with artificial
 * viscosity. Source: Parshikov (2013), chapter 1. */
#ifndef BOLIDE_SPH_H
#define BOLIDE_SPH_H

#include "model/solver.h"

enum sph_method { SPH_CONTACT, SPH_STANDARD, SPH_MUSCL, SPH_HLLC, SPH_MONAGHAN };
enum sph_contact { SPH_CONTACT_ACOUSTIC, SPH_CONTACT_DUKOWICZ, SPH_CONTACT_EXACT_GAS };
enum sph_energy { SPH_ENERGY_TOTAL, SPH_ENERGY_INTERNAL };
enum sph_motion { SPH_MOTION_PARTICLE, SPH_MOTION_CONTACT, SPH_MOTION_NONE };
enum sph_rotation { SPH_ROTATION_FAITHFUL, SPH_ROTATION_CORRECTED };
enum sph_conduction { SPH_CONDUCTION_NONE, SPH_CONDUCTION_CONTACT, SPH_CONDUCTION_HARMONIC };
enum sph_continuity { SPH_CONTINUITY_VOLUME, SPH_CONTINUITY_MASS };
enum sph_correction { SPH_CORRECTION_OWN, SPH_CORRECTION_SYMMETRIC };
enum sph_reconstruction {
    SPH_RECONSTRUCTION_NONE,
    SPH_RECONSTRUCTION_VELOCITY,
    SPH_RECONSTRUCTION_ALL
};
enum sph_pair_stress { SPH_PAIR_STRESS_SQUARES, SPH_PAIR_STRESS_PRODUCT };

struct sph_parameters {
    int method;
    int contact;
    double smoothing, courant; /* NAN: by method */
    int energy, motion, rotation;
    double viscosity_quadratic, viscosity_linear;
    int conduction;
    double conduction_limit;                    /* NAN: by form and dimension */
    int continuity, correction, reconstruction; /* of hllc and monaghan */
    bool approach_switch;
    int pair_stress;
    double viscosity_alpha, viscosity_beta;
    double skin;
    int64_t rebuild;
};

/* `solver: {sph: {...}}`. */
extern const struct parameter sph_table[];
extern const struct solver_class sph_class;

#endif
