/* fragments, largest_fragment, length: what bodies have broken into (fragments.h). */
#include "measure/broken.h"

static const char *const take_names[] = {"mass",       "size",       "particles",  "speed",
                                         "velocity.x", "velocity.y", "velocity.z", "angle.x",
                                         "angle.y",    "angle.z",    NULL};
enum {
    TAKE_MASS,
    TAKE_SIZE,
    TAKE_PARTICLES,
    TAKE_SPEED,
    TAKE_VELOCITY,
    TAKE_ANGLE = TAKE_VELOCITY + 3
};

static const char *const sum_names[] = {"number", "mass", "dust", NULL};
enum { SUM_NUMBER, SUM_MASS, SUM_DUST };

const struct parameter measure_fragments_table[] = {
    PARAMETER(CHOICE, struct measure_fragments, take, "number",
              "the number of fragments, their mass, or the mass of the dust: of failed particles",
              .names = sum_names),
    PARAMETER(QUANTITY, struct measure_fragments, above, OPTIONAL,
              "smallest mass of a fragment that counts; default: any"),
    PARAMETER(QUANTITY, struct measure_fragments, below, OPTIONAL,
              "the mass that a fragment that counts does not reach; default: any"),
    CONNECTED_LINK(offsetof(struct measure_fragments, link)),
    PARAMETER_END,
};

const struct parameter measure_largest_fragment_table[] = {
    PARAMETER(
        CHOICE, struct measure_largest_fragment, take, "mass",
        "what of it; size: the diameter of the sphere of its volume, in a plane of the circle; "
        "angle.x: between its velocity and that axis",
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

static struct error *check_limit(const struct measurement *measurement, const char *key,
                                 const struct quantity *limit, const struct unit *mass)
{
    if (isnan(limit->value) || dimension_equal(limit->dimension, mass->dimension))
        return NULL;
    return measure_error(measurement, "`%s`: the mass of a fragment is in %s here", key,
                         unit_of_mass(measurement));
}

static struct error *count_unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_fragments *parameters = measurement->check->measure.value;
    struct unit mass;
    TRY(broken_check(measurement));
    TRY(unit_parse(unit_of_mass(measurement), &mass));
    TRY(check_limit(measurement, "above", &parameters->above, &mass));
    TRY(check_limit(measurement, "below", &parameters->below, &mass));
    if (parameters->take == SUM_DUST &&
        !(isnan(parameters->above.value) && isnan(parameters->below.value)))
        return measure_error(measurement, "`above` and `below` have no meaning for dust");
    *unit = parameters->take == SUM_NUMBER ? "" : unit_of_mass(measurement);
    return NULL;
}

static struct error *count(const struct measurement *measurement, double *value)
{
    const struct measure_fragments *parameters = measurement->check->measure.value;
    const double above = isnan(parameters->above.value) ? 0.0 : parameters->above.value,
                 below = isnan(parameters->below.value) ? INFINITY : parameters->below.value;
    struct fragments fragments;
    struct error *error = broken_find(measurement, parameters->link, &fragments);
    double number = 0.0, mass = 0.0;
    for (int64_t i = 0; i < fragments.count && fragments.item[i].mass >= above; i++)
        if (fragments.item[i].mass < below) {
            number += 1.0;
            mass += fragments.item[i].mass;
        }
    *value = parameters->take == SUM_NUMBER ? number
             : parameters->take == SUM_MASS ? mass
                                            : fragments.dust.mass;
    fragments_free(&fragments);
    return error;
}

static struct error *largest_unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_largest_fragment *parameters = measurement->check->measure.value;
    const int dimension = measurement->simulation->problem->dimension, take = parameters->take;
    TRY(broken_check(measurement));
    if (take >= TAKE_VELOCITY && (take - TAKE_VELOCITY) % 3 >= dimension)
        return measure_error(measurement, "the case has %d dimension%s", dimension,
                             dimension == 1 ? "" : "s");
    *unit = take == TAKE_MASS        ? unit_of_mass(measurement)
            : take == TAKE_SIZE      ? "m"
            : take == TAKE_PARTICLES ? ""
            : take >= TAKE_ANGLE     ? "rad"
                                     : "m/s";
    return NULL;
}

static double take_of(const struct fragment *fragment, int take)
{
    const double *u = fragment->velocity;
    const double speed = sqrt(square(u[0]) + square(u[1]) + square(u[2]));
    switch (take) {
    case TAKE_MASS:
        return fragment->mass;
    case TAKE_SIZE:
        return fragment->size;
    case TAKE_PARTICLES:
        return (double)fragment->particles;
    case TAKE_SPEED:
        return speed;
    default:
        return take < TAKE_ANGLE ? u[take - TAKE_VELOCITY] : acos(u[take - TAKE_ANGLE] / speed);
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
