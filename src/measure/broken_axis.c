/* Axes normal to plates; see broken_axis.h. */
#include "measure/broken_axis.h"

#include <stdlib.h>

#include "base/memory.h"
#include "shape/shape.h"

static struct bounds bounds_of(const struct measurement *measurement)
{
    const struct simulation_case *input = measurement->simulation->problem->input;
    return shape_bounds(&case_body(input, measure_body(measurement))->shape);
}

static struct error *check_center(const struct measurement *measurement,
                                  const struct vector_value *center)
{
    const int dimension = measurement->simulation->problem->dimension;
    if (center->count == 0 || center->count == dimension)
        return NULL;
    return measure_error(measurement,
                         "`center`: expected %d components, one per dimension; found %d", dimension,
                         center->count);
}

/* The axis of symmetry is the only one of axisymmetry. */
static struct error *check_round(const struct measurement *measurement, int along,
                                 const struct vector_value *center)
{
    if (along != 1)
        return measure_error(measurement, "`along` must be y, the axis of symmetry");
    if (center->count && center->at[0] != 0.0)
        return measure_error(measurement, "`center`: the axis of symmetry is at x = 0");
    return NULL;
}

/* Whether a mirror wall of PROBLEM normal to axis K is at AT. */
static bool is_mirrored(const struct problem *problem, int k, double at)
{
    const double near = 1e-6 * problem->input->resolution;
    const struct face *face = problem->place.face[k];
    return (face_closes(&face[0]) && fabs(face[0].at - at) < near) ||
           (face_closes(&face[1]) && fabs(face[1].at - at) < near);
}

struct error *broken_find_axis(const struct measurement *measurement, int along,
                               const struct vector_value *center, struct broken_axis *axis)
{
    const struct problem *problem = measurement->simulation->problem;
    const char *name = measurement->check->measure.choice->name;
    *axis =
        (struct broken_axis){.along = along, .round = problem->geometry == GEOMETRY_AXISYMMETRIC};
    TRY(broken_check(measurement));
    TRY(broken_check_axis(measurement, along));
    TRY(check_center(measurement, center));
    if (problem->dimension == 1)
        return measure_error(measurement, "`%s` has no meaning in one dimension", name);
    if (axis->round)
        TRY(check_round(measurement, along, center));
    if (measure_body(measurement) < 0)
        return measure_error(measurement, "`%s` needs `of`: the body that has it", name);
    const struct bounds bounds = bounds_of(measurement);
    for (int k = 0; k < problem->dimension; k++) {
        if (k == along)
            continue;
        const double at = center->count ? center->at[k] : 0.0;
        if (at < vec3_at(bounds.low, k) || at > vec3_at(bounds.high, k))
            return measure_error(measurement, "the axis misses \"%s\": give its `center`",
                                 measurement->check->of);
        axis->across[axis->count] = k;
        axis->mirror[axis->count] = is_mirrored(problem, k, at);
        axis->center[axis->count++] = at;
    }
    return NULL;
}

bool broken_image(const struct broken_axis *axis, const double at[3], int image, double across[2])
{
    across[1] = 0.0;
    for (int k = 0; k < 2; k++) {
        const bool flips = image >> k & 1;
        if (flips && (k >= axis->count || !axis->mirror[k]))
            return false;
        if (k < axis->count)
            across[k] = (flips ? -1.0 : 1.0) * (at[axis->across[k]] - axis->center[k]);
    }
    return true;
}

double broken_face(const struct measurement *measurement, int along, bool high)
{
    const struct bounds bounds = bounds_of(measurement);
    return vec3_at(high ? bounds.high : bounds.low, along);
}

/* A fragment with this fraction of the mass of the heaviest is part of the plate. */
#define PLATE 0.5

static bool is_plate(const struct fragments *fragments, int32_t i)
{
    const int64_t k = fragments->of_member[i];
    return k != FRAGMENT_NONE && fragments->item[k].mass >= PLATE * fragments->item[0].mass;
}

struct error *broken_find_plate(const struct measurement *measurement, double link,
                                struct broken_plate *plate)
{
    struct fragments fragments;
    *plate = (struct broken_plate){0};
    struct error *error = broken_find(measurement, link, &fragments);
    if (!error) {
        plate->is_part = memory_allocate(((size_t)fragments.members + 1) * sizeof *plate->is_part);
        if (!plate->is_part)
            error = out_of_memory_for("a check of a plate");
    }
    if (!error)
        error = connected_diameters(measurement->population, &plate->diameter);
    error = ranks_agree(measurement->simulation->ranks, error);
    plate->fragments = fragments.count;
    for (int32_t i = 0; i < fragments.members && !error; i++)
        plate->is_part[i] = is_plate(&fragments, i);
    fragments_free(&fragments);
    return error;
}

void broken_plate_free(struct broken_plate *plate)
{
    free(plate->is_part);
    free(plate->diameter);
    *plate = (struct broken_plate){0};
}
