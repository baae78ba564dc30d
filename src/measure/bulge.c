/* bulge: how far a body has been pushed out of its face: the outermost particle edge of its
 * heaviest fragment from where the face was at the start. */
#include "measure/broken_axis.h"

const struct parameter measure_bulge_table[] = {
    PARAMETER(CHOICE, struct measure_bulge, along, REQUIRED, "the axis normal to the face",
              .names = parameter_axes),
    PARAMETER(CHOICE, struct measure_bulge, side, REQUIRED,
              "the end of the axis at which the rear face is: low or high",
              .names = parameter_sides),
    CONNECTED_LINK(offsetof(struct measure_bulge, link)),
    PARAMETER_END,
};

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_bulge *parameters = measurement->check->measure.value;
    TRY(broken_check(measurement));
    if (measure_body(measurement) < 0)
        return measure_error(measurement, "`bulge` needs `of`: the body that has it");
    *unit = "m";
    return broken_check_axis(measurement, parameters->along);
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_bulge *parameters = measurement->check->measure.value;
    const double face = broken_face(measurement, parameters->along, parameters->side);
    struct fragments fragments;
    struct error *error = broken_find(measurement, parameters->link, &fragments);
    *value = !fragments.count   ? measure_nothing(measurement, NOTHING_NO_FRAGMENT)
             : parameters->side ? fragments.item[0].high[parameters->along] - face
                                : face - fragments.item[0].low[parameters->along];
    fragments_free(&fragments);
    return error;
}

const struct measure_class measure_bulge = {.unit = unit, .measure = measure, .of_bodies = true};
