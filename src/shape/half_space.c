/* Everything on one side of a plane, in 2-D of a line. */
#include "shape/kinds.h"

const struct parameter shape_half_space_table[] = {
    PARAMETER(VECTOR, struct shape_half_space, point, REQUIRED, "a point of the plane",
              .unit = "m"),
    PARAMETER(VECTOR, struct shape_half_space, normal, REQUIRED,
              "outward normal of the plane, of any length", .unit = ""),
    PARAMETER_END,
};

/* A plane belongs to what lies above it along the first axis that it is not parallel to, as the
 * faces of a box do: a body that is cut in two loses no point and gains none. */
static bool plane_belongs(struct vec3 normal)
{
    const double first = normal.x != 0.0 ? normal.x : normal.y != 0.0 ? normal.y : normal.z;
    return first < 0.0;
}

static bool inside(const void *shape, struct vec3 point)
{
    const struct shape_half_space *half = shape;
    const struct vec3 normal = vec3_of(&half->normal);
    const double height = vec3_dot(vec3_sub(point, vec3_of(&half->point)), normal);
    return height < 0.0 || (height == 0.0 && plane_belongs(normal));
}

/* Only a plane across an axis bounds anything. */
static struct bounds bounds(const void *shape)
{
    const struct shape_half_space *half = shape;
    const struct vec3 at = vec3_of(&half->point), normal = vec3_of(&half->normal);
    struct bounds all = {vec3_make(-INFINITY, -INFINITY, -INFINITY),
                         vec3_make(INFINITY, INFINITY, INFINITY)};
    if (normal.y == 0.0 && normal.z == 0.0)
        *(normal.x > 0.0 ? &all.high.x : &all.low.x) = at.x;
    else if (normal.z == 0.0 && normal.x == 0.0)
        *(normal.y > 0.0 ? &all.high.y : &all.low.y) = at.y;
    else if (normal.x == 0.0 && normal.y == 0.0)
        *(normal.z > 0.0 ? &all.high.z : &all.low.z) = at.z;
    return all;
}

static const char *wrong(const void *shape, int dimension)
{
    const struct shape_half_space *half = shape;
    if (half->point.count != dimension || half->normal.count != dimension)
        return "a half-space needs as many numbers in `point` and `normal` as the case has "
               "dimensions";
    const struct vec3 normal = vec3_of(&half->normal);
    if (!(vec3_dot(normal, normal) > 0.0))
        return "the `normal` of a half-space must not be zero";
    return NULL;
}

const struct shape_class shape_half_space_class = {inside, bounds, wrong, NULL, NULL, NULL, NULL};
