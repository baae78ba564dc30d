/* The parameters of the material point method, as a case names them. */
#include "material/material.h"
#include "mpm/mpm_internal.h"

static const char *const shape_names[] = {"linear", "gimp", "quadratic", "cubic", NULL};
static const char *const scheme_names[] = {"musl", "usl", "usf", NULL};
static const char *const transfer_names[] = {"flip", "apic", "tpic", NULL};
static const char *const rotation_names[] = {"exact", "jaumann", NULL};
static const char *const quadrature_names[] = {"particles", "faces", NULL};
static const char *const energy_names[] = {"conserved", "work", NULL};
static const char *const damping_names[] = {"plain", "symmetric", NULL};

const struct parameter mpm_table[] = {
    PARAMETER(NUMBER, struct mpm_parameters, cell, OPTIONAL,
              "edge of a grid cell; grid planes lie at its multiples, and walls must lie on them; "
              "default: twice the resolution",
              .unit = "m", .above = 0.0, .below = INFINITY),
    PARAMETER(CHOICE, struct mpm_parameters, shape, "quadratic",
              "shape functions of the grid; linear; gimp: linear, averaged over particles of "
              "constant size; quadratic, cubic: B-splines",
              .names = shape_names),
    PARAMETER(CHOICE, struct mpm_parameters, scheme, "musl",
              "when stresses are updated; musl: last, from velocities mapped to nodes once more; "
              "usl: last; usf: first",
              .names = scheme_names),
    PARAMETER(CHOICE, struct mpm_parameters, transfer, "flip",
              "what particles take from nodes; flip: accelerations (the fraction `flip`) and "
              "velocities (the rest); apic: velocities and their first moments; tpic: velocities "
              "and their gradients",
              .names = transfer_names),
    PARAMETER(NUMBER, struct mpm_parameters, flip, "1",
              "fraction of accelerations in `transfer: flip`; less than 1 damps what the grid does "
              "not resolve",
              .above = 0.0, .below = 1.0, .closed = true),
    PARAMETER(INTEGER, struct mpm_parameters, order, "1",
              "order of the inverse of the full mass matrix for node velocities and accelerations; "
              "1: lumped masses; with `flip: 0` the method FMPM of this order",
              .above = 1, .below = 20, .closed = true),
    PARAMETER(NUMBER, struct mpm_parameters, courant, OPTIONAL,
              "K of dt = min K h/(c + max |u_i|), h the cell; default: 0.2 with fluids, 0.8 with "
              "`shape: quadratic` or `cubic`, `transfer: flip` and `order: 1`, else 0.5",
              .above = COURANT_LEAST, .below = 1.0, .change = CHANGE_FROM_HERE),
    PARAMETER(CHOICE, struct mpm_parameters, quadrature, "faces",
              "integration of the stress for nodal forces; faces: means on the faces between "
              "nodes, so that a uniform stress gives no force; needs `energy: conserved` and "
              "`shape: quadratic` or `cubic`; particles: each over its volume, as in the source",
              .names = quadrature_names),
    PARAMETER(CHOICE, struct mpm_parameters, energy, "conserved",
              "energy of particles; conserved: what forces take from the motion at nodes; needs "
              "`transfer: flip` with `flip: 1`, `order: 1`, a shape that is not linear, and in "
              "axisymmetry `quadrature: faces`; work: work of the stress in the strain of the "
              "particle, as in the source",
              .names = energy_names),
    PARAMETER(CHOICE, struct mpm_parameters, rotation, "exact",
              "how stress rotates with the particle; exact: by a rotation; jaumann: by its linear "
              "part, as in the source",
              .names = rotation_names),
    PARAMETER(NUMBER, struct mpm_parameters, viscosity_quadratic, "1.5",
              "b2 of the artificial viscosity q = rho h (b2 h d^2 - b1 c d) in compression, d < 0 "
              "the volumetric strain rate",
              .above = 0.0, .below = 1e3, .closed = true, .change = CHANGE_FROM_HERE),
    PARAMETER(NUMBER, struct mpm_parameters, viscosity_linear, OPTIONAL,
              "b1 of the artificial viscosity; default: 0.06, and up to 0.2 in shocks in solids "
              "and in explosives that burn by a rate",
              .above = 0.0, .below = 1e3, .closed = true, .change = CHANGE_FROM_HERE),
    PARAMETER(NUMBER, struct mpm_parameters, viscosity_unresolved, OPTIONAL,
              "b3 of the viscous pressure -b3 rho h c w in solids, where w is the part of the "
              "volumetric strain rate that the nodes do not resolve. That part then does not "
              "change the density; with b3 = 0 it does. Default: 2 with `scheme: musl`, energy "
              "that is conserved and a b1 or b2 that is not zero, else 0",
              .above = 0.0, .below = 10.0, .closed = true),
    PARAMETER(NUMBER, struct mpm_parameters, shock_mixing, OPTIONAL,
              "rate, in c/h, at which the energies of particles that share a node in a shock are "
              "mixed; velocities mix at two thirds of it; 0: no mixing; default: 3 with `transfer: "
              "flip`, `order: 1` and a shape that is not linear, else 0",
              .above = 0.0, .below = 100.0, .closed = true),
    PARAMETER(NUMBER, struct mpm_parameters, shear_damping, "0",
              "Q of the damping of shear modes in cells of fluid, as a viscosity 4 Q c h; stable "
              "at 1/(8 K) and less",
              .above = 0.0, .below = 1.0, .closed = true),
    PARAMETER(CHOICE, struct mpm_parameters, damping, "plain",
              "which shear is damped; plain: with rotation; symmetric: without rotation",
              .names = damping_names),
    PARAMETER(NUMBER, struct mpm_parameters, gauge_pressure, "0",
              "ambient pressure, subtracted from that of fluids in forces: a uniform pressure "
              "makes particles on a grid unstable",
              .unit = "Pa", .below = INFINITY, .above = -INFINITY),
    PARAMETER_END};

