/* Grains that fill a box, or do so with a gap between them: the Voronoi cells of random sites. */
#include "shape/kinds.h"
#include "shape/tessellation.h"

#include <string.h>

const struct parameter shape_voronoi_table[] = {
    PARAMETER(VECTOR, struct shape_voronoi, from, REQUIRED,
              "the corner of the box with the low coordinates", .unit = "m"),
    PARAMETER(VECTOR, struct shape_voronoi, to, REQUIRED, "the opposite corner", .unit = "m"),
    PARAMETER(NUMBER, struct shape_voronoi, size, REQUIRED,
              "size of the grains: the edge of a square (cube) as large as a grain with half the "
              "gap around it is on average",
              .unit = "m", .above = 0.0, .below = INFINITY),
    PARAMETER(NUMBER, struct shape_voronoi, gap, OPTIONAL,
              "the distance between neighbours; default: that which `fraction` needs, or none",
              .unit = "m", .above = 0.0, .below = INFINITY, .closed = true),
    PARAMETER(NUMBER, struct shape_voronoi, fraction, OPTIONAL,
              "the fraction of the box that all grains fill, in place of `gap`", .unit = "",
              .above = 0.0, .below = 1.0),
    PARAMETER(NUMBER, struct shape_voronoi, picked, "1",
              "the fraction of the volume of the cells whose grains are the shape, picked at "
              "random; as near as a whole number of grains can be",
              .unit = "", .above = 0.0, .below = 1.0, .closed = true),
    PARAMETER(
        NAMES, struct shape_voronoi, periodic, OPTIONAL,
        "axes along which a grain that is cut by a face of the box continues at the opposite face"),
    PARAMETER(INTEGER, struct shape_voronoi, seed, "1", "another number gives other grains",
              .owned = offsetof(struct shape_voronoi, grains)),
    PARAMETER_END,
};

static struct bounds bounds(const void *shape)
{
    const struct shape_voronoi *voronoi = shape;
    return (struct bounds){vec3_of(&voronoi->from), vec3_of(&voronoi->to)};
}

/* The box has its low faces and not its high ones. */
static bool inside(const void *shape, struct vec3 point)
{
    const struct shape_voronoi *voronoi = shape;
    assert(voronoi->grains);
    return point_in_box(&voronoi->from, &voronoi->to, point) &&
           tessellation_holds(voronoi->grains, point);
}

static const char *wrong(const void *shape, int dimension)
{
    const struct shape_voronoi *voronoi = shape;
    if (dimension < 2 || voronoi->from.count != dimension || voronoi->to.count != dimension)
        return "Voronoi grains need two or three dimensions, and as many numbers in `from` and "
               "`to`";
    for (int axis = 0; axis < dimension; axis++)
        if (!(voronoi->from.at[axis] < voronoi->to.at[axis]))
            return "each number of `from` must be below that of `to`";
    if (!isnan(voronoi->gap) && !isnan(voronoi->fraction))
        return "give `gap` or `fraction`: one follows from the other";
    if (!(voronoi->picked > 0.0))
        return "`picked` must be above zero: no grain is left";
    bool periodic[3];
    if (!axes_of(&voronoi->periodic, dimension, periodic))
        return "`periodic` is a list of axes of the case: x, y, z";
    return NULL;
}

static const char *prepare(void *shape, int dimension)
{
    struct shape_voronoi *voronoi = shape;
    if (voronoi->grains)
        return NULL;
    struct tessellation_wanted wanted = {.dimension = dimension,
                                         .box = bounds(voronoi),
                                         .size = voronoi->size,
                                         .gap = voronoi->gap,
                                         .fraction = voronoi->fraction,
                                         .picked = voronoi->picked,
                                         .seed = (uint64_t)voronoi->seed};
    if (isnan(wanted.gap))
        wanted.gap = 0.0;
    axes_of(&voronoi->periodic, dimension, wanted.periodic);
    return tessellation_make(&wanted, &voronoi->grains);
}

/* Those of a polycrystal touch everywhere. */
static bool grains(const void *shape, struct grain_sizes *sizes)
{
    const struct shape_voronoi *voronoi = shape;
    const double gap = voronoi->grains ? 2.0 * voronoi->grains->half_gap : 0.0;
    *sizes = (struct grain_sizes){NAN, voronoi->size - gap};
    return gap > 0.0;
}

const struct shape_class shape_voronoi_class = {
    .inside = inside, .bounds = bounds, .wrong = wrong, .prepare = prepare, .grains = grains};
