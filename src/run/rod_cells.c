/* Particles across the radius of a rod; see rod_cells.h. The strength of a rod acts at its nose in
 * a layer that is thin beside the radius: with 4 particles in the radius nothing of it is felt
 * there, with 8 half of it (docs/tasks/long-rod.md). */
#include "run/rod_cells.h"

#include <math.h>

#include "material/any.h"
#include "material/material.h"
#include "model/generate.h"
#include "model/place.h"

static const double PARTICLES = 10.0; /* in the radius */
static const double SLENDER = 4.0;    /* length over diameter of a rod */
static const double ERODES = 4.0;     /* dynamic pressure over yield stress */

struct rod {
    int axis;                /* along which it flies */
    double speed, particles; /* m/s; in the smallest radius */
};

/* Half the width of BODY along AXIS; the whole one where it is half of a symmetric body. */
static double half_width(const struct simulation_case *input, const struct bounds *bounds, int axis)
{
    const double low = vec3_at(bounds->low, axis), high = vec3_at(bounds->high, axis);
    const struct place whole = place_whole(input);
    const struct face *face = whole.face[axis];
    const bool halved = (axis == 0 && geometry_power(input->geometry) > 0) ||
                        (face_closes(&face[0]) && low <= face[0].at) ||
                        (face_closes(&face[1]) && high >= face[1].at);
    return halved ? high - low : 0.5 * (high - low);
}

/* Whether BODY is slender along the axis along which it flies. */
static bool rod_of(const struct simulation_case *input, int body, struct rod *rod)
{
    const struct bounds bounds = body_bounds(input, body);
    const struct vec3 extent = vec3_sub(bounds.high, bounds.low),
                      velocity = body_velocity(input, body),
                      spacing = body_lattice(input, body).spacing;
    double radius = INFINITY;
    *rod = (struct rod){0};
    for (int axis = 0; axis < input->dimension; axis++)
        if (fabs(vec3_at(velocity, axis)) > rod->speed)
            *rod = (struct rod){.axis = axis, .speed = fabs(vec3_at(velocity, axis))};
    for (int axis = 0; axis < input->dimension; axis++) {
        const double half = half_width(input, &bounds, axis);
        if (axis == rod->axis || half >= radius || walls_on_both_sides(input, axis))
            continue;
        radius = half;
        rod->particles = half / vec3_at(spacing, axis);
    }
    return rod->speed > 0.0 && vec3_at(extent, rod->axis) >= SLENDER * 2.0 * radius;
}

static bool erodes(const struct simulation_case *input, int body, double speed)
{
    const struct body_input *of = case_body(input, body);
    const struct material *material = case_material(input, of->material_index)->material;
    struct point point = of->start;
    if (!material_has_strength(material))
        return false;
    const double yield = any_material_evaluate(material, &point).yield;
    return 0.5 * material_density(material) * speed * speed > ERODES * yield;
}

void rod_cells(struct findings *findings)
{
    const struct simulation_case *input = findings->input;
    struct rod rod;
    for (int body = 0; body < input->bodies.count && input->dimension > 1; body++)
        if (!case_body(input, body)->driven && rod_of(input, body, &rod) &&
            rod.particles < PARTICLES - 0.01 && erodes(input, body, rod.speed))
            finding_add(findings, FINDING_COARSE, "bodies", input->bodies.names[body],
                        "a rod with %.3g particles across its radius: with 8 the depth that it "
                        "reaches is a tenth too small, with 4 a quarter; choose a `resolution` "
                        "for 12",
                        rod.particles);
}
