/* Smoothed particle hydrodynamics: contact (Riemann) SPH and, as its baseline, standard SPH with artificial
 * viscosity. Source: Parshikov (2013), chapter 1. */
#ifndef BOLIDE_SPH_H
#define BOLIDE_SPH_H

#include "model/solver.h"

enum sph_method { SPH_CONTACT, SPH_STANDARD };
enum sph_energy { SPH_ENERGY_TOTAL, SPH_ENERGY_INTERNAL };

struct sph_parameters {
    int method;
    int contact; /* enum sph_contact: the contact solver */
    double smoothing, courant;
    int energy;
    double viscosity_quadratic, viscosity_linear;
    double skin;
    int64_t rebuild;
};

enum sph_contact { SPH_CONTACT_ACOUSTIC };

/* `solver: {sph: {...}}`; its thing is the solver_class. */
extern const struct choice sph_choice;

#endif
