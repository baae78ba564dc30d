/* Copies of a shape at equal steps along the axes, in straight or staggered rows. The copies near a
 * point are found by arithmetic: a million cost as much as one. */
#include "shape/kinds.h"

/* The names begin with none: an axis is one less than the choice. */
static const char *const stagger_names[] = {"none", "x", "y", "z", NULL};

const struct parameter shape_repeat_table[] = {
    PARAMETER(ONE_OF, struct shape_repeat, shape, REQUIRED,
              "the shape, at the position of the first copy", .kind_of_thing = "shape"),
    PARAMETER(VECTOR, struct shape_repeat, count, REQUIRED, "the number of copies along each axis",
              .unit = ""),
    PARAMETER(VECTOR, struct shape_repeat, step, REQUIRED,
              "the distance from copy to copy along each axis", .unit = "m"),
    PARAMETER(CHOICE, struct shape_repeat, stagger, "none",
              "the axis along which every second row of copies is shifted by half a step; in 3-D "
              "rows are counted along both other axes",
              .names = stagger_names),
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
    const double low[3] = {one.low.x, one.low.y, one.low.z};
    const double high[3] = {one.high.x, one.high.y, one.high.z};
    const double at[3] = {point.x, point.y, point.z};
    const double *step = repeat->step.at, *count = repeat->count.at;
    /* The axis of the shift comes last, since its copies depend on the row. */
    const int a = repeat->stagger ? repeat->stagger - 1 : 0, b = (a + 1) % 3, c = (a + 2) % 3;
    const struct copies third = copies_near(at[c], low[c], high[c], step[c], count[c]);
    const struct copies second = copies_near(at[b], low[b], high[b], step[b], count[b]);
    for (int64_t k = third.first; k <= third.last; k++)
        for (int64_t j = second.first; j <= second.last; j++) {
            const double shift = repeat->stagger && (j + k) % 2 ? 0.5 * step[a] : 0.0;
            const struct copies first =
                copies_near(at[a] - shift, low[a], high[a], step[a], count[a]);
            for (int64_t i = first.first; i <= first.last; i++) {
                double moved[3];
                moved[a] = at[a] - ((double)i * step[a] + shift);
                moved[b] = at[b] - (double)j * step[b];
                moved[c] = at[c] - (double)k * step[c];
                if (shape_inside(&repeat->shape, vec3_make(moved[0], moved[1], moved[2])))
                    return true;
            }
        }
    return false;
}

static struct bounds bounds(const void *shape)
{
    const struct shape_repeat *repeat = shape;
    struct bounds all = shape_bounds(&repeat->shape);
    double reach[3], rows = 1.0;
    for (int axis = 0; axis < 3; axis++) {
        const double count = maximum(repeat->count.at[axis], 1.0);
        reach[axis] = (count - 1.0) * repeat->step.at[axis];
        rows *= axis == repeat->stagger - 1 ? 1.0 : count;
    }
    if (repeat->stagger && rows > 1.0)
        reach[repeat->stagger - 1] += 0.5 * repeat->step.at[repeat->stagger - 1];
    all.high = vec3_add(all.high, vec3_make(reach[0], reach[1], reach[2]));
    return all;
}

static const char *wrong(const void *shape, int dimension)
{
    const struct shape_repeat *repeat = shape;
    if (repeat->count.count != dimension || repeat->step.count != dimension)
        return "a repetition needs as many numbers in `count` and `step` as the case has "
               "dimensions";
    for (int axis = 0; axis < dimension; axis++) {
        const double count = repeat->count.at[axis];
        if (!(count >= 1.0 && count <= 1e9) || count != floor(count))
            return "the `count` of a repetition must be whole numbers from 1 to 1e9";
        if (count > 1.0 && !(repeat->step.at[axis] > 0.0))
            return "the `step` of a repetition must be positive where there is more than one copy";
    }
    if (repeat->stagger > dimension || (repeat->stagger && dimension == 1))
        return "the `stagger` of a repetition needs its axis and one more";
    if (repeat->stagger && !(repeat->step.at[repeat->stagger - 1] > 0.0))
        return "the `step` of a repetition must be positive along its `stagger`";
    const char *text = shape_wrong(&repeat->shape, dimension);
    if (text)
        return text;
    const struct bounds one = shape_bounds(&repeat->shape);
    return bounds_finite(&one) ? NULL : "an infinite shape cannot be repeated";
}

/* As many copies as may lie over one another at a place. */
static double work(const void *shape)
{
    const struct shape_repeat *repeat = shape;
    const struct bounds one = shape_bounds(&repeat->shape);
    const double extent[3] = {one.high.x - one.low.x, one.high.y - one.low.y,
                              one.high.z - one.low.z};
    double copies = 1.0;
    for (int axis = 0; axis < 3; axis++)
        if (repeat->count.at[axis] > 1.0)
            copies *=
                minimum(repeat->count.at[axis], floor(extent[axis] / repeat->step.at[axis]) + 1.0);
    return copies * shape_work(&repeat->shape);
}

/* So many copies, or more, are a bed of grains. */
enum { MANY = 10 };

static bool grains(const void *shape, struct grain_sizes *sizes)
{
    const struct shape_repeat *repeat = shape;
    struct radii radii;
    if (repeat->count.at[0] * repeat->count.at[1] < MANY)
        return false;
    if (!shape_radii(&repeat->shape, &radii) || radii.inner > 0.0)
        return shape_grains(&repeat->shape, sizes);
    *sizes = (struct grain_sizes){2.0 * radii.outer, 2.0 * radii.outer};
    return true;
}

const struct shape_class shape_repeat_class = {
    .inside = inside, .bounds = bounds, .wrong = wrong, .work = work, .grains = grains};
