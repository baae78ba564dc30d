/* summary.csv: what a run is and how it went, for the report and for other programs. Its columns:
 * about (run, body, material, method, phase, event, picture), name, quantity, value, unit ("text"
 * where the value is no number). Written at the beginning, so that a run that is killed has one
 * too, and at the end. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/csv.h"
#include "base/file.h"
#include "base/memory.h"
#include "material/any.h"
#include "material/material.h"
#include "page/page.h"
#include "run/run_internal.h"

/* The first four columns but the value. */
static void put_key(FILE *file, const char *about, const char *name, const char *quantity)
{
    fprintf(file, "%s,", about);
    csv_put_text(file, name);
    fputc(',', file);
    csv_put_text(file, quantity);
    fputc(',', file);
}

/* A name of a file or a message with it may begin as a formula does, which a spreadsheet would
 * compute: an apostrophe before it makes it a text. */
static void put_text(FILE *file, const char *about, const char *name, const char *quantity,
                     const char *value)
{
    char *text = strchr("=+-@", value[0]) && value[0] ? text_format("'%s", value) : NULL;
    put_key(file, about, name, quantity);
    csv_put_text(file, text ? text : value);
    fputs(",text\n", file);
    free(text);
}

static void put_number(FILE *file, const char *about, const char *name, const char *quantity,
                       double value, const char *unit)
{
    put_key(file, about, name, quantity);
    csv_put_number(file, value);
    fprintf(file, ",%s\n", unit ? unit : "");
}

static void put_table(FILE *file, const char *about, const char *name, const char *prefix,
                      const struct parameter *table, const void *values);

/* A thing that was chosen, and its parameters as QUANTITY.KEY. */
static void put_one_of(FILE *file, const char *about, const char *name, const char *quantity,
                       const struct one_of *one_of)
{
    if (!one_of->choice)
        return;
    put_text(file, about, name, quantity, one_of->choice->name);
    char *prefix = text_format("%s.", quantity);
    if (prefix && one_of->choice->table && one_of->value)
        put_table(file, about, name, prefix, one_of->choice->table, one_of->value);
    free(prefix);
}

/* The values of TABLE that fit on a line; the others are in the case as run. */
static void put_table(FILE *file, const char *about, const char *name, const char *prefix,
                      const struct parameter *table, const void *values)
{
    for (const struct parameter *p = table; p && !PARAMETER_IS_END(p); p++) {
        const void *value = (const char *)values + p->offset;
        char *quantity = text_format("%s%s", prefix, p->key ? p->key : p->kind_of_thing);
        if (!quantity)
            return;
        if (p->kind == PARAMETER_NUMBER && !isnan(*(const double *)value))
            put_number(file, about, name, quantity, *(const double *)value, p->unit);
        else if (p->kind == PARAMETER_INTEGER)
            put_number(file, about, name, quantity, (double)*(const int64_t *)value, "");
        else if (p->kind == PARAMETER_FLAG)
            put_text(file, about, name, quantity, *(const bool *)value ? "yes" : "no");
        else if (p->kind == PARAMETER_CHOICE && *(const int *)value >= 0)
            put_text(file, about, name, quantity, p->names[*(const int *)value]);
        else if (p->kind == PARAMETER_ONE_OF)
            put_one_of(file, about, name, quantity, value);
        free(quantity);
    }
}

static void put_body(FILE *file, const struct run *run, int index)
{
    const struct simulation_case *input = run->input;
    const struct population population = simulation_population(&run->simulation),
                            *particles = &population;
    const struct body_input *body = case_body(input, index);
    const char *name = input->bodies.names[index];
    const char *mass = ledger_unit(LEDGER_MASS, run->simulation.problem->dimension,
                                   run->simulation.problem->geometry);
    struct totals totals = population_totals(population, &run->ranks, index);
    int64_t count = 0;
    for (int32_t i = 0; i < particles->count; i++)
        count += particles->body[i] == index;
    put_text(file, "body", name, "material", body->material);
    put_number(file, "body", name, population_members(particles),
               ranks_sum(&run->ranks, (double)count), "");
    put_number(file, "body", name, "mass", totals.entry[LEDGER_MASS], mass);
    put_number(file, "body", name, "resolution",
               isnan(body->resolution) ? input->resolution : body->resolution, "m");
    if (body->varies)
        return;
    struct point point = body->start;
    struct response response =
        any_material_evaluate(case_material(input, body->material_index)->material, &point);
    put_number(file, "body", name, "density", point.density, "kg/m^3");
    put_number(file, "body", name, "sound_long", response.sound_long, "m/s");
    put_number(file, "body", name, "sound_shear", response.sound_shear, "m/s");
}

/* The models of every material: all that the case's table knows of them. */
static void put_materials(FILE *file, const struct simulation_case *input)
{
    const struct parameter *p = case_table;
    while (!PARAMETER_IS_END(p) && !(p->key && !strcmp(p->key, "materials")))
        p++;
    for (int i = 0; i < input->materials.count && !PARAMETER_IS_END(p); i++)
        put_table(file, "material", input->materials.names[i], "", p->table,
                  case_material(input, i));
}

static void put_speed(FILE *file, const struct run *run)
{
    const struct run_result *result = run->result;
    char hash[24], now[32];
    struct tm calendar;
    time_t seconds = time(NULL);
    snprintf(hash, sizeof hash, "%016llx", (unsigned long long)result->hash);
    put_number(file, "run", "", "seconds", result->seconds, "s");
    put_number(file, "run", "", "updates_per_second", result->updates_per_second, "");
    put_number(file, "run", "", "energy_drift", result->energy_drift, "");
    if (result->hash)
        put_text(file, "run", "", "hash", hash);
    if (gmtime_r(&seconds, &calendar) && strftime(now, sizeof now, "%Y-%m-%d %H:%M UTC", &calendar))
        put_text(file, "run", "", "ended", now);
}