double mpm_courant(const struct mpm_parameters *parameters, bool fluid)
{
    /* With fluids the error of the step, of first order, decides; with solids stability does. A
     * free bar with two particles a cell is stable below 0.97 with quadratic functions, 1.47 with
     * cubic ones, 0.82 with gimp, and 0.2 with linear ones, which drift rather than blow up. */
    const bool smooth = parameters->shape == SHAPE_QUADRATIC || parameters->shape == SHAPE_CUBIC;
    if (!isnan(parameters->courant))
        return parameters->courant;
    if (fluid)
        return 0.2;
    return smooth && parameters->transfer == MPM_FLIP && parameters->order == 1 ? 0.8 : 0.5;
}

double mpm_courant_beside_gas(const struct mpm_parameters *parameters, bool fluid)
{
    /* of solids: with 0.8 a plate under a blast bends 2 % less than with short steps */
    static const double most = 0.5;
    const double courant = mpm_courant(parameters, fluid);
    return isnan(parameters->courant) ? minimum(courant, most) : courant;
}

struct mpm_parameters mpm_settled(const struct mpm_parameters *parameters,
                                  const struct simulation *simulation)
{
    struct mpm_parameters settled = *parameters;
    bool fluid = false;
    for (int m = 0; m < simulation->problem->materials; m++)
        fluid |= !material_has_strength(&simulation->problem->material[m]);
    if (isnan(settled.cell))
        settled.cell = 2.0 * simulation->problem->input->resolution;
    settled.courant = mpm_courant(&settled, fluid);
    if (settled.transfer != MPM_FLIP)
        settled.flip = 0.0;
    if (isnan(settled.shock_mixing))
        settled.shock_mixing =
            settled.transfer == MPM_FLIP && settled.order == 1 && settled.shape != SHAPE_LINEAR
                ? 3.0
                : 0.0;
    if (!mpm_conserves(&settled) || settled.shape == SHAPE_GIMP)
        settled.quadrature = MPM_PARTICLES;
    /* what a node of next to no mass gets by functions around the axis, which reach further than
     * those that its mass is from, has no bound */
    if (simulation->problem->geometry == GEOMETRY_AXISYMMETRIC &&
        settled.quadrature == MPM_PARTICLES)
        settled.energy = MPM_ENERGY_WORK;
    if (isnan(settled.viscosity_unresolved))
        settled.viscosity_unresolved =
            mpm_conserves(&settled) && settled.scheme == MPM_MUSL &&
                    !(settled.viscosity_linear + settled.viscosity_quadratic <= 0.0)
                ? 2.0
                : 0.0;
    return settled;
}
