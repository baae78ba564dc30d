/* What is outside the faces of the domain: reflecting faces are walls, and through periodic ones
 * particles go round. */
#include <stdio.h>

#include "model/domain.h"
#include "model/generate.h"
#include "parallel/periodic.h"
#include "shape/shape.h"
#include "sph/scheme.h"

static double end_of(struct vec3 place, int axis)
{
    return axis == 0 ? place.x : axis == 1 ? place.y : place.z;
}

/* Rows of a hexagonal lattice are shifted in turn: an odd number of them does not repeat. */
static struct error *check_rows(const struct simulation_case *input, int body, int axis)
{
    const struct lattice lattice = body_lattice(input, body);
    if (lattice.kind != LATTICE_HEXAGONAL || axis != 1 || lattice.count[1] % 2 == 0)
        return NULL;
    return input_error(
        input, "bodies", input->bodies.names[body],
        "its hexagonal lattice has %lld rows between periodic faces, and only an even "
        "number repeats: change the resolution a little",
        (long long)lattice.count[1]);
}

/* Bodies lie in the domain, and those that fill it fit together across the faces. */
static struct error *check_bodies(const struct simulation_case *input, int axis,
                                  const struct face_place face[2])
{
    const double margin = 1e-6 * input->resolution;
    struct error *error = NULL;
    for (int b = 0; b < input->bodies.count; b++) {
        const struct bounds bounds = body_bounds(input, b);
        const double low = end_of(bounds.low, axis), high = end_of(bounds.high, axis);
        if (low < face[0].at - margin || high > face[1].at + margin)
            error = error_join(
                error,
                input_error(input, "bodies", input->bodies.names[b],
                            "it lies between %.6g m and %.6g m along %c, outside the domain, "
                            "which is from %.6g m to %.6g m",
                            low, high, "xyz"[axis], face[0].at, face[1].at));
        else if (low < face[0].at + margin && high > face[1].at - margin)
            error = error_join(error, check_rows(input, b, axis));
    }
    return error;
}

static struct error *check_face(const struct simulation_case *input, int b)
{
    const struct boundary_input *boundary = case_boundary(input, b);
    const int axis = boundary->axis;
    const struct face_place face[2] = {domain_face(input, axis, 0), domain_face(input, axis, 1)};
    char path[160];
    snprintf(path, sizeof path, "%.100s.part", input->boundaries.names[b]);
    if (boundary->part.choice)
        return input_error(input, "boundaries", path,
                           "only the solver gas has faces of several parts: remove this key, or "
                           "close the part with a `frozen` body");
    if (!(face[0].at < face[1].at))
        return input_error(input, face[1].section, face[1].name, "the domain has no room along %c",
                           "xyz"[axis]);
    return check_bodies(input, axis, face);
}

struct error *sph_check_faces(const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    struct error *error = refuse_obstacles(input);
    if (!input->boundaries.count && (input->domain.low.count || input->domain.high.count))
        error = error_join(
            error,
            input_error(input, "domain", NULL,
                        "the solver sph computes wherever particles are: name in "
                        "`boundaries` which faces of the domain are periodic or reflecting"));
    for (int b = 0; b < input->boundaries.count; b++) {
        const int kind = case_boundary(input, b)->kind;
        if (kind == BOUNDARY_PERIODIC || kind == BOUNDARY_REFLECTING)
            error = error_join(error, check_face(input, b));
        else
            error = error_join(
                error, input_error(input, "boundaries", input->boundaries.names[b],
                                   "the solver sph has periodic and reflecting faces: %s",
                                   kind == BOUNDARY_INFLOW
                                       ? "use gas for an inflow"
                                       : "use gas, or end the material with a few particles of a "
                                         "`frozen` body, which waves leave through"));
    }
    return error;
}

struct error *sph_check_periods(const struct simulation *simulation, double support)
{
    const struct simulation_case *input = simulation->problem->input;
    struct error *error = NULL;
    for (int b = 0; b < input->boundaries.count; b++) {
        const int axis = case_boundary(input, b)->axis;
        if (!mirrors_repeat(&simulation->problem->mirrors, axis))
            continue;
        const double period = periodic_period(&simulation->problem->mirrors, axis);
        if (period < 2.0 * (1.0 - 1e-9) * support)
            error = error_join(
                error, input_error(input, "boundaries", input->boundaries.names[b],
                                   "the period along %c is %.4g m; with this smoothing and "
                                   "resolution it must be %.4g m at least, twice the support",
                                   "xyz"[axis], period, 2.0 * support));
    }
    return error;
}

void sph_wrap(const struct simulation *simulation, const struct particles *particles)
{
    const struct mirrors *mirrors = &simulation->problem->mirrors;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < particles->count; i++)
        for (int axis = 0; axis < simulation->problem->dimension; axis++)
            if (mirrors_repeat(mirrors, axis)) {
                double *x = &particles->position[i][axis];
                *x = periodic_inside(mirrors, axis, periodic_rounded(mirrors, axis, *x));
            }
}
