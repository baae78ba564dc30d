/* radius: the present radius of a material circle or sphere that had radius a_0 at the start, for
 * example a surface, at which no particle lies. Each particle that was within a layer of it gives a
 * value, assuming that the volume between the two is constant: a_i^d = a_0^d + r_i^d - R_i^d, d = 2
 * in 2-D, 3 in 3-D and in axisymmetry, with R_i at the start and r_i now. */
#include <stdlib.h>

#include "base/memory.h"
#include "measure/measure.h"
#include "model/start_place.h"

enum { TAKE_MEAN, TAKE_SPREAD };
static const char *const take_names[] = {"mean", "spread", NULL};

const struct parameter measure_radius_table[] = {
    PARAMETER(NUMBER, struct measure_radius, start, REQUIRED,
              "its radius at the start, for example that of a surface", .unit = "m",
              .below = INFINITY),
    PARAMETER(CHOICE, struct measure_radius, take, "mean",
              "mean of the particles' estimates, or their standard deviation, which measures the "
              "roundness",
              .names = take_names),
    PARAMETER(NUMBER, struct measure_radius, layer, OPTIONAL,
              "distance from it at the start within which particles count; default: the resolution "
              "of the case",
              .unit = "m", .below = INFINITY),
    PARAMETER(VECTOR, struct measure_radius, center, OPTIONAL, "its centre; default: the origin",
              .unit = "m"),
    PARAMETER_END,
};

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_radius *parameters = measurement->check->measure.value;
    const int dimension = measurement->simulation->problem->dimension;
    const int count = parameters->center.count;
    if (count != 0 && count != dimension)
        return measure_error(measurement,
                             "`center`: expected %d components, one per dimension; found %d",
                             dimension, count);
    *unit = "m";
    return NULL;
}

static double distance(const double a[3], const struct vector_value *center)
{
    return sqrt(square(a[0] - center->at[0]) + square(a[1] - center->at[1]) +
                square(a[2] - center->at[2]));
}

/* The places that the owned particles tell; their number. */
static int64_t radii(const struct measurement *measurement, const double (*start)[3], double *told)
{
    const struct measure_radius *parameters = measurement->check->measure.value;
    const struct simulation *simulation = measurement->simulation;
    const struct population *p = measurement->population;
    const double layer =
        isnan(parameters->layer) ? simulation->problem->input->resolution : parameters->layer;
    const double power =
        (double)(simulation->problem->dimension + geometry_power(simulation->problem->geometry));
    const double own = pow(parameters->start, power);
    const int body = measure_body(measurement);
    int64_t count = 0;
    for (int32_t i = 0; i < p->count; i++) {
        if (body >= 0 && p->body[i] != body)
            continue;
        const double then = distance(start[i], &parameters->center);
        const double now = distance(p->position[i], &parameters->center);
        if (fabs(then - parameters->start) <= layer)
            told[count++] =
                pow(maximum(own + pow(now, power) - pow(then, power), 0.0), 1.0 / power);
    }
    return count;
}

static double mean_of(const struct ranks *ranks, const double *told, int64_t count)
{
    struct exact_sum sum = {0};
    for (int64_t i = 0; i < count; i++)
        exact_sum_add(&sum, told[i]);
    ranks_sum_exact(ranks, &sum, 1);
    const double all = (double)ranks_sum(ranks, count);
    return all > 0.0 ? exact_sum_value(&sum) / all : NAN;
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_radius *parameters = measurement->check->measure.value;
    const struct simulation *simulation = measurement->simulation;
    const size_t room = (size_t)measurement->population->count + 1;
    double(*start)[3] = memory_allocate(room * sizeof *start);
    double *told = memory_allocate(room * sizeof *told);
    struct error *error = NULL;
    if (!start || !told)
        error = out_of_memory_for("a check of %d particles", (int)measurement->population->count);
    error = ranks_agree(simulation->ranks, error);
    if (!error) {
        start_places(measurement->population, 0, measurement->population->count, start);
        const int64_t count = radii(measurement, (const double(*)[3])start, told);
        *value = mean_of(simulation->ranks, told, count);
        if (isnan(*value))
            measure_nothing(measurement, NOTHING_NO_MEMBER);
        if (parameters->take == TAKE_SPREAD) {
            for (int64_t i = 0; i < count; i++)
                told[i] = square(told[i] - *value);
            *value = sqrt(mean_of(simulation->ranks, told, count));
        }
    }
    free(start);
    free(told);
    return error;
}

const struct measure_class measure_radius = {.unit = unit, .measure = measure, .of_bodies = true};
