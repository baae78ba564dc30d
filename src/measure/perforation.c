/* perforation: what an impact has left of a wall, about an axis normal to it: the hole, the least
 * thickness, or the mass that came through. The plane of the wall is divided into columns, each
 * with the mass of the wall's particles within one and a half of their diameters across, over that
 * of the whole wall. Columns that have lost nearly all are the hole. The rim is left out, since the
 * wall ends there. What came through are particles behind the wall, unless they flew past its rim:
 * their paths are followed back to its rear face along straight lines. */
#include "measure/broken_axis.h"

#include <stdlib.h>

#include "material/material.h"
#include "shape/shape.h"

enum { TAKE_HOLE, TAKE_THICKNESS, TAKE_MASS };
static const char *const take_names[] = {"hole", "thickness", "mass", NULL};

const struct parameter measure_perforation_table[] = {
    PARAMETER(CHOICE, struct measure_perforation, along, REQUIRED, "the axis normal to the wall",
              .names = parameter_axes),
    PARAMETER(CHOICE, struct measure_perforation, side, REQUIRED,
              "the end of the axis at which the rear face is: low or high",
              .names = parameter_sides),
    PARAMETER(CHOICE, struct measure_perforation, take, "hole",
              "diameter of the circle of the area that is open; least thickness left; mass that "
              "came through",
              .names = take_names),
    PARAMETER(VECTOR, struct measure_perforation, center, OPTIONAL,
              "a point on the axis; default: the origin", .unit = "m"),
    CONNECTED_LINK(offsetof(struct measure_perforation, link)),
    PARAMETER_END,
};

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_perforation *parameters = measurement->check->measure.value;
    const struct problem *problem = measurement->simulation->problem;
    struct broken_axis axis;
    *unit = parameters->take == TAKE_MASS
                ? ledger_unit(LEDGER_MASS, problem->dimension, problem->geometry)
                : "m";
    return broken_find_axis(measurement, parameters->along, &parameters->center, &axis);
}

/* In particle diameters: the width of a column (at least), and how far a particle reaches. The
 * share of its thickness below which a column is open. */
#define COLUMN_WIDTH 0.5
#define COLUMN_REACH 1.5
#define OPEN 0.05
enum { COLUMNS_MOST = 1 << 22 };

/* A wall as it was at the start, and what is left of it: of each column the share of its thickness,
 * in whole parts, so that sums do not depend on their order. */
struct wall {
    const struct measurement *measurement;
    const struct measure_perforation *parameters;
    struct broken_plate plate;
    struct broken_axis axis;
    double low[2], high[2]; /* of its rim, from the axis */
    double thickness, width;
    int64_t count[2], *left;
};
#define PARTS (double)(INT64_C(1) << 40)

static void find_rim(struct wall *wall)
{
    const struct simulation_case *input = wall->measurement->simulation->problem->input;
    const struct bounds bounds =
        shape_bounds(&case_body(input, measure_body(wall->measurement))->shape);
    const int along = wall->parameters->along;
    wall->thickness = vec3_at(bounds.high, along) - vec3_at(bounds.low, along);
    wall->width = COLUMN_WIDTH * input->resolution;
    for (int k = 0; k < wall->axis.count; k++) {
        const int across = wall->axis.across[k];
        wall->low[k] = vec3_at(bounds.low, across) - wall->axis.center[k];
        wall->high[k] = vec3_at(bounds.high, across) - wall->axis.center[k];
        if (wall->axis.mirror[k] || wall->axis.round)
            wall->low[k] = maximum(wall->low[k], 0.0);
    }
}

