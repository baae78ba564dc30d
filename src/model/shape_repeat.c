/* Copies of a shape at equal steps along the axes. The copies near a point are found by arithmetic: a
 * million cost as much as one. */
#include "model/shape_kinds.h"

const struct parameter shape_repeat_table[] = {
    {.key = "shape",
     .kind = PARAMETER_ONE_OF,
     .offset = offsetof(struct shape_repeat, shape),
     .kind_of_thing = "shape",
     .help = "the shape that is copied, where its first copy stands"},
    {.key = "count",
     .kind = PARAMETER_VECTOR,
     .offset = offsetof(struct shape_repeat, count),
     .unit = "",
     .help = "the number of copies along each axis"},
    {.key = "step",
     .kind = PARAMETER_VECTOR,
     .offset = offsetof(struct shape_repeat, step),
     .unit = "m",
     .help = "the distance from copy to copy along each axis"},
    PARAMETER_END,
};

/* The copies first .. last along one axis. */
struct copies {
    int64_t first, last;
};

/* Bounds and quotient are rounded; so much of a step more is searched on either side. */
static const double search_margin = 1e-6;

/* The copies whose bounds LOW .. HIGH, moved by k steps, can hold coordinate AT:
 * (at - high)/step <= k <= (at - low)/step. */
static struct copies copies_near(double at, double low, double high, double step, double count)
{
    if (count <= 1.0)
        return (struct copies){0, 0};
    const double first = ceil((at - high) / step - search_margin);
    const double last = floor((at - low) / step + search_margin);
    if (first >= count || last < 0.0)
        return (struct copies){0, -1};
    return (struct copies){(int64_t)maximum(first, 0.0), (int64_t)minimum(last, count - 1.0)};
}

static bool inside(const void *shape, struct vec3 point)
{
    const struct shape_repeat *repeat = shape;
    const struct bounds one = shape_bounds(&repeat->shape);
    const struct vec3 step = vec3_of(&repeat->step), count = vec3_of(&repeat->count);
    const struct copies x = copies_near(point.x, one.low.x, one.high.x, step.x, count.x);
    const struct copies y = copies_near(point.y, one.low.y, one.high.y, step.y, count.y);
    const struct copies z = copies_near(point.z, one.low.z, one.high.z, step.z, count.z);
    for (int64_t k = z.first; k <= z.last; k++)
        for (int64_t j = y.first; j <= y.last; j++)
            for (int64_t i = x.first; i <= x.last; i++) {
                const struct vec3 moved =
                    vec3_make((double)i * step.x, (double)j * step.y, (double)k * step.z);
                if (shape_inside(&repeat->shape, vec3_sub(point, moved)))
                    return true;
            }
    return false;
}

static struct bounds bounds(const void *shape)
{
    const struct shape_repeat *repeat = shape;
    struct bounds all = shape_bounds(&repeat->shape);
    const struct vec3 step = vec3_of(&repeat->step), count = vec3_of(&repeat->count);
    all.high.x += maximum(count.x - 1.0, 0.0) * step.x;
    all.high.y += maximum(count.y - 1.0, 0.0) * step.y;
    all.high.z += maximum(count.z - 1.0, 0.0) * step.z;
    return all;
}

static const char *wrong(const void *shape, int dimension)
{
    const struct shape_repeat *repeat = shape;
    if (repeat->count.count != dimension || repeat->step.count != dimension)
        return "a repetition wants as many numbers in `count` and `step` as the case has "
               "dimensions";
    for (int axis = 0; axis < dimension; axis++) {
        const double count = repeat->count.at[axis];
        if (!(count >= 1.0 && count <= 1e9) || count != floor(count))
            return "the `count` of a repetition must be whole numbers from 1 to 1e9";
        if (count > 1.0 && !(repeat->step.at[axis] > 0.0))
            return "the `step` of a repetition must be positive where there is more than one copy";
    }
    return shape_wrong(&repeat->shape, dimension);
}

const struct shape_class shape_repeat_class = {inside, bounds, wrong};
