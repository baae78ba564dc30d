/* tracer: follows one particle, the nearest to a place at the start, by its id. */
#include <string.h>

#include "material/material.h"
#include "measure/probes.h"
#include "model/generate.h"

const struct parameter probe_tracer_table[] = {
    PARAMETER(VECTOR, struct probe_tracer, at, REQUIRED,
              "position at the start, whose nearest particle is followed, of equally near ones the "
              "first created; at most one resolution outside the body",
              .unit = "m"),
    PARAMETER_END,
};

/* How far AT lies outside the bounds of BODY, along the axis where it is farthest, less its
 * resolution, m. */
static double outside_body(const struct simulation_case *input, int body,
                           const struct vector_value *at)
{
    const struct body_input *of = case_body(input, body);
    const struct bounds bounds = body_bounds(input, body);
    double farthest = 0.0;
    for (int i = 0; i < at->count; i++)
        farthest = maximum(farthest, maximum(vec3_at(bounds.low, i) - at->at[i],
                                             at->at[i] - vec3_at(bounds.high, i)));
    return farthest - (isnan(of->resolution) ? input->resolution : of->resolution);
}

/* The nearest particle of a place outside all bodies is none that its user means. */
static struct error *check_inside(const struct probe *probe, const struct simulation *simulation,
                                  const struct vector_value *at)
{
    const struct simulation_case *input = simulation->problem->input;
    const int only = probe->selection.body;
    double outside = INFINITY;
    for (int b = 0; b < input->bodies.count; b++)
        if (only < 0 || b == only)
            outside = minimum(outside, outside_body(input, b, at));
    if (!(outside > 0.0 && isfinite(outside)))
        return NULL;
    return probe_error(probe, simulation, "tracer",
                       "it starts more than a resolution outside %s%s%s, so that no particle is "
                       "near: move it into the body",
                       only < 0 ? "all bodies" : "body \"",
                       only < 0 ? "" : input->bodies.names[only], only < 0 ? "" : "\"");
}

/* The place comes first, whatever fields are named. */
static struct error *prepare(struct probe *probe, const struct simulation *simulation,
                             const struct population *population)
{
    const struct probe_tracer *tracer = probe->input->probe.value;
    char position[] = "position", *name = position;
    const struct name_list place = {1, &name};
    TRY(probe_check_place(probe, simulation, "tracer", &tracer->at));
    if (population->kind == POPULATION_OF_PARTICLES)
        TRY(check_inside(probe, simulation, &tracer->at));
    TRY(fields_choose(population, &place, simulation->problem->dimension, probe->fields));
    return probe_add_fields(probe, simulation, population);
}

/* The whole of ID from two halves that are numbers without rounding, each the smallest of all
 * ranks. */
static uint64_t smallest_id(const struct ranks *ranks, uint64_t id)
{
    double high = ranks_minimum(ranks, (double)(id >> 32));
    double low =
        ranks_minimum(ranks, (double)(id >> 32) == high ? (double)(id & 0xffffffff) : INFINITY);
    return (uint64_t)high << 32 | (uint64_t)low;
}

/* The id of the particle that is nearest to the tracer's place; the smallest of several. */
static uint64_t nearest_particle(const struct probe *probe, const struct ranks *ranks,
                                 const struct population *particles)
{
    const struct probe_tracer *tracer = probe->input->probe.value;
    double nearest = INFINITY;
    uint64_t id = UINT64_MAX;
    for (int32_t i = 0; i < particles->count; i++) {
        double distance = distance_square(&tracer->at, particles->position[i]);
        if ((probe->selection.body >= 0 && particles->body[i] != probe->selection.body) ||
            distance > nearest || (distance == nearest && particles->id[i] > id))
            continue;
        nearest = distance;
        id = particles->id[i];
    }
    bool has_it = nearest == ranks_minimum(ranks, nearest);
    return smallest_id(ranks, has_it ? id : UINT64_MAX);
}

/* Where the particle lies now on this rank; -1 when it is not here. */
static int32_t find_particle(struct probe *probe, const struct population *population)
{
    if (probe->order == population->order && probe->index >= 0 &&
        probe->index < population->count && population->id[probe->index] == probe->id)
        return probe->index;
    probe->order = population->order;
    probe->index = -1;
    for (int32_t i = 0; i < population->count && probe->index < 0; i++)
        if (population->id[i] == probe->id)
            probe->index = i;
    return probe->index;
}

/* Notes when the particle fails, which may then come off and fly alone, unless the case asks for
 * its damage by name. INDEX: -1 on ranks that do not have it. Collective. */
static void watch_damage(struct probe *probe, const struct simulation *simulation,
                         const struct population *population, int32_t index)
{
    int component;
    const struct column *column = column_find(population, "damage", &component);
    const struct name_list *asked = &probe->input->fields;
    bool wanted = column && probe->failed < 0.0;
    for (int i = 0; i < asked->count; i++)
        wanted = wanted && strcmp(asked->names[i], "damage");
    if (!wanted)
        return;
    double damage = 0.0;
    if (index >= 0 && material_fails(&simulation->problem->material[population->material[index]]))
        column_read_component(population, column, 0, index, index + 1, &damage);
    if (ranks_maximum(simulation->ranks, damage) >= 1.0)
        probe->failed = simulation->time;
}

/* The rank that has the particle gives the numbers, the others zeros: the sum of all is exact. */
static struct error *sample(struct probe *probe, const struct simulation *simulation,
                            const struct population *population, double *row)
{
    if (probe->rows == 0)
        probe->id = nearest_particle(probe, simulation->ranks, population);
    int32_t index = find_particle(probe, population);
    bool anywhere = ranks_maximum(simulation->ranks, index) >= 0.0;
    for (int i = 0; i < probe->fields->count; i++) {
        struct exact_sum sum = {0};
        if (index >= 0)
            exact_sum_add(&sum, field_value(population, &probe->fields->field[i], index));
        ranks_sum_exact(simulation->ranks, &sum, 1);
        row[i] = anywhere ? exact_sum_value(&sum) : NAN;
    }
    if (simulation->step > 0)
        watch_damage(probe, simulation, population, index);
    return NULL;
}

const struct probe_class probe_tracer = {PROBE_TAKES_OF | PROBE_TAKES_FIELDS, prepare, sample};
