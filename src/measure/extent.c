/* extent: the width of a body, or of a slice of it, along an axis, from the first particle to the
 * last, or the largest distance of a particle from the centre of mass. */
#include <stdlib.h>

#include "base/memory.h"
#include "measure/measure.h"

enum { EXTENT_RADIUS = 3 };
static const char *const along_names[] = {"x", "y", "z", "radius", NULL};

const struct parameter measure_extent_table[] = {
    PARAMETER(CHOICE, struct measure_extent, along, REQUIRED,
              "the axis of the width; radius: the largest distance from the centre of mass",
              .names = along_names),
    PARAMETER(
        FLAG, struct measure_extent, edges, "no",
        "whether to measure to the edges of particles, half a diameter outside their centres"),
    PARAMETER_END,
};

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_extent *parameters = measurement->check->measure.value;
    const int dimension = measurement->simulation->problem->dimension;
    if (parameters->along < EXTENT_RADIUS && parameters->along >= dimension)
        return measure_error(measurement, "the case has %d dimension%s", dimension,
                             dimension == 1 ? "" : "s");
    *unit = "m";
    return NULL;
}

/* Half the diameters where edges are asked for, to be freed; zeros otherwise. */
static struct error *find_margins(const struct measurement *measurement, double **margin)
{
    const struct measure_extent *parameters = measurement->check->measure.value;
    const int32_t count = measurement->population->count;
    int component = 0;
    const struct column *diameter =
        parameters->edges ? column_find(measurement->population, "diameter", &component) : NULL;
    *margin = memory_allocate(((size_t)count + 1) * sizeof **margin);
    if (!*margin)
        return out_of_memory_for("the edges of %d particles", (int)count);
    if (diameter)
        column_read_component(measurement->population, diameter, component, 0, count, *margin);
    for (int32_t i = 0; i < count; i++)
        (*margin)[i] = diameter ? 0.5 * (*margin)[i] : 0.0;
    return NULL;
}

static double width(const struct measurement *measurement, const double *margin, int body, int axis)
{
    const struct population *particles = measurement->population;
    const struct ranks *ranks = measurement->simulation->ranks;
    double low = INFINITY, high = -INFINITY;
    for (int32_t i = 0; i < particles->count; i++)
        if (measure_takes(measurement, body, i)) {
            low = minimum(low, particles->position[i][axis] - margin[i]);
            high = maximum(high, particles->position[i][axis] + margin[i]);
        }
    return ranks_maximum(ranks, high) - ranks_minimum(ranks, low);
}

static double radius(const struct measurement *measurement, const double *margin, int body)
{
    const struct population *particles = measurement->population;
    const struct vec3 center =
        measure_center(measurement, (const double(*)[3])particles->position, body);
    double largest = 0.0;
    for (int32_t i = 0; i < particles->count; i++)
        if (measure_takes(measurement, body, i)) {
            const double *x = particles->position[i];
            const struct vec3 from = {x[0] - center.x, x[1] - center.y, x[2] - center.z};
            largest = maximum(largest, sqrt(vec3_dot(from, from)) + margin[i]);
        }
    largest = ranks_maximum(measurement->simulation->ranks, largest);
    return isfinite(center.x) ? largest : NAN;
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_extent *parameters = measurement->check->measure.value;
    const int body = measure_body(measurement);
    double *margin;
    TRY(ranks_agree(measurement->simulation->ranks, find_margins(measurement, &margin)));
    *value = parameters->along == EXTENT_RADIUS
                 ? radius(measurement, margin, body)
                 : width(measurement, margin, body, parameters->along);
    if (!isfinite(*value))
        *value = measure_nothing(measurement, NOTHING_NO_MEMBER);
    free(margin);
    return NULL;
}

const struct measure_class measure_extent = {.unit = unit, .measure = measure};
