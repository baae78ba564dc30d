/* When bodies that may be apart touch: those under a contact law, and those that started apart.
 * Across a gap the contact of a pair would be a dashpot without a spring: it takes the speed of
 * slow bodies before their surfaces meet. So particles of which neither touches the other body do
 * not see each other (find_places). A particle touches when a neighbour there is as near as on a
 * lattice, or when the neighbours there fill what its own body leaves open, and it goes on touching
 * as long as one of them is within its support. The flags follow from the records of a step and
 * count in the next one, so the places are those of the next one, too. */
#include "sph/kernel.h"
#include "sph/lanes.h"
#include "sph/muscl/muscl.h"
#include "sph/record.h"

/* D/r of particles that touch, with a hundredth of room, as for what is filled: all particles of a
 * face that meets another one must touch at once. */
static const double contact = 1.01, full = 0.97;
/* More than this of the space around a particle that its own body fills: it is inside. */
static const double inside = 0.93;

/* Records, and the step after which particles are looked at; zero before the first. */
struct touching {
    const struct sph *sph;
    const struct simulation *simulation;
    struct muscl_kind kind;
    double dt;
};

/* What the neighbours of a particle say: how near the nearest of other bodies is, 1 in contact, 0
 * where there is none; the fractions of the space around it that those of its own body, itself
 * included, and of others fill. */
struct nearness {
    double closest, own, other;
};

/* What of the space around a particle a neighbour at the distance *R fills; false where it is
 * outside the support. */
static bool is_beside(const struct touching *touching, const double *own, const double *other,
                      double *r, double *filled)
{
    const int dimension = touching->kind.dimension;
    const int d = record_diameter(dimension), u = record_velocity(dimension);
    const struct vec3 x =
        vec3_sub(vector_from(dimension, other, 1), vector_from(dimension, own, 1));
    const struct vec3 du =
        vec3_sub(vector_from(dimension, other + u, 1), vector_from(dimension, own + u, 1));
    const struct vec3 next = vec3_add(x, vec3_scale(touching->dt, du));
    const double both = touching->sph->parameters.smoothing * (own[d] + other[d]);
    *r = sqrt(vec3_dot(next, next));
    *filled =
        other[record_volume(dimension)] * kernel_value(minimum(*r, both), 2.0 / both, dimension);
    return vec3_dot(x, x) < square(both);
}

/* At the start bodies that may not part are in contact across half a diameter. */
static double contact_of(const struct touching *touching, int32_t i, int32_t j)
{
    const struct sph *sph = touching->sph;
    const struct laws laws = {&sph->neighbours, &sph->groups, sph->particles->body};
    return touching->simulation->step > 0 || touching->dt > 0.0 ||
                   laws_between(&laws, i, j) & LAW_NO_TENSION
               ? contact
               : SPH_START_CONTACT;
}

/* A walk over the neighbours of the particle's own body (OTHERS false), or over those of others, up
 * to the first that is nearer than ENOUGH. */
static void look_around(const struct touching *touching, int32_t i, bool others, double enough,
                        struct nearness *near)
{
    const struct sph *sph = touching->sph;
    const struct neighbours *n = &sph->neighbours;
    const int v = record_volume(touching->kind.dimension);
    const size_t stride = (size_t)muscl_stride(touching->kind);
    const double *own = sph->record + (size_t)i * stride;
    const double diameter = diameter_of_volume(own[v], touching->kind.dimension);
    int count = (int)n->row[i].count;
    /* near rows are found by the pair sums */
    const uint32_t *entry = n->prune ? neighbours_row(n, i) : neighbours_walk(n, i, &count);
    int q = others ? lanes_part(entry, 0, count, 0) : 0;
    for (; q < count && !(near->closest > enough); q++) {
        const int32_t j = (int32_t)(entry[q] & ENTRY_INDEX);
        const double *other = sph->record + (size_t)j * stride;
        double r, filled;
        if ((entry[q] >> ENTRY_PART_SHIFT & PART_LAW) != (others ? PART_LAW : 0) ||
            !is_beside(touching, own, other, &r, &filled))
            continue;
        *(others ? &near->other : &near->own) += filled;
        if (others) {
            const double mean =
                0.5 * (diameter + diameter_of_volume(other[v], touching->kind.dimension));
            near->closest =
                maximum(near->closest, contact_of(touching, i, j) * mean / maximum(r, 1e-40));
        }
    }
}

static bool has_others(const struct neighbours *n, int32_t i)
{
    const uint32_t *entry = neighbours_row(n, i);
    const int count = (int)n->row[i].count, images = lanes_part(entry, 0, count, 0);
    if (images == count)
        return false;
    return entry[images] >> ENTRY_PART_SHIFT == PART_LAW ||
           entry[count - 1] >> ENTRY_PART_SHIFT == (PART_IMAGE | PART_LAW);
}

/* Whether a particle that WAS as the field `touch` has it touches another body. */
static bool touches(const struct touching *touching, int32_t i, double was)
{
    const struct sph *sph = touching->sph;
    const int dimension = touching->kind.dimension;
    const double *own = sph->record + (size_t)i * (size_t)muscl_stride(touching->kind);
    struct nearness near = {0.0, 0.0, 0.0};
    if (!has_others(&sph->neighbours, i))
        return false;
    const double enough = was > 0.0 ? 0.0 : 1.0;
    look_around(touching, i, true, enough, &near);
    if (near.closest > enough)
        return true;
    if (dimension == 1 || !(near.other > full * (1.0 - inside)))
        return false;
    const double inverse_h = 1.0 / (sph->parameters.smoothing * own[record_diameter(dimension)]);
    near.own = own[record_volume(dimension)] * kernel_value(0.0, inverse_h, dimension);
    look_around(touching, i, false, 1.0, &near);
    return near.own < inside && near.other > full * (1.0 - near.own);
}

void muscl_find_touch(const struct sph *sph, const struct simulation *simulation, double dt,
                      double *touch)
{
    const struct touching touching = {sph, simulation, muscl_kind_of(sph), dt};
#pragma omp parallel for schedule(dynamic) num_threads(simulation->threads)
    for (int32_t b = 0; b < sph->particles->blocks; b++) {
        const struct block *block = &sph->particles->block[b];
        for (int32_t i = block->first; i < block->first + block->count; i++)
            touch[i] = touches(&touching, i, touch[i]) ? 1.0 : -1.0;
    }
}
