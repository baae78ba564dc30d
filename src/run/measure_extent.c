/* extent: the width of a body along an axis, from the first particle to the last, or the largest distance
 * of a particle from the centre of mass. */
#include "run/measure.h"

enum { EXTENT_RADIUS = 3 };
static const char *const along_names[] = {"x", "y", "z", "radius", NULL};

const struct parameter measure_extent_table[] = {
    {.key = "along",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct measure_extent, along),
     .standard = PARAMETER_REQUIRED,
     .names = along_names,
     .help = "the axis of the width; radius: the largest distance from the centre of mass"},
    PARAMETER_END,
};

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_extent *parameters = measurement->check->measure.value;
    const int dimension = measurement->simulation->dimension;
    if (parameters->along < EXTENT_RADIUS && parameters->along >= dimension)
        return measure_error(measurement, "the case has %d dimension%s", dimension,
                             dimension == 1 ? "" : "s");
    *unit = "m";
    return NULL;
}

static double width(const struct measurement *measurement, int body, int axis)
{
    const struct particles *particles = &measurement->simulation->particles;
    const struct ranks *ranks = measurement->simulation->ranks;
    double low = INFINITY, high = -INFINITY;
    for (int32_t i = 0; i < particles->count; i++)
        if (body < 0 || particles->body[i] == body) {
            low = minimum(low, particles->position[i][axis]);
            high = maximum(high, particles->position[i][axis]);
        }
    return ranks_maximum(ranks, high) - ranks_minimum(ranks, low);
}

static double radius(const struct measurement *measurement, int body)
{
    const struct particles *particles = &measurement->simulation->particles;
    const struct vec3 center =
        measure_center(measurement, (const double(*)[3])particles->position, body);
    double largest = 0.0;
    for (int32_t i = 0; i < particles->count; i++)
        if (body < 0 || particles->body[i] == body) {
            const double *x = particles->position[i];
            largest = maximum(largest, square(x[0] - center.x) + square(x[1] - center.y) +
                                           square(x[2] - center.z));
        }
    return sqrt(ranks_maximum(measurement->simulation->ranks, largest));
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_extent *parameters = measurement->check->measure.value;
    const int body = measure_body(measurement);
    *value = parameters->along == EXTENT_RADIUS ? radius(measurement, body)
                                                : width(measurement, body, parameters->along);
    return NULL;
}

const struct measure_class measure_extent = {.unit = unit, .measure = measure, .of_bodies = true};
