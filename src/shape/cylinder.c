/* A round bar or pipe between the centers of its two end faces, along any direction. */
#include "shape/kinds.h"

const struct parameter shape_cylinder_table[] = {
    PARAMETER(VECTOR, struct shape_cylinder, from, REQUIRED, "the center of one end face",
              .unit = "m"),
    PARAMETER(VECTOR, struct shape_cylinder, to, REQUIRED, "the center of the other end face",
              .unit = "m"),
    PARAMETER(NUMBER, struct shape_cylinder, radius, REQUIRED, "the outer radius", .unit = "m",
              .above = 0.0, .below = INFINITY),
    PARAMETER(NUMBER, struct shape_cylinder, inner, "0 m", "the inner radius of a pipe",
              .unit = "m", .above = 0.0, .below = INFINITY, .closed = true),
    PARAMETER_END,
};

static bool inside(const void *shape, struct vec3 point)
{
    const struct shape_cylinder *cylinder = shape;
    const struct vec3 from = vec3_of(&cylinder->from);
    const struct vec3 along = vec3_sub(vec3_of(&cylinder->to), from);
    const struct vec3 offset = vec3_sub(point, from);
    const double fraction = vec3_dot(offset, along) / vec3_dot(along, along);
    if (!(fraction >= 0.0 && fraction < 1.0))
        return false;
    const struct vec3 across = vec3_sub(offset, vec3_scale(fraction, along));
    const double distance_square = vec3_dot(across, across);
    return distance_square >= square(cylinder->inner) && distance_square < square(cylinder->radius);
}

/* An end face reaches radius sqrt(1 - n_i^2) along axis i, where n is the direction of the axis. */
static double face_reach(double radius, double along, double length)
{
    return radius * sqrt(maximum(0.0, 1.0 - square(along / length)));
}

static struct bounds bounds(const void *shape)
{
    const struct shape_cylinder *cylinder = shape;
    const struct vec3 from = vec3_of(&cylinder->from), to = vec3_of(&cylinder->to);
    const struct vec3 along = vec3_sub(to, from);
    const double length = sqrt(vec3_dot(along, along));
    const struct vec3 reach = vec3_make(face_reach(cylinder->radius, along.x, length),
                                        face_reach(cylinder->radius, along.y, length),
                                        face_reach(cylinder->radius, along.z, length));
    const struct vec3 low =
        vec3_make(minimum(from.x, to.x), minimum(from.y, to.y), minimum(from.z, to.z));
    const struct vec3 high =
        vec3_make(maximum(from.x, to.x), maximum(from.y, to.y), maximum(from.z, to.z));
    return (struct bounds){vec3_sub(low, reach), vec3_add(high, reach)};
}

static const char *wrong(const void *shape, int dimension)
{
    const struct shape_cylinder *cylinder = shape;
    if (dimension != 3)
        return "a cylinder needs three dimensions";
    if (cylinder->from.count != 3 || cylinder->to.count != 3)
        return "a cylinder needs three numbers in `from` and `to`";
    const struct vec3 along = vec3_sub(vec3_of(&cylinder->to), vec3_of(&cylinder->from));
    if (!(vec3_dot(along, along) > 0.0))
        return "the `from` and `to` of a cylinder must be two different points";
    if (!(cylinder->inner < cylinder->radius))
        return "the `inner` radius of a cylinder must be smaller than its `radius`";
    return NULL;
}

const struct shape_class shape_cylinder_class = {inside, bounds, wrong, NULL, NULL, NULL, NULL};
