/* Grains that fill a box, or do so with a gap between them: the Voronoi cells of random sites. */
#include "shape/kinds.h"
#include "shape/tessellation.h"

#include <string.h>

const struct parameter shape_voronoi_table[] = {
    {.key = "from",
     .kind = PARAMETER_VECTOR,
     .offset = offsetof(struct shape_voronoi, from),
     .unit = "m",
     .help = "the corner of the box with the low coordinates"},
    {.key = "to",
     .kind = PARAMETER_VECTOR,
     .offset = offsetof(struct shape_voronoi, to),
     .unit = "m",
     .help = "the opposite corner"},
    {.key = "size",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct shape_voronoi, size),
     .unit = "m",
     .above = 0.0,
     .below = INFINITY,
     .help =
         "size of the grains: the edge of a square (cube) as large as a grain with half the gap "
         "around it is on average"},
    {.key = "gap",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct shape_voronoi, gap),
     .unit = "m",
     .standard = PARAMETER_OPTIONAL,
     .above = 0.0,
     .below = INFINITY,
     .closed = true,
     .help = "the distance between neighbours; default: that which `fraction` needs, or none"},
    {.key = "fraction",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct shape_voronoi, fraction),
     .unit = "",
     .standard = PARAMETER_OPTIONAL,
     .above = 0.0,
     .below = 1.0,
     .help = "the fraction of the box that all grains fill, in place of `gap`"},
    {.key = "picked",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct shape_voronoi, picked),
     .unit = "",
     .standard = "1",
     .above = 0.0,
     .below = 1.0,
     .closed = true,
     .help =
         "the fraction of the volume of the cells whose grains are the shape, picked at random; "
         "as near as a whole number of grains can be"},
    {.key = "periodic",
     .kind = PARAMETER_NAMES,
     .offset = offsetof(struct shape_voronoi, periodic),
     .standard = PARAMETER_OPTIONAL,
     .help = "axes along which a grain that is cut by a face of the box continues at the opposite "
             "face"},
    {.key = "seed",
     .kind = PARAMETER_INTEGER,
     .offset = offsetof(struct shape_voronoi, seed),
     .standard = "1",
     .help = "another number gives other grains",
     .owned = offsetof(struct shape_voronoi, grains)},
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

const struct shape_class shape_voronoi_class = {inside, bounds, wrong, NULL, NULL, prepare};
