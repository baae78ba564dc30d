/* What of a blast on a structure cells are too coarse for; see coarse.h. */
#include "couple/coarse.h"

#include <math.h>

#include "couple/part.h"
#include "gas/gas_phases.h"
#include "material/material.h"
#include "shape/shape.h"

/* Cells through a plate below which it hardly bends, and shares its cells with the gas on both
 * sides. */
static const double PLATE = 3.0;
/* Cells below which the pressure of a detonation, and of what it sends through the air before a
 * solid, comes out too low. */
static const double RADIUS = 10.0, STAND_OFF = 10.0;

/* The bounds of a body in the domain, and at how many of its ends along AXIS the domain ends:
 * behind a mirror there the body goes on. */
static struct bounds bounds_of(const struct simulation_case *input, int body)
{
    return bounds_common(shape_bounds(&case_body(input, body)->shape), domain_bounds(input));
}

static void find_ends(const struct simulation_case *input, const struct bounds *bounds, int axis,
                      double edge, bool ends[2])
{
    ends[0] = vec3_at(bounds->low, axis) <= domain_face(input, axis, 0).at + 0.5 * edge;
    ends[1] = vec3_at(bounds->high, axis) >= domain_face(input, axis, 1).at - 0.5 * edge;
}

/* Lines through a shape along one axis: STEP apart along each, COUNT of them and of places. */
struct lines {
    const struct one_of *shape;
    int axis;
    double low[3], step[3];
    int64_t count[3];
    bool ends[2]; /* whether the body goes on there */
};

/* What line NUMBER has in common with the shape; twice as much where it goes on at one end, nothing
 * where at both. */
static double length_within(const struct lines *lines, int64_t number)
{
    const int axis = lines->axis, a = (axis + 1) % 3, b = (axis + 2) % 3;
    const int64_t count = lines->count[axis];
    double at[3], within = 0.0;
    bool goes_on[2] = {false, false};
    at[a] = lines->low[a] + ((double)(number % lines->count[a]) + 0.5) * lines->step[a];
    at[b] = lines->low[b] + ((double)(number / lines->count[a]) + 0.5) * lines->step[b];
    for (int64_t k = 0; k < count; k++) {
        at[axis] = lines->low[axis] + ((double)k + 0.5) * lines->step[axis];
        const bool inside = shape_inside(lines->shape, vector_at(at));
        within += inside ? lines->step[axis] : 0.0;
        goes_on[0] |= inside && k == 0 && lines->ends[0];
        goes_on[1] |= inside && k == count - 1 && lines->ends[1];
    }
    return goes_on[0] && goes_on[1] ? 0.0 : goes_on[0] || goes_on[1] ? 2.0 * within : within;
}

/* The mean length of lines along AXIS in a body, for a plate at an angle, too; 0 where there are
 * none. At most MOST lines along each other axis are looked at. */
static double thickness(const struct simulation_case *input, int body, int axis, double edge)
{
    enum { MOST = 64, PLACES = 8 };
    const struct bounds bounds = bounds_of(input, body);
    struct lines lines = {.shape = &case_body(input, body)->shape, .axis = axis};
    double sum = 0.0;
    int64_t number = 0, all = 1;
    find_ends(input, &bounds, axis, edge, lines.ends);
    for (int k = 0; k < 3; k++) {
        lines.count[k] = 1;
        if (k >= input->dimension)
            continue;
        const double extent = vec3_at(bounds.high, k) - vec3_at(bounds.low, k),
                     wanted = ceil(PLACES * extent / edge);
        lines.low[k] = vec3_at(bounds.low, k);
        lines.count[k] = (int64_t)minimum(maximum(wanted, 1.0), k == axis ? 1e6 : (double)MOST);
        lines.step[k] = extent / (double)lines.count[k];
        all *= k == axis ? 1 : lines.count[k];
    }
    for (int64_t line = 0; line < all; line++) {
        const double length = length_within(&lines, line);
        sum += length;
        number += length > 0.0;
    }
    return number ? sum / (double)number : 0.0;
}

