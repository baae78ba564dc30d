/* line: gauges at equal distances on a straight line, in one table. A field at a point is the mean
 * over the members near it, by volume, as that of a gauge. */
#include <stdlib.h>

#include "base/memory.h"
#include "measure/probes.h"

const struct parameter probe_line_table[] = {
    PARAMETER(VECTOR, struct probe_line, from, REQUIRED, "its first point", .unit = "m"),
    PARAMETER(VECTOR, struct probe_line, to, REQUIRED, "its last point", .unit = "m"),
    PARAMETER(INTEGER, struct probe_line, points, REQUIRED, "how many points, 2 or more",
              .above = 2, .below = PROBE_COLUMNS - 1, .closed = true),
    PARAMETER(NUMBER, struct probe_line, radius, OPTIONAL,
              "radius around a point within which particles and cells count; default: 0.87 of the "
              "resolution of the case, so that each point has a cell, and one in the centre of a "
              "cell that cell alone",
              .unit = "m", .below = INFINITY),
    PARAMETER_END,
};

static const struct probe_line *line_of(const struct probe *probe)
{
    return probe->input->probe.value;
}

static double radius_of(const struct probe *probe, const struct simulation *simulation)
{
    static const double of_a_cell = 0.87; /* a little more than half its diagonal in 3-D */
    return isnan(line_of(probe)->radius) ? of_a_cell * simulation->problem->input->resolution
                                         : line_of(probe)->radius;
}

static double length_of(const struct probe_line *line)
{
    return sqrt(distance_square(&line->from, line->to.at));
}

static struct error *prepare(struct probe *probe, const struct simulation *simulation,
                             const struct population *population)
{
    const struct probe_line *line = line_of(probe);
    struct chosen_fields *fields = probe->fields;
    TRY(probe_check_place(probe, simulation, "line.from", &line->from));
    TRY(probe_check_place(probe, simulation, "line.to", &line->to));
    if (length_of(line) == 0.0)
        return probe_error(probe, simulation, "line.to", "this is where the line begins");
    TRY(probe_add_fields(probe, simulation, population));
    const int points = (int)line->points, count = fields->count;
    if (count * points >= PROBE_COLUMNS)
        return probe_error(probe, simulation, "fields",
                           "%d fields at %d points are more than the %d columns that a table has; "
                           "name the `fields`, or take fewer points",
                           count, points, PROBE_COLUMNS - 1);
    probe->columns = 1;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < points; k++) {
            char name[sizeof probe->column->name];
            snprintf(name, sizeof name, "%.40s" PROBE_LINE_AT "%.9g", fields->field[i].name,
                     length_of(line) * k / (points - 1));
            probe_add_column(probe, name, fields->field[i].unit);
        }
    return NULL;
}

/* What one sample needs: sums of the fields and of the volume at each point. */
struct sampling {
    const struct probe *probe;
    const struct population *population;
    double radius, spacing, along[3];
    int dimension, points, fields;
    struct exact_sum *sums;
};

/* The points that member INDEX is near, FIRST .. LAST: none where LAST is less. */
static void find_points(const struct sampling *s, const struct population *population,
                        int32_t index, double *first, double *last)
{
    const struct probe_line *line = line_of(s->probe);
    const double *at = population->position[index];
    double along = 0.0, square_of_distance = 0.0;
    for (int axis = 0; axis < s->dimension; axis++)
        along += (at[axis] - line->from.at[axis]) * s->along[axis];
    square_of_distance = distance_square(&line->from, at) - square(along);
    const double reach =
        square(probe_reach(population, index, s->radius)) - maximum(square_of_distance, 0.0);
    *first = 0.0;
    *last = -1.0;
    if (!(reach >= 0.0))
        return;
    const double half = sqrt(reach) * (1.0 + 1e-9);
    *first = maximum(ceil((along - half) / s->spacing), 0.0);
    *last = minimum(floor((along + half) / s->spacing), s->points - 1.0);
}

static bool is_near(const void *context, const struct population *population, int32_t index)
{
    double first, last;
    find_points(context, population, index, &first, &last);
    return last >= first;
}

/* Adds member INDEX to the points that it is near. */
static void add_member(const struct sampling *s, int32_t index)
{
    double first, last;
    find_points(s, s->population, index, &first, &last);
    const double volume = s->population->mass[index] / s->population->density[index];
    for (int k = (int)first; k <= last; k++) {
        struct exact_sum *sums = s->sums + (int64_t)k * (s->fields + 1);
        for (int i = 0; i < s->fields; i++)
            exact_sum_add(&sums[i],
                          volume * field_value(s->population, &s->probe->fields->field[i], index));
        exact_sum_add(&sums[s->fields], volume);
    }
}

static struct error *sample(struct probe *probe, const struct simulation *simulation,
                            const struct population *population, double *row)
{
    const struct probe_line *line = line_of(probe);
    const double length = length_of(line);
    struct sampling s = {.probe = probe,
                         .population = population,
                         .radius = radius_of(probe, simulation),
                         .spacing = length / (double)(line->points - 1),
                         .dimension = line->from.count,
                         .points = (int)line->points,
                         .fields = probe->fields->count};
    const int sums = s.points * (s.fields + 1);
    for (int axis = 0; axis < s.dimension; axis++)
        s.along[axis] = (line->to.at[axis] - line->from.at[axis]) / length;
    s.sums = memory_allocate((size_t)sums * sizeof *s.sums);
    struct error *error = s.sums ? NULL : out_of_memory_for("a line");
    if (!error)
        error = probe_find_near(probe, population, is_near, &s);
    error = ranks_agree(simulation->ranks, error);
    if (error) {
        free(s.sums);
        return error;
    }
    for (int64_t k = 0; k < probe->nears; k++) {
        const int32_t i = probe->near[k];
        if (population_has(population, i) &&
            (probe->selection.body < 0 || population->body[i] == probe->selection.body))
            add_member(&s, i);
    }
    ranks_sum_exact(simulation->ranks, s.sums, sums);
    for (int i = 0; i < s.fields; i++)
        for (int k = 0; k < s.points; k++) {
            const struct exact_sum *point = s.sums + (int64_t)k * (s.fields + 1);
            const double volume = exact_sum_value(&point[s.fields]);
            row[i * s.points + k] = volume > 0.0 ? exact_sum_value(&point[i]) / volume : NAN;
        }
    free(s.sums);
    return NULL;
}

const struct probe_class probe_line = {PROBE_TAKES_OF | PROBE_TAKES_FIELDS, prepare, sample};
