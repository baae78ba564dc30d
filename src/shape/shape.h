/* Shapes: where a body is. A shape is a choice of the catalogue's kind "shape"; its thing is a struct
 * shape_class. Those made of other shapes ask them in turn. */
#ifndef BOLIDE_SHAPE_H
#define BOLIDE_SHAPE_H

#include "base/parameter.h"
#include "base/vector.h"

struct bounds {
    struct vec3 low, high;
};

/* A middle, and how far from it the matter of a round shape begins and ends. */
struct radii {
    struct vec3 center;
    double inner, outer;
};

struct shape_class {
    bool (*inside)(const void *shape, struct vec3 point);
    /* The smallest box known to hold the shape; infinite where it has no end. */
    struct bounds (*bounds)(const void *shape);
    /* NULL when the parameters make sense in DIMENSION, else what is wrong (static text). */
    const char *(*wrong)(const void *shape, int dimension);
    /* Fills *radii; false, or NULL instead of a function, when the shape is not round. */
    bool (*radii)(const void *shape, struct radii *radii);
    /* How many simple shapes a single question may ask, at most; NULL: one. */
    double (*work)(const void *shape);
};

extern const struct choice shape_choices[];
extern const int shape_choice_count;

bool shape_inside(const struct one_of *shape, struct vec3 point);
struct bounds shape_bounds(const struct one_of *shape);
const char *shape_wrong(const struct one_of *shape, int dimension);
bool shape_radii(const struct one_of *shape, struct radii *radii);

double shape_work(const struct one_of *shape);
/* The sum of those of a list. */
double shapes_work(const struct one_of_list *shapes);

/* The first mistake of a list of shapes, NULL when there is none. */
const char *shapes_wrong(const struct one_of_list *shapes, int dimension);

bool bounds_finite(const struct bounds *bounds);

/* What holds both of two bounds, and what they have in common, whose low end is above its high end where
 * they lie apart. */
struct bounds bounds_around(struct bounds a, struct bounds b);
struct bounds bounds_common(struct bounds a, struct bounds b);

#endif
