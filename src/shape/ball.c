/* A ball, in 2-D a disc, in 1-D an interval. */
#include "shape/kinds.h"

const struct parameter shape_ball_table[] = {
    PARAMETER(VECTOR, struct shape_ball, center, REQUIRED, "the center", .unit = "m"),
    PARAMETER(NUMBER, struct shape_ball, radius, REQUIRED, "the radius", .unit = "m", .above = 0.0,
              .below = INFINITY),
    PARAMETER_END,
};

/* An interval has its low end and not its high one: intervals side by side share no point and miss
 * none. The surface of a disc or ball stays out all around, which keeps its symmetry. */
static bool inside(const void *shape, struct vec3 point)
{
    const struct shape_ball *ball = shape;
    const double at[3] = {point.x, point.y, point.z};
    if (ball->center.count == 1)
        return point.x >= ball->center.at[0] - ball->radius &&
               point.x < ball->center.at[0] + ball->radius;
    double distance_square = 0.0;
    assert(ball->center.count <= 3);
    for (int axis = 0; axis < ball->center.count; axis++)
        distance_square += square(at[axis] - ball->center.at[axis]);
    return distance_square < square(ball->radius);
}

static struct bounds bounds(const void *shape)
{
    const struct shape_ball *ball = shape;
    const struct vec3 center = vec3_of(&ball->center);
    const struct vec3 reach = vec3_make(ball->radius, ball->center.count > 1 ? ball->radius : 0.0,
                                        ball->center.count > 2 ? ball->radius : 0.0);
    return (struct bounds){vec3_sub(center, reach), vec3_add(center, reach)};
}

static const char *wrong(const void *shape, int dimension)
{
    const struct shape_ball *ball = shape;
    if (ball->center.count != dimension)
        return "a ball needs as many numbers in `center` as the case has dimensions";
    return NULL;
}

static bool radii(const void *shape, struct radii *radii)
{
    const struct shape_ball *ball = shape;
    *radii = (struct radii){vec3_of(&ball->center), 0.0, ball->radius};
    return true;
}

const struct shape_class shape_ball_class = {inside, bounds, wrong, radii, NULL, NULL, NULL};
