/* The points that all shapes of a list have in common. */
#include "shape/kinds.h"

const struct parameter shape_intersection_table[] = {
    PARAMETER(LIST, struct shape_intersection, shapes, REQUIRED,
              "the shapes to intersect; at least one of them is bounded", .kind_of_thing = "shape"),
    PARAMETER_END,
};

static bool inside(const void *shape, struct vec3 point)
{
    const struct one_of_list *shapes = &((const struct shape_intersection *)shape)->shapes;
    for (int i = 0; i < shapes->count; i++)
        if (!shape_inside(&shapes->items[i], point))
            return false;
    return true;
}

static struct bounds bounds(const void *shape)
{
    const struct one_of_list *shapes = &((const struct shape_intersection *)shape)->shapes;
    struct bounds all = shape_bounds(&shapes->items[0]);
    for (int i = 1; i < shapes->count; i++)
        all = bounds_common(all, shape_bounds(&shapes->items[i]));
    return all;
}

static const char *wrong(const void *shape, int dimension)
{
    const struct one_of_list *shapes = &((const struct shape_intersection *)shape)->shapes;
    if (shapes->count < 2)
        return "an intersection needs at least two shapes";
    const char *text = shapes_wrong(shapes, dimension);
    if (text)
        return text;
    const struct bounds all = bounds(shape);
    if (all.low.x > all.high.x || all.low.y > all.high.y || all.low.z > all.high.z)
        return "the shapes of this intersection lie apart";
    return NULL;
}

static bool radii(const void *shape, struct radii *radii)
{
    return shape_radii(&((const struct shape_intersection *)shape)->shapes.items[0], radii);
}

static double work(const void *shape)
{
    return shapes_work(&((const struct shape_intersection *)shape)->shapes);
}

const struct shape_class shape_intersection_class = {inside, bounds, wrong, radii, work, NULL};
