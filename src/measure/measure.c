/* The list of measures, and what they share: which particles a check speaks of, and the exact state
 * that belongs to a particle. */
#include "measure/measure.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "shape/shape.h"

const struct parameter measure_field_table[] = {
    PARAMETER(TEXT, struct measure_field, field, REQUIRED,
              "a field of the particles, or one component of it: pressure, velocity.x, stress.xx"),
    PARAMETER_END,
};

const struct parameter measure_weighted_table[] = {
    PARAMETER_AS("field", TEXT, struct measure_weighted, of.field, REQUIRED,
                 "a field of the particles, or one component of it: pressure, velocity.x"),
    PARAMETER(CHOICE, struct measure_weighted, weight, "number",
              "what each particle or cell counts by", .names = weight_names),
    PARAMETER_END,
};

#define MEASURE_CHOICE(name, parameters, help)                                       \
    {#name, help, measure_##parameters##_table, sizeof(struct measure_##parameters), \
     &measure_##name},
const struct choice measure_choices[MEASURES] = {MEASURE_LIST(MEASURE_CHOICE)};

const char *nothing_text(enum nothing why)
{
    static const char *const texts[NOTHING_REASONS] = {
        [NOTHING_SAID] = "the value is not a finite number",
        [NOTHING_NO_MEMBER] = "nothing is there to be measured",
        [NOTHING_NOT_FINITE] = "a value among those measured is not a finite number",
        [NOTHING_NOT_REACHED] = "the value was not reached",
        [NOTHING_NOT_RECORDED] =
            "the probe recorded no number in the window: nothing came within its reach",
        [NOTHING_ONE_ROW] = "the probe recorded fewer than two numbers in the window",
        [NOTHING_NO_PEAKS] = "the record has fewer than two maxima",
        [NOTHING_NO_RISE] = "the pressure did not rise above the ambient pressure",
        [NOTHING_NO_END] = "the positive phase did not end before the record did: give a later "
                           "`until` or `before`",
        [NOTHING_NO_EVENT] = "this did not happen before the end",
        [NOTHING_NO_FRAGMENT] = "no fragment is left: everything has failed",
        [NOTHING_OPEN] = "the crater reaches the edge of the body, or the axis misses the body, or "
                         "it is pierced",
        [NOTHING_NOT_AROUND] = "the body does not surround the axis",
        [NOTHING_FEW] = "fewer than 10 particles are on one side of the contact",
        [NOTHING_NO_IMAGE] = "a particle has no mirror image among the others",
        [NOTHING_NO_ZONE] = "the field reached the value nowhere on the face",
        [NOTHING_NO_ROWS] = "there is no row of particles, or no time has passed",
        [NOTHING_ADDED_LATE] = "the check was added to a resumed run after its time",
        [NOTHING_NO_RANGE] = "the error has no scale: the exact solution is "
                             "uniform there, or `scale` is 0",
    };
    return texts[why < NOTHING_REASONS ? why : NOTHING_SAID];
}

double measure_nothing(const struct measurement *measurement, enum nothing why)
{
    if (measurement->why)
        *measurement->why = why;
    return NAN;
}

struct error *measure_error(const struct measurement *measurement, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *text = text_vformat(format, arguments);
    va_end(arguments);
    struct error *error = measurement->unplaced
                              ? error_new(ERROR_INPUT, "%s", text ? text : "")
                              : input_error(measurement->simulation->problem->input, "checks",
                                            measurement->name, "%s", text ? text : "");
    free(text);
    return error;
}

struct error *measure_located(const struct measurement *measurement, struct error *error)
{
    if (!error)
        return NULL;
    struct error *told = measure_error(measurement, "%s", error_message(error, 0));
    error_free(error);
    return told;
}

static const char *field_of(const struct measurement *measurement)
{
    const struct measure_field *parameters = measurement->check->measure.value;
    return parameters->field;
}

static struct error *find_field(const struct measurement *measurement, const struct column **column,
                                int *component)
{
    struct error *error =
        column_choose(measurement->population, field_of(measurement), NULL, 0, column, component);
    return measure_located(measurement, error);
}

struct error *measure_field_unit(const struct measurement *measurement, const char **unit)
{
    const struct column *column;
    int component;
    TRY(find_field(measurement, &column, &component));
    *unit = column->unit;
    return NULL;
}

struct error *measure_no_unit(const struct measurement *measurement, const char **unit)
{
    TRY(measure_field_unit(measurement, unit));
    *unit = "";
    return NULL;
}

int measure_body(const struct measurement *measurement)
{
    return case_find_body(measurement->simulation->problem->input, measurement->check->of);
}

static bool selects(const struct selection *selection, double at, int body)
{
    const struct vector_value *between = &selection->between;
    return (selection->body < 0 || body == selection->body) &&
           (between->count != 2 || (at >= between->at[0] && at <= between->at[1]));
}

struct vec3 measure_center(const struct measurement *measurement, const double (*at)[3], int body)
{
    const struct population *particles = measurement->population;
    struct exact_sum sums[4] = {{{0}, 0, false}};
    for (int32_t i = 0; i < particles->count; i++) {
        if (body >= 0 && particles->body[i] != body)
            continue;
        exact_sum_add(&sums[3], particles->mass[i]);
        for (int k = 0; k < 3; k++)
            exact_sum_add(&sums[k], particles->mass[i] * at[i][k]);
    }
    ranks_sum_exact(measurement->simulation->ranks, sums, 4);
    const double mass = exact_sum_value(&sums[3]);
    return vec3_make(exact_sum_value(&sums[0]) / mass, exact_sum_value(&sums[1]) / mass,
                     exact_sum_value(&sums[2]) / mass);
}

/* Where X lies on the axis of SELECTION, or how far from its point. */
static double place_of(const struct selection *selection, const double x[3])
{
    const struct vector_value *about = &selection->about;
    double sum = 0.0;
    for (int axis = 0; axis < about->count; axis++)
        sum += square(x[axis] - about->at[axis]);
    return about->count > 0 ? sqrt(sum) : x[selection->axis];
}

bool measure_takes(const struct measurement *measurement, int body, int32_t i)
{
    const struct check_input *check = measurement->check;
    const struct population *p = measurement->population;
    const struct selection selection = {body, check->axis, check->between, check->about};
    return selects(&selection, place_of(&selection, p->position[i]), p->body[i]);
}

struct error *samples_select(const struct population *population, const struct column *column,
                             int component, const struct selection *selection,
                             struct samples *samples)
{
    size_t room = (size_t)population->count + 1;
    double *values = memory_allocate(room * sizeof *values);
    *samples = (struct samples){0, memory_allocate(room * sizeof *samples->at)};
    if (!values || !samples->at) {
        free(values);
        samples_free(samples);
        return out_of_memory_for("the values of %d particles", (int)population->count);
    }
    column_read_component(population, column, component, 0, population->count, values);
    for (int32_t i = 0; i < population->count; i++) {
        double at = place_of(selection, population->position[i]);
        if (population_has(population, i) && selects(selection, at, population->body[i]))
            samples->at[samples->count++] =
                (struct sample){at, values[i], population->mass[i] / population->density[i],
                                population->mass[i], population->body[i]};
    }
    free(values);
    return NULL;
}

struct error *samples_take(const struct measurement *measurement, struct samples *samples)
{
    const struct simulation *simulation = measurement->simulation;
    const struct check_input *check = measurement->check;
    const struct selection selection = {measure_body(measurement), check->axis, check->between,
                                        check->about};
    const struct column *column;
    int component;
    *samples = (struct samples){0, NULL};
    TRY(find_field(measurement, &column, &component));
    struct error *error =
        samples_select(measurement->population, column, component, &selection, samples);
    error = ranks_agree(simulation->ranks, error);
    if (error)
        samples_free(samples);
    return error;
}

void samples_free(struct samples *samples)
{
    free(samples->at);
    samples->at = NULL;
    samples->count = 0;
}

int sample_order(const struct sample *a, const struct sample *b)
{
    if (a->at != b->at)
        return a->at > b->at ? 1 : -1;
    return (a->value > b->value) - (a->value < b->value);
}

static int compare_samples(const void *first, const void *second)
{
    return sample_order(first, second);
}

void samples_sort(struct samples *samples)
{
    qsort(samples->at, (size_t)samples->count, sizeof *samples->at, compare_samples);
}

enum exact_side measure_side(const struct measurement *measurement, const struct sample *sample)
{
    const struct simulation *simulation = measurement->simulation;
    if (measurement->population->kind == POPULATION_OF_CELLS)
        return exact_side_at(measurement->exact, measurement->solved, sample->at, simulation->time);
    const struct body_input *input = case_body(simulation->problem->input, sample->body);
    struct bounds bounds = shape_bounds(&input->shape);
    double middle = 0.5 * (bounds.low.x + bounds.high.x);
    return exact_side_at(measurement->exact, measurement->solved, middle, 0.0);
}

double exact_field(const struct exact_state *state, const char *field)
{
    const struct {
        const char *name;
        double value;
    } fields[] = {
        {"density", state->density},      {"velocity.x", state->velocity},
        {"speed", fabs(state->velocity)}, {"pressure", state->pressure},
        {"energy", state->energy},        {"stress.xx", state->stress},
        {"deviator.xx", state->deviator}, {"temperature", state->temperature},
        {"burnt", state->burnt},
    };
    for (size_t i = 0; i < COUNT_OF(fields); i++)
        if (!strcmp(fields[i].name, field))
            return fields[i].value;
    return NAN;
}

double exact_distance(const struct exact_class *exact, const void *solved,
                      const struct vector_value *place)
{
    const struct vector_value none = {0}, *center = exact->center ? exact->center(solved) : &none;
    double sum = 0.0;
    for (int k = 0; k < place->count; k++)
        sum += square(place->at[k] - (k < center->count ? center->at[k] : 0.0));
    return sqrt(sum);
}
