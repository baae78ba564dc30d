/* Shapes sampled at many points, for tests of what is in them. */
#ifndef BOLIDE_TEST_SAMPLE_H
#define BOLIDE_TEST_SAMPLE_H

#include "build_case.h"

/* A repeatable random number in 0 .. 1. */
static inline double random_number(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

static inline struct vec3 random_point(uint64_t *state, double low, double high)
{
    const double x = low + (high - low) * random_number(state);
    const double y = low + (high - low) * random_number(state);
    const double z = low + (high - low) * random_number(state);
    return vec3_make(x, y, z);
}

/* Volume (area, length) of the cells with their center inside, COUNT along each axis. */
static inline double sampled_volume(const struct one_of *shape, int dimension, int count)
{
    const struct bounds bounds = shape_bounds(shape);
    const struct vec3 cell = vec3_scale(1.0 / count, vec3_sub(bounds.high, bounds.low));
    int64_t inside = 0;
    for (int k = 0; k < (dimension > 2 ? count : 1); k++)
        for (int j = 0; j < (dimension > 1 ? count : 1); j++)
            for (int i = 0; i < count; i++)
                inside += shape_inside(shape, vec3_make(bounds.low.x + (i + 0.5) * cell.x,
                                                        bounds.low.y + (j + 0.5) * cell.y,
                                                        bounds.low.z + (k + 0.5) * cell.z));
    return (double)inside * cell.x * (dimension > 1 ? cell.y : 1.0) *
           (dimension > 2 ? cell.z : 1.0);
}

static inline void assert_near(double value, double wanted, double within)
{
    if (!(fabs(value - wanted) <= within * fabs(wanted)))
        fail_msg("%.9g is not within %g of %.9g", value, within, wanted);
}

#define POINTS(...)                                                                            \
    {                                                                                          \
        {                                                                                      \
            (int)(sizeof((struct vector_value[]){__VA_ARGS__}) / sizeof(struct vector_value)), \
                (struct vector_value[])                                                        \
            {                                                                                  \
                __VA_ARGS__                                                                    \
            }                                                                                  \
        }                                                                                      \
    }

static inline void assert_wrong(const char *name, void *value, int dimension, const char *words)
{
    const struct one_of shape = shape_of(name, value);
    const char *text = shape_wrong(&shape, dimension);
    if (!text || !strstr(text, words))
        fail_msg("\"%s\" does not tell of \"%s\"", text ? text : "nothing", words);
}

#endif
