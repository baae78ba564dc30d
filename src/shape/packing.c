/* Grains at random places in a box: discs in 2-D, spheres in 3-D. */
#include "shape/grains.h"
#include "shape/kinds.h"

const struct parameter shape_packing_table[] = {
    PARAMETER(VECTOR, struct shape_packing, from, REQUIRED,
              "the corner of the box with the low coordinates", .unit = "m"),
    PARAMETER(VECTOR, struct shape_packing, to, REQUIRED, "the opposite corner", .unit = "m"),
    PARAMETER(NUMBER, struct shape_packing, fraction, REQUIRED,
              "the fraction of the box that the grains fill; random packings of equal discs reach "
              "about 0.8, of equal spheres 0.6",
              .unit = "", .above = 0.0, .below = 1.0),
    PARAMETER(NUMBER, struct shape_packing, radius, REQUIRED,
              "the radius of the grains, or of the smallest; all radii change by one factor so "
              "that a whole number of grains gives `fraction`",
              .unit = "m", .above = 0.0, .below = INFINITY),
    PARAMETER(NUMBER, struct shape_packing, largest, OPTIONAL,
              "the largest radius: radii are evenly distributed between the two; default: all are "
              "`radius`",
              .unit = "m", .above = 0.0, .below = INFINITY),
    PARAMETER(NUMBER, struct shape_packing, gap, "0 m",
              "the least distance between two grains; half of it to the faces of the box",
              .unit = "m", .above = 0.0, .below = INFINITY, .closed = true),
    PARAMETER(NAMES, struct shape_packing, periodic, OPTIONAL,
              "axes along which a grain that is cut by a face of the box continues at the opposite "
              "face; default: all grains are whole"),
    PARAMETER(INTEGER, struct shape_packing, seed, "1", "another number gives other places",
              .owned = offsetof(struct shape_packing, grains)),
    PARAMETER_END,
};

static struct bounds bounds(const void *shape)
{
    const struct shape_packing *packing = shape;
    return (struct bounds){vec3_of(&packing->from), vec3_of(&packing->to)};
}

/* The box has its low faces and not its high ones. */
static bool inside(const void *shape, struct vec3 point)
{
    const struct shape_packing *packing = shape;
    assert(packing->grains);
    return point_in_box(&packing->from, &packing->to, point) && grains_hold(packing->grains, point);
}

static const char *wrong(const void *shape, int dimension)
{
    const struct shape_packing *packing = shape;
    if (dimension < 2 || packing->from.count != dimension || packing->to.count != dimension)
        return "a packing needs two or three dimensions, and as many numbers in `from` and `to`";
    for (int axis = 0; axis < dimension; axis++)
        if (!(packing->from.at[axis] < packing->to.at[axis]))
            return "each number of `from` of a packing must be below that of `to`";
    if (packing->largest < packing->radius)
        return "the `largest` radius of a packing must not be below `radius`";
    bool periodic[3];
    if (!axes_of(&packing->periodic, dimension, periodic))
        return "`periodic` of a packing is a list of axes of the case: x, y, z";
    return NULL;
}

static const char *prepare(void *shape, int dimension)
{
    struct shape_packing *packing = shape;
    if (packing->grains)
        return NULL;
    struct grains_wanted wanted = {.dimension = dimension,
                                   .box = bounds(packing),
                                   .fraction = packing->fraction,
                                   .smallest = packing->radius,
                                   .largest = packing->largest,
                                   .gap = packing->gap,
                                   .seed = (uint64_t)packing->seed};
    if (isnan(wanted.largest))
        wanted.largest = packing->radius;
    axes_of(&packing->periodic, dimension, wanted.periodic);
    return grains_make(&wanted, &packing->grains);
}

static bool grains(const void *shape, struct grain_sizes *sizes)
{
    const struct grains *all = ((const struct shape_packing *)shape)->grains;
    *sizes = (struct grain_sizes){INFINITY, 0.0};
    for (int64_t i = 0; all && i < all->count; i++) {
        sizes->smallest = minimum(sizes->smallest, 2.0 * all->radius[i]);
        sizes->mean += 2.0 * all->radius[i] / (double)all->count;
    }
    return sizes->mean > 0.0;
}

const struct shape_class shape_packing_class = {
    .inside = inside, .bounds = bounds, .wrong = wrong, .prepare = prepare, .grains = grains};
