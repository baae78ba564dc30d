/* The list of kinds of probes, and what they share: their tables; see probes.h. */
#include "measure/probes.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"
#include "model/simulation.h"

#define PROBE_CHOICE(name, parameters, help) \
    {#name, help, parameters##_table, sizeof(struct parameters), &probe_##name},
const struct choice probe_choices[PROBES] = {PROBE_LIST(PROBE_CHOICE)};

static const struct probe_class *class_of(const struct probe *probe)
{
    return probe->input->probe.choice->thing;
}

struct error *probes_create(const struct simulation_case *input, struct probes *probes)
{
    *probes = (struct probes){
        0, memory_allocate(((size_t)input->probes.count + 1) * sizeof *probes->item)};
    if (!probes->item)
        return out_of_memory();
    for (; probes->count < input->probes.count; probes->count++) {
        struct probe *probe = &probes->item[probes->count];
        const struct probe_input *given = case_probe(input, probes->count);
        probe->name = input->probes.names[probes->count];
        probe->input = given;
        probe->selection = (struct selection){.body = case_find_body(input, given->of),
                                              .axis = given->axis < 0 ? 0 : given->axis,
                                              .between = given->between};
        probe->stored = probes->count;
        probe->step = -1;
        probe->failed = -1.0;
    }
    return NULL;
}

void probes_free(struct probes *probes)
{
    for (int i = 0; i < probes->count; i++) {
        free(probes->item[i].column);
        free(probes->item[i].fields);
        free(probes->item[i].value);
        free(probes->item[i].near);
        free(probes->item[i].solved);
        free(probes->item[i].text);
        free(probes->item[i].path);
    }
    free(probes->item);
    *probes = (struct probes){0, NULL};
}

struct error *probe_find_near(struct probe *probe, const struct population *population,
                              probe_is_near *is_near, const void *context)
{
    if (population->kind == POPULATION_OF_CELLS && probe->near && probe->order == population->order)
        return NULL;
    probe->nears = 0;
    probe->order = population->order;
    for (int32_t i = 0; i < population->count; i++) {
        if (!is_near(context, population, i))
            continue;
        if (!memory_reserve((void **)&probe->near, &probe->near_room, probe->nears + 1,
                            probe->nears, sizeof *probe->near))
            return out_of_memory_for("a probe");
        probe->near[probe->nears++] = i;
    }
    return memory_reserve((void **)&probe->near, &probe->near_room, 1, 0, sizeof *probe->near)
               ? NULL
               : out_of_memory_for("a probe");
}

struct error *probe_error(const struct probe *probe, const struct simulation *simulation,
                          const char *key, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *text = text_vformat(format, arguments);
    va_end(arguments);
    char *name = text_format("%s%s%s", probe->name, *key ? "." : "", key);
    struct error *error =
        name ? input_error(simulation->problem->input, "probes", name, "%s", text ? text : "")
             : out_of_memory();
    free(text);
    free(name);
    return error;
}

void probe_add_column(struct probe *probe, const char *name, const char *unit)
{
    assert(probe->columns < PROBE_COLUMNS);
    struct probe_column *column = &probe->column[probe->columns++];
    struct unit parsed = {0};
    snprintf(column->name, sizeof column->name, "%s", name);
    snprintf(column->unit, sizeof column->unit, "%s", unit);
    error_free(unit_parse(unit, &parsed));
    parsed.dimension.time--;
    dimension_text(parsed.dimension, column->rate);
}

struct error *probe_check_place(const struct probe *probe, const struct simulation *simulation,
                                const char *key, const struct vector_value *place)
{
    if (place->count == simulation->problem->dimension)
        return NULL;
    return probe_error(probe, simulation, key,
                       "expected %d component%s, one per dimension; found %d",
                       simulation->problem->dimension,
                       simulation->problem->dimension == 1 ? "" : "s", place->count);
}

struct error *probe_add_fields(struct probe *probe, const struct simulation *simulation,
                               const struct population *population)
{
    struct chosen_fields *fields = probe->fields;
    struct error *error = fields_choose(population, &probe->input->fields,
                                        simulation->problem->dimension, fields),
                 *told = NULL;
    for (int i = 0; error && i < error_count(error); i++)
        told = error_join(told,
                          probe_error(probe, simulation, "fields", "%s", error_message(error, i)));
    error_free(error);
    for (int i = 0; i < fields->count && !told; i++)
        probe_add_column(probe, fields->field[i].name, fields->field[i].unit);
    return told;
}

/* A key that PROBE does not take. */
static struct error *check_key(const struct probe *probe, const struct simulation *simulation,
                               const char *key, bool given, enum probe_keys needed)
{
    if (!given || class_of(probe)->takes & needed)
        return NULL;
    return probe_error(probe, simulation, key, "this has no meaning for the probe `%s`",
                       probe->input->probe.choice->name);
}

/* Cuts *ARRAY to SIZE bytes, of which one at least is kept. */
static void shrink(void **array, size_t size)
{
    void *fit = realloc(*array, size ? size : 1);
    *array = fit ? fit : *array;
}

/* Finds the columns and fields of PROBE, in memory for as many as there are: a case may have a
 * hundred thousand probes. */
static struct error *prepare(struct probe *probe, const struct simulation *simulation,
                             const struct population *population)
{
    const struct probe_input *input = probe->input;
    probe->column = memory_allocate(PROBE_COLUMNS * sizeof *probe->column);
    probe->fields = memory_allocate(sizeof *probe->fields);
    if (!probe->column || !probe->fields)
        return out_of_memory();
    population = simulation_seen(simulation, input->of, population);
    TRY(check_key(probe, simulation, "of", input->of, PROBE_TAKES_OF));
    TRY(simulation_check_of(simulation, "probes", probe->name, input->of));
    TRY(check_key(probe, simulation, "fields", input->fields.count, PROBE_TAKES_FIELDS));
    TRY(check_key(probe, simulation, "axis", input->axis >= 0, PROBE_TAKES_AXIS));
    TRY(check_key(probe, simulation, "between", input->between.count, PROBE_TAKES_AXIS));
    probe_add_column(probe, "time", "s");
    struct error *error = class_of(probe)->prepare(probe, simulation, population);
    shrink((void **)&probe->column, (size_t)probe->columns * sizeof *probe->column);
    shrink((void **)&probe->fields,
           offsetof(struct chosen_fields, field) +
               (size_t)probe->fields->count * sizeof probe->fields->field[0]);
    return error;
}

struct error *probes_prepare(struct probes *probes, const struct simulation *simulation,
                             const struct population *population)
{
    struct error *error = NULL;
    for (int i = 0; i < probes->count; i++)
        error = error_join(error, prepare(&probes->item[i], simulation, population));
    return error;
}

struct probe *probes_find(const struct probes *probes, const char *name)
{
    for (int i = 0; i < probes->count; i++)
        if (!strcmp(probes->item[i].name, name))
            return &probes->item[i];
    return NULL;
}

const struct vector_value *probe_place(const struct probe *probe)
{
    return class_of(probe) == &probe_gauge
               ? &((const struct probe_gauge *)probe->input->probe.value)->at
               : NULL;
}

/* The place of the row in the making, in memory that keeps all rows or just this one. */
static double *row_of(struct probe *probe)
{
    int64_t before = probe->kept ? probe->rows * probe->columns : 0;
    if (!memory_reserve((void **)&probe->value, &probe->room, before + probe->columns, before,
                        sizeof *probe->value))
        return NULL;
    return probe->value + before;
}

/* The rows that an interrupted run took. */
static struct error *read_back(struct probe *probe)
{
    struct csv csv;
    TRY(csv_read(probe->path, &csv));
    int64_t rows = probe->rows;
    for (probe->rows = 0; probe->rows < rows; probe->rows++) {
        double *row = row_of(probe);
        if (!row) {
            csv_free(&csv);
            return out_of_memory();
        }
        for (int i = 0; i < probe->columns; i++)
            row[i] = csv_number(&csv, probe->rows, i);
    }
    csv_free(&csv);
    return NULL;
}

static struct error *open_one(struct probe *probe, const char *folder, bool resume, bool writes)
{
    char *name = text_format("%s.csv", probe->name);
    probe->path = name ? path_join(folder, name) : NULL;
    free(name);
    if (!probe->path)
        return out_of_memory();
    probe->writes = writes;
    if (writes) {
        FILE *file;
        TRY(csv_grow(probe->path, resume ? probe->rows : -1, &probe->mark, &file));
        fclose(file);
    }
    return resume && probe->kept ? read_back(probe) : NULL;
}

struct error *probes_open(struct probes *probes, const char *folder, bool resume, bool writes)
{
    if (probes->count == 0)
        return NULL;
    char *own = path_join(folder, "probes");
    struct error *error = !own ? out_of_memory() : writes ? folder_make(own) : NULL;
    for (int i = 0; i < probes->count && !error; i++)
        error = open_one(&probes->item[i], own, resume && probes->item[i].stored >= 0, writes);
    free(own);
    return error;
}

static void put_row(const struct probe *probe, const double *row, FILE *file)
{
    for (int i = 0; i < probe->columns && probe->rows == 0; i++) {
        if (i)
            putc(',', file);
        csv_put_head(file, probe->column[i].name, probe->column[i].unit);
    }
    if (probe->rows == 0)
        putc('\n', file);
    for (int i = 0; i < probe->columns; i++) {
        if (i)
            putc(',', file);
        csv_put_number(file, row[i]);
    }
    putc('\n', file);
}

/* Moves the rows of PROBE from memory into its file, and extends MARK (NULL: none) to them. */
static struct error *pour(struct probe *probe, struct csv_mark *mark)
{
    FILE *file;
    TRY(file_check_folder(probe->path));
    TRY(file_open(probe->path, "a+", &file));
    errno = 0;
    const size_t bytes = (size_t)probe->text_bytes;
    const bool failed = (bytes && fwrite(probe->text, 1, bytes, file) < bytes) || fflush(file);
    struct error *error = failed ? file_error(probe->path, errno) : NULL;
    if (!error && mark)
        error = csv_extend(file, probe->path, mark);
    fclose(file);
    probe->text_bytes = 0;
    return error;
}

/* Takes ROW as text; enough of them go to the file together. */
static struct error *write_row(struct probe *probe, const double *row)
{
    enum { ENOUGH = 4096 };
    char *text = NULL;
    size_t size;
    FILE *file = open_memstream(&text, &size);
    if (file)
        put_row(probe, row, file);
    bool done = file && !fclose(file);
    const int64_t before = probe->text_bytes;
    done = done && memory_reserve((void **)&probe->text, &probe->text_room, before + (int64_t)size,
                                  before, 1);
    if (done) {
        memcpy(probe->text + before, text, size);
        probe->text_bytes += (int64_t)size;
    }
    free(text);
    if (!done)
        return out_of_memory();
    return probe->text_bytes < ENOUGH ? NULL : pour(probe, NULL);
}

static struct error *record(struct probe *probe, const struct simulation *simulation,
                            const struct population *population)
{
    double *row = row_of(probe);
    TRY(ranks_agree(simulation->ranks, row ? NULL : out_of_memory()));
    row[0] = simulation->time;
    TRY(ranks_agree(simulation->ranks,
                    class_of(probe)->sample(
                        probe, simulation,
                        simulation_seen(simulation, probe->input->of, population), row + 1)));
    TRY(ranks_agree(simulation->ranks, probe->writes ? write_row(probe, row) : NULL));
    probe->rows++;
    probe->step = simulation->step;
    return NULL;
}

struct error *probes_watch(struct probes *probes, const struct simulation *simulation,
                           const struct population *population, bool last)
{
    struct error *error = NULL;
    for (int i = 0; i < probes->count && !error; i++) {
        struct probe *probe = &probes->item[i];
        double every = probe->input->every;
        bool due = isnan(every) || interval_is_due(simulation->time, every, &probe->due) || last;
        if (due && probe->step < simulation->step)
            error = record(probe, simulation, population);
    }
    return error;
}

void probes_catch_up(struct probes *probes, double time)
{
    for (int i = 0; i < probes->count; i++) {
        probes->item[i].due = 0;
        interval_is_due(time, probes->item[i].input->every, &probes->item[i].due);
    }
}

struct error *probes_mark(struct probes *probes)
{
    for (int i = 0; i < probes->count; i++) {
        struct probe *probe = &probes->item[i];
        if (probe->writes)
            TRY(pour(probe, &probe->mark));
    }
    return NULL;
}

struct error *probes_close(struct probes *probes)
{
    struct error *error = probes_mark(probes);
    for (int i = 0; i < probes->count; i++)
        probes->item[i].writes = false;
    return error;
}

struct error *probes_check_loaded(const struct probes *probes, int64_t steps)
{
    for (int i = 0; i < probes->count; i++) {
        const struct probe *probe = &probes->item[i];
        if (probe->rows < 0 || probe->rows > steps + 1 || probe->due < 0 || probe->step > steps ||
            !(probe->failed >= -1.0 && isfinite(probe->failed)))
            return error_new(ERROR_SYSTEM, "a number of probe \"%s\" does not fit step %lld",
                             probe->name, (long long)steps);
    }
    return NULL;
}

struct error *probes_visit(struct probes *probes, struct visitor *visitor)
{
    for (int i = 0; i < probes->count; i++) {
        struct probe *probe = &probes->item[i];
        const int number = visitor->most ? probe->stored : i;
        if (number < 0)
            continue;
        int64_t numbers[3] = {probe->rows, probe->due, probe->step};
        char name[64];
        snprintf(name, sizeof name, "probes/%d/rows", number);
        TRY(visitor->visit(visitor, name, NUMBER_INT64, numbers, 3, 1));
        snprintf(name, sizeof name, "probes/%d/id", number);
        TRY(visitor->visit(visitor, name, NUMBER_UINT64, &probe->id, 1, 1));
        snprintf(name, sizeof name, "probes/%d/failed", number);
        TRY(visitor->visit(visitor, name, NUMBER_DOUBLE, &probe->failed, 1, 1));
        snprintf(name, sizeof name, "probes/%d/file", number);
        TRY(csv_visit_mark(&probe->mark, name, visitor));
        probe->rows = numbers[0];
        probe->due = numbers[1];
        probe->step = numbers[2];
    }
    return NULL;
}
