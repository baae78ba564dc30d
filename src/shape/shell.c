/* What lies between two balls about one center; in 2-D a ring. */
#include "shape/kinds.h"

const struct parameter shape_shell_table[] = {
    PARAMETER(VECTOR, struct shape_shell, center, REQUIRED, "the center", .unit = "m"),
    PARAMETER(NUMBER, struct shape_shell, inner, REQUIRED, "the inner radius", .unit = "m",
              .above = 0.0, .below = INFINITY, .closed = true),
    PARAMETER(NUMBER, struct shape_shell, outer, REQUIRED, "the outer radius", .unit = "m",
              .above = 0.0, .below = INFINITY),
    PARAMETER_END,
};

/* The inner surface belongs to the shell, the outer does not: a ball in a shell in a shell share no
 * point and miss none. */
static bool inside(const void *shape, struct vec3 point)
{
    const struct shape_shell *shell = shape;
    const struct vec3 offset = vec3_sub(point, vec3_of(&shell->center));
    const double distance_square = vec3_dot(offset, offset);
    return distance_square >= square(shell->inner) && distance_square < square(shell->outer);
}

static struct bounds bounds(const void *shape)
{
    const struct shape_shell *shell = shape;
    const struct vec3 center = vec3_of(&shell->center);
    const struct vec3 reach =
        vec3_make(shell->outer, shell->outer, shell->center.count > 2 ? shell->outer : 0.0);
    return (struct bounds){vec3_sub(center, reach), vec3_add(center, reach)};
}

static const char *wrong(const void *shape, int dimension)
{
    const struct shape_shell *shell = shape;
    if (dimension == 1)
        return "a shell needs two or three dimensions";
    if (shell->center.count != dimension)
        return "a shell needs as many numbers in `center` as the case has dimensions";
    if (!(shell->inner < shell->outer))
        return "the `inner` radius of a shell must be smaller than the `outer`";
    return NULL;
}

static bool radii(const void *shape, struct radii *radii)
{
    const struct shape_shell *shell = shape;
    *radii = (struct radii){vec3_of(&shell->center), shell->inner, shell->outer};
    return true;
}

const struct shape_class shape_shell_class = {inside, bounds, wrong, radii, NULL, NULL, NULL};
