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
    PARAMETER(CHOICE, struct muscl_hancock_options, riemann, "hllc",
              "the Riemann solver of the faces" GAS_RIEMANN_LIST(RIEMANN_HELP),
              .names = riemann_names),
    PARAMETER_END,
};

static const struct parameter lax_wendroff_table[] = {
    PARAMETER(NUMBER, struct lax_wendroff_options, viscosity, "0.25",
              "eta, the factor of the adaptive viscosity", .below = 1.0, .closed = true),
    PARAMETER(CHOICE, struct lax_wendroff_options, viscosity_of, "faces",
              "faces: the larger of both cells' theta; cells: each cell's own, as printed in the "
              "source, which does not conserve",
              .names = viscosity_names),
    PARAMETER(CHOICE, struct lax_wendroff_options, form, "richtmyer",
              "richtmyer: two steps; printed: as printed in the source, without the Jacobian, "
              "which does not converge",
              .names = form_names),
    PARAMETER(CHOICE, struct lax_wendroff_options, mixing, "conservative",
              "how two materials share the energy of a cell that both are in; printed: as printed "
              "in the source, which does not conserve it",
              .names = mixing_names),
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
    PARAMETER(ONE_OF, struct gas_parameters, method, "muscl-hancock",
              "the method of the sweeps along the axes: its name, or {NAME: {options}}",
              .kind_of_thing = "gas-method"),
    PARAMETER(NUMBER, struct gas_parameters, courant, OPTIONAL,
              "K of dt = min K h/(|u_i| + c); default: 0.8, with lax-wendroff 0.2",
              .above = COURANT_LEAST, .below = 1.0, .change = CHANGE_FROM_HERE),
    PARAMETER(NUMBER, struct gas_parameters, ambient, OPTIONAL,
              "pressure of the air before a blast, for the fields `peak_overpressure` and "
              "`peak_impulse`; default: without these fields",
              .unit = "Pa", .below = INFINITY),
    PARAMETER(
        INTEGER, struct gas_parameters, regrid, "4",
        "with several `levels`, the number of steps after which cells become finer or coarser "
        "to follow pressure waves; 0: they stay as they begin",
        .below = INFINITY, .closed = true),
    PARAMETER(NUMBER, struct gas_parameters, cells_to_front, OPTIONAL,
              "with several `levels`, cells that follow waves are not finer than so many between "
              "`center` and them; default: as fine as `resolution`",
              .below = INFINITY),
    PARAMETER(VECTOR, struct gas_parameters, center, OPTIONAL,
              "where the blast begins, for `cells_to_front`; default: the centre of `start`, "
              "else the origin",
              .unit = "m"),
    PARAMETER_END,
};
