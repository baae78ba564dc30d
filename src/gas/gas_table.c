/* The parameters of the gas solver and of its methods. */
#include "gas/gas_internal.h"
#include "riemann/gas_solvers.h"

static const char *const form_names[] = {"richtmyer", "printed", NULL};
static const char *const viscosity_names[] = {"faces", "cells", NULL};

static const char *const mixing_names[] = {"conservative", "printed", NULL};

#define RIEMANN_NAME(name) #name,
static const char *const riemann_names[] = {GAS_RIEMANN_LIST(RIEMANN_NAME) NULL};
#define RIEMANN_HELP(name) "; " #name ": " GAS_RIEMANN_##name##_HELP

static const struct parameter muscl_hancock_table[] = {
    {.key = "riemann",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct muscl_hancock_options, riemann),
     .standard = "hllc",
     .names = riemann_names,
     .help = "the Riemann solver of the faces" GAS_RIEMANN_LIST(RIEMANN_HELP)},
    PARAMETER_END,
};

static const struct parameter lax_wendroff_table[] = {
    {.key = "viscosity",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct lax_wendroff_options, viscosity),
     .standard = "0.25",
     .below = 1.0,
     .closed = true,
     .help = "eta, the factor of the adaptive viscosity"},
    {.key = "viscosity_of",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct lax_wendroff_options, viscosity_of),
     .standard = "faces",
     .names = viscosity_names,
     .help = "faces: the larger of both cells' theta; cells: each cell's own, as printed in the "
             "source, which does not conserve"},
    {.key = "form",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct lax_wendroff_options, form),
     .standard = "richtmyer",
     .names = form_names,
     .help = "richtmyer: two steps; printed: as printed in the source, without the Jacobian, which "
             "does not converge"},
    {.key = "mixing",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct lax_wendroff_options, mixing),
     .standard = "conservative",
     .names = mixing_names,
     .help = "how two materials share the energy of a cell that both are in; printed: as printed "
             "in the source, which does not conserve it"},
    PARAMETER_END,
};

const struct choice gas_method_choices[GAS_METHODS] = {
    {"muscl-hancock", "second order, positive: limited slopes and a Riemann solver",
     muscl_hancock_table, sizeof(struct muscl_hancock_options), NULL},
    {"lax-wendroff",
     "Lax-Wendroff with adaptive viscosity, and markers between two materials (Cui 2014), restored",
     lax_wendroff_table, sizeof(struct lax_wendroff_options), NULL},
};

const struct parameter gas_table[] = {
    {.key = "method",
     .kind = PARAMETER_ONE_OF,
     .offset = offsetof(struct gas_parameters, method),
     .standard = "muscl-hancock",
     .kind_of_thing = "gas-method",
     .help = "the method of the sweeps along the axes: its name, or {NAME: {options}}"},
    {.key = "courant",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct gas_parameters, courant),
     .standard = PARAMETER_OPTIONAL,
     .above = 1e-6, /* a smaller step adds less than rounding takes, and no run of it ends */
     .below = 1.0,
     .help = "K of dt = min K h/(|u_i| + c); default: 0.8, with lax-wendroff 0.2"},
    {.key = "ambient",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct gas_parameters, ambient),
     .unit = "Pa",
     .standard = PARAMETER_OPTIONAL,
     .below = INFINITY,
     .help = "pressure of the air before a blast, for the fields `peak_overpressure` and "
             "`peak_impulse`; default: without these fields"},
    PARAMETER_END,
};
