/* What of space is in a picture of particles, and which of them. */
#include "base/memory.h"
#include "picture/dots.h"

enum { SLICE = 4096 };

/* Beside cells particles are squares, so large that they leave few gaps. */
static const double particle_factor = 1.3;

/* The edge of the square or cube that a member fills; of RINGS that of their section. */
static double particle_diameter(const struct population *population, bool rings, int64_t i)
{
    if (population->kind == POPULATION_OF_CELLS)
        return population->edge;
    double volume = population->mass[i] / population->density[i];
    if (rings) /* mass is that of a radian */
        volume /= fabs(population->position[i][0]);
    return diameter_of_volume(volume, population->dimension);
}

/* Where a wall or periodic face is; NAN: there is none. */
static double wall_at(const struct face *face)
{
    return face_closes(face) || face->kind == BOUNDARY_PERIODIC ? face->at : (double)NAN;
}

/* The range of a picture ends at a wall that the material touches. */
static void end_at_walls(struct plane *plane, const struct place *place)
{
    for (int axis = 0; axis < 3; ++axis) {
        struct range *extent = &plane->extent[axis];
        const double low = wall_at(&place->face[axis][0]), high = wall_at(&place->face[axis][1]);
        plane->wall[axis][0] = fabs(extent->low - low) <= plane->diameter && low < extent->high;
        plane->wall[axis][1] = fabs(extent->high - high) <= plane->diameter && high > extent->low;
        extent->low = plane->wall[axis][0] ? low : extent->low;
        extent->high = plane->wall[axis][1] ? high : extent->high;
    }
}

/* Collective: extents and mean diameter of the particles of all ranks, without their size. */
static void measure(const struct simulation *simulation, const struct population *population,
                    struct plane *plane)
{
    const struct ranks *ranks = simulation->ranks;
    const struct population *all[POPULATIONS_MAX];
    const int populations = simulation_shown(simulation, population, all);
    struct range *extent = plane->extent;
    struct exact_sum logarithms = {0};
    int64_t counted = 0;
    for (int k = 0; k < populations; k++)
        for (int64_t i = 0; i < all[k]->count; ++i) {
            for (int axis = 0; axis < 3; ++axis)
                range_include(&extent[axis], all[k]->position[i][axis]);
            double logarithm = log(particle_diameter(all[k], plane->rings, i));
            if (isfinite(logarithm)) {
                exact_sum_add(&logarithms, logarithm);
                ++counted;
            }
            plane->cells |= all[k]->kind == POPULATION_OF_CELLS;
        }
    for (int axis = 0; axis < 3; ++axis)
        extent[axis] = range_of_all(ranks, extent[axis]);
    ranks_sum_exact(ranks, &logarithms, 1);
    counted = ranks_sum(ranks, counted);
    plane->cells = ranks_sum(ranks, plane->cells) > 0;
    plane->diameter = counted > 0 ? exp(exact_sum_value(&logarithms) / (double)counted) : 0.0;
}

struct plane plane_find(const struct simulation *simulation, const struct population *population)
{
    struct plane plane = {.rings = simulation->problem->geometry == GEOMETRY_AXISYMMETRIC,
                          .across = 0,
                          .up = 1,
                          .normal = -1,
                          .extent = {range_empty(), range_empty(), range_empty()}};
    measure(simulation, population, &plane);
    for (int axis = 0; axis < 3; ++axis) {
        struct range *extent = &plane.extent[axis];
        if (!(extent->low <= extent->high))
            *extent = (struct range){0.0, plane.diameter > 0.0 ? 0.0 : 1.0};
        extent->low -= 0.5 * plane.diameter;
        extent->high += 0.5 * plane.diameter;
    }
    end_at_walls(&plane, &simulation->problem->place);
    if (population->dimension == 3) {
        /* Of equal axes the last, but for rounding, so that x and y are the picture's. */
        plane.normal = 2;
        for (int axis = 1; axis >= 0; --axis)
            if (length_of(plane.extent[axis]) < 0.99 * length_of(plane.extent[plane.normal]))
                plane.normal = axis;
        plane.across = plane.normal == 0;
        plane.up = plane.normal == 2 ? 1 : 2;
        plane.middle = middle_of(plane.extent[plane.normal]);
    }
    return plane;
}

/* Adds particle I, unless it lies outside of the slab: its centre within 3/4 of its diameter of the
 * middle, so that a lattice shows one or two layers and never a gap. */
static bool take_one(const struct population *population, const struct plane *plane, int64_t i,
                     double value, struct dots *dots)
{
    const double *position = population->position[i];
    double depth = plane->normal < 0 ? 0.0 : position[plane->normal] - plane->middle;
    double diameter = particle_diameter(population, plane->rings, i);
    /* A particle blown to next to nothing would cover all others. */
    diameter = minimum(isfinite(diameter) ? diameter : plane->diameter, 4.0 * plane->diameter);
    if (plane->cells && population->kind == POPULATION_OF_PARTICLES)
        diameter *= particle_factor;
    const double reach = plane->cells ? 0.500001 : 0.75; /* one layer of cells; two of a tie */
    if (!isfinite(position[plane->across]) || !isfinite(position[plane->up]) ||
        !(fabs(depth) <= reach * diameter || plane->normal < 0))
        return true;
    if (plane->cells && !population_has(population, (int32_t)i)) /* blocked */
        return true;
    if (dots->count == dots->capacity &&
        !memory_reserve((void **)&dots->dot, &dots->capacity, dots->count + 1, dots->count,
                        sizeof *dots->dot))
        return false;
    struct dot *dot = &dots->dot[dots->count++];
    dot->across = (float)(position[plane->across] - middle_of(plane->extent[plane->across]));
    dot->up = (float)(position[plane->up] - middle_of(plane->extent[plane->up]));
    dot->depth = (float)depth;
    dot->diameter = (float)diameter;
    dot->value = (float)value;
    dot->order = (uint64_t)(population->kind == POPULATION_OF_PARTICLES) << 63 | population->id[i];
    range_include(&dots->values, value);
    return true;
}

struct error *dots_take(const struct shown *shown, const struct plane *plane, struct dots *dots)
{
    const struct population *population = shown->population;
    double values[SLICE];
    /* In a plane all are shown. */
    if (plane->normal < 0 &&
        !memory_reserve((void **)&dots->dot, &dots->capacity, dots->count + population->count,
                        dots->count, sizeof *dots->dot))
        return out_of_memory_for("a picture");
    for (int64_t begin = 0; begin < population->count; begin += SLICE) {
        int64_t end = begin + SLICE < population->count ? begin + SLICE : population->count;
        shown_read(shown, begin, end, values);
        for (int64_t i = begin; i < end; ++i)
            if (!take_one(population, plane, i, values[i - begin], dots))
                return out_of_memory_for("a picture");
    }
    return NULL;
}
