/* blast: what a gauge records of a blast wave: peak overpressure, arrival, duration and impulse of
 * the positive phase. An exact solution that has a blast says what they are at the gauge. */
#include <stdlib.h>

#include "base/memory.h"
#include "measure/blast_record.h"
#include "measure/probes.h"

enum blast_take { BLAST_OVERPRESSURE, BLAST_ARRIVAL, BLAST_DURATION, BLAST_IMPULSE };
static const char *const take_names[] = {"overpressure", "arrival", "duration", "impulse", NULL};
static const char *const take_units[] = {"Pa", "s", "s", "Pa*s"};

const struct parameter measure_blast_table[] = {
    PARAMETER(TEXT, struct measure_blast, probe, REQUIRED,
              "name of a probe that records the pressure"),
    PARAMETER(CHOICE, struct measure_blast, take, "overpressure",
              "overpressure: the peak; arrival: when half the peak is reached; duration: from then "
              "until the overpressure is zero again; impulse: its integral up to then",
              .names = take_names),
    PARAMETER(NUMBER, struct measure_blast, ambient, OPTIONAL,
              "pressure before the blast; default: the first that the probe records", .unit = "Pa"),
    PARAMETER(NUMBER, struct measure_blast, before, OPTIONAL,
              "end of the time window, before a second wave arrives, say", .unit = "s"),
    PARAMETER_END,
};

static struct error *unit(const struct measurement *measurement, const char **unit)
{
    const struct measure_blast *blast = measurement->check->measure.value;
    struct probe *probe;
    int column;
    *unit = NULL;
    TRY(measure_find_record(measurement, blast->probe, "pressure", &probe, &column));
    if (column == probe->columns)
        return NULL;
    probe->kept = true;
    *unit = take_units[blast->take];
    return NULL;
}

static double taken(const struct blast_wave *wave, int take)
{
    switch ((enum blast_take)take) {
    case BLAST_OVERPRESSURE:
        return wave->overpressure;
    case BLAST_ARRIVAL:
        return wave->arrival;
    case BLAST_DURATION:
        return wave->duration;
    case BLAST_IMPULSE:
        return wave->impulse;
    }
    return NAN;
}

static struct error *measure(const struct measurement *measurement, double *value)
{
    const struct measure_blast *blast = measurement->check->measure.value;
    struct probe *probe;
    int column;
    TRY(measure_find_record(measurement, blast->probe, "pressure", &probe, &column));
    const size_t room = ((size_t)probe->rows + 1) * sizeof(double);
    double *time = memory_allocate(room), *pressure = memory_allocate(room);
    const bool made = time && pressure;
    int64_t count = 0;
    for (int64_t row = 0; made && row < probe->rows; row++) {
        const double *at = &probe->value[row * probe->columns];
        if (isnan(at[column]) || at[0] > blast->before)
            continue;
        time[count] = at[0];
        pressure[count++] = at[column];
    }
    if (made) {
        const struct blast_wave wave = blast_record(time, pressure, count, blast->ambient);
        *value = taken(&wave, blast->take);
        if (!isfinite(*value))
            measure_nothing(measurement, count == 0                     ? NOTHING_NOT_RECORDED
                                         : count < 2                    ? NOTHING_ONE_ROW
                                         : !isfinite(wave.overpressure) ? NOTHING_NOT_FINITE
                                         : !(wave.overpressure > 0.0)   ? NOTHING_NO_RISE
                                                                        : NOTHING_NO_END);
    }
    free(time);
    free(pressure);
    return made ? NULL : out_of_memory_for("a check");
}

static double expected(const struct measurement *measurement)
{
    const struct measure_blast *blast = measurement->check->measure.value;
    const struct probe *probe = probes_find(measurement->probes, blast->probe);
    const struct vector_value *place = probe ? probe_place(probe) : NULL;
    if (!place || !measurement->exact->blast)
        return NAN;
    const struct blast_wave wave = measurement->exact->blast(
        measurement->solved, exact_distance(measurement->exact, measurement->solved, place));
    return taken(&wave, blast->take);
}

const struct measure_class measure_blast = {
    .unit = unit, .measure = measure, .of_run = true, .expected = expected};
