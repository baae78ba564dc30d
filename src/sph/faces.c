/* Periodic faces: particles that leave through one come in at the other. */
#include "parallel/periodic.h"
#include "sph/scheme.h"

struct error *sph_check_periods(const struct simulation *simulation, double support)
{
    const struct simulation_case *input = simulation->problem->input;
    struct error *error = NULL;
    for (int b = 0; b < input->boundaries.count; b++) {
        const int axis = case_boundary(input, b)->axis;
        if (!images_repeat(&simulation->problem->images, axis))
            continue;
        const double period = periodic_period(&simulation->problem->images, axis);
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
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < particles->count; i++)
        for (int axis = 0; axis < simulation->problem->dimension; axis++)
            if (images_repeat(&simulation->problem->images, axis)) {
                double *x = &particles->position[i][axis];
                *x = periodic_inside(&simulation->problem->images, axis,
                                     periodic_rounded(&simulation->problem->images, axis, *x));
            }
}
