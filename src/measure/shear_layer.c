/* shear_layer: the viscosity with which two streams mix that slid over each other at the start, u_x
 * = U above a plane y and -U below: what the method itself has where the fluid has none. A row is
 * the particles that stood at one height, between two places on x; a least-squares fit of the mean
 * displacements of all rows to Stokes' layer gives the viscosity, and how well it fits. */
#include <stdlib.h>

#include "base/memory.h"
#include "exact/stokes_layer.h"
#include "measure/bands.h"
#include "measure/measure.h"
#include "model/start_place.h"

enum layer_value { LAYER_VISCOSITY, LAYER_DISPLACEMENT, LAYER_VELOCITY };
static const char *const value_names[] = {"viscosity", "displacement", "velocity", NULL};

const struct parameter measure_shear_layer_table[] = {
    PARAMETER(CHOICE, struct measure_shear_layer, value, "viscosity",
              "the viscosity, or the root mean square residual of the rows' displacements or "
              "velocities in the fit",
              .names = value_names),
    PARAMETER(NUMBER, struct measure_shear_layer, speed, REQUIRED,
              "speed of each stream at the start, along x", .unit = "m/s", .below = INFINITY),
    PARAMETER(NUMBER, struct measure_shear_layer, plane, "0 m", "position of their interface on y",
              .unit = "m"),
    PARAMETER_END,
};

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    static const char *const units[] = {
        [LAYER_VISCOSITY] = "m^2/s", [LAYER_DISPLACEMENT] = "m", [LAYER_VELOCITY] = "m/s"};
    const struct measure_shear_layer *parameters = measurement->check->measure.value;
    if (measurement->simulation->problem->dimension == 1)
        return measure_error(measurement, "there is no shear in one dimension");
    *unit = units[parameters->value];
    return NULL;
}

/* The rows as bands: distance from the plane at the start, displacement and velocity along x. */
struct rows {
    struct bands bands;
    double speed, time;
};

/* The particles that the check speaks of, by the places at the start; their number. */
static int64_t take_particles(const struct measurement *measurement, const double (*start)[3],
                              struct band *taken)
{
    const struct measure_shear_layer *parameters = measurement->check->measure.value;
    const struct vector_value *between = &measurement->check->between;
    const struct population *p = measurement->population;
    const int body = measure_body(measurement);
    int64_t count = 0;
    for (int32_t i = 0; i < p->count; i++) {
        const double x = start[i][0];
        bool inside = between->count == 0 || (x >= between->at[0] && x <= between->at[1]);
        if (inside && (body < 0 || p->body[i] == body))
            taken[count++] = (struct band){start[i][1] - parameters->plane, p->position[i][0] - x,
                                           p->velocity[i][0]};
    }
    return count;
}

static struct error *find_rows(const struct measurement *measurement, struct bands *rows)
{
    const struct simulation *simulation = measurement->simulation;
    const int32_t count = measurement->population->count;
    double(*start)[3] = memory_allocate(((size_t)count + 1) * sizeof *start);
    struct band *own = memory_allocate(((size_t)count + 1) * sizeof *own);
    struct error *error = NULL;
    if (!start || !own)
        error = out_of_memory_for("a check of %d particles", (int)count);
    error = ranks_agree(simulation->ranks, error);
    if (!error) {
        start_places(measurement->population, 0, count, start);
        const int64_t taken = take_particles(measurement, (const double(*)[3])start, own);
        error = bands_make(simulation->ranks, own, taken,
                           1e-3 * simulation->problem->input->resolution, rows);
    }
    free(start);
    free(own);
    return error;
}

/* Sum of the squares of the distances of the rows from the layer of VISCOSITY. */
static double misfit(const struct rows *rows, double viscosity)
{
    double sum = 0.0;
    for (int64_t i = 0; i < rows->bands.count; i++) {
        const double wanted =
            rows->speed * stokes_layer_displacement(rows->bands.band[i].at, rows->time, viscosity);
        sum += square(rows->bands.band[i].first - wanted);
    }
    return sum;
}

/* The best viscosity: the best of a coarse scale about the one whose layer is as thick as the rows
 * are high, then golden section on its logarithm. */
static double fit(const struct rows *rows)
{
    static const double golden = 0.61803398874989484820, step = 0.5;
    const double reach =
        maximum(fabs(rows->bands.band[0].at), rows->bands.band[rows->bands.count - 1].at);
    const double scale = square(reach) / rows->time;
    double best = 0.0, low, high;
    for (double power = -20.0; power <= 5.0; power += step)
        if (power == -20.0 || misfit(rows, scale * exp(power)) < misfit(rows, scale * exp(best)))
            best = power;
    low = best - step;
    high = best + step;
    while (high - low > 1e-12) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        if (misfit(rows, scale * exp(a)) < misfit(rows, scale * exp(b)))
            high = b;
        else
            low = a;
    }
    return scale * exp(0.5 * (low + high));
}

static double velocity_misfit(const struct rows *rows, double viscosity)
{
    double sum = 0.0;
    for (int64_t i = 0; i < rows->bands.count; i++) {
        const double wanted =
            rows->speed * stokes_layer_velocity(rows->bands.band[i].at, rows->time, viscosity);
        sum += square(rows->bands.band[i].second - wanted);
    }
    return sum;
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_shear_layer *parameters = measurement->check->measure.value;
    struct rows rows = {.speed = parameters->speed, .time = measurement->simulation->time};
    struct error *error = find_rows(measurement, &rows.bands);
    *value = measure_nothing(measurement, NOTHING_NO_ROWS);
    if (!error && rows.bands.count > 0 && rows.time > 0.0) {
        const double viscosity = fit(&rows), count = (double)rows.bands.count;
        *value = parameters->value == LAYER_VISCOSITY ? viscosity
                 : parameters->value == LAYER_DISPLACEMENT
                     ? sqrt(misfit(&rows, viscosity) / count)
                     : sqrt(velocity_misfit(&rows, viscosity) / count);
    }
    bands_free(&rows.bands);
    return error;
}

const struct measure_class measure_shear_layer = {.unit = unit, .measure = measure};
