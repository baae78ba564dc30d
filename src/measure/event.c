/* event: the time of what a solver does once in a run, such as the change to another method. */
#include <stdlib.h>
#include <string.h>

#include "measure/measure.h"

const struct parameter measure_event_table[] = {
    PARAMETER(TEXT, struct measure_event, name, REQUIRED,
              "name of the event, as the log of the run has it: propagation"),
    PARAMETER_END,
};

static const struct event *event_of(const struct measurement *measurement)
{
    const struct measure_event *parameters = measurement->check->measure.value;
    const struct simulation *simulation = measurement->simulation;
    for (int k = 0; k < simulation->events; k++)
        if (!strcmp(simulation->event[k].name, parameters->name))
            return &simulation->event[k];
    return NULL;
}

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_event *parameters = measurement->check->measure.value;
    const struct simulation *simulation = measurement->simulation;
    *unit = "s";
    if (event_of(measurement))
        return NULL;
    if (simulation->events == 0)
        return measure_error(measurement, "the solver of this case has no events");
    return measure_error(measurement, "the solver has no event \"%s\": it has \"%s\"%s%s%s",
                         parameters->name, simulation->event[0].name,
                         simulation->events > 1 ? " and \"" : "",
                         simulation->events > 1 ? simulation->event[1].name : "",
                         simulation->events > 1 ? "\"" : "");
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    *value = event_of(measurement)->time;
    if (isnan(*value))
        measure_nothing(measurement, NOTHING_NO_EVENT);
    return NULL;
}

const struct measure_class measure_event = {
    .unit = unit, .measure = measure, .of_bodies = true, .of_run = true};