static struct error *make_columns(struct wall *wall)
{
    const double wide = wall->high[0] - wall->low[0], deep = wall->high[1] - wall->low[1];
    while ((1.0 + wide / wall->width) * (1.0 + deep / wall->width) > COLUMNS_MOST)
        wall->width *= 2.0;
    for (int k = 0; k < 2; k++)
        wall->count[k] = 1 + (int64_t)((wall->high[k] - wall->low[k]) / wall->width);
    wall->left = calloc((size_t)(wall->count[0] * wall->count[1]), sizeof *wall->left);
    return wall->left ? NULL : out_of_memory_for("a check of a wall");
}

static double middle_of(const struct wall *wall, int k, int64_t column)
{
    return wall->low[k] + ((double)column + 0.5) * wall->width;
}

/* The first and last column of axis K whose middle is within REACH of AT. */
static void range_of(const struct wall *wall, int k, double at, double reach, int64_t range[2])
{
    const double first = ceil((at - reach - wall->low[k]) / wall->width - 0.5);
    const double last = floor((at + reach - wall->low[k]) / wall->width - 0.5);
    range[0] = (int64_t)maximum(first, 0.0);
    range[1] = (int64_t)minimum(last, (double)(wall->count[k] - 1));
}

/* A particle at ACROSS that would fill THICK of the wall's thickness over its reach. */
static void fill(struct wall *wall, const double across[2], double reach, double thick)
{
    int64_t x[2], y[2] = {0, 0};
    range_of(wall, 0, across[0], reach, x);
    if (wall->axis.count > 1)
        range_of(wall, 1, across[1], reach, y);
    const int64_t parts = llround(thick * PARTS);
    for (int64_t j = y[0]; j <= y[1]; j++)
        for (int64_t i = x[0]; i <= x[1]; i++)
            wall->left[j * wall->count[0] + i] += parts;
}

static void fill_by(struct wall *wall, const struct population *p, int32_t i)
{
    const struct material *material = &p->problem->material[p->material[i]];
    const double reach = COLUMN_REACH * wall->plate.diameter[i];
    const double over = wall->axis.count > 1 ? square(2.0 * reach) : 2.0 * reach;
    const double thick = p->mass[i] / (material_density(material) * over * wall->thickness);
    double across[2];
    if (wall->axis.round) { /* a ring, and what is behind the axis of it */
        const double radius = p->position[i][0], ring = thick / maximum(radius, 1e-3 * reach);
        fill(wall, (const double[2]){radius, 0.0}, reach, ring);
        fill(wall, (const double[2]){-radius, 0.0}, reach, ring);
        return;
    }
    for (int image = 0; image < BROKEN_IMAGES; image++)
        if (broken_image(&wall->axis, p->position[i], image, across))
            fill(wall, across, reach, thick);
}

/* Whether column C of axis K is so near to the rim that it was never full. */
static bool at_rim(const struct wall *wall, int k, int64_t column)
{
    const double at = middle_of(wall, k, column);
    const double most =
        2.0 * COLUMN_REACH * wall->measurement->simulation->problem->input->resolution;
    const bool through = wall->axis.mirror[k] || (wall->axis.round && k == 0);
    return k < wall->axis.count &&
           (at > wall->high[k] - most || (!through && at < wall->low[k] + most));
}

/* The hole or the least thickness of what is left. */
static double judge_columns(const struct wall *wall)
{
    const double spacing = wall->measurement->simulation->problem->input->resolution;
    const bool space = wall->axis.count > 1;
    double least = INFINITY, area = 0.0;
    for (int64_t j = 0; j < wall->count[1]; j++)
        for (int64_t i = 0; i < wall->count[0]; i++) {
            if (at_rim(wall, 0, i) || at_rim(wall, 1, j))
                continue;
            const double left = (double)wall->left[j * wall->count[0] + i] / PARTS;
            const double ring = wall->axis.round ? 2.0 * M_PI * middle_of(wall, 0, i) : 1.0;
            least = minimum(least, left);
            if (left < OPEN)
                area += ring * (space ? square(wall->width) : wall->width);
        }
    for (int k = 0; k < wall->axis.count && !wall->axis.round; k++)
        area *= wall->axis.mirror[k] ? 2.0 : 1.0;
    if (isinf(least)) /* all is rim */
        return NAN;
    if (wall->parameters->take == TAKE_THICKNESS)
        return least * wall->thickness;
    if (area == 0.0)
        return 0.0;
    const double excess = 2.0 * (COLUMN_REACH - 0.5) * spacing; /* particles reach into the hole */
    return (space || wall->axis.round ? 2.0 * sqrt(area / M_PI) : area) + excess;
}

