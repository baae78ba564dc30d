/* The first of a list of shapes without all others. Its bounds are the first's, and so is its
 * lattice: a hole does not move the sites around it. */
#include "shape/kinds.h"

const struct parameter shape_difference_table[] = {
    PARAMETER(LIST, struct shape_difference, shapes, REQUIRED,
              "the shape to cut from, then those to cut away", .kind_of_thing = "shape"),
    PARAMETER_END,
};

static bool inside(const void *shape, struct vec3 point)
{
    const struct one_of_list *shapes = &((const struct shape_difference *)shape)->shapes;
    if (!shape_inside(&shapes->items[0], point))
        return false;
    for (int i = 1; i < shapes->count; i++)
        if (shape_inside(&shapes->items[i], point))
            return false;
    return true;
}

static struct bounds bounds(const void *shape)
{
    return shape_bounds(&((const struct shape_difference *)shape)->shapes.items[0]);
}

static const char *wrong(const void *shape, int dimension)
{
    const struct one_of_list *shapes = &((const struct shape_difference *)shape)->shapes;
    if (shapes->count < 2)
        return "a difference needs at least two shapes";
    return shapes_wrong(shapes, dimension);
}

static bool radii(const void *shape, struct radii *radii)
{
    return shape_radii(&((const struct shape_difference *)shape)->shapes.items[0], radii);
}

static double work(const void *shape)
{
    return shapes_work(&((const struct shape_difference *)shape)->shapes);
}

const struct shape_class shape_difference_class = {inside, bounds, wrong, radii, work, NULL};
