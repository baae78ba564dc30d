/* The sets that a list of shapes makes: their union, their intersection, and the first without all
 * others, whose bounds and lattice are the first's: a hole does not move the sites around it. */
#include "shape/kinds.h"

const struct parameter shape_union_table[] = {
    PARAMETER(LIST, struct shape_union, shapes, REQUIRED, "the shapes that are joined",
              .kind_of_thing = "shape"),
    PARAMETER_END,
};

const struct parameter shape_intersection_table[] = {
    PARAMETER(LIST, struct shape_intersection, shapes, REQUIRED,
              "the shapes to intersect; at least one of them is bounded", .kind_of_thing = "shape"),
    PARAMETER_END,
};

const struct parameter shape_difference_table[] = {
    PARAMETER(LIST, struct shape_difference, shapes, REQUIRED,
              "the shape to cut from, then those to cut away", .kind_of_thing = "shape"),
    PARAMETER_END,
};

/* All three are a list alone. */
static const struct one_of *items_of(const void *shape)
{
    return ((const struct one_of_list *)shape)->items;
}

static int count_of(const void *shape) { return ((const struct one_of_list *)shape)->count; }

/* Whether one of the items from FIRST on contains POINT. */
static bool any_inside(const void *shape, int first, struct vec3 point)
{
    for (int i = first; i < count_of(shape); i++)
        if (shape_inside(&items_of(shape)[i], point))
            return true;
    return false;
}

static bool union_inside(const void *shape, struct vec3 point)
{
    return any_inside(shape, 0, point);
}

static bool intersection_inside(const void *shape, struct vec3 point)
{
    for (int i = 0; i < count_of(shape); i++)
        if (!shape_inside(&items_of(shape)[i], point))
            return false;
    return true;
}

static bool difference_inside(const void *shape, struct vec3 point)
{
    return shape_inside(items_of(shape), point) && !any_inside(shape, 1, point);
}

static struct bounds first_bounds(const void *shape) { return shape_bounds(items_of(shape)); }

static struct bounds union_bounds(const void *shape)
{
    struct bounds all = first_bounds(shape);
    for (int i = 1; i < count_of(shape); i++)
        all = bounds_around(all, shape_bounds(&items_of(shape)[i]));
    return all;
}

static struct bounds intersection_bounds(const void *shape)
{
    struct bounds all = first_bounds(shape);
    for (int i = 1; i < count_of(shape); i++)
        all = bounds_common(all, shape_bounds(&items_of(shape)[i]));
    return all;
}

static const char *union_wrong(const void *shape, int dimension)
{
    return count_of(shape) < 1 ? "a union needs at least one shape"
                               : shapes_wrong(shape, dimension);
}

static const char *intersection_wrong(const void *shape, int dimension)
{
    if (count_of(shape) < 2)
        return "an intersection needs at least two shapes";
    const char *text = shapes_wrong(shape, dimension);
    if (text)
        return text;
    const struct bounds all = intersection_bounds(shape);
    if (all.low.x > all.high.x || all.low.y > all.high.y || all.low.z > all.high.z)
        return "the shapes of this intersection lie apart";
    return NULL;
}

static const char *difference_wrong(const void *shape, int dimension)
{
    return count_of(shape) < 2 ? "a difference needs at least two shapes"
                               : shapes_wrong(shape, dimension);
}

static bool first_radii(const void *shape, struct radii *radii)
{
    return shape_radii(items_of(shape), radii);
}

static bool first_grains(const void *shape, struct grain_sizes *sizes)
{
    return shape_grains(items_of(shape), sizes);
}

static double work(const void *shape) { return shapes_work(shape); }

const struct shape_class shape_union_class = {union_inside, union_bounds, union_wrong, NULL,
                                              work,         NULL,         NULL};
const struct shape_class shape_intersection_class = {
    intersection_inside, intersection_bounds, intersection_wrong, first_radii, work, NULL,
    first_grains};
const struct shape_class shape_difference_class = {
    difference_inside, first_bounds, difference_wrong, first_radii, work, NULL, first_grains};