static void judge_solid(struct findings *findings, int body, double edge)
{
    const struct simulation_case *input = findings->input;
    for (int axis = 0; axis < input->dimension; axis++) {
        const double cells = thickness(input, body, axis, edge) / edge;
        if (cells > PLATE - 0.1 || cells == 0.0)
            continue;
        {
            finding_add(findings, FINDING_COARSE, "bodies", input->bodies.names[body],
                        "%.2g cells thick along %c: with fewer than %.0f it hardly bends, and "
                        "shares its cells with the gas on both sides; refine it",
                        cells, "xyz"[axis], PLATE);
            return;
        }
    }
}

/* Half the smallest extent. */
static double radius_of(const struct simulation_case *input, int body, double edge)
{
    const struct bounds bounds = bounds_of(input, body);
    struct radii radii;
    double least = INFINITY;
    if (shape_radii(&case_body(input, body)->shape, &radii))
        return radii.outer;
    for (int axis = 0; axis < input->dimension; axis++) {
        bool ends[2];
        find_ends(input, &bounds, axis, edge, ends);
        const double extent = vec3_at(bounds.high, axis) - vec3_at(bounds.low, axis);
        if (!(ends[0] && ends[1]))
            least = minimum(least, ends[0] || ends[1] ? extent : 0.5 * extent);
    }
    return least;
}

static void judge_charge(struct findings *findings, int body, double edge)
{
    const struct simulation_case *input = findings->input;
    const double cells = radius_of(input, body, edge) / edge;
    if (cells > RADIUS - 1e-6 || !isfinite(cells))
        return;
    finding_add(findings, FINDING_COARSE, "bodies", input->bodies.names[body],
                "this charge has %.2g cells in its radius: with fewer than %.0f its blast "
                "is too weak; refine it, or compute it in 1-D and `start` from that",
                cells, RADIUS);
}

/* The gap between a charge and a solid, by their bounds, or from the surface of a round charge. */
static double gap_between(const struct simulation_case *input, int charge, int solid)
{
    const struct bounds of = bounds_of(input, solid), own = bounds_of(input, charge);
    struct radii radii;
    const bool round = shape_radii(&case_body(input, charge)->shape, &radii);
    double sum = 0.0;
    for (int axis = 0; axis < input->dimension; axis++) {
        const double low = round ? vec3_at(radii.center, axis) : vec3_at(own.low, axis),
                     high = round ? vec3_at(radii.center, axis) : vec3_at(own.high, axis);
        sum += square(
            maximum(0.0, maximum(vec3_at(of.low, axis) - high, low - vec3_at(of.high, axis))));
    }
    return sqrt(sum) - (round ? radii.outer : 0.0);
}

static void judge_stand_off(struct findings *findings, int charge, int solid, double edge)
{
    const struct simulation_case *input = findings->input;
    static const double touches = 0.5; /* cells */
    const double cells = gap_between(input, charge, solid) / edge;
    if (cells <= touches || cells > STAND_OFF - 1e-6)
        return;
    finding_add(findings, FINDING_COARSE, "bodies", input->bodies.names[charge],
                "there are %.2g cells between this charge and \"%s\": with fewer than %.0f "
                "the shock before the products is not resolved; refine it",
                cells, input->bodies.names[solid], STAND_OFF);
}

void coarse_cells(struct findings *findings, double edge)
{
    const struct simulation_case *input = findings->input;
    gas_judge_bodies(findings, edge);
    for (int b = 0; b < input->bodies.count; b++) {
        const struct material *material = body_material(input, b);
        if (is_solid(input, b))
            judge_solid(findings, b, edge);
        if (!material_burns(material))
            continue;
        judge_charge(findings, b, edge);
        for (int solid = 0; solid < input->bodies.count; solid++)
            if (is_solid(input, solid))
                judge_stand_off(findings, b, solid, edge);
    }
}

void coarse_gases(struct findings *findings, double edge)
{
    const struct simulation_case *input = findings->input;
    for (int b = 0; b < input->bodies.count; b++) {
        const struct body_input *body = case_body(input, b);
        const double resolution = isnan(body->resolution) ? input->resolution : body->resolution;
        if (gas_computes(case_material(input, body->material_index)->material) &&
            edge < 1.5 * resolution)
            finding_add(findings, FINDING_COARSE, "bodies", input->bodies.names[b],
                        "one particle a cell along each axis: where gas flows into the "
                        "region, gaps between them tear it; choose a `resolution` of "
                        "half a cell");
    }
}
