/* Shapes: where a body is. A shape is a choice of the catalogue's kind "shape"; its thing is a struct
 * shape_class. Union, difference and repetition hold other shapes and ask them in turn. */
#ifndef BOLIDE_SHAPE_H
#define BOLIDE_SHAPE_H

#include "base/parameter.h"
#include "base/vector.h"

struct bounds {
    struct vec3 low, high;
};

struct shape_class {
    bool (*inside)(const void *shape, struct vec3 point);
    /* The smallest box known to hold the shape. */
    struct bounds (*bounds)(const void *shape);
    /* NULL when the parameters make sense in DIMENSION, else what is wrong (static text). */
    const char *(*wrong)(const void *shape, int dimension);
};

extern const struct choice shape_choices[];
extern const int shape_choice_count;

bool shape_inside(const struct one_of *shape, struct vec3 point);
struct bounds shape_bounds(const struct one_of *shape);
const char *shape_wrong(const struct one_of *shape, int dimension);

#endif
