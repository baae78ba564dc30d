/* Shapes of bodies. A shape is a choice of the catalogue's kind "shape", and its thing is a struct
 * shape_class. Shapes that are made of others call the functions of these. */
#ifndef BOLIDE_SHAPE_H
#define BOLIDE_SHAPE_H

#include "base/parameter.h"
#include "base/vector.h"

struct bounds {
    struct vec3 low, high;
};

/* The centre of a round shape, and its inner and outer radius. */
struct radii {
    struct vec3 center;
    double inner, outer;
};

/* Diameters of the grains that a shape consists of; smallest NAN: not known. */
struct grain_sizes {
    double smallest, mean;
};

struct shape_class {
    bool (*inside)(const void *shape, struct vec3 point);
    /* The smallest box known to contain the shape; infinite if the shape is unbounded. */
    struct bounds (*bounds)(const void *shape);
    /* NULL when the parameters make sense in DIMENSION, else what is wrong (static text). */
    const char *(*wrong)(const void *shape, int dimension);
    /* Fills *radii; false, or NULL instead of a function, when the shape is not round. */
    bool (*radii)(const void *shape, struct radii *radii);
    /* The largest number of simple shapes that one query tests; NULL: one. */
    double (*work)(const void *shape);
    /* Computes what the shape keeps beside its parameters, once they are right; NULL, or what is
     * wrong (static text). NULL instead of a function: nothing. */
    const char *(*prepare)(void *shape, int dimension);
    /* Fills *sizes of a shape that has been prepared; false, or NULL instead of a function, when it
     * does not consist of grains, or they fill all of its box. */
    bool (*grains)(const void *shape, struct grain_sizes *sizes);
};

extern const struct choice shape_choices[];
extern const int shape_choice_count;

bool shape_inside(const struct one_of *shape, struct vec3 point);
struct bounds shape_bounds(const struct one_of *shape);
/* Prepares the shape too: it comes before any question of what is inside. */
const char *shape_wrong(const struct one_of *shape, int dimension);
bool shape_radii(const struct one_of *shape, struct radii *radii);

bool shape_grains(const struct one_of *shape, struct grain_sizes *sizes);

/* Whether the shape is a box along the axes. */
bool shape_is_box(const struct one_of *shape);

double shape_work(const struct one_of *shape);
/* The sum of those of a list. */
double shapes_work(const struct one_of_list *shapes);

/* The first mistake of a list of shapes, NULL when there is none. */
const char *shapes_wrong(const struct one_of_list *shapes, int dimension);

bool bounds_finite(const struct bounds *bounds);

/* The union and the intersection of two bounds. The intersection of disjoint bounds has low above
 * high. */
struct bounds bounds_around(struct bounds a, struct bounds b);
struct bounds bounds_common(struct bounds a, struct bounds b);
/* How far PLACE is from BOUNDS along the first DIMENSION axes. */
double bounds_distance(const struct bounds *bounds, struct vec3 place, int dimension);

#endif
