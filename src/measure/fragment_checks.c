/* fragments, largest_fragment, length: what bodies have broken into (fragments.h). */
#include "measure/broken.h"

static const char *const take_names[] = {"mass",       "size",       "particles",  "speed",
                                         "velocity.x", "velocity.y", "velocity.z", NULL};
enum { TAKE_MASS, TAKE_SIZE, TAKE_PARTICLES, TAKE_SPEED, TAKE_VELOCITY };

const struct parameter measure_fragments_table[] = {
    PARAMETER(QUANTITY, struct measure_fragments, above, OPTIONAL,
              "smallest mass of a fragment that counts; default: any"),
    CONNECTED_LINK(offsetof(struct measure_fragments, link)),
    PARAMETER_END,
};

const struct parameter measure_largest_fragment_table[] = {
    PARAMETER(
        CHOICE, struct measure_largest_fragment, take, "mass",
        "what of it; size: the diameter of the sphere of its volume, in a plane of the circle",
        .names = take_names),
    CONNECTED_LINK(offsetof(struct measure_largest_fragment, link)),
    PARAMETER_END,
};

const struct parameter measure_length_table[] = {
    PARAMETER(CHOICE, struct measure_length, along, REQUIRED, "the axis of the length",
              .names = parameter_axes),
    CONNECTED_LINK(offsetof(struct measure_length, link)),
    PARAMETER_END,
};

static const char *unit_of_mass(const struct measurement *measurement)
{
    const struct problem *problem = measurement->simulation->problem;
    return ledger_unit(LEDGER_MASS, problem->dimension, problem->geometry);
}

static struct error *count_unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_fragments *parameters = measurement->check->measure.value;
    struct unit mass;
    TRY(broken_check(measurement));
    TRY(unit_parse(unit_of_mass(measurement), &mass));
    if (!isnan(parameters->above.value) &&
        !dimension_equal(parameters->above.dimension, mass.dimension))
        return measure_error(measurement, "`above`: the mass of a fragment is in %s here",
                             unit_of_mass(measurement));
    *unit = "";
    return NULL;
}

static struct error *count(const struct measurement *measurement, double *value)
{
    const struct measure_fragments *parameters = measurement->check->measure.value;
    const double above = isnan(parameters->above.value) ? 0.0 : parameters->above.value;
    struct fragments fragments;
    struct error *error = broken_find(measurement, parameters->link, &fragments);
    int64_t number = 0;
    while (number < fragments.count && fragments.item[number].mass >= above)
        number++;
    *value = (double)number;
    fragments_free(&fragments);
    return error;
}

static struct error *largest_unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_largest_fragment *parameters = measurement->check->measure.value;
    const int dimension = measurement->simulation->problem->dimension, take = parameters->take;
    TRY(broken_check(measurement));
    if (take >= TAKE_VELOCITY && take - TAKE_VELOCITY >= dimension)
        return measure_error(measurement, "the case has %d dimension%s", dimension,
                             dimension == 1 ? "" : "s");
    *unit = take == TAKE_MASS        ? unit_of_mass(measurement)
            : take == TAKE_SIZE      ? "m"
            : take == TAKE_PARTICLES ? ""
                                     : "m/s";
    return NULL;
}

static double take_of(const struct fragment *fragment, int take)
{
    const double *u = fragment->velocity;
    switch (take) {
    case TAKE_MASS:
        return fragment->mass;
    case TAKE_SIZE:
        return fragment->size;
    case TAKE_PARTICLES:
        return (double)fragment->particles;
    case TAKE_SPEED:
        return sqrt(square(u[0]) + square(u[1]) + square(u[2]));
    default:
        return u[take - TAKE_VELOCITY];
    }
}

static struct error *largest(const struct measurement *measurement, double *value)
{
    const struct measure_largest_fragment *parameters = measurement->check->measure.value;
    struct fragments fragments;
    struct error *error = broken_find(measurement, parameters->link, &fragments);
    *value = fragments.count ? take_of(&fragments.item[0], parameters->take)
                             : measure_nothing(measurement, NOTHING_NO_FRAGMENT);
    fragments_free(&fragments);
    return error;
}

static struct error *length_unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_length *parameters = measurement->check->measure.value;
    TRY(broken_check(measurement));
    *unit = "m";
    return broken_check_axis(measurement, parameters->along);
}

static struct error *length(const struct measurement *measurement, double *value)
{
    const struct measure_length *parameters = measurement->check->measure.value;
    const int axis = parameters->along;
    struct fragments fragments;
    struct error *error = broken_find(measurement, parameters->link, &fragments);
    *value = fragments.count ? fragments.item[0].high[axis] - fragments.item[0].low[axis]
                             : measure_nothing(measurement, NOTHING_NO_FRAGMENT);
    fragments_free(&fragments);
    return error;
}

const struct measure_class measure_fragments = {
    .unit = count_unit, .measure = count, .of_bodies = true};
const struct measure_class measure_largest_fragment = {
    .unit = largest_unit, .measure = largest, .of_bodies = true};
const struct measure_class measure_length = {
    .unit = length_unit, .measure = length, .of_bodies = true};
