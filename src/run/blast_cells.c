/* Cells between a charge and what its blast loads; see blast_cells.h. A grid cuts the peak, a thin
 * layer behind the front, by a part that depends on how many cells the front has passed
 * (docs/blast.md, errors to expect). */
#include "run/blast_cells.h"

#include <math.h>
#include <string.h>

#include "gas/gas.h"
#include "material/material.h"
#include "measure/probes.h"
#include "shape/shape.h"

/* A peak lacks a third with twice as many cells, as of a point explosion at five times the pressure
 * of the air. */
static const double CELLS = 20.0;

/* Nearer than this many radii of a charge its products arrive, and no such peak. */
static const double RADII = 5.0;

struct charge {
    struct vec3 center;
    double radius; /* m */
};

/* A body that ends at faces of the domain goes on behind a mirror there. False: it is no charge
 * whose blast spreads. */
static bool charge_of(const struct simulation_case *input, int body, struct charge *charge)
{
    const struct one_of *shape = &case_body(input, body)->shape;
    const struct bounds bounds = shape_bounds(shape);
    double center[3] = {0.0, 0.0, 0.0}, least = INFINITY;
    struct radii radii;
    if (shape_radii(shape, &radii)) {
        *charge = (struct charge){radii.center, radii.outer};
        return true;
    }
    for (int axis = 0; axis < input->dimension; axis++) {
        const double low = vec3_at(bounds.low, axis), high = vec3_at(bounds.high, axis);
        const bool ends_low = low <= domain_face(input, axis, 0).at,
                   ends_high = high >= domain_face(input, axis, 1).at;
        center[axis] = ends_low && !ends_high   ? low
                       : ends_high && !ends_low ? high
                                                : 0.5 * (low + high);
        if (!(ends_low && ends_high))
            least = minimum(least, ends_low || ends_high ? high - low : 0.5 * (high - low));
    }
    *charge = (struct charge){vector_at(center), least};
    return isfinite(least);
}

/* The blast of `start`, of which the charge is in the case that it comes from. */
static bool charge_of_start(const struct simulation_case *input, struct charge *charge)
{
    const struct start_input *start = &input->start;
    double center[3] = {0.0, 0.0, 0.0};
    for (int b = 0; start->input && b < start->input->bodies.count; b++) {
        const int material = case_body(start->input, b)->material_index;
        if (!material_burns(case_material(start->input, material)->material) ||
            !charge_of(start->input, b, charge))
            continue;
        for (int axis = 0; axis < start->center.count; axis++)
            center[axis] = start->center.at[axis];
        charge->center = vector_at(center);
        return true;
    }
    return false;
}

static void judge(struct findings *findings, const struct charge *charge, const char *section,
                  const char *name, const struct bounds *bounds)
{
    const struct simulation_case *input = findings->input;
    const double distance = bounds_distance(bounds, charge->center, (int)input->dimension),
                 cells = distance / input->resolution;
    if (cells > CELLS - 1e-6 || !(distance > RADII * charge->radius))
        return;
    finding_add(findings, FINDING_COARSE, section, name,
                "%.3g cells between the middle of the charge and this: with 40 the peak of a "
                "blast lacks a third, with 150 a tenth, and a reflected one more; choose a "
                "smaller `resolution`",
                cells);
}

static void judge_all(struct findings *findings, const struct charge *charge)
{
    const struct simulation_case *input = findings->input;
    for (int p = 0; p < input->probes.count; p++) {
        const struct probe_input *probe = (struct probe_input *)input->probes.items + p;
        double at[3] = {0.0, 0.0, 0.0};
        if (!probe->probe.choice || strcmp(probe->probe.choice->name, "gauge") != 0)
            continue;
        const struct probe_gauge *gauge = probe->probe.value;
        for (int axis = 0; axis < gauge->at.count; axis++)
            at[axis] = gauge->at.at[axis];
        const struct bounds place = {vector_at(at), vector_at(at)};
        judge(findings, charge, "probes", input->probes.names[p], &place);
    }
    for (int b = 0; b < input->boundaries.count; b++) {
        const struct boundary_input *boundary = case_boundary(input, b);
        if (boundary->kind != BOUNDARY_RIGID_BODY)
            continue;
        const struct bounds bounds = shape_bounds(&boundary->part);
        judge(findings, charge, "boundaries", input->boundaries.names[b], &bounds);
    }
}

void blast_cells(struct findings *findings)
{
    const struct simulation_case *input = findings->input;
    struct charge charge;
    const bool plane = input->dimension == 1 && geometry_power(input->geometry) == 0;
    if (input->solver.choice->thing != &gas_class || plane)
        return;
    if (charge_of_start(input, &charge))
        judge_all(findings, &charge);
    for (int b = 0; b < input->bodies.count; b++) {
        const int material = case_body(input, b)->material_index;
        if (material_burns(case_material(input, material)->material) &&
            charge_of(input, b, &charge))
            judge_all(findings, &charge);
    }
}
