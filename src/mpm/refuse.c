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
static void refuse_transfer(const struct mpm_parameters *given, struct findings *findings)
{
    if (given->transfer == MPM_FLIP)
        return;
    if (given->shape == SHAPE_LINEAR)
        finding_add(
            findings, FINDING_WRONG, "solver", "mpm.transfer",
            "an affine transfer is unstable with `shape: linear`: a particle that keeps a gradient "
            "hands on the velocity of nodes that it hardly reaches; quadratic, cubic and gimp go "
            "with it");
    if (given->flip != 1.0)
        finding_add(findings, FINDING_WRONG, "solver", "mpm.flip",
                    "this belongs to `transfer: flip`: leave it out");
    if (given->shock_mixing > 0.0)
        finding_add(findings, FINDING_WRONG, "solver", "mpm.shock_mixing",
                    "this belongs to `transfer: flip`: particles with a gradient take all "
                    "of their velocity from nodes; leave it out");
}

static void refuse_filter(const struct mpm_parameters *given, struct findings *findings)
{
    if (!(given->viscosity_unresolved > 0.0) || given->scheme == MPM_MUSL)
        return;

    finding_add(findings, FINDING_WRONG, "solver", "mpm.viscosity_unresolved",
                "this belongs to `scheme: musl`, which gives velocities back to nodes; "
                "leave it out");
}

static void refuse_order(const struct mpm_parameters *given, const struct simulation *simulation,
                         struct findings *findings)
{
    bool burns = false;
    for (int m = 0; m < simulation->problem->materials; m++)
        burns |= material_burns(&simulation->problem->material[m]);
    if (given->order == 1)
        return;
    if (given->transfer != MPM_FLIP || given->shape == SHAPE_LINEAR)
        finding_add(
            findings, FINDING_WRONG, "solver", "mpm.order",
            "more than 1 goes with `transfer: flip`, as what affine particles give to nodes is not "
            "smoothed, and not with `shape: linear`, whose nodes of next to no mass get unstable");
    /* what has yet to burn has neither stiffness nor viscosity against what overshoots */
    if (burns)
        finding_add(findings, FINDING_WRONG, "solver", "mpm.order",
                    "more than 1 is unstable at the front of an explosive that burns");
}

static void refuse_contacts(struct findings *findings)
{
    const struct simulation_case *input = findings->input;
    for (int c = 0; c < input->contacts.count; c++)
        for (int side = 0; side < 2; side++)
            if (case_body(input, case_contact(input, c)->body[side])->frozen)
                finding_add(findings, FINDING_WRONG, "contacts", input->contacts.names[c],
                            "by the solver mpm a frozen body sticks to what it touches");
}

/* The indices of cells are finite. */
static void refuse_far_bodies(double edge, const struct simulation *simulation,
                              struct findings *findings)
{
    const struct simulation_case *input = simulation->problem->input;
    const double reach = edge * (double)bins_reach(simulation->problem->dimension);
    for (int b = 0; b < input->bodies.count; b++) {
        const struct bounds bounds = shape_bounds(&case_body(input, b)->shape);
        double far = 0.0;
        for (int axis = 0; axis < simulation->problem->dimension; axis++)
            far = maximum(
                far, maximum(fabs(vec3_at(bounds.low, axis)), fabs(vec3_at(bounds.high, axis))));
        if (far >= reach)
            finding_add(findings, FINDING_WRONG, "bodies", input->bodies.names[b],
                        "a place at %.6g m is beyond the grid of the solver "
                        "mpm: with cells of %.6g m it reaches %.6g m from zero",
                        far, edge, reach);
    }
}

/* A cell that is wider than all bodies resolves nothing. The default, two particles wide, may be
 * twice as wide as a body of one particle. */
