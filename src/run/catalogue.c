/* The catalogue; each list is in its own module. */
#include "run/catalogue.h"

#include "couple/couple.h"
#include "exact/choices.h"
#include "gas/gas.h"
#include "material/choices.h"
#include "measure/measure.h"
#include "measure/probes.h"
#include "mpm/mpm.h"
#include "shape/kinds.h"
#include "shape/lattice.h"
#include "sph/sph.h"

#define COUNT_SHAPE(identifier, help) +1
enum { SHAPES = 0 SHAPE_LIST(COUNT_SHAPE) };

static const struct choice solver_choices[] = {
    {"sph", "smoothed particle hydrodynamics: Riemann problems or artificial viscosity", sph_table,
     sizeof(struct sph_parameters), &sph_class},
    {"mpm", "the material point method: particles on a background grid that is reset each step",
     mpm_table, sizeof(struct mpm_parameters), &mpm_class},
    {"gas", "a gas, or two gases, on a fixed grid, without particles", gas_table,
     sizeof(struct gas_parameters), &gas_class},
    {"cfdmp", "gas on a grid and material points side by side, for blasts on structures",
     cfdmp_table, sizeof(struct cfdmp_parameters), &cfdmp_class},
    {"afdmp", "material points for a detonation, then gas on a grid, then material points again",
     afdmp_table, sizeof(struct afdmp_parameters), &afdmp_class},
};

static const struct choice_list lists[] = {
    {"solver", "the solver", solver_choices, COUNT_OF(solver_choices)},
    {"gas-method", "the method of the solver gas", gas_method_choices, GAS_METHODS},
    {"scheme", "the interaction of neighbours in SPH", sph_scheme_choices, SPH_SCHEMES},
    {"eos", "the equation of state of a material", eos_choices, EOS_KINDS},
    {"strength", "the shear strength of a material", strength_choices, STRENGTH_KINDS},
    {"failure", "how a solid breaks", failure_choices, FAILURE_KINDS},
    {"burn", "how an explosive turns into its products", burn_choices, BURN_KINDS},
    {"shape", "the shape of a body", shape_choices, SHAPES},
    {"lattice", "the initial arrangement of the particles of a body", lattice_choices,
     LATTICE_KINDS},
    {"exact", "an exact solution to compare results with", exact_choices, exact_choice_count},
    {"probe", "what is recorded while a case runs", probe_choices, PROBES},
    {"measure", "what a check measures", measure_choices, MEASURES},
    {0},
};

const struct catalogue bolide_catalogue = {lists};
