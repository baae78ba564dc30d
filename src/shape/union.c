/* All points of a list of shapes. */
#include "shape/kinds.h"

const struct parameter shape_union_table[] = {
    PARAMETER(LIST, struct shape_union, shapes, REQUIRED, "the shapes that are joined",
              .kind_of_thing = "shape"),
    PARAMETER_END,
};

static bool inside(const void *shape, struct vec3 point)
{
    const struct one_of_list *shapes = &((const struct shape_union *)shape)->shapes;
    for (int i = 0; i < shapes->count; i++)
        if (shape_inside(&shapes->items[i], point))
            return true;
    return false;
}

static struct bounds bounds(const void *shape)
{
    const struct one_of_list *shapes = &((const struct shape_union *)shape)->shapes;
    struct bounds all = shape_bounds(&shapes->items[0]);
    for (int i = 1; i < shapes->count; i++)
        all = bounds_around(all, shape_bounds(&shapes->items[i]));
    return all;
}

static const char *wrong(const void *shape, int dimension)
{
    const struct one_of_list *shapes = &((const struct shape_union *)shape)->shapes;
    if (shapes->count < 1)
        return "a union needs at least one shape";
    return shapes_wrong(shapes, dimension);
}

static double work(const void *shape)
{
    return shapes_work(&((const struct shape_union *)shape)->shapes);
}

const struct shape_class shape_union_class = {inside, bounds, wrong, NULL, work, NULL};