static void refuse_wide_cell(double edge, const struct simulation *simulation,
                             struct findings *findings)
{
    const struct simulation_case *input = simulation->problem->input;
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    double extent = 0.0;
    assert(simulation->problem->dimension <= 3);
    for (int b = 0; b < input->bodies.count; b++) {
        const struct bounds bounds = shape_bounds(&case_body(input, b)->shape);
        for (int axis = 0; axis < simulation->problem->dimension; axis++) {
            low[axis] = minimum(low[axis], vec3_at(bounds.low, axis));
            high[axis] = maximum(high[axis], vec3_at(bounds.high, axis));
            extent = maximum(extent, high[axis] - low[axis]);
        }
    }
    if (edge <= 2.0 * (1.0 + 1e-9) * extent)
        return;

    finding_add(findings, FINDING_WRONG, "solver", "mpm.cell",
                "a cell of %.6g m is wider than all bodies together, %.6g m: choose a "
                "smaller one, or a finer resolution",
                edge, extent);
}

static void refuse(const struct mpm_parameters *given, double edge,
                   const struct simulation *simulation, struct findings *findings)
{
    if (simulation->problem->geometry == GEOMETRY_PLANE_STRESS)
        finding_add(findings, FINDING_WRONG, "geometry", NULL,
                    "the solver mpm does not support plane stress");
    problem_refuse_gas_keys(simulation->problem, findings);
    refuse_transfer(given, findings);
    refuse_filter(given, findings);
    refuse_order(given, simulation, findings);
    refuse_contacts(findings);
    refuse_wide_cell(edge, simulation, findings);
    if (!simulation->problem->place.is_part)
        boundaries_refuse_of_particles(findings, mpm_class.boundaries);
    refuse_broken_contacts(simulation->problem, findings);
    refuse_standing_spall(simulation->problem, findings);
    refuse_far_bodies(edge, simulation, findings);
}

/* Whether the places from FIRST on, SPACING apart, lie on nodes of cells of EDGE. */
static bool lies_on_nodes(double first, double spacing, double edge)
{
    const double place = first / edge, step = spacing / edge;
    return fabs(place - round(place)) < 1e-6 && fabs(step - round(step)) < 1e-6;
}

/* The slope of a linear function jumps at a node: a particle there, which moves by rounding, feels
 * a strain of no body. The first particles of a body stand at its low end plus half a spacing. */
static void judge_lattices(const struct mpm_parameters *given, double edge,
                           struct findings *findings)
{
    const struct simulation_case *input = findings->input;
    for (int b = 0; b < input->bodies.count && given->shape == SHAPE_LINEAR; b++) {
        const struct lattice lattice = body_lattice(input, b);
        const double first[] = {lattice.origin.x, lattice.origin.y, lattice.origin.z};
        const double spacing[] = {lattice.spacing.x, lattice.spacing.y, lattice.spacing.z};
        for (int axis = 0; axis < input->dimension && lattice.kind == LATTICE_SQUARE; axis++)
            if (lies_on_nodes(first[axis] + 0.5 * spacing[axis], spacing[axis], edge)) {
                finding_add(findings, FINDING_DOUBTFUL, "bodies", input->bodies.names[b],
                            "its particles lie on nodes of the grid along %c, where `shape: "
                            "linear` has no slope: they feel strains even in rigid motion. "
                            "Move the body by half a spacing, or take another shape",
                            "xyz"[axis]);
                break;
            }
    }
}

const char mpm_energy_lost[] =
    "where bodies strike or shocks pass, nodes of the grid equalise the velocities of particles "
    "and that energy is lost: finer particles lose less";

void mpm_judge(const void *parameters, const struct simulation *simulation,
               struct judgement *judgement)
{
    struct mpm mpm = {.parameters = mpm_settled(parameters, simulation)};
    mpm.edge = mpm.parameters.cell;
    refuse(parameters, mpm.edge, simulation, &judgement->findings);
    findings_take(&judgement->findings, FINDING_WRONG,
                  error_join(mpm_note_bodies(&mpm, parameters, simulation),
                             mpm_find_planes(&mpm, simulation)));
    mpm_class.destroy(&mpm);
    judge_lattices(parameters, mpm.edge, &judgement->findings);
    judgement->energy_lost = mpm_energy_lost;
}
