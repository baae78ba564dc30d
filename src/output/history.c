/* history.csv; see history.h. Numbers have as many digits as reading the same bits again takes. */
#include "output/history.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

struct history {
    FILE *file;
    char *path;
    int64_t rows;
    struct csv_mark mark;
};

struct error *history_open(const char *path, int64_t keep, const struct csv_mark *mark,
                           struct history **history)
{
    struct history *made = calloc(1, sizeof *made);
    char *copy = text_copy(path);
    struct error *error = made && (copy || !path) ? NULL : out_of_memory();
    FILE *file = NULL;
    if (!error && path)
        error = csv_grow(path, keep, mark, &file);
    if (error) {
        free(copy);
        free(made);
        return error;
    }
    *made = (struct history){file, copy, keep > 0 ? keep : 0, {0}};
    if (keep > 0 && mark)
        made->mark = *mark;
    *history = made;
    return NULL;
}

int64_t history_rows(const struct history *history) { return history->rows; }

struct error *history_mark(struct history *history, struct csv_mark *mark)
{
    if (history->file)
        TRY(csv_extend(history->file, history->path, &history->mark));
    *mark = history->mark;
    return NULL;
}

struct error *history_close(struct history *history)
{
    if (!history)
        return NULL;
    struct error *error =
        history->file && fclose(history->file) ? file_error(history->path, errno) : NULL;
    free(history->path);
    free(history);
    return error;
}

/* Writes columns one behind the other: the head's names or a row's numbers. */
struct line {
    FILE *file;
    bool head, begun;
};

static void column(struct line *line, const char *name, const char *part, const char *unit,
                   double value)
{
    if (line->begun)
        putc(',', line->file);
    line->begun = true;
    if (line->head) {
        fputs(name, line->file);
        csv_put_head(line->file, part, unit);
        return;
    }
    csv_put_number(line->file, value);
}

static void totals_columns(struct line *line, const char *prefix, const struct totals *totals,
                           const struct simulation *simulation)
{
    for (int i = 0; i < LEDGER_ENTRIES; i++)
        column(line, prefix, ledger_entry_name((enum ledger_entry)i),
               ledger_unit((enum ledger_entry)i, simulation->problem->dimension,
                           simulation->problem->geometry),
               totals->entry[i]);
}

struct entry_range {
    double low, high;
};

static void widen(struct entry_range *range, double value)
{
    range->low = value < range->low ? value : range->low;
    range->high = value > range->high ? value : range->high;
}

static void range_columns(struct line *line, const char *name, const char *unit,
                          struct entry_range range)
{
    column(line, name, ".min", unit, range.low);
    column(line, name, ".max", unit, range.high);
}

/* What load INDEX has delivered or should have, along AXIS. Its name may contain a comma. */
static void load_column(struct line *line, const struct problem *problem, int index, int axis,
                        bool expected, const struct load_totals *totals)
{
    const enum ledger_entry entry = (enum ledger_entry)((int)LEDGER_MOMENTUM_X + axis);
    char head[320];
    if (!line->head) {
        column(line, "", "", "", expected ? totals->expected[axis] : totals->delivered[axis]);
        return;
    }
    snprintf(head, sizeof head, "load.%.120s.%s.%c [%.40s]", problem->input->loads.names[index],
             expected ? "expected" : "delivered", "xyz"[axis],
             ledger_unit(entry, problem->dimension, problem->geometry));
    putc(',', line->file);
    csv_put_text(line->file, head);
}

static void load_columns(struct line *line, const struct simulation *simulation,
                         const struct load_totals *loads)
{
    const struct problem *problem = simulation->problem;
    for (int i = 0; i < simulation->loads; i++)
        for (int axis = 0; axis < 2 * problem->dimension; axis++)
            load_column(line, problem, i, axis % problem->dimension, axis >= problem->dimension,
                        &loads[i]);
}

/* What a row says; write_line shows it as the head or as numbers. */
struct row {
    const struct simulation *simulation;
    const char *members;
    double dt, drift;
    int64_t count, more[POPULATIONS_MAX]; /* of the first population, and of all that count */
    struct totals now, booked[LEDGER_CAUSES];
    struct entry_range density, pressure, speed;
    struct load_totals *loads; /* of each load of the case */
};

/* Of no particle there are no extremes. */
static struct entry_range over_ranks(const struct ranks *ranks, struct entry_range range)
{
    const struct entry_range all = {ranks_minimum(ranks, range.low),
                                    ranks_maximum(ranks, range.high)};
    return all.low <= all.high ? all : (struct entry_range){NAN, NAN};
}

