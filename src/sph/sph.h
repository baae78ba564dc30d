/* Smoothed particle hydrodynamics: contact (Riemann) SPH and, as its baseline, standard SPH with artificial
 * viscosity. Source: Parshikov (2013), chapter 1. */
#ifndef BOLIDE_SPH_H
#define BOLIDE_SPH_H

#include "model/solver.h"

enum sph_method { SPH_CONTACT, SPH_STANDARD };
enum sph_contact { SPH_CONTACT_ACOUSTIC, SPH_CONTACT_DUKOWICZ, SPH_CONTACT_EXACT_GAS };
enum sph_energy { SPH_ENERGY_TOTAL, SPH_ENERGY_INTERNAL };
enum sph_motion { SPH_MOTION_PARTICLE, SPH_MOTION_CONTACT, SPH_MOTION_NONE };
enum sph_rotation { SPH_ROTATION_FAITHFUL, SPH_ROTATION_CORRECTED };
enum sph_conduction { SPH_CONDUCTION_NONE, SPH_CONDUCTION_CONTACT, SPH_CONDUCTION_HARMONIC };

struct sph_parameters {
    int method;
    int contact;
    double smoothing, courant;
    int energy, motion, rotation;
    double viscosity_quadratic, viscosity_linear;
    int conduction;
    double conduction_limit; /* NAN: by form and dimension */
    double skin;
    int64_t rebuild;
};

/* `solver: {sph: {...}}`; its thing is the solver_class. */
extern const struct choice sph_choice;

#endif
