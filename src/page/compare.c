/* Comparisons: for each column of each probe a plot with a line a run and dots for measurements;
 * and of each run and measurement how far they are apart. See compare.h. */
#include "page/compare.h"

#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"
#include "page/curve.h"
#include "page/internal.h"

enum { RUNS_MAX = 8, DATA_MAX = 4 };
static const char EXACT[] = "exact [Pa]"; /* of a gauge: a column beside its pressure */

struct comparison {
    const struct compare_request *request;
    struct page page;
    FILE *table;
    struct csv run[RUNS_MAX]; /* of the probe that is looked at */
    struct curve data[DATA_MAX];
    int plots;
};

static void judge(const struct comparison *c, const char *folder, const struct compare_data *data,
                  const struct curve *run, const struct curve *measured, const char *unit)
{
    char rms[QUANTITY_TEXT], most[QUANTITY_TEXT], shift[QUANTITY_TEXT], fit[QUANTITY_TEXT];
    const double by = curve_shift(run, measured), difference = curve_rms(run, measured, 0.0);
    const double peak = curve_largest(run) - curve_largest(measured);
    char *text = text_format(
        "%s, %s of %s: rms %s, largest value %s, best fit with the data shifted by %s (rms %s)",
        folder, data->field, data->probe, quantity_text(difference, unit, rms),
        quantity_text(peak, unit, most), quantity_text(by, "s", shift),
        quantity_text(curve_rms(run, measured, by), unit, fit));
    if (text && c->request->line)
        c->request->line(c->request->context, text);
    if (text) {
        fputs("<li>", c->page.file);
        page_text(c->page.file, text);
        fputs("</li>\n", c->page.file);
    }
    free(text);
    csv_put_text(c->table, folder);
    putc(',', c->table);
    csv_put_text(c->table, data->path);
    fprintf(c->table, ",%.9g,%.9g,%.9g\n", difference, peak, by);
}

static bool same_name(const char *head, const char *name)
{
    const size_t length = strlen(name);
    return !strncmp(head, name, length) && (!head[length] || !strncmp(head + length, " [", 2));
}

