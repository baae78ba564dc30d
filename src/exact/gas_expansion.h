/* A slab, cylinder or ball of ideal gas that expands from rest into a vacuum: density falls from
 * the centre to nothing at the edge so that the gas stretches evenly, u = r R'/R, and keeps its
 * entropy. Zel'dovich and Raizer, Physics of shock waves, chapter I, section 29; nu = 1, 2, 3
 * dimensions. */
#ifndef BOLIDE_EXACT_GAS_EXPANSION_H
#define BOLIDE_EXACT_GAS_EXPANSION_H

#include "base/parameter.h"
#include "exact/exact.h"

struct exact_gas_expansion {
    int geometry;             /* enum radial_geometry */
    double radius;            /* at the start; half the thickness of a slab */
    double density, pressure; /* at the centre at the start */
    double gamma;
};

extern const struct parameter exact_gas_expansion_table[];
extern const struct exact_class exact_gas_expansion_class;

#endif