/* Collective: of what is left. */
static struct error *measure_columns(struct wall *wall, double *value)
{
    const struct population *p = wall->measurement->population;
    const struct ranks *ranks = wall->measurement->simulation->ranks;
    TRY(ranks_agree(ranks, make_columns(wall)));
    for (int32_t i = 0; i < p->count; i++)
        if (wall->plate.is_part[i])
            fill_by(wall, p, i);
    ranks_sum_of(ranks, wall->left, (int)(wall->count[0] * wall->count[1]));
    *value = judge_columns(wall);
    free(wall->left);
    return NULL;
}

/* Whether member I, BEHIND the rear face at the start, came through the wall. */
static bool came_through(const struct wall *wall, const struct population *p, int32_t i,
                         double behind)
{
    const int along = wall->parameters->along;
    const double away = (wall->parameters->side ? 1.0 : -1.0) * p->velocity[i][along];
    const double since = away > 0.0 ? behind / away : 0.0;
    double across[2], start[3];
    for (int k = 0; k < 3; k++)
        start[k] = p->position[i][k] - since * p->velocity[i][k];
    if (!broken_image(&wall->axis, start, 0, across))
        return false;
    bool inside = true;
    for (int k = 0; k < wall->axis.count; k++) {
        const double at = wall->axis.mirror[k] || wall->axis.round ? fabs(across[k]) : across[k];
        inside &= at >= wall->low[k] && at <= wall->high[k];
    }
    return inside;
}

/* Collective: the mass that came through, farther than what is left of the wall reaches. */
static double measure_mass(const struct wall *wall)
{
    const struct population *p = wall->measurement->population;
    const struct ranks *ranks = wall->measurement->simulation->ranks;
    const int along = wall->parameters->along, side = wall->parameters->side;
    const double face = broken_face(wall->measurement, along, side);
    double rear = 0.0;
    for (int32_t i = 0; i < p->count; i++)
        if (wall->plate.is_part[i])
            rear = maximum(rear, (side ? 1.0 : -1.0) * (p->position[i][along] - face) +
                                     wall->plate.diameter[i]);
    rear = ranks_maximum(ranks, rear);
    struct exact_sum sum = {0};
    for (int32_t i = 0; i < p->count; i++) {
        const double behind = (side ? 1.0 : -1.0) * (p->position[i][along] - face);
        if (population_has(p, i) && !wall->plate.is_part[i] && behind > rear &&
            came_through(wall, p, i, behind))
            exact_sum_add(&sum, p->mass[i]);
    }
    ranks_sum_exact(ranks, &sum, 1);
    return exact_sum_value(&sum);
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_perforation *parameters = measurement->check->measure.value;
    struct wall wall = {.measurement = measurement, .parameters = parameters};
    TRY(broken_find_axis(measurement, parameters->along, &parameters->center, &wall.axis));
    struct error *error = broken_find_plate(measurement, parameters->link, &wall.plate);
    find_rim(&wall);
    if (!error && parameters->take == TAKE_MASS)
        *value = measure_mass(&wall);
    else if (!error)
        error = measure_columns(&wall, value);
    if (!error && isnan(*value))
        measure_nothing(measurement, NOTHING_NOT_AROUND);
    broken_plate_free(&wall.plate);
    return error;
}

const struct measure_class measure_perforation = {
    .unit = unit, .measure = measure, .of_bodies = true};
