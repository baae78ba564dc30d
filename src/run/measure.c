/* The list of measures, and what they share: which particles a check speaks of, and the exact state
 * that belongs to a particle. */
#include "run/measure.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "model/shape.h"

#define FIELD measure_field_table, sizeof(struct measure_field)

const struct parameter measure_field_table[] = {
    {.key = "field",
     .kind = PARAMETER_TEXT,
     .offset = offsetof(struct measure_field, field),
     .standard = PARAMETER_REQUIRED,
     .help = "a field of the particles, or one component of it: pressure, velocity.x, stress.xx"},
    PARAMETER_END,
};

/* The names are keys of a check. */
const struct choice measure_choices[MEASURES] = {
    {"mean", "mean of a field over particles", FIELD, &measure_mean},
    {"minimum", "smallest value of a field", FIELD, &measure_minimum},
    {"maximum", "largest value of a field", FIELD, &measure_maximum},
    {"l1", "mean distance of a field from the exact solution, by volume, over `scale`", FIELD,
     &measure_l1},
    {"rms", "root of the mean square distance from the exact solution, by volume, over `scale`",
     FIELD, &measure_rms},
    {"max_error", "largest distance from the exact solution, over `scale`", FIELD,
     &measure_max_error},
    {"contact_max", "largest |f/f* - 1| of the 10 particles nearest the contact on either side",
     FIELD, &measure_contact_max},
    {"contact_rms", "root mean square of f/f* - 1 of the same 20 particles", FIELD,
     &measure_contact_rms},
    {"front", "place where a field first crosses a value, seen from one end", measure_front_table,
     sizeof(struct measure_front), &measure_front},
    {"conserved", "relative change of a total since the start, less what the ledger booked",
     measure_conserved_table, sizeof(struct measure_conserved), &measure_conserved},
    {"finite", "number of particles whose field is not a finite number", FIELD, &measure_finite},
};

struct error *measure_error(const struct measurement *measurement, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *text = text_vformat(format, arguments);
    va_end(arguments);
    struct error *error = input_error(measurement->simulation->input, "checks", measurement->name,
                                      "%s", text ? text : "");
    free(text);
    return error;
}

/* ERROR, which it takes, told at the check. */
static struct error *located(const struct measurement *measurement, struct error *error)
{
    struct error *told = measure_error(measurement, "%s", error_message(error, 0));
    error_free(error);
    return told;
}

static const char *field_of(const struct measurement *measurement)
{
    const struct measure_field *parameters = measurement->check->measure.value;
    return parameters->field;
}

static struct error *find_field(const struct measurement *measurement, const struct view **view,
                                int *component)
{
    struct error *error =
        views_choose(measurement->views, field_of(measurement), NULL, 0, view, component);
    return error ? located(measurement, error) : NULL;
}

struct error *measure_field_unit(const struct measurement *measurement, const char **unit)
{
    const struct view *view;
    int component;
    TRY(find_field(measurement, &view, &component));
    *unit = view->unit;
    return NULL;
}

struct error *measure_no_unit(const struct measurement *measurement, const char **unit)
{
    TRY(measure_field_unit(measurement, unit));
    *unit = "";
    return NULL;
}

/* The body that `of` names, -1 for all. */
static int body_of(const struct measurement *measurement)
{
    const struct named_map *bodies = &measurement->simulation->input->bodies;
    for (int i = 0; measurement->check->of && i < bodies->count; i++)
        if (!strcmp(bodies->names[i], measurement->check->of))
            return i;
    return -1;
}

struct error *samples_take(const struct measurement *measurement, struct samples *samples)
{
    const struct particles *particles = &measurement->simulation->particles;
    const struct check_input *check = measurement->check;
    const struct view *view;
    int component;
    *samples = (struct samples){0, NULL};
    TRY(find_field(measurement, &view, &component));
    size_t room = (size_t)particles->count + 1;
    double *values = memory_allocate(room * sizeof *values);
    samples->at = memory_allocate(room * sizeof *samples->at);
    if (!values || !samples->at) {
        free(values);
        samples_free(samples);
        return error_new(ERROR_SYSTEM, "out of memory for a check of %d particles",
                         (int)particles->count);
    }
    view_read_component(view, component, 0, particles->count, values);
    int body = body_of(measurement);
    for (int32_t i = 0; i < particles->count; i++) {
        double at = particles->position[i][check->axis];
        if (body >= 0 && particles->body[i] != body)
            continue;
        if (check->between.count == 2 &&
            !(at >= check->between.at[0] && at <= check->between.at[1]))
            continue;
        samples->at[samples->count++] = (struct sample){
            at, values[i], particles->mass[i] / particles->density[i], particles->body[i]};
    }
    free(values);
    return NULL;
}

void samples_free(struct samples *samples)
{
    free(samples->at);
    *samples = (struct samples){0, NULL};
}

static int compare_samples(const void *first, const void *second)
{
    const struct sample *a = first, *b = second;
    return (a->at > b->at) - (a->at < b->at);
}

void samples_sort(struct samples *samples)
{
    qsort(samples->at, (size_t)samples->count, sizeof *samples->at, compare_samples);
}

enum exact_side measure_side(const struct measurement *measurement, int body)
{
    const struct body_input *input = case_body(measurement->simulation->input, body);
    struct bounds bounds = shape_bounds(&input->shape);
    double middle = 0.5 * (bounds.low.x + bounds.high.x);
    return middle < measurement->exact->contact(measurement->solved, 0.0) ? SIDE_LEFT : SIDE_RIGHT;
}

double exact_field(const struct exact_state *state, const char *field)
{
    const struct {
        const char *name;
        double value;
    } fields[] = {
        {"density", state->density},   {"velocity.x", state->velocity},
        {"pressure", state->pressure}, {"energy", state->energy},
        {"stress.xx", state->stress},  {"deviator.xx", state->deviator},
    };
    for (size_t i = 0; i < COUNT_OF(fields); i++)
        if (!strcmp(fields[i].name, field))
            return fields[i].value;
    return NAN;
}
