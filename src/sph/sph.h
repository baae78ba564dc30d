/* Smoothed particle hydrodynamics: contact (Riemann) SPH of first and second order, SPH with
 * corrected gradients and elastic-plastic contacts, and the two classical methods with artificial
 * viscosity. What a case chooses among these is a scheme (sph/scheme.h), in a folder of its own.
 * Source: Parshikov (2013), chapter 1; Wang et al., Explosion and Shock Waves 44 (2024) 081431. */
#ifndef BOLIDE_SPH_H
#define BOLIDE_SPH_H

#include "model/solver.h"

enum sph_conduction { SPH_CONDUCTION_NONE, SPH_CONDUCTION_CONTACT, SPH_CONDUCTION_HARMONIC };

/* What all schemes have in common; what belongs to one is in the table of that scheme. */
struct sph_parameters {
    struct one_of method;      /* its thing is a struct sph_scheme */
    double smoothing, courant; /* NAN: those of the scheme */
    int conduction;
    double conduction_limit; /* NAN: by form and dimension */
    double skin;
    int64_t rebuild;
};

enum { SPH_SCHEMES = 5 };
extern const struct choice sph_scheme_choices[SPH_SCHEMES];

/* `solver: {sph: {...}}`. */
extern const struct parameter sph_table[];
extern const struct solver_class sph_class;

#endif
