/* gauge: stands still. A field at its place is the mean over the particles within its radius, by
 * volume, sum V f/sum V with V = m/rho; sums are exact. Beside a pressure stands that of the case's
 * exact solution, if it is that of a blast. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "measure/probes.h"

const struct parameter probe_gauge_table[] = {
    {.key = "at",
     .kind = PARAMETER_VECTOR,
     .offset = offsetof(struct probe_gauge, at),
     .unit = "m",
     .standard = PARAMETER_REQUIRED,
     .help = "its position"},
    {.key = "radius",
     .kind = PARAMETER_NUMBER,
     .offset = offsetof(struct probe_gauge, radius),
     .unit = "m",
     .standard = PARAMETER_OPTIONAL,
     .below = INFINITY,
     .help = "radius within which particles count; default: the resolution of the case"},
    PARAMETER_END,
};

/* Solves the exact solution of the case for the gauge where both have a pressure over time. A
 * problem without a solution is reported by the checks. */
static struct error *add_exact(struct probe *probe, const struct simulation_case *input)
{
    const struct exact_class *class = input->exact.choice ? input->exact.choice->thing : NULL;
    bool pressure = false;
    for (int i = 0; i < probe->fields->count; i++)
        pressure |= !strcmp(probe->fields->field[i].name, "pressure");
    if (!pressure || !class || class->known != EXACT_PRESSURE || probe->columns == PROBE_COLUMNS)
        return NULL;
    probe->solved = memory_allocate(class->size);
    if (!probe->solved)
        return error_new(ERROR_SYSTEM, "out of memory for an exact solution");
    struct error *error = class->solve(input->exact.value, probe->solved);
    if (error) {
        error_free(error);
        free(probe->solved);
        probe->solved = NULL;
    } else
        probe_add_column(probe, "exact", "Pa");
    return NULL;
}

static struct error *prepare(struct probe *probe, const struct simulation *simulation,
                             const struct population *population)
{
    const struct probe_gauge *gauge = probe->input->probe.value;
    TRY(probe_check_place(probe, simulation, "gauge", &gauge->at));
    probe_add_column(probe, "particles", "");
    TRY(probe_add_fields(probe, simulation, population));
    return add_exact(probe, simulation->problem->input);
}

/* Behind the sums of the fields come the count of particles and their volume. */
static void add_particle(const struct probe *probe, const struct population *population,
                         int32_t index, struct exact_sum *sums)
{
    const int count = probe->fields->count;
    double volume = population->mass[index] / population->density[index];
    for (int i = 0; i < count; i++)
        exact_sum_add(&sums[i], volume * field_value(population, &probe->fields->field[i], index));
    exact_sum_add(&sums[count], 1.0);
    exact_sum_add(&sums[count + 1], volume);
}

static struct error *sample(struct probe *probe, const struct simulation *simulation,
                            const struct population *population, double *row)
{
    const struct probe_gauge *gauge = probe->input->probe.value;
    const int count = probe->fields->count;
    double radius = isnan(gauge->radius) ? simulation->problem->input->resolution : gauge->radius;
    struct exact_sum *sums = memory_allocate(((size_t)count + 2) * sizeof *sums);
    TRY(ranks_agree(simulation->ranks,
                    sums ? NULL : error_new(ERROR_SYSTEM, "out of memory for a gauge")));
    for (int32_t i = 0; i < population->count; i++)
        if (population_has(population, i) &&
            distance_square(&gauge->at, population->position[i]) <= square(radius) &&
            (probe->selection.body < 0 || population->body[i] == probe->selection.body))
            add_particle(probe, population, i, sums);
    ranks_sum_exact(simulation->ranks, sums, count + 2);
    double volume = exact_sum_value(&sums[count + 1]);
    row[0] = exact_sum_value(&sums[count]);
    for (int i = 0; i < count; i++)
        row[i + 1] = row[0] > 0.0 ? exact_sum_value(&sums[i]) / volume : NAN;
    if (probe->solved) {
        const struct exact_class *class = simulation->problem->input->exact.choice->thing;
        const double distance = exact_distance(class, probe->solved, &gauge->at);
        row[count + 1] =
            class->sample(probe->solved, SIDE_LEFT, distance, simulation->time).pressure;
    }
    free(sums);
    return NULL;
}

const struct probe_class probe_gauge = {PROBE_TAKES_OF | PROBE_TAKES_FIELDS, prepare, sample};
