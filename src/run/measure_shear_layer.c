/* shear_layer: the viscosity with which two streams mix that slid over each other at the start, u_x = U
 * above a plane y and -U below: what the method itself has where the fluid has none. A row is the particles
 * that stood at one height, between two places on x; a least-squares fit of the mean displacements of all
 * rows to Stokes' layer gives the viscosity, and how well it fits. */
#include <stdlib.h>

#include "base/memory.h"
#include "exact/stokes_layer.h"
#include "model/start_place.h"
#include "run/measure.h"

enum layer_value { LAYER_VISCOSITY, LAYER_DISPLACEMENT, LAYER_VELOCITY };
static const char *const value_names[] = {"viscosity", "displacement", "velocity", NULL};

const struct parameter measure_shear_layer_table[] = {
    {.key = "value",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct measure_shear_layer, value),
     .standard = "viscosity",
     .names = value_names,
     .help = "the viscosity, or the root mean square distance of the rows' displacements or "
             "velocities from the layer of that viscosity"},
    {.key = "speed",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct measure_shear_layer, speed),
     .unit = "m/s",
     .standard = PARAMETER_REQUIRED,
     .below = INFINITY,
     .help = "of either stream at the start, along x"},
    {.key = "plane",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct measure_shear_layer, plane),
     .unit = "m",
     .standard = "0 m",
     .help = "where they met, on y"},
    PARAMETER_END,
};

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    static const char *const units[] = {
        [LAYER_VISCOSITY] = "m^2/s", [LAYER_DISPLACEMENT] = "m", [LAYER_VELOCITY] = "m/s"};
    const struct measure_shear_layer *parameters = measurement->check->measure.value;
    if (measurement->simulation->dimension == 1)
        return measure_error(measurement, "there is no shear in one dimension");
    *unit = units[parameters->value];
    return NULL;
}

/* Of a particle, of a row: distance from the plane at the start, displacement and velocity along x. */
struct row {
    double height, displacement, velocity;
};

struct rows {
    int64_t count;
    struct row *row;
    double speed, time;
};

static int compare_rows(const void *first, const void *second)
{
    const struct row *a = first, *b = second;
    return (a->height > b->height) - (a->height < b->height);
}

/* Those that the check speaks of, by the places at the start. */
static struct error *take_particles(const struct measurement *measurement, struct rows *rows)
{
    const struct measure_shear_layer *parameters = measurement->check->measure.value;
    const struct vector_value *between = &measurement->check->between;
    const struct particles *p = &measurement->simulation->particles;
    const int body = measure_body(measurement);
    double(*start)[3] = memory_allocate(((size_t)p->count + 1) * sizeof *start);
    rows->row = memory_allocate(((size_t)p->count + 1) * sizeof *rows->row);
    if (!start || !rows->row) {
        free(start);
        return error_new(ERROR_SYSTEM, "out of memory for a check of %d particles", (int)p->count);
    }
    start_places(measurement->simulation, 0, p->count, start);
    for (int32_t i = 0; i < p->count; i++) {
        const double x = start[i][0];
        bool inside = between->count == 0 || (x >= between->at[0] && x <= between->at[1]);
        if (inside && (body < 0 || p->body[i] == body))
            rows->row[rows->count++] = (struct row){start[i][1] - parameters->plane,
                                                    p->position[i][0] - x, p->velocity[i][0]};
    }
    free(start);
    return NULL;
}

/* Replaces the particles of each height by their mean. */
static void average(struct rows *rows, double resolution)
{
    int64_t made = 0;
    qsort(rows->row, (size_t)rows->count, sizeof *rows->row, compare_rows);
    for (int64_t i = 0; i < rows->count;) {
        const double height = rows->row[i].height;
        struct exact_sum sums[2] = {{{0}, 0, false}};
        int64_t first = i;
        for (; i < rows->count && rows->row[i].height - height < 1e-3 * resolution; i++) {
            exact_sum_add(&sums[0], rows->row[i].displacement);
            exact_sum_add(&sums[1], rows->row[i].velocity);
        }
        const double particles = (double)(i - first);
        rows->row[made++] = (struct row){height, exact_sum_value(&sums[0]) / particles,
                                         exact_sum_value(&sums[1]) / particles};
    }
    rows->count = made;
}

/* Sum of the squares of the distances of the rows from the layer of VISCOSITY. */
static double misfit(const struct rows *rows, double viscosity)
{
    double sum = 0.0;
    for (int64_t i = 0; i < rows->count; i++) {
        const double wanted =
            rows->speed * stokes_layer_displacement(rows->row[i].height, rows->time, viscosity);
        sum += square(rows->row[i].displacement - wanted);
    }
    return sum;
}

/* The best viscosity: the best of a coarse scale about the one whose layer is as thick as the rows are high,
 * then golden section on its logarithm. */
static double fit(const struct rows *rows)
{
    static const double golden = 0.61803398874989484820, step = 0.5;
    const double reach = maximum(fabs(rows->row[0].height), rows->row[rows->count - 1].height);
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
    for (int64_t i = 0; i < rows->count; i++) {
        const double wanted =
            rows->speed * stokes_layer_velocity(rows->row[i].height, rows->time, viscosity);
        sum += square(rows->row[i].velocity - wanted);
    }
    return sum;
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_shear_layer *parameters = measurement->check->measure.value;
    struct rows rows = {.speed = parameters->speed, .time = measurement->simulation->time};
    struct error *error = take_particles(measurement, &rows);
    *value = NAN;
    if (!error && rows.count > 0 && rows.time > 0.0) {
        average(&rows, measurement->simulation->input->resolution);
        const double viscosity = fit(&rows), count = (double)rows.count;
        *value = parameters->value == LAYER_VISCOSITY ? viscosity
                 : parameters->value == LAYER_DISPLACEMENT
                     ? sqrt(misfit(&rows, viscosity) / count)
                     : sqrt(velocity_misfit(&rows, viscosity) / count);
    }
    free(rows.row);
    return error;
}

const struct measure_class measure_shear_layer = {
    .at_once = true, .unit = unit, .measure = measure};
