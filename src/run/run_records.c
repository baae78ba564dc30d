/* Loads whose pressure another case records: that case is run before this one begins. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "run/run_internal.h"

/* Where the columns of the pressure are in PROBE, a line: their count, and *FIRST. */
static int find_pressure(const struct probe *probe, int *first)
{
    static const char head[] = "pressure" PROBE_LINE_AT;
    int count = 0;
    for (int k = 1; k < probe->columns; k++)
        if (!strncmp(probe->column[k].name, head, sizeof head - 1) && count++ == 0)
            *first = k;
    return count;
}

/* The record that is taken, and where its impulses go. */
struct taking {
    const struct record_input *record;
    struct load_trace *trace;
};

static struct error *take(const struct probe *probe, void *context)
{
    const struct taking *taking = context;
    const struct probe_line *line = probe->input->probe.value;
    struct load_trace *trace = taking->trace;
    int first = 0;
    const int points = find_pressure(probe, &first);
    if (points == 0)
        return error_new(ERROR_INPUT, "probe \"%s\" does not record the pressure", probe->name);
    if (!load_trace_create(trace, points, probe->rows))
        return out_of_memory_for("a record");
    trace->spacing = sqrt(distance_square(&line->from, line->to.at)) / (points - 1);
    double *pressure = memory_allocate((size_t)probe->rows * (size_t)points * sizeof *pressure);
    struct error *error = pressure ? NULL : out_of_memory_for("a record");
    for (int64_t row = 0; row < probe->rows && !error; row++) {
        const double *value = probe->value + row * probe->columns;
        trace->time[row] = value[0];
        memcpy(pressure + row * points, value + first, (size_t)points * sizeof *pressure);
        for (int k = 0; k < points && !error; k++)
            if (!isfinite(value[first + k]))
                error = error_new(ERROR_INPUT,
                                  "probe \"%s\" has no open cell near %s: move the line into the "
                                  "cells beside the target, or enlarge its `radius`",
                                  probe->name, probe->column[first + k].name);
    }
    if (!error)
        load_trace_integrate(trace, pressure, taking->record->ambient);
    free(pressure);
    return error;
}

static void say_record(struct run *run, const char *name, const struct load_trace *trace)
{
    const double *last = trace->impulse + (trace->rows - 1) * trace->points;
    double most = last[0];
    for (int k = 1; k < trace->points; k++)
        most = fabs(last[k]) > fabs(most) ? last[k] : most;
    run_say(run, "load \"%s\": a record of %d points to %.4g m, to %.4g s, with at most %.4g Pa s",
            name, trace->points, (trace->points - 1) * trace->spacing, trace->time[trace->rows - 1],
            most);
}

struct error *run_take_records(struct run *run)
{
    const struct run_options plain = {
        .threads = run->options->threads, .force = run->options->force, .stop = run->options->stop};
    for (int i = 0; i < run->input->loads.count; i++) {
        const struct record_input *record = &case_load(run->input, i)->record;
        struct taking taking = {record, &run->simulation.trace[i]};
        if (!record->input)
            continue;
        run_say(run, "computing \"%s\", whose record is the load \"%s\"", record->input->name,
                run->input->loads.names[i]);
        struct error *error = run_probe(record->input, &plain, record->probe, take, &taking);
        TRY(error_context(error, "loads.%s.record", run->input->loads.names[i]));
        say_record(run, run->input->loads.names[i], taking.trace);
    }
    return NULL;
}
