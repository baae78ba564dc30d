/* What the material point method takes from the bodies of a case, and what it refuses; gravity in the ledger. */
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

/* Work goes with the mean velocity of the step, so that free fall keeps its energy to rounding. */
void mpm_book_gravity(struct simulation *simulation, double dt, bool begin)
{
    const struct particles *p = &simulation->particles;
    const double *g = simulation->gravity;
    if (!simulation_has_gravity(simulation))
        return;
#pragma omp parallel num_threads(simulation->threads)
    {
        struct ledger own = {0};
#pragma omp for schedule(static)
        for (int32_t i = 0; i < p->count; i++) {
            const double *x = p->position[i], *u = p->velocity[i];
            const struct vec3 impulse = vec3_scale(dt * p->mass[i], vec3_make(g[0], g[1], g[2]));
            const double work = 0.5 * vec3_dot(impulse, vec3_make(u[0], u[1], u[2]));
            ledger_book(&own, LEDGER_GRAVITY, 0.0, begin ? impulse : vec3_make(0.0, 0.0, 0.0),
                        vec3_make(x[0], x[1], x[2]), work);
        }
#pragma omp critical(bolide_mpm_gravity)
        ledger_join(&simulation->ledger, &own);
    }
}
