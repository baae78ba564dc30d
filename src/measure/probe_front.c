/* front: the place of a front over time, by the formula of the measure `front`. */
#include "measure/probes.h"

/* COLUMN is the field's, as index of the column and component. */
static struct error *prepare(struct probe *probe, const struct simulation *simulation,
                             const struct population *population)
{
    const struct measure_front *front = probe->input->probe.value;
    const struct column *column;
    struct chosen_field *field = &probe->fields->field[0];
    struct error *error =
        column_choose(population, front->field, NULL, 0, &column, &field->component);
    if (!error)
        error = front_check(front, column->unit);
    if (error) {
        struct error *told = probe_error(probe, simulation, "front", "%s", error_message(error, 0));
        error_free(error);
        return told;
    }
    field->column = (int)(column - population->column);
    probe->fields->count = 1;
    probe_add_column(probe, "position", "m");
    probe_add_column(probe, "level", column->unit);
    return NULL;
}

static struct error *sample(struct probe *probe, const struct simulation *simulation,
                            const struct population *population, double *row)
{
    const struct chosen_field *field = &probe->fields->field[0];
    struct samples samples = {0, NULL};
    struct error *error = samples_select(population, &population->column[field->column],
                                         field->component, &probe->selection, &samples);
    error = ranks_agree(simulation->ranks, error);
    if (!error)
        error = front_place(simulation->ranks, &samples, probe->input->probe.value,
                            simulation->time, &row[0], &row[1]);
    samples_free(&samples);
    return error;
}

const struct probe_class probe_front = {PROBE_TAKES_OF | PROBE_TAKES_AXIS, prepare, sample};
