/* The cells and particles by which the surface of a body is sampled. Private to surface_*.c. */
#ifndef BOLIDE_SURFACE_SAMPLER_H
#define BOLIDE_SURFACE_SAMPLER_H

#include "model/generate.h"
#include "model/surface.h"

/* A particle, and the first of its elements, which form a chain. */
struct carrier {
    struct vec3 place;
    int64_t site;
    int32_t next; /* in its cell */
    int32_t element;
};

struct piece {
    struct surface_element element; /* sums of place and normal, with weights */
    double weight;
    struct vec3 point, normal; /* of its first face */
    int32_t next;
};

struct sampler {
    const struct place *place;
    const struct simulation_case *input;
    int body, dimension;
    struct bounds bounds; /* of the body, and what walls leave of it */
    const struct replacements *replacements;
    int *other, others;                    /* bodies that may cover or replace it */
    double origin[3], spacing[3], step[3]; /* of cells, and the size of their parts */
    int64_t count[3];
    int32_t *cell; /* first carrier of each, -1: none */
    int64_t cells;
    struct carrier *carrier;
    int64_t carriers, carrier_capacity;
    struct piece *piece;
    int64_t pieces, piece_capacity;
    bool out_of_memory;
};

/* The index of the cell at steps K from that of AT; -1 outside. */
BOLIDE_INLINE int64_t sampler_cell(const struct sampler *s, const int64_t at[3], const int k[3])
{
    int64_t index = 0;
    for (int axis = 0; axis < 3; axis++) {
        const int64_t n = at[axis] + k[axis];
        if (n < 0 || n >= s->count[axis])
            return -1;
        index = index * s->count[axis] + n;
    }
    return index;
}

BOLIDE_INLINE void sampler_cell_of(const struct sampler *s, struct vec3 place, int64_t at[3])
{
    for (int axis = 0; axis < 3; axis++) {
        const double n = floor((vec3_at(place, axis) - s->origin[axis]) / s->spacing[axis]);
        at[axis] = (int64_t)minimum(maximum(n, 0.0), (double)(s->count[axis] - 1));
    }
}

/* The steps to the cells around one, itself in the middle. */
BOLIDE_INLINE int sampler_around(int dimension, int n, int k[3])
{
    static const int cells[] = {1, 3, 9, 27};
    for (int axis = 0; axis < 3; axis++, n /= 3)
        k[axis] = axis < dimension ? n % 3 - 1 : 0;
    return cells[dimension];
}

/* How far carrier C is from PLACE, in spacings, squared. */
BOLIDE_INLINE double sampler_distance(const struct sampler *s, const struct carrier *c,
                                      struct vec3 place)
{
    double sum = 0.0;
    for (int axis = 0; axis < s->dimension; axis++)
        sum += square((vec3_at(c->place, axis) - vec3_at(place, axis)) / s->spacing[axis]);
    return sum;
}

/* Makes SURFACE of what has been sampled; false when memory is out. */
bool sampler_make_surface(const struct sampler *sampler, struct body_surface *surface);

#endif
