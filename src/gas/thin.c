/* Rigid bodies that cells do not see: those thinner than a cell, between whose centres gas
 * passes. */
#include "gas/gas_phases.h"

#include "model/problem.h"
#include "shape/shape.h"

/* Of the lines of cell centres along an axis that meet an obstacle, the part that must cross it
 * between two centres for it to be thin: at the tip of a wedge and the rim of a ball a few do. */
static const double THIN_PART = 0.2;

/* Places looked at between two centres, and lines along an axis at most. */
enum { PLACES = 32, MOST_LINES = 4096 };

struct look {
    const struct one_of *shape;
    double edge;
    int dimension;
    int64_t low[3], count[3]; /* the cells about the obstacle in the domain */
};

/* What the lines along an axis met. */
struct crossings {
    int64_t lines, thin;
    double thickness; /* m, the largest of thin ones */
    int64_t blocked;  /* centres */
};

static double place_of(const struct look *look, int axis, double cell)
{
    return axis < look->dimension ? ((double)look->low[axis] + cell + 0.5) * look->edge : 0.0;
}

/* Where the line of AT along AXIS crosses the surface, between INSIDE and OUTSIDE. */
static double surface(const struct look *look, int axis, const double at[3], double inside,
                      double outside)
{
    double place[3] = {at[0], at[1], at[2]};
    for (int k = 0; k < 40; k++) {
        place[axis] = 0.5 * (inside + outside);
        *(shape_inside(look->shape, vector_at(place)) ? &inside : &outside) = place[axis];
    }
    return 0.5 * (inside + outside);
}

/* Follows the line along AXIS whose other cells are A and B. */
static void follow(const struct look *look, int axis, const int64_t cell[3],
                   struct crossings *crossings)
{
    double at[3], begin = NAN;
    bool centre_within = false, met = false, thin = false;
    for (int k = 0; k < 3; k++)
        at[k] = place_of(look, k, (double)cell[k]);
    /* from the centre before the first cell to the one after the last */
    for (int64_t k = -PLACES; k <= look->count[axis] * PLACES; k++) {
        at[axis] = place_of(look, axis, (double)k / PLACES);
        const bool inside = shape_inside(look->shape, vector_at(at)), centre = k % PLACES == 0;
        met |= inside;
        if (inside && isnan(begin))
            begin = surface(look, axis, at, at[axis], at[axis] - look->edge / PLACES);
        centre_within |= inside && centre;
        crossings->blocked += inside && centre;
        if (inside || isnan(begin))
            continue;
        if (!centre_within) {
            thin = true;
            const double end = surface(look, axis, at, at[axis] - look->edge / PLACES, at[axis]);
            crossings->thickness = maximum(crossings->thickness, end - begin);
        }
        begin = NAN;
        centre_within = false;
    }
    crossings->lines += met;
    crossings->thin += thin;
}

static struct crossings cross(const struct look *look, int axis)
{
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    const int64_t all = look->count[a] * look->count[b], step = (all + MOST_LINES - 1) / MOST_LINES;
    struct crossings crossings = {0};
    for (int64_t line = 0; line < all; line += step) {
        int64_t cell[3] = {0, 0, 0};
        cell[a] = line % look->count[a];
        cell[b] = line / look->count[a];
        follow(look, axis, cell, &crossings);
    }
    return crossings;
}

/* The cells about the shape of LOOK that the domain has; false where there are none. */
static bool find_cells(const struct simulation_case *input, struct look *look)
{
    const struct bounds box = bounds_common(shape_bounds(look->shape), domain_bounds(input));
    for (int axis = 0; axis < 3; axis++) {
        look->low[axis] = 0;
        look->count[axis] = 1;
        if (axis >= look->dimension)
            continue;
        const double low = vec3_at(box.low, axis), high = vec3_at(box.high, axis);
        if (!(high > low))
            return false;
        look->low[axis] = (int64_t)floor(low / look->edge + 1e-6);
        look->count[axis] = (int64_t)ceil(high / look->edge - 1e-6) - look->low[axis];
    }
    return true;
}

static void judge(struct findings *findings, int body, double edge)
{
    const struct simulation_case *input = findings->input;
    const char *name = input->boundaries.names[body];
    struct look look = {.shape = &case_boundary(input, body)->part,
                        .edge = edge,
                        .dimension = (int)input->dimension};
    if (!find_cells(input, &look)) {
        finding_add(findings, FINDING_COARSE, "boundaries", name,
                    "it lies outside the domain: it blocks nothing");
        return;
    }
    int64_t blocked = 0;
    for (int axis = 0; axis < look.dimension; axis++) {
        const struct crossings crossings = cross(&look, axis);
        blocked += crossings.blocked;
        if ((double)crossings.thin > THIN_PART * (double)crossings.lines) {
            finding_add(findings, FINDING_COARSE, "boundaries", name,
                        "%.3g m thick along %c, thinner than a cell of %.3g m: gas passes "
                        "where no centre of a cell is in it; make it a cell thick, or the "
                        "cells finer",
                        crossings.thickness, "xyz"[axis], edge);
            return;
        }
    }
    if (!blocked)
        finding_add(findings, FINDING_COARSE, "boundaries", name,
                    "no centre of a cell of %.3g m is in it: it blocks nothing", edge);
}

void gas_judge_bodies(struct findings *findings, double edge)
{
    const struct simulation_case *input = findings->input;
    for (int b = 0; b < input->boundaries.count; b++)
        if (case_boundary(input, b)->kind == BOUNDARY_RIGID_BODY)
            judge(findings, b, edge);
}
