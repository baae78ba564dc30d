/* hole: the diameter of the opening of a body about an axis, at a position on it or, by default, as
 * seen along the whole axis. The directions about the axis are divided into sectors; in each the
 * opening ends at the particle edge nearest to the axis, at the radius R_s, and
 *   d = 2 sqrt(mean of R_s^2) in 3-D,  2 R in axisymmetry,  R_1 + R_2 in a plane. */
#include "measure/broken_axis.h"

const struct parameter measure_hole_table[] = {
    PARAMETER(CHOICE, struct measure_hole, along, REQUIRED, "the axis of the hole",
              .names = parameter_axes),
    PARAMETER(NUMBER, struct measure_hole, at, OPTIONAL,
              "position on the axis; default: the clear opening seen along the whole axis",
              .unit = "m", .above = -INFINITY, .below = INFINITY),
    PARAMETER(VECTOR, struct measure_hole, center, OPTIONAL,
              "a point on the axis; default: the origin", .unit = "m"),
    CONNECTED_LINK(offsetof(struct measure_hole, link)),
    PARAMETER_END,
};

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_hole *parameters = measurement->check->measure.value;
    struct broken_axis axis;
    *unit = "m";
    return broken_find_axis(measurement, parameters->along, &parameters->center, &axis);
}

enum { SECTORS = 72, SECTORS_LEAST = 4 };

/* What is seen along an axis. */
struct look {
    const struct measurement *measurement;
    struct broken_plate plate;
    struct broken_axis axis;
};

static bool is_seen(const struct look *look, const struct population *p, int32_t i)
{
    const struct measure_hole *parameters = look->measurement->check->measure.value;
    return look->plate.is_part[i] &&
           (isnan(parameters->at) || fabs(p->position[i][parameters->along] - parameters->at) <=
                                         parameters->link * look->plate.diameter[i]);
}

/* The sector of COUNT that the place ACROSS is in. */
static int sector_of(const struct broken_axis *axis, const double across[2], int count)
{
    const double turn = axis->count > 1   ? 0.5 + 0.5 * atan2(across[1], across[0]) / M_PI
                        : across[0] < 0.0 ? 0.0
                                          : 0.5;
    const int at = (int)(turn * count);
    return at < count ? at : count - 1;
}

/* Collective: the radii of COUNT sectors; INFINITY where nothing bounds the opening. */
static void look_along(const struct look *look, int count, double *radius)
{
    const struct population *p = look->measurement->population;
    double inward[SECTORS], across[2];
    for (int s = 0; s < count; s++)
        inward[s] = -INFINITY;
    for (int32_t i = 0; i < p->count; i++)
        for (int image = 0; image < BROKEN_IMAGES && is_seen(look, p, i); image++) {
            if (!broken_image(&look->axis, p->position[i], image, across))
                continue;
            const int s = sector_of(&look->axis, across, count);
            const double edge = hypot(across[0], across[1]) - 0.5 * look->plate.diameter[i];
            inward[s] = maximum(inward[s], -maximum(edge, 0.0));
        }
    ranks_maximum_of(look->measurement->simulation->ranks, inward, count);
    for (int s = 0; s < count; s++)
        radius[s] = -inward[s];
}

/* Sectors that are one and a half particles wide at the narrowest place. */
static int sectors_of(const struct look *look, double spacing)
{
    double narrowest;
    if (look->axis.count < 2)
        return look->axis.round ? 1 : 2;
    look_along(look, 1, &narrowest);
    const double wanted = 2.0 * M_PI * (narrowest + 0.5 * spacing) / (1.5 * spacing);
    return (int)minimum(maximum(floor(wanted), SECTORS_LEAST), SECTORS);
}

static double find_diameter(const struct look *look, double spacing)
{
    const int count = sectors_of(look, spacing);
    double radius[SECTORS], sum = 0.0;
    look_along(look, count, radius);
    for (int s = 0; s < count; s++)
        sum += look->axis.count > 1 ? square(radius[s]) : radius[s];
    const double diameter = look->axis.count > 1 ? 2.0 * sqrt(sum / count) : 2.0 * sum / count;
    if (isinf(diameter)) /* the body does not surround the axis */
        return NAN;
    return diameter < 2.0 * spacing ? 0.0 : diameter;
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_hole *parameters = measurement->check->measure.value;
    struct look look = {.measurement = measurement};
    TRY(broken_find_axis(measurement, parameters->along, &parameters->center, &look.axis));
    struct error *error = broken_find_plate(measurement, parameters->link, &look.plate);
    if (!error)
        *value = find_diameter(&look, measurement->simulation->problem->input->resolution);
    if (!error && isnan(*value))
        measure_nothing(measurement, NOTHING_NOT_AROUND);
    broken_plate_free(&look.plate);
    return error;
}

const struct measure_class measure_hole = {.unit = unit, .measure = measure, .of_bodies = true};
