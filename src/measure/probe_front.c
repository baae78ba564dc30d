/* front: the place of a front over time, by the formula of the measure `front`. */
#include "measure/probes.h"

/* COLUMN is the field's, as index of the view and component. */
static struct error *prepare(struct probe *probe, const struct simulation *simulation,
                             const struct views *views)
{
    const struct measure_front *front = probe->input->probe.value;
    const struct view *view;
    struct chosen_field *field = &probe->fields->field[0];
    struct error *error = views_choose(views, front->field, NULL, 0, &view, &field->component);
    if (!error)
        error = front_check(front, view->unit);
    if (error) {
        struct error *told = probe_error(probe, simulation, "front", "%s", error_message(error, 0));
        error_free(error);
        return told;
    }
    field->view = (int)(view - views->view);
    probe->fields->count = 1;
    probe_add_column(probe, "position", "m");
    probe_add_column(probe, "level", view->unit);
    return NULL;
}

static struct error *sample(struct probe *probe, const struct simulation *simulation,
                            const struct views *views, double *row)
{
    const struct chosen_field *field = &probe->fields->field[0];
    struct samples samples = {0, NULL};
    struct error *error =
        samples_select(simulation_population(simulation), &views->view[field->view],
                       field->component, &probe->selection, &samples);
    error = ranks_agree(simulation->ranks, error);
    if (!error)
        error = front_place(simulation->ranks, &samples, probe->input->probe.value,
                            simulation->time, &row[0], &row[1]);
    samples_free(&samples);
    return error;
}

const struct probe_class probe_front = {PROBE_TAKES_OF | PROBE_TAKES_AXIS, prepare, sample};
