/* What of a case the material point method cannot do, told where it stands in the case. */
#include "material/material.h"
#include "model/boundaries.h"
#include "model/generate.h"
#include "mpm/mpm_internal.h"
#include "shape/shape.h"

/* Particles that keep a gradient keep the velocities of their nodes. A node that a single particle
 * reaches, w cells beyond another, has the mass w m and the stiffness m (c/h)^2, so that steps of
 * more than 2 sqrt(w) h/c are unstable, in all of its motion: sooner or later there is such a
 * particle at a free surface. Other functions have less slope where they are small. See M. Steffen,
 * R. M. Kirby, M. Berzins, IJNME 76 (2008) 922, on functions whose slopes jump, and the choice of
 * C. Jiang et al., The material point method for simulating continuum materials, SIGGRAPH 2016
 * Courses. */
static struct error *refuse_transfer(const struct mpm_parameters *given,
                                     const struct simulation_case *input)
{
    struct error *error = NULL;
    if (given->transfer == MPM_FLIP)
        return NULL;
    if (given->shape == SHAPE_LINEAR)
        error = input_error(
            input, "solver", "mpm.transfer",
            "an affine transfer is unstable with `shape: linear`: a particle that keeps a gradient "
            "hands on the velocity of nodes that it hardly reaches; quadratic, cubic and gimp go "
            "with it");
    if (given->flip != 1.0)
        error = error_join(error, input_error(input, "solver", "mpm.flip",
                                              "this belongs to `transfer: flip`: leave it out"));
    if (given->shock_mixing > 0.0)
        error = error_join(
            error,
            input_error(input, "solver", "mpm.shock_mixing",
                        "this belongs to `transfer: flip`: particles with a gradient take all "
                        "of their velocity from nodes; leave it out"));
    return error;
}

static struct error *refuse_filter(const struct mpm_parameters *given,
                                   const struct simulation_case *input)
{
    if (!(given->viscosity_unresolved > 0.0) || given->scheme == MPM_MUSL)
        return NULL;
    return input_error(input, "solver", "mpm.viscosity_unresolved",
                       "this belongs to `scheme: musl`, which gives velocities back to nodes; "
                       "leave it out");
}

static struct error *refuse_order(const struct mpm_parameters *given,
                                  const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    struct error *error = NULL;
    bool burns = false;
    for (int m = 0; m < simulation->problem->materials; m++)
        burns |= material_burns(&simulation->problem->material[m]);
    if (given->order == 1)
        return NULL;
    if (given->transfer != MPM_FLIP || given->shape == SHAPE_LINEAR)
        error = input_error(
            input, "solver", "mpm.order",
            "more than 1 goes with `transfer: flip`, as what affine particles give to nodes is not "
            "smoothed, and not with `shape: linear`, whose nodes of next to no mass get unstable");
    /* what has yet to burn has neither stiffness nor viscosity against what overshoots */
    if (burns)
        error = error_join(
            error, input_error(input, "solver", "mpm.order",
                               "more than 1 is unstable at the front of an explosive that burns"));
    return error;
}

static struct error *refuse_contacts(const struct simulation_case *input)
{
    struct error *error = NULL;
    for (int c = 0; c < input->contacts.count; c++)
        for (int side = 0; side < 2; side++)
            if (case_body(input, case_contact(input, c)->body[side])->frozen)
                error = error_join(
                    error,
                    input_error(input, "contacts", input->contacts.names[c],
                                "by the solver mpm a frozen body sticks to what it touches"));
    return error;
}

/* The indices of cells are finite. */
static struct error *refuse_far_bodies(double edge, const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    const double reach = edge * (double)bins_reach(simulation->problem->dimension);
    struct error *error = NULL;
    for (int b = 0; b < input->bodies.count; b++) {
        const struct bounds bounds = shape_bounds(&case_body(input, b)->shape);
        const double ends[] = {bounds.low.x,  bounds.low.y,  bounds.low.z,
                               bounds.high.x, bounds.high.y, bounds.high.z};
        double far = 0.0;
        for (int k = 0; k < 6; k++)
            far = k % 3 < simulation->problem->dimension ? maximum(far, fabs(ends[k])) : far;
        if (far >= reach)
            error = error_join(error,
                               input_error(input, "bodies", input->bodies.names[b],
                                           "a place at %.6g m is beyond the grid of the solver "
                                           "mpm: with cells of %.6g m it reaches %.6g m from zero",
                                           far, edge, reach));
    }
    return error;
}

