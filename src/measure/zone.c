/* zone: the part of a face of a body in which a field reaches a value, such as the crushed part of
 * a slab. The outermost layer of particles at the start is looked at, each with the area that it
 * covered there, about an axis normal to the face. Diameter: of the circle of the area of all of
 * them. For its shape the plane is divided into sectors about the axis, in each of which an area
 * gives a radius. */
#include "measure/broken_axis.h"

#include <stdlib.h>

#include "base/memory.h"
#include "model/start_place.h"

enum { TAKE_DIAMETER, TAKE_RATIO, TAKE_DEVIATION };
static const char *const take_names[] = {"diameter", "ratio", "deviation", NULL};

const struct parameter measure_zone_table[] = {
    PARAMETER(TEXT, struct measure_zone, field, REQUIRED,
              "a field of the particles without a unit, such as damage"),
    PARAMETER(NUMBER, struct measure_zone, value, REQUIRED,
              "what the field is at least in the zone"),
    PARAMETER(CHOICE, struct measure_zone, along, REQUIRED, "the axis normal to the face",
              .names = parameter_axes),
    PARAMETER(CHOICE, struct measure_zone, side, REQUIRED,
              "the end of the axis at which the face is: low or high", .names = parameter_sides),
    PARAMETER(CHOICE, struct measure_zone, take, "diameter",
              "diameter: of the circle of its area; of its radii in 16 directions ratio: the "
              "largest over the smallest, deviation: the standard deviation over the mean",
              .names = take_names),
    PARAMETER(VECTOR, struct measure_zone, center, OPTIONAL,
              "a point on the axis; default: the origin", .unit = "m"),
    PARAMETER_END,
};

enum { SECTORS = 16 };

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_zone *parameters = measurement->check->measure.value;
    struct broken_axis axis;
    const char *of_field;
    TRY(broken_find_axis(measurement, parameters->along, &parameters->center, &axis));
    TRY(measure_field_unit(measurement, &of_field));
    if (of_field[0])
        return measure_error(measurement, "`field` must be one without a unit, such as damage");
    if (parameters->take != TAKE_DIAMETER && axis.count < 2)
        return measure_error(measurement, "`take`: only a face in 3-D has a shape");
    *unit = parameters->take == TAKE_DIAMETER ? "m" : "";
    return NULL;
}

/* The sector in which ACROSS is; the first has its middle on the first axis. */
static int sector_of(const double across[2])
{
    const double turn = atan2(across[1], across[0]) / (2.0 * M_PI);
    return ((int)floor(turn * SECTORS + 0.5) + SECTORS) % SECTORS;
}

/* What of the face a particle of DIAMETER at ACROSS covers: an area, in a plane a width. */
static double area_of(const struct broken_axis *axis, const double across[2], double diameter)
{
    return axis->count > 1 ? square(diameter)
           : axis->round   ? 2.0 * M_PI * across[0] * diameter
                           : diameter;
}

/* Collective: the AREA of the zone in each sector. START, DIAMETER and FIELD are of the owned
 * particles. False where a value at the face is not finite. */
static bool find_areas(const struct measurement *m, const struct broken_axis *axis,
                       const double (*start)[3], const double *diameter, const double *field,
                       double area[SECTORS])
{
    const struct measure_zone *parameters = m->check->measure.value;
    const double face = broken_face(m, parameters->along, parameters->side);
    const int body = measure_body(m);
    struct exact_sum sum[SECTORS] = {{{0}, 0, false}};
    double across[2];
    int64_t lost = 0;
    for (int32_t i = 0; i < m->population->count; i++) {
        const double depth = fabs(start[i][parameters->along] - face);
        if (m->population->body[i] != body || !(depth < diameter[i]))
            continue;
        lost += !isfinite(field[i]);
        if (!(field[i] >= parameters->value))
            continue;
        for (int image = 0; image < (axis->round ? 1 : BROKEN_IMAGES); image++)
            if (broken_image(axis, start[i], image, across))
                exact_sum_add(&sum[sector_of(across)], area_of(axis, across, diameter[i]));
    }
    ranks_sum_exact(m->simulation->ranks, sum, SECTORS);
    for (int k = 0; k < SECTORS; k++)
        area[k] = exact_sum_value(&sum[k]);
    return ranks_sum(m->simulation->ranks, lost) == 0;
}

/* The value that TAKE names; a zone of no area has no shape. */
static double value_of(const struct broken_axis *axis, const double area[SECTORS], int take)
{
    double all = 0.0, sum = 0.0, squares = 0.0, least = INFINITY, most = 0.0;
    for (int k = 0; k < SECTORS; k++) {
        const double radius = sqrt(2.0 * area[k] / (2.0 * M_PI / SECTORS));
        all += area[k];
        sum += radius / SECTORS;
        squares += square(radius) / SECTORS;
        least = minimum(least, radius);
        most = maximum(most, radius);
    }
    if (take == TAKE_DIAMETER)
        return axis->count < 2 && !axis->round ? all : 2.0 * sqrt(all / M_PI);
    if (all == 0.0)
        return NAN;
    return take == TAKE_RATIO ? most / least : sqrt(maximum(squares - square(sum), 0.0)) / sum;
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_zone *parameters = measurement->check->measure.value;
    const int32_t count = measurement->population->count;
    struct broken_axis axis;
    const struct column *column;
    int component;
    TRY(broken_find_axis(measurement, parameters->along, &parameters->center, &axis));
    TRY(column_choose(measurement->population, parameters->field, NULL, 0, &column, &component));
    double(*start)[3] = memory_allocate(((size_t)count + 1) * sizeof *start);
    double *field = memory_allocate(((size_t)count + 1) * sizeof *field), *diameter = NULL;
    struct error *error = NULL;
    if (!start || !field)
        error = out_of_memory_for("a check of a zone");
    if (!error)
        error = connected_diameters(measurement->population, &diameter);
    error = ranks_agree(measurement->simulation->ranks, error);
    if (!error) {
        double area[SECTORS];
        start_places(measurement->population, 0, count, start);
        column_read_component(measurement->population, column, component, 0, count, field);
        const bool finite =
            find_areas(measurement, &axis, (const double(*)[3])start, diameter, field, area);
        *value = value_of(&axis, area, parameters->take);
        if (isnan(*value))
            measure_nothing(measurement, NOTHING_NO_ZONE);
        if (!finite)
            *value = measure_nothing(measurement, NOTHING_NOT_FINITE);
    }
    free(start);
    free(field);
    free(diameter);
    return error;
}

const struct measure_class measure_zone = {
    .of_field = true, .unit = unit, .measure = measure, .of_bodies = true};
