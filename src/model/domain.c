/* The faces of the domain; see domain.h. */
#include "model/domain.h"

#include "parallel/periodic.h"
#include "shape/shape.h"

static double end_of(struct vec3 place, int axis)
{
    return axis == 0 ? place.x : axis == 1 ? place.y : place.z;
}

struct face_place domain_face(const struct simulation_case *input, int axis, int side)
{
    const struct vector_value *given = side ? &input->domain.high : &input->domain.low;
    if (given->count > axis)
        return (struct face_place){given->at[axis], "domain", side ? "high" : "low"};
    for (int w = 0; w < input->walls.count; w++)
        if (case_wall(input, w)->axis == axis && case_wall(input, w)->side == side)
            return (struct face_place){case_wall(input, w)->at, "walls", input->walls.names[w]};
    struct face_place place = {side ? -INFINITY : INFINITY, "bodies", NULL};
    for (int b = 0; b < input->bodies.count; b++) {
        const struct bounds bounds = shape_bounds(&case_body(input, b)->shape);
        double at = end_of(side ? bounds.high : bounds.low, axis);
        if (geometry_power(input->geometry) > 0 && axis == 0 && !side)
            at = maximum(at, 0.0);
        if (side ? at > place.at : at < place.at)
            place = (struct face_place){at, "bodies", input->bodies.names[b]};
    }
    return place;
}

void domain_set_faces(const struct simulation_case *input, struct mirrors *mirrors)
{
    for (int b = 0; b < input->boundaries.count; b++) {
        const struct boundary_input *boundary = case_boundary(input, b);
        const int axis = boundary->axis;
        const double low = domain_face(input, axis, 0).at, high = domain_face(input, axis, 1).at;
        if (boundary->kind == BOUNDARY_PERIODIC && low < high && isfinite(high - low))
            mirrors_make_periodic(mirrors, axis, low, high);
        if (boundary->kind == BOUNDARY_REFLECTING && !boundary->part.choice && low < high)
            (boundary->side ? mirrors->high : mirrors->low)[axis] = boundary->side ? high : low;
    }
}
