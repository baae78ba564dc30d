/* The list of measures, and what they share: which particles a check speaks of, and the exact state
 * that belongs to a particle. */
#include "measure/measure.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "shape/shape.h"

#define FIELD measure_field_table, sizeof(struct measure_field)

const struct parameter measure_field_table[] = {
    PARAMETER(TEXT, struct measure_field, field, REQUIRED,
              "a field of the particles, or one component of it: pressure, velocity.x, stress.xx"),
    PARAMETER_END,
};

/* The names are keys of a check. */
const struct choice measure_choices[MEASURES] = {
    {"mean", "mean of a field over particles", FIELD, &measure_mean},
    {"minimum", "smallest value of a field", FIELD, &measure_minimum},
    {"maximum", "largest value of a field", FIELD, &measure_maximum},
    {"quantile", "value of a field that a fraction of the particles does not exceed",
     measure_quantile_table, sizeof(struct measure_quantile), &measure_quantile},
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
    {"front", "position where a field first crosses a value, seen from one end",
     measure_front_table, sizeof(struct measure_front), &measure_front},
    {"width", "number of particles in a front, between 10 and 90 % of its jump",
     measure_width_table, sizeof(struct measure_width), &measure_width},
    {"conserved", "relative change of a total since the start, less what the ledger booked",
     measure_conserved_table, sizeof(struct measure_conserved), &measure_conserved},
    {"total", "a sum over particles: momentum.x, kinetic_energy", measure_total_table,
     sizeof(struct measure_total), &measure_total},
    {"decay", "decay rate of such a sum: the logarithm of start over now, over the time",
     measure_total_table, sizeof(struct measure_total), &measure_decay},
    {"spread", "standard deviation of a field over particles", FIELD, &measure_spread},
    {"extent", "width of a body along an axis between its outermost particles, or its radius",
     measure_extent_table, sizeof(struct measure_extent), &measure_extent},
    {"turn", "rotation angle of a body since the start, within half a turn", measure_turn_table,
     sizeof(struct measure_turn), &measure_turn},
    {"pieces", "number of pieces into which bodies are broken", measure_pieces_table,
     sizeof(struct measure_pieces), &measure_pieces},
    {"fragments", "number of fragments into which bodies have broken, failed particles aside",
     measure_fragments_table, sizeof(struct measure_fragments), &measure_fragments},
    {"largest_fragment", "mass, size or velocity of the heaviest fragment",
     measure_largest_fragment_table, sizeof(struct measure_largest_fragment),
     &measure_largest_fragment},
    {"length", "length of the heaviest fragment of a body along an axis, debris aside",
     measure_length_table, sizeof(struct measure_length), &measure_length},
    {"hole", "diameter of the hole in a body about an axis; 0 if there is none", measure_hole_table,
     sizeof(struct measure_hole), &measure_hole},
    {"crater", "depth, diameter or volume of a crater below the original face of a body",
     measure_crater_table, sizeof(struct measure_crater), &measure_crater},
    {"bulge", "how far a body has been pushed out of one of its faces", measure_bulge_table,
     sizeof(struct measure_bulge), &measure_bulge},
    {"zone", "diameter or shape of the part of a face in which a field reaches a value",
     measure_zone_table, sizeof(struct measure_zone), &measure_zone},
    {"asymmetry", "largest difference of a field from its mirror image, over its largest value",
     measure_asymmetry_table, sizeof(struct measure_asymmetry), &measure_asymmetry},
    {"radius", "radius of a material circle or sphere, estimated from adjacent particles",
     measure_radius_table, sizeof(struct measure_radius), &measure_radius},
    {"shear_layer", "effective viscosity with which two sliding streams mix",
     measure_shear_layer_table, sizeof(struct measure_shear_layer), &measure_shear_layer},
    {"recorded", "number from the record of a probe", measure_recorded_table,
     sizeof(struct measure_recorded), &measure_recorded},
    {"blast", "peak, arrival, duration or impulse of a blast wave at a probe", measure_blast_table,
     sizeof(struct measure_blast), &measure_blast},
    {"event", "time at which the solver does something that it does once: the stages of `afdmp`",
     measure_event_table, sizeof(struct measure_event), &measure_event},
    {"finite", "number of particles whose field is not a finite number", FIELD, &measure_finite},
};

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
            samples->at[samples->count++] = (struct sample){
                at, values[i], population->mass[i] / population->density[i], population->body[i]};
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
