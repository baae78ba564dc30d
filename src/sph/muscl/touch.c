/* When bodies under a contact law touch. Across a gap the contact of a pair would be a dashpot
 * without a spring: it takes the speed of slow bodies before their surfaces meet. So particles of
 * which neither touches the other body do not see each other (find_places). A particle touches when
 * a neighbour there is as near as on a lattice, or when the neighbours there fill what its own body
 * leaves open, and it goes on touching as long as one of them is within its support. The flags
 * follow from the records of a step and count from the next step on. */
#include "sph/kernel.h"
#include "sph/lanes.h"
#include "sph/muscl/muscl.h"
#include "sph/record.h"

/* What the neighbours of a particle say: the fractions of the space around it that neighbours
 * without and with a law fill, its own volume included; the largest ratio of mean diameter to
 * distance among those with a law. */
struct nearness {
    double own, law, closest;
};

/* The volume of a neighbour times the kernel at its distance *R; zero outside the support. */
static double filled_by(const struct sph *sph, int dimension, const double *own,
                        const double *other, double *r)
{
    const int d = record_diameter(dimension);
    const struct vec3 x =
        vec3_sub(vector_from(dimension, other, 1), vector_from(dimension, own, 1));
    const double both = sph->parameters.smoothing * (own[d] + other[d]), r2 = vec3_dot(x, x);
    *r = sqrt(r2);
    return r2 < square(both)
               ? other[record_volume(dimension)] * kernel_value(*r, 2.0 / both, dimension)
               : 0.0;
}

/* A walk over the entries of a row that a law marks (LAW) or does not. */
static void look_around(const struct sph *sph, struct muscl_kind kind, int32_t i, bool law,
                        struct nearness *near)
{
    const struct neighbours *n = &sph->neighbours;
    const int dimension = kind.dimension, v = record_volume(dimension);
    const size_t stride = (size_t)muscl_stride(kind);
    const double *own = sph->record + (size_t)i * stride;
    const double diameter = diameter_of_volume(own[v], dimension);
    int count = (int)n->row[i].count;
    /* near rows are found by the pair sums */
    const uint32_t *entry = n->prune ? neighbours_row(n, i) : neighbours_walk(n, i, &count);
    for (int q = 0; q < count; q++) {
        if ((entry[q] >> ENTRY_PART_SHIFT & PART_LAW) != (law ? PART_LAW : 0))
            continue;
        double r;
        const double *other = sph->record + (size_t)(entry[q] & ENTRY_INDEX) * stride;
        const double filled = filled_by(sph, dimension, own, other, &r);
        if (law && filled > 0.0) {
            const double mean = 0.5 * (diameter + diameter_of_volume(other[v], dimension));
            near->closest = maximum(near->closest, mean / maximum(r, 1e-40));
        }
        *(law ? &near->law : &near->own) += filled;
    }
}

static bool has_laws(const struct neighbours *n, int32_t i)
{
    const uint32_t *entry = neighbours_row(n, i);
    const int count = (int)n->row[i].count, images = lanes_part(entry, 0, count, 0);
    if (images == count)
        return false;
    return entry[images] >> ENTRY_PART_SHIFT == PART_LAW ||
           entry[count - 1] >> ENTRY_PART_SHIFT == (PART_IMAGE | PART_LAW);
}

/* Whether a particle that WAS as the field `touch` has it touches another body. */
static bool touches(const struct sph *sph, struct muscl_kind kind, int32_t i, double was)
{
    /* a thousandth, so that lattices that start in contact touch */
    const double contact = 1.001, at_start = 1.5, full = 0.95, surface = 0.93;
    const int dimension = kind.dimension;
    const double *own = sph->record + (size_t)i * (size_t)muscl_stride(kind);
    struct nearness near = {0.0, 0.0, 0.0};
    if (!has_laws(&sph->neighbours, i))
        return false;
    look_around(sph, kind, i, true, &near);
    if (near.closest == 0.0 || was > 0.0)
        return near.closest > 0.0;
    if (near.closest * (was == 0.0 ? at_start : contact) > 1.0)
        return true;
    if (dimension == 1)
        return false;
    const double inverse_h = 1.0 / (sph->parameters.smoothing * own[record_diameter(dimension)]);
    near.own = own[record_volume(dimension)] * kernel_value(0.0, inverse_h, dimension);
    look_around(sph, kind, i, false, &near);
    return near.own < surface && near.law > full * (1.0 - near.own);
}

void muscl_find_touch(const struct sph *sph, const struct simulation *simulation, double *touch)
{
    const struct muscl_kind kind = muscl_kind_of(sph);
#pragma omp parallel for schedule(dynamic) num_threads(simulation->threads)
    for (int32_t b = 0; b < sph->particles->blocks; b++) {
        const struct block *block = &sph->particles->block[b];
        for (int32_t i = block->first; i < block->first + block->count; i++)
            touch[i] = touches(sph, kind, i, touch[i]) ? 1.0 : -1.0;
    }
}
