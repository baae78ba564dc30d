/* The list of shapes, and questions to whichever shape a case has chosen. */
#include "shape/kinds.h"

#include <string.h>

#define SHAPE_CHOICE(identifier, help)                                                 \
    {#identifier, help, shape_##identifier##_table, sizeof(struct shape_##identifier), \
     &shape_##identifier##_class},

const struct choice shape_choices[] = {SHAPE_LIST(SHAPE_CHOICE)};

const int shape_choice_count = (int)COUNT_OF(shape_choices);

static const struct shape_class *class_of(const struct one_of *shape)
{
    assert(shape->choice);
    return shape->choice->thing;
}

bool shape_inside(const struct one_of *shape, struct vec3 point)
{
    return class_of(shape)->inside(shape->value, point);
}

struct bounds shape_bounds(const struct one_of *shape)
{
    return class_of(shape)->bounds(shape->value);
}

const char *shape_wrong(const struct one_of *shape, int dimension)
{
    const struct shape_class *class = class_of(shape);
    const char *text = class->wrong(shape->value, dimension);
    return !text && class->prepare ? class->prepare(shape->value, dimension) : text;
}

bool shape_radii(const struct one_of *shape, struct radii *radii)
{
    const struct shape_class *class = class_of(shape);
    return class->radii && class->radii(shape->value, radii);
}

bool shape_grains(const struct one_of *shape, struct grain_sizes *sizes)
{
    const struct shape_class *class = shape->choice ? shape->choice->thing : NULL;
    return class && class->grains && class->grains(shape->value, sizes);
}

bool shape_is_box(const struct one_of *shape) { return class_of(shape) == &shape_box_class; }

double shape_work(const struct one_of *shape)
{
    const struct shape_class *class = class_of(shape);
    return class->work ? class->work(shape->value) : 1.0;
}

double shapes_work(const struct one_of_list *shapes)
{
    double work = 0.0;
    for (int i = 0; i < shapes->count; i++)
        work += shape_work(&shapes->items[i]);
    return work;
}

const char *shapes_wrong(const struct one_of_list *shapes, int dimension)
{
    const char *text = NULL;
    for (int i = 0; i < shapes->count && !text; i++)
        text = shape_wrong(&shapes->items[i], dimension);
    return text;
}

bool bounds_finite(const struct bounds *bounds)
{
    return isfinite(bounds->low.x) && isfinite(bounds->low.y) && isfinite(bounds->low.z) &&
           isfinite(bounds->high.x) && isfinite(bounds->high.y) && isfinite(bounds->high.z);
}

bool axes_of(const struct name_list *names, int dimension, bool marked[3])
{
    for (int axis = 0; axis < 3; axis++)
        marked[axis] = false;
    for (int i = 0; i < names->count; i++) {
        const char *name = names->names[i];
        if (strlen(name) != 1 || name[0] < 'x' || name[0] >= 'x' + dimension)
            return false;
        marked[name[0] - 'x'] = true;
    }
    return true;
}

static struct vec3 lower_ends(struct vec3 a, struct vec3 b)
{
    return vec3_make(minimum(a.x, b.x), minimum(a.y, b.y), minimum(a.z, b.z));
}

static struct vec3 higher_ends(struct vec3 a, struct vec3 b)
{
    return vec3_make(maximum(a.x, b.x), maximum(a.y, b.y), maximum(a.z, b.z));
}

struct bounds bounds_around(struct bounds a, struct bounds b)
{
    return (struct bounds){lower_ends(a.low, b.low), higher_ends(a.high, b.high)};
}

double bounds_distance(const struct bounds *bounds, struct vec3 place, int dimension)
{
    double sum = 0.0;
    for (int axis = 0; axis < dimension; axis++) {
        const double at = vec3_at(place, axis);
        sum += square(maximum(
            0.0, maximum(vec3_at(bounds->low, axis) - at, at - vec3_at(bounds->high, axis))));
    }
    return sqrt(sum);
}

struct bounds bounds_common(struct bounds a, struct bounds b)
{
    return (struct bounds){higher_ends(a.low, b.low), lower_ends(a.high, b.high)};
}
