/* The catalogue; each list is in its own module. */
#include "run/catalogue.h"

#include "exact/choices.h"
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
    {"mpm", "the material point method: particles on a grid that is made anew each step", mpm_table,
     sizeof(struct mpm_parameters), &mpm_class},
};

static const struct choice_list lists[] = {
    {"solver", "the method of solution", solver_choices, COUNT_OF(solver_choices)},
    {"scheme", "what neighbours in SPH do to each other", sph_scheme_choices, SPH_SCHEMES},
    {"eos", "the equation of state of a material", eos_choices, EOS_KINDS},
    {"strength", "what a material does with shear", strength_choices, STRENGTH_KINDS},
    {"burn", "how an explosive becomes its products", burn_choices, BURN_KINDS},
    {"shape", "where a body is", shape_choices, SHAPES},
    {"lattice", "how the particles of a body stand at the start", lattice_choices, LATTICE_KINDS},
    {"exact", "an exact solution that results are measured against", exact_choices,
     exact_choice_count},
    {"probe", "what is recorded while a case runs", probe_choices, PROBES},
    {"measure", "what a check measures", measure_choices, MEASURES},
    {0},
};

const struct catalogue bolide_catalogue = {lists};
