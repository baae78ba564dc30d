/* turn: the angle by which a body has turned since the start about its centre of mass: of the
 * rotation about an axis that brings the places at the start nearest to those now, by least squares
 * over mass,
 *   tan(angle) = sum m (X x x) / sum m (X . x),
 * X and x across the axis. It lies within half a turn of zero. */
#include <stdlib.h>

#include "base/memory.h"
#include "measure/measure.h"
#include "model/start_place.h"

const struct parameter measure_turn_table[] = {
    PARAMETER(CHOICE, struct measure_turn, axis, "z", "the axis of rotation",
              .names = parameter_axes),
    PARAMETER_END,
};

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_turn *parameters = measurement->check->measure.value;
    const int dimension = measurement->simulation->problem->dimension;
    if (dimension == 1 || (dimension == 2 && parameters->axis != 2))
        return measure_error(measurement, dimension == 1 ? "nothing turns in one dimension"
                                                         : "a plane turns about z alone");
    *unit = "rad";
    return NULL;
}

static double angle(const struct measurement *measurement, const double (*start)[3])
{
    const struct measure_turn *parameters = measurement->check->measure.value;
    const struct population *p = measurement->population;
    const int body = measure_body(measurement), k = parameters->axis;
    const int a = (k + 1) % 3, b = (k + 2) % 3;
    const struct vec3 now_center =
        measure_center(measurement, (const double(*)[3])p->position, body);
    const struct vec3 then_center = measure_center(measurement, start, body);
    const double now[3] = {now_center.x, now_center.y, now_center.z};
    const double then[3] = {then_center.x, then_center.y, then_center.z};
    struct exact_sum sums[2] = {{{0}, 0, false}};
    for (int32_t i = 0; i < p->count; i++) {
        if (body >= 0 && p->body[i] != body)
            continue;
        const double xa = p->position[i][a] - now[a], xb = p->position[i][b] - now[b];
        const double sa = start[i][a] - then[a], sb = start[i][b] - then[b];
        exact_sum_add(&sums[0], p->mass[i] * (sa * xb - sb * xa));
        exact_sum_add(&sums[1], p->mass[i] * (sa * xa + sb * xb));
    }
    ranks_sum_exact(measurement->simulation->ranks, sums, 2);
    if (isnan(now_center.x))
        return measure_nothing(measurement, NOTHING_NO_MEMBER);
    return atan2(exact_sum_value(&sums[0]), exact_sum_value(&sums[1]));
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct simulation *simulation = measurement->simulation;
    const int32_t count = measurement->population->count;
    double(*start)[3] = memory_allocate(((size_t)count + 1) * sizeof *start);
    struct error *error = NULL;
    if (!start)
        error = out_of_memory_for("a check of %d particles", (int)count);
    TRY(ranks_agree(simulation->ranks, error));
    start_places(measurement->population, 0, count, start);
    *value = angle(measurement, (const double(*)[3])start);
    free(start);
    return NULL;
}

const struct measure_class measure_turn = {.unit = unit, .measure = measure, .of_bodies = true};
