/* Shapes and cases built in C, for tests of the model's parts without a file. */
#ifndef BOLIDE_TEST_BUILD_CASE_H
#define BOLIDE_TEST_BUILD_CASE_H

#include <string.h>

#include "case/case.h"
#include "shape/kinds.h"
#include "shape/lattice.h"

/* The shape NAME with the parameters in VALUE. */
static inline struct one_of shape_of(const char *name, void *value)
{
    for (int i = 0; i < shape_choice_count; i++)
        if (strcmp(shape_choices[i].name, name) == 0)
            return (struct one_of){i, &shape_choices[i], value};
    return (struct one_of){-1, NULL, NULL};
}

/* The lattice KIND with the parameters in VALUE. */
static inline struct one_of lattice_of(enum lattice_kind kind, void *value)
{
    return (struct one_of){(int)kind, &lattice_choices[kind], value};
}

#define VECTOR(...)                                                              \
    {                                                                            \
        (int)(sizeof((double[]){__VA_ARGS__}) / sizeof(double)), { __VA_ARGS__ } \
    }

#endif