/* A cell that is wider than all bodies resolves nothing. The default, two particles wide, may be
 * twice as wide as a body of one particle. */
static struct error *refuse_wide_cell(double edge, const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    double extent = 0.0;
    assert(simulation->problem->dimension <= 3);
    for (int b = 0; b < input->bodies.count; b++) {
        const struct bounds bounds = shape_bounds(&case_body(input, b)->shape);
        const double from[] = {bounds.low.x, bounds.low.y, bounds.low.z};
        const double to[] = {bounds.high.x, bounds.high.y, bounds.high.z};
        for (int axis = 0; axis < simulation->problem->dimension; axis++) {
            low[axis] = minimum(low[axis], from[axis]);
            high[axis] = maximum(high[axis], to[axis]);
            extent = maximum(extent, high[axis] - low[axis]);
        }
    }
    if (edge <= 2.0 * (1.0 + 1e-9) * extent)
        return NULL;
    return input_error(input, "solver", "mpm.cell",
                       "a cell of %.6g m is wider than all bodies together, %.6g m: choose a "
                       "smaller one, or a finer resolution",
                       edge, extent);
}

struct error *mpm_refuse(const struct mpm_parameters *given, double edge,
                         const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    struct error *error = NULL;
    if (simulation->problem->geometry == GEOMETRY_PLANE_STRESS)
        error =
            input_error(input, "geometry", NULL, "the solver mpm does not support plane stress");
    error = error_join(error, problem_refuse_gas_keys(simulation->problem));
    error = error_join(error, refuse_transfer(given, input));
    error = error_join(error, refuse_filter(given, input));
    error = error_join(error, refuse_order(given, simulation));
    error = error_join(error, refuse_contacts(input));
    error = error_join(error, refuse_wide_cell(edge, simulation));
    if (!simulation->problem->place.is_part)
        error = error_join(error, boundaries_refuse_of_particles(input, mpm_class.boundaries));
    error = error_join(error, refuse_broken_contacts(simulation->problem));
    return error_join(error, refuse_far_bodies(edge, simulation));
}

/* Whether the places from FIRST on, SPACING apart, lie on nodes of cells of EDGE. */
static bool lies_on_nodes(double first, double spacing, double edge)
{
    const double place = first / edge, step = spacing / edge;
    return fabs(place - round(place)) < 1e-6 && fabs(step - round(step)) < 1e-6;
}

/* The slope of a linear function jumps at a node: a particle there, which moves by rounding, feels
 * a strain of no body. The first particles of a body stand at its low end plus half a spacing. */
struct error *mpm_warnings(const void *parameters, const struct simulation_case *input)
{
    const struct mpm_parameters *given = parameters;
    const double edge = isnan(given->cell) ? 2.0 * input->resolution : given->cell;
    struct error *warnings = NULL;
    if (given->shape != SHAPE_LINEAR)
        return NULL;
    for (int b = 0; b < input->bodies.count; b++) {
        const struct lattice lattice = body_lattice(input, b);
        const double first[] = {lattice.origin.x, lattice.origin.y, lattice.origin.z};
        const double spacing[] = {lattice.spacing.x, lattice.spacing.y, lattice.spacing.z};
        for (int axis = 0; axis < input->dimension && lattice.kind == LATTICE_SQUARE; axis++)
            if (lies_on_nodes(first[axis] + 0.5 * spacing[axis], spacing[axis], edge)) {
                warnings = error_join(
                    warnings,
                    input_error(input, "bodies", input->bodies.names[b],
                                "its particles lie on nodes of the grid along %c, where `shape: "
                                "linear` has no slope: they feel strains even in rigid motion. "
                                "Move the body by half a spacing, or take another shape",
                                "xyz"[axis]));
                break;
            }
    }
    return warnings;
}