/* Of all populations, and how many members count in each. */
static void find_extremes(const struct simulation *simulation, struct row *row)
{
    struct entry_range density = {INFINITY, -INFINITY}, pressure = density, speed = density;
    for (int k = 0; k < simulation->populations; k++) {
        const struct population population = simulation_population_at(simulation, k),
                                *members = &population;
        int64_t count = 0;
        for (int32_t i = 0; i < members->count; i++) {
            const double *u = members->velocity[i];
            if (!population_has(members, i))
                continue;
            count++;
            widen(&density, members->density[i]);
            widen(&pressure, members->pressure[i]);
            widen(&speed, u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
        }
        row->more[k] = ranks_sum(simulation->ranks, count);
    }
    speed = (struct entry_range){sqrt(maximum(speed.low, 0.0)), sqrt(maximum(speed.high, 0.0))};
    row->density = over_ranks(simulation->ranks, density);
    row->pressure = over_ranks(simulation->ranks, pressure);
    row->speed = over_ranks(simulation->ranks, speed);
}

static struct row find_row(const struct simulation *simulation, double dt, const struct totals *now,
                           const struct totals *start, struct load_totals *totals)
{
    const struct population population = simulation_population(simulation);
    struct row row = {.simulation = simulation,
                      .members = population_members(&population),
                      .dt = dt,
                      .now = *now,
                      .loads = totals};
    row.count = ranks_sum(simulation->ranks, population.count);
    for (int i = 0; i < LEDGER_CAUSES; i++)
        row.booked[i] = ledger_totals(&simulation->ledger, simulation->ranks, (enum ledger_cause)i);
    struct totals all = ledger_totals(&simulation->ledger, simulation->ranks, LEDGER_CAUSES);
    row.drift = energy_drift(&row.now, &all, start);
    find_extremes(simulation, &row);
    for (int i = 0; i < simulation->loads; i++)
        row.loads[i] = load_record_totals(&simulation->load[i], simulation->ranks);
    return row;
}

static void write_line(FILE *file, bool head, const struct row *row)
{
    const struct simulation *simulation = row->simulation;
    const char *joule =
        ledger_unit(LEDGER_ENERGY, simulation->problem->dimension, simulation->problem->geometry);
    struct line line = {file, head, false};
    column(&line, "time", "", "s", simulation->time);
    column(&line, "step", "", "", (double)simulation->step);
    column(&line, "dt", "", "s", row->dt);
    column(&line, row->members, "", "", (double)row->count);
    totals_columns(&line, "", &row->now, simulation);
    column(&line, "kinetic_energy", "", joule, row->now.kinetic);
    column(&line, "internal_energy", "", joule, row->now.internal);
    column(&line, "energy_drift", "", "", row->drift);
    for (int i = 0; i < LEDGER_AFTERBURN; i++) {
        char prefix[32];
        snprintf(prefix, sizeof prefix, "%s.", ledger_cause_name((enum ledger_cause)i));
        totals_columns(&line, prefix, &row->booked[i], simulation);
    }
    if (simulation->populations > 1)
        totals_columns(&line, "exchange.", &row->booked[LEDGER_EXCHANGE], simulation);
    for (int k = 1; k < simulation->populations; k++)
        column(&line, simulation->population[k].name, "", "", (double)row->more[k]);
    if (problem_afterburns(simulation->problem))
        column(&line, "afterburn.energy", "", joule,
               row->booked[LEDGER_AFTERBURN].entry[LEDGER_ENERGY]);
    range_columns(&line, "density", "kg/m^3", row->density);
    range_columns(&line, "pressure", "Pa", row->pressure);
    range_columns(&line, "speed", "m/s", row->speed);
    load_columns(&line, simulation, row->loads);
    column(&line, "segment", "", "", (double)simulation->segment);
    putc('\n', file);
}

struct error *history_row(struct history *history, const struct simulation *simulation, double dt,
                          const struct totals *now, const struct totals *start)
{
    const size_t loads = (size_t)simulation->loads;
    struct load_totals *totals = memory_allocate(loads * sizeof *totals);
    TRY(ranks_agree(simulation->ranks, totals ? NULL : out_of_memory_for("the history")));
    const struct row row = find_row(simulation, dt, now, start, totals);
    if (history->rows++ == 0 && history->file)
        write_line(history->file, true, &row);
    if (history->file)
        write_line(history->file, false, &row);
    free(totals);
    if (history->file && (fflush(history->file) || ferror(history->file)))
        return file_error(history->path, errno);
    return NULL;
}
