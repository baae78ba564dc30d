/* What the material point method takes from the bodies of a case, and what it refuses. */
#include "base/memory.h"
#include "model/generate.h"
#include "mpm/mpm_internal.h"

struct error *mpm_refuse(const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->input;
    struct error *error = NULL;
    if (simulation->geometry == GEOMETRY_PLANE_STRESS)
        error = input_error(input, "geometry", NULL, "the solver mpm knows no plane stress");
    for (int b = 0; b < input->bodies.count; b++) {
        const struct body_input *body = case_body(input, b);
        if (body->driven || body->frozen || !isnan(body->stop))
            error = error_join(
                error, input_error(input, "bodies", input->bodies.names[b],
                                   "the solver mpm moves all bodies by their forces: driven, "
                                   "frozen and stop are for sph"));
    }
    return error;
}

/* The density that decides from which mass on a node's velocity counts. */
static double least_density(const struct simulation *simulation)
{
    double least = INFINITY;
    for (int b = 0; b < simulation->input->bodies.count; b++) {
        const struct body_input *body = case_body(simulation->input, b);
        least = minimum(least, body->varies
                                   ? material_density(&simulation->material[body->material_index])
                                   : body->start.density);
    }
    return least;
}

struct error *mpm_note_bodies(struct mpm *mpm, const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->input;
    mpm->half_size = memory_allocate((size_t)input->bodies.count * sizeof *mpm->half_size);
    mpm->gauge = memory_allocate((size_t)simulation->materials * sizeof *mpm->gauge);
    if (!mpm->half_size || !mpm->gauge)
        return error_new(ERROR_SYSTEM, "out of memory");
    struct error *error = NULL;
    for (int m = 0; m < simulation->materials; m++)
        if (!material_has_strength(&simulation->material[m]))
            mpm->gauge[m] = mpm->parameters.gauge_pressure;
    for (int b = 0; b < input->bodies.count; b++) {
        const double size =
            diameter_of_volume(body_lattice(input, b).volume, simulation->dimension);
        mpm->half_size[b] = 0.5 * size / mpm->edge;
        if (mpm->half_size[b] > 0.5 * (1.0 + 1e-6))
            error = error_join(error,
                               input_error(input, "bodies", input->bodies.names[b],
                                           "particles of %.4g m are wider than a cell of %.4g m: "
                                           "choose a larger `cell` of the solver mpm",
                                           size, mpm->edge));
        mpm->half_size[b] = minimum(mpm->half_size[b], 0.5);
    }
    mpm->least_mass = 1e-6 * least_density(simulation) * pow(mpm->edge, simulation->dimension);
    if (simulation->geometry == GEOMETRY_AXISYMMETRIC) /* a cell at the axis, per radian */
        mpm->least_mass *= 0.5 * mpm->edge;
    return error;
}
