/* interface: where two bodies meet on an axis, such as the floor of a hole and the nose of the rod
 * in it. Particles of both mix there, so the outermost of either says little: the interface is the
 * plane with equal volumes of the two bodies on the wrong side of it, within a radius of the axis.
 * Each particle spreads its volume evenly over its diameter. */
#include "measure/broken_axis.h"

#include <stdlib.h>

#include "base/memory.h"
#include "shape/shape.h"

const struct parameter measure_interface_table[] = {
    PARAMETER(CHOICE, struct measure_interface, along, REQUIRED, "the axis",
              .names = parameter_axes),
    PARAMETER(TEXT, struct measure_interface, with, REQUIRED,
              "the body that meets the one that the check is `of`"),
    PARAMETER(NUMBER, struct measure_interface, radius, REQUIRED,
              "how far from the axis particles count, the half width in a plane", .unit = "m"),
    PARAMETER(VECTOR, struct measure_interface, center, OPTIONAL,
              "a point on the axis; default: the origin", .unit = "m"),
    PARAMETER_END,
};

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_interface *parameters = measurement->check->measure.value;
    struct broken_axis axis;
    TRY(broken_find_axis(measurement, parameters->along, &parameters->center, &axis));
    if (case_find_body(measurement->simulation->problem->input, parameters->with) < 0)
        return measure_error(measurement, "`with`: there is no body \"%s\"", parameters->with);
    *unit = "m";
    return NULL;
}

/* Whether the body that the check is `of` was the upper one along AXIS at the start. */
static bool is_above(const struct measurement *measurement, int axis)
{
    const struct measure_interface *parameters = measurement->check->measure.value;
    const struct simulation_case *input = measurement->simulation->problem->input;
    const struct bounds of = shape_bounds(&case_body(input, measure_body(measurement))->shape),
                        with = shape_bounds(
                            &case_body(input, case_find_body(input, parameters->with))->shape);
    return vec3_at(of.low, axis) + vec3_at(of.high, axis) >
           vec3_at(with.low, axis) + vec3_at(with.high, axis);
}

/* A particle near the axis: from where to where it reaches, and its volume. */
struct stretch {
    double low, high, volume;
    bool of; /* of the body that the check is `of` */
};

static bool is_near(const struct broken_axis *axis, const double at[3], double radius)
{
    double across[2];
    broken_image(axis, at, 0, across);
    return square(across[0]) + square(across[1]) <= square(radius);
}

static struct error *find_stretches(const struct measurement *measurement,
                                    const struct broken_axis *axis, struct stretch **item,
                                    int64_t *count)
{
    const struct measure_interface *parameters = measurement->check->measure.value;
    const struct population *p = measurement->population;
    const int of = measure_body(measurement),
              with = case_find_body(measurement->simulation->problem->input, parameters->with);
    int component = 0;
    const struct column *column = column_find(p, "diameter", &component);
    double *diameter = memory_allocate(((size_t)p->count + 1) * sizeof *diameter);
    *count = 0;
    *item = memory_allocate(((size_t)p->count + 1) * sizeof **item);
    if (!diameter || !*item) {
        free(diameter);
        return out_of_memory_for("an interface among %d particles", (int)p->count);
    }
    column_read_component(p, column, component, 0, p->count, diameter);
    for (int32_t i = 0; i < p->count; i++) {
        const double at = p->position[i][axis->along];
        if ((p->body[i] == of || p->body[i] == with) &&
            is_near(axis, p->position[i], parameters->radius))
            (*item)[(*count)++] = (struct stretch){at - 0.5 * diameter[i], at + 0.5 * diameter[i],
                                                   p->mass[i] / p->density[i], p->body[i] == of};
    }
    free(diameter);
    return NULL;
}

/* Collective: the volume of one body, `of` or not, below AT. */
static double volume_below(const struct measurement *measurement, const struct stretch *item,
                           int64_t count, bool of, double at)
{
    struct exact_sum sum = {{0}, 0, false};
    for (int64_t i = 0; i < count; i++)
        if (item[i].of == of)
            exact_sum_add(
                &sum,
                item[i].volume *
                    minimum(maximum((at - item[i].low) / (item[i].high - item[i].low), 0.0), 1.0));
    ranks_sum_exact(measurement->simulation->ranks, &sum, 1);
    return exact_sum_value(&sum);
}

/* Collective: the plane above which the lower body has the volume that the upper one has below it;
 * NAN where one of them is not near the axis. */
static double find_plane(const struct measurement *measurement, const struct broken_axis *axis,
                         const struct stretch *item, int64_t count)
{
    enum { HALVINGS = 50 };
    const struct ranks *ranks = measurement->simulation->ranks;
    double low = INFINITY, high = -INFINITY;
    for (int64_t i = 0; i < count; i++) {
        low = minimum(low, item[i].low);
        high = maximum(high, item[i].high);
    }
    low = ranks_minimum(ranks, low);
    high = ranks_maximum(ranks, high);
    if (!(low < high))
        return NAN;
    const double all[2] = {volume_below(measurement, item, count, false, high),
                           volume_below(measurement, item, count, true, high)};
    if (!(all[0] > 0.0 && all[1] > 0.0))
        return NAN;
    const bool above = is_above(measurement, axis->along);
    for (int k = 0; k < HALVINGS; k++) {
        const double at = 0.5 * (low + high),
                     lower = volume_below(measurement, item, count, above, at),
                     upper = all[!above] - volume_below(measurement, item, count, !above, at);
        if (lower > upper)
            high = at;
        else
            low = at;
    }
    return 0.5 * (low + high);
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_interface *parameters = measurement->check->measure.value;
    struct broken_axis axis;
    struct stretch *item = NULL;
    int64_t count = 0;
    TRY(broken_find_axis(measurement, parameters->along, &parameters->center, &axis));
    struct error *error = ranks_agree(measurement->simulation->ranks,
                                      find_stretches(measurement, &axis, &item, &count));
    if (!error)
        *value = find_plane(measurement, &axis, item, count);
    if (!error && !isfinite(*value))
        *value = measure_nothing(measurement, NOTHING_NO_MEMBER);
    free(item);
    return error;
}

const struct measure_class measure_interface = {
    .unit = unit, .measure = measure, .of_bodies = true};