static int by_number(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The head of the column of the runs that DATA is compared with, in fresh memory. */
static struct error *find_head(const struct comparison *c, const struct compare_data *data,
                               char **head)
{
    if (!data->probe || !data->field)
        return error_new(ERROR_INPUT, "--data: %s: %s is missing: what it is compared with",
                         data->path, data->probe ? "field=" : "probe=");
    struct error *error = NULL;
    *head = NULL;
    for (int r = 0; r < c->request->runs && !*head && !error; r++) {
        struct csv csv = {0};
        char *path = text_format("%s/probes/%s.csv", c->request->folder[r], data->probe);
        error = path ? csv_read(path, &csv) : out_of_memory_for("a comparison");
        for (int i = 1; i < csv.columns && !*head && !error; i++)
            if (same_name(csv_head(&csv, i), data->field)) {
                *head = text_copy(csv_head(&csv, i));
                error = *head ? NULL : out_of_memory_for("a comparison");
            }
        if (!error && !*head && r == c->request->runs - 1) {
            char *known = csv.columns ? csv_heads(&csv, 1) : NULL;
            error = known ? error_new(ERROR_INPUT, "%s: there is no column \"%s\" (known: %s)",
                                      path, data->field, known)
                          : error_new(ERROR_INPUT, "--data: %s has no probe \"%s\"",
                                      c->request->folder[r], data->probe);
            free(known);
        }
        free(path);
        csv_free(&csv);
    }
    return error;
}

static struct error *read_data(struct comparison *c, int index)
{
    const struct compare_data *data = &c->request->measured[index];
    char *head, *unit = NULL;
    TRY(find_head(c, data, &head));
    unit = compare_unit(head);
    struct error *error =
        unit ? compare_data_curve(data, unit, &c->data[index]) : out_of_memory_for("a comparison");
    free(unit);
    free(head);
    return error;
}

/* What a plot shows: a line, or the points of a measurement. */
struct drawn {
    const struct curve *curve; /* NULL or without points: not drawn */
    const char *label;
    bool dashed, dots;
};

static struct error *put_plot(struct comparison *c, const char *title, const char *unit,
                              const struct drawn *drawn, int lines)
{
    int64_t count = 0, kept = 0;
    for (int s = 0; s < lines; s++)
        count += drawn[s].curve ? drawn[s].curve->count : 0;
    double *numbers = memory_allocate((size_t)((lines + 1) * count + 1) * sizeof *numbers);
    if (!numbers)
        return out_of_memory_for("a comparison");
    for (int s = 0; s < lines; s++) {
        const struct curve *from = drawn[s].curve;
        if (from && from->count)
            memcpy(numbers + kept, from->time, (size_t)from->count * sizeof *numbers);
        kept += from ? from->count : 0;
    }
    qsort(numbers, (size_t)count, sizeof *numbers, by_number);
    kept = 0;
    for (int64_t i = 0; i < count; i++)
        if (kept == 0 || numbers[i] != numbers[kept - 1])
            numbers[kept++] = numbers[i];
    struct page_plot plot = {
        .title = title, .x_name = "time", .x_unit = "s", .unit = unit, .count = kept, .x = numbers};
    for (int s = 0; s < lines; s++) {
        const struct curve *from = drawn[s].curve;
        struct page_series *series = &plot.series[plot.series_count];
        double *value = numbers + (s + 1) * count;
        series->optional = !from || from->count < 2; /* left out, but the next keep their colours */
        for (int64_t i = 0, k = 0; i < kept; i++) {
            value[i] = NAN;
            if (series->optional)
                continue;
            while (k < from->count && from->time[k] < numbers[i])
                k++;
            const bool there = k < from->count && from->time[k] == numbers[i];
            value[i] = !drawn[s].dots ? curve_at(from, numbers[i])
                       : there        ? from->value[k]
                                      : (double)NAN;
        }
        snprintf(series->label, sizeof series->label, "%s", drawn[s].label);
        series->value = value;
        series->dots = drawn[s].dots;
        series->dashed = drawn[s].dashed;
        plot.series_count++;
    }
    page_plot(c->page.file, &plot);
    c->plots++;
    free(numbers);
    return NULL;
}

/* The curve of column HEAD of RUN; without points where it has none. */
static struct error *read_column(const struct csv *run, const char *head, struct curve *curve)
{
    const int at = csv_column(run, head);
    *curve = (struct curve){0};
    return at > 0 ? curve_make(run, 0, at, 1.0, 1.0, 0.0, curve) : NULL;
}

/* What a plot of a column is made of: the runs, the measurements, exact solutions that differ. */
struct column {
    struct curve run[RUNS_MAX], exact[RUNS_MAX];
    const struct curve *measured[DATA_MAX];
    struct drawn drawn[PLOT_SERIES];
    int lines;
};

/* Adds the exact solutions that gauges recorded beside their pressure, equal ones once. */
static struct error *add_exact(const struct comparison *c, struct column *column)
{
    int found = 0;
    for (int r = 0; r < c->request->runs && column->lines < PLOT_SERIES; r++) {
        struct curve *exact = &column->exact[found];
        TRY(read_column(&c->run[r], EXACT, exact));
        bool known = exact->count == 0;
        for (int k = 0; k < found; k++)
            known |= curve_equal(exact, &column->exact[k]);
        if (known) {
            free(exact->time);
            *exact = (struct curve){0};
            continue;
        }
        column->drawn[column->lines++] =
            (struct drawn){.curve = exact, .label = "exact", .dashed = true};
        found++;
    }
    return NULL;
}

static struct error *fill_column(const struct comparison *c, const char *name, const char *head,
                                 struct column *column)
{
    const struct compare_request *request = c->request;
    for (int r = 0; r < request->runs; r++) {
        TRY(read_column(&c->run[r], head, &column->run[r]));
        column->drawn[column->lines++] =
            (struct drawn){.curve = &column->run[r], .label = request->folder[r]};
    }
    for (int k = 0; k < request->data; k++) {
        const struct compare_data *data = &request->measured[k];
        if (!data->probe || !data->field || strcmp(data->probe, name) != 0 ||
            !same_name(head, data->field))
            continue;
        column->measured[k] = &c->data[k];
        column->drawn[column->lines++] =
            (struct drawn){.curve = &c->data[k], .label = data->path, .dots = true};
    }
    return same_name(head, "pressure") ? add_exact(c, column) : NULL;
}

static void judge_column(const struct comparison *c, const struct column *column, const char *unit)
{
    bool begun = false;
    for (int k = 0; k < c->request->data; k++)
        for (int r = 0; r < c->request->runs && column->measured[k]; r++) {
            if (column->measured[k]->count < 2 || column->run[r].count < 2)
                continue;
            fputs(begun ? "" : "<ul class=\"note\">\n", c->page.file);
            begun = true;
            judge(c, c->request->folder[r], &c->request->measured[k], &column->run[r],
                  column->measured[k], unit);
        }
    fputs(begun ? "</ul>\n" : "", c->page.file);
}

/* The column HEAD of the first run that has the probe NAME, in all of them. */
static struct error *compare_column(struct comparison *c, const char *name, const char *head)
{
    struct column column = {.lines = 0};
    const size_t length = strcspn(head, "[");
    char *field = text_copy_part(head, head[length] && length ? length - 1 : length);
    char *unit = head[length] ? text_copy_part(head + length + 1, strcspn(head + length + 1, "]"))
                              : text_copy("");
    char *title = text_format("%s: %s", name, field ? field : "");
    struct error *error = field && unit && title ? fill_column(c, name, head, &column)
                                                 : out_of_memory_for("a comparison");
    bool any = false;
    for (int r = 0; r < c->request->runs; r++)
        any |= curve_varies(&column.run[r]);
    if (!error && any) {
        fputs("<div>\n", c->page.file); /* one place for a plot and what is said of it */
        error = put_plot(c, title, unit, column.drawn, column.lines);
    }
    if (!error)
        judge_column(c, &column, unit);
    fputs(any ? "</div>\n" : "", c->page.file);
    for (int r = 0; r < c->request->runs; r++) {
        free(column.run[r].time);
        free(column.exact[r].time);
    }
    free(title);
    free(unit);
    free(field);
    return error;
}

static struct error *compare_probe(struct comparison *c, const char *file)
{
    struct error *error = NULL;
    char *name = text_copy_part(file, strlen(file) - 4);
    if (!name)
        return out_of_memory_for("a comparison");
    for (int r = 0; r < c->request->runs && !error; r++) {
        char *probes = path_join(c->request->folder[r], "probes");
        error =
            probes ? page_read_table(probes, file, &c->run[r]) : out_of_memory_for("a comparison");
        free(probes);
    }
    fputs("<section><h2>", c->page.file);
    page_text(c->page.file, name);
    fputs("</h2>\n<div class=\"plots\">\n", c->page.file);
    for (int i = 1; i < c->run[0].columns && !error; i++)
        if (strcmp(csv_head(&c->run[0], i), EXACT) != 0) /* it is in the plot of the pressure */
            error = compare_column(c, name, csv_head(&c->run[0], i));
    fputs("</div></section>\n", c->page.file);
    for (int r = 0; r < c->request->runs; r++)
        csv_free(&c->run[r]);
    free(name);
    return error;
}

static struct error *put_page(struct comparison *c)
{
    char **names = NULL, *folder = path_join(c->request->folder[0], "probes");
    int count = 0;
    struct error *error =
        folder ? folder_names(folder, ".csv", &names, &count) : out_of_memory_for("a comparison");
    page_head(&c->page, "Comparison");
    fputs("<header><h1>Comparison</h1></header>\n<main>\n", c->page.file);
    for (int k = 0; k < c->request->data && !error; k++)
        error = read_data(c, k);
    for (int i = 0; i < count && !error; i++)
        error = compare_probe(c, names[i]);
    page_foot(&c->page, true);
    if (!error && !c->plots)
        error = error_new(ERROR_INPUT, "%s: there are no probes to compare", c->request->folder[0]);
    names_free(names, count);
    free(folder);
    return error;
}

/* Removes what has been begun. */
static void drop_files(const struct comparison *c, const char *path, const char *table)
{
    char *beside;
    if (c->page.file)
        fclose(c->page.file);
    if (c->table)
        fclose(c->table);
    if (path && c->page.file && !file_clear_beside(path, &beside))
        free(beside);
    if (table && c->table && !file_clear_beside(table, &beside))
        free(beside);
}

struct error *compare_write(const struct compare_request *request)
{
    struct comparison c = {.request = request, .page = {.folder = request->output}};
    if (request->runs > RUNS_MAX || request->data > DATA_MAX)
        return error_new(ERROR_INPUT, "at most %d runs and %d measurements are compared", RUNS_MAX,
                         DATA_MAX);
    char *path = path_join(request->output, "compare.html");
    char *table = path_join(request->output, "compare.csv");
    struct error *error = path && table ? folder_make(request->output) : out_of_memory();
    if (!error)
        error = file_begin(path, &c.page.file);
    if (!error)
        error = file_begin(table, &c.table);
    if (!error) {
        fputs("run,data,rms,largest,shift [s]\n", c.table);
        error = put_page(&c);
    }
    if (!error)
        error = error_join(file_end(path, c.page.file), file_end(table, c.table));
    else
        drop_files(&c, path, table);
    for (int k = 0; k < request->data; k++)
        free(c.data[k].time);
    free(path);
    free(table);
    return error;
}
