/* A box with faces normal to the axes. */
#include "shape/kinds.h"

const struct parameter shape_box_table[] = {
    PARAMETER(VECTOR, struct shape_box, from, REQUIRED, "the corner of the low coordinates",
              .unit = "m"),
    PARAMETER(VECTOR, struct shape_box, to, REQUIRED, "the corner of the high coordinates",
              .unit = "m"),
    PARAMETER_END,
};

static bool inside(const void *shape, struct vec3 point)
{
    const struct shape_box *box = shape;
    return point_in_box(&box->from, &box->to, point);
}

static struct bounds bounds(const void *shape)
{
    const struct shape_box *box = shape;
    return (struct bounds){vec3_of(&box->from), vec3_of(&box->to)};
}

static const char *wrong(const void *shape, int dimension)
{
    const struct shape_box *box = shape;
    if (box->from.count != dimension || box->to.count != dimension)
        return "a box needs as many numbers in `from` and `to` as the case has dimensions";
    for (int axis = 0; axis < dimension; axis++)
        if (!(box->from.at[axis] < box->to.at[axis]))
            return "the `to` of a box must lie above its `from` on every axis";
    return NULL;
}

const struct shape_class shape_box_class = {inside, bounds, wrong, NULL, NULL, NULL, NULL};