/* How many there are, and how many members the one with the fewest and the one with the most has.
 * Collective. */
static void put_ranks(FILE *file, const struct run *run, const struct population *population)
{
    put_number(file, "run", "", "ranks", run->ranks.size, "");
    put_number(file, "run", "", "least_on_rank", ranks_minimum(&run->ranks, population->count), "");
    put_number(file, "run", "", "most_on_rank", ranks_maximum(&run->ranks, population->count), "");
}

static void put_run(FILE *file, const struct run *run, const char *status,
                    const struct error *error)
{
    const struct simulation_case *input = run->input;
    const struct simulation *s = &run->simulation;
    put_text(file, "run", "", "status", status);
    for (int i = 0; error && i < error_count(error); i++)
        put_text(file, "run", "", "error", error_message(error, i));
    if (input->name)
        put_text(file, "run", "", "name", input->name);
    if (input->title)
        put_text(file, "run", "", "title", input->title);
    put_number(file, "run", "", "dimension", (double)input->dimension, "");
    put_text(file, "run", "", "method", input->solver.choice->name);
    const struct population population = simulation_population(s);
    put_number(file, "run", "", population_members(&population), (double)simulation_members(s), "");
    put_number(file, "run", "", "threads", run->threads.most, "");
    if (run->ranks.size > 1)
        put_ranks(file, run, &population);
    put_number(file, "run", "", "until", input->run.until, "s");
    put_number(file, "run", "", "time", s->time, "s");
    put_number(file, "run", "", "steps", (double)s->step, "");
    if (run->result->seconds > 0.0)
        put_speed(file, run);
}

/* about "warning": the name, and why it is expected ("": it is not). */
static void put_warnings(FILE *file, const struct warning_results *warnings)
{
    for (int i = 0; i < warnings->count; i++) {
        const struct warning *warning = &warnings->item[i];
        put_text(file, "warning", warning->name, "text", warning->text);
        put_text(file, "warning", warning->name, "expected",
                 warning->expected ? warning->expected : "");
    }
}

/* about "load": "delivered.x", "expected.x", "apart". Collective. */
static void put_loads(FILE *file, const struct run *run)
{
    const struct problem *problem = run->simulation.problem;
    for (int i = 0; i < problem->input->loads.count; i++) {
        const char *name = problem->input->loads.names[i];
        const struct load_totals totals = load_record_totals(&run->simulation.load[i], &run->ranks);
        for (int k = 0; k < 2 * problem->dimension; k++) {
            const int axis = k % problem->dimension;
            const bool expected = k >= problem->dimension;
            const enum ledger_entry entry = (enum ledger_entry)((int)LEDGER_MOMENTUM_X + axis);
            char quantity[32];
            snprintf(quantity, sizeof quantity, "%s.%c", expected ? "expected" : "delivered",
                     "xyz"[axis]);
            put_number(file, "load", name, quantity,
                       expected ? totals.expected[axis] : totals.delivered[axis],
                       ledger_unit(entry, problem->dimension, problem->geometry));
        }
        put_number(file, "load", name, "apart", load_deviation(&totals), "");
    }
}

static void put_summary(FILE *file, const struct run *run, const char *status,
                        const struct error *error)
{
    const struct simulation *s = &run->simulation;
    fputs("about,name,quantity,value,unit\n", file);
    put_run(file, run, status, error);
    put_warnings(file, &run->result->warnings);
    put_table(file, "method", "", "", run->input->solver.choice->table, run->input->solver.value);
    for (int i = 0; i < run->input->bodies.count; i++)
        put_body(file, run, i);
    put_materials(file, run->input);
    put_loads(file, run);
    for (int i = 0; i < s->phases; i++)
        put_number(file, "phase", s->phase[i].name, "seconds", s->phase[i].seconds, "s");
    for (int i = 0; i < s->events; i++)
        put_number(file, "event", s->event[i].name, "time", s->event[i].time, "s");
    for (int64_t i = 0; i < run->snapshots; i++) {
        char number[32];
        snprintf(number, sizeof number, "%06lld", (long long)i);
        put_number(file, "picture", number, "time", run->snapshot_times[i], "s");
    }
}

static struct error *write_summary(const struct run *run, const char *status,
                                   const struct error *error)
{
    FILE *file;
    char *path = run_path(run, "summary.csv"), *text = NULL;
    size_t size;
    FILE *memory = open_memstream(&text, &size);
    struct error *failure = path && memory ? NULL : out_of_memory();
    failure = ranks_agree(&run->ranks, failure);
    if (!failure)
        put_summary(memory, run, status, error);
    if (memory && fclose(memory) && !failure)
        failure = out_of_memory();
    if (!failure && run_writes(run)) {
        failure = file_begin(path, &file);
        if (!failure) {
            fputs(text, file);
            failure = file_end(path, file);
        }
    }
    free(text);
    free(path);
    return ranks_agree(&run->ranks, failure);
}

struct error *run_summary_begin(const struct run *run)
{
    return run->options->output ? write_summary(run, "running", NULL) : NULL;
}

struct error *run_report(const struct run *run, struct error *error)
{
    if (!run->options->output)
        return error;
    const char *status = error ? "failed" : run->result->finished ? "finished" : "stopped";
    struct error *failure = write_summary(run, status, error);
    if (!failure && run_writes(run))
        failure = page_write(run->options->output);
    return error_join(error, failure);
}
