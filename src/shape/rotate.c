/* A shape turned by an angle: in 2-D about a point, in 3-D about a line along an axis. The lattice
 * of the body is not turned. */
#include "shape/kinds.h"

const struct parameter shape_rotate_table[] = {
    PARAMETER(ONE_OF, struct shape_rotate, shape, REQUIRED, "the shape before the rotation",
              .kind_of_thing = "shape"),
    PARAMETER(
        NUMBER, struct shape_rotate, angle, REQUIRED,
        "rotation angle, such as 30 deg; counterclockwise in 2-D, and in 3-D seen against the axis",
        .unit = ""),
    PARAMETER(VECTOR, struct shape_rotate, about, OPTIONAL,
              "a point on the axis of rotation; default: the origin", .unit = "m"),
    PARAMETER(CHOICE, struct shape_rotate, axis, "z", "direction of the axis of rotation; z in 2-D",
              .names = parameter_axes),
    PARAMETER_END,
};

/* POINT turned by SENSE (1 or -1) times the angle. Quarter turns are exact. */
static struct vec3 turned(const struct shape_rotate *rotate, struct vec3 point, double sense)
{
    static const double rounding = 1e-15;
    double c = cos(rotate->angle), s = sense * sin(rotate->angle);
    if (fabs(c) < rounding) {
        c = 0.0;
        s = copysign(1.0, s);
    } else if (fabs(s) < rounding) {
        c = copysign(1.0, c);
        s = 0.0;
    }
    const struct vec3 about = vec3_of(&rotate->about), p = vec3_sub(point, about);
    struct vec3 q;
    if (rotate->axis == 0)
        q = vec3_make(p.x, c * p.y - s * p.z, s * p.y + c * p.z);
    else if (rotate->axis == 1)
        q = vec3_make(c * p.x + s * p.z, p.y, c * p.z - s * p.x);
    else
        q = vec3_make(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
    return vec3_add(about, q);
}

static bool inside(const void *shape, struct vec3 point)
{
    const struct shape_rotate *rotate = shape;
    return shape_inside(&rotate->shape, turned(rotate, point, -1.0));
}

/* The box of the turned corners. */
static struct bounds bounds(const void *shape)
{
    const struct shape_rotate *rotate = shape;
    const struct bounds one = shape_bounds(&rotate->shape);
    struct bounds all = {vec3_make(INFINITY, INFINITY, INFINITY),
                         vec3_make(-INFINITY, -INFINITY, -INFINITY)};
    if (!bounds_finite(&one))
        return (struct bounds){all.high, all.low};
    for (int corner = 0; corner < 8; corner++) {
        const struct vec3 at = turned(rotate,
                                      vec3_make(corner & 1 ? one.high.x : one.low.x,
                                                corner & 2 ? one.high.y : one.low.y,
                                                corner & 4 ? one.high.z : one.low.z),
                                      1.0);
        all.low =
            vec3_make(minimum(all.low.x, at.x), minimum(all.low.y, at.y), minimum(all.low.z, at.z));
        all.high = vec3_make(maximum(all.high.x, at.x), maximum(all.high.y, at.y),
                             maximum(all.high.z, at.z));
    }
    return all;
}

static const char *wrong(const void *shape, int dimension)
{
    const struct shape_rotate *rotate = shape;
    if (dimension == 1)
        return "a rotation needs two or three dimensions";
    if (rotate->about.count != 0 && rotate->about.count != dimension)
        return "a rotation needs as many numbers in `about` as the case has dimensions";
    if (dimension == 2 && rotate->axis != 2)
        return "a rotation in two dimensions is about the `axis` z";
    return shape_wrong(&rotate->shape, dimension);
}

static double work(const void *shape)
{
    return shape_work(&((const struct shape_rotate *)shape)->shape);
}

static bool grains(const void *shape, struct grain_sizes *sizes)
{
    return shape_grains(&((const struct shape_rotate *)shape)->shape, sizes);
}

const struct shape_class shape_rotate_class = {inside, bounds, wrong, NULL, work, NULL, grains};
