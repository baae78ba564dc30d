/* The report of a calibration: keys, their correlations, targets and runs, from its tables. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "base/memory.h"
#include "page/internal.h"

/* The tables of a calibration. */
struct calibration_tables {
    struct csv keys, targets, runs;
};

static void put_cell(FILE *file, const char *label, const char *text)
{
    fputs("<td data-label=\"", file);
    page_text(file, label);
    fputs("\">", file);
    page_text(file, text);
    fputs("</td>", file);
}

static void begin_number(FILE *file, const char *label)
{
    fputs("<td class=\"num\" data-label=\"", file);
    page_text(file, label);
    fputs("\">", file);
}

static void put_number(FILE *file, const char *label, double value, const char *unit)
{
    begin_number(file, label);
    if (!isnan(value))
        page_quantity(file, value, unit);
    fputs("</td>", file);
}

static double number_of(const struct csv *table, int64_t row, const char *column)
{
    return csv_number(table, row, csv_column(table, column));
}

static const char *text_of(const struct csv *table, int64_t row, const char *column)
{
    return csv_field(table, row, csv_column(table, column));
}

static void put_heads(FILE *file, const char *caption, const char *const *heads, size_t count)
{
    fprintf(file, "<table class=\"cards\"><caption>%s</caption>\n<thead><tr>", caption);
    for (size_t i = 0; i < count; i++)
        fprintf(file, "<th scope=\"col\">%s</th>", heads[i]);
    fputs("</tr></thead>\n<tbody>\n", file);
}

static void put_row_head(FILE *file, const char *text)
{
    fputs("<tr><th scope=\"row\">", file);
    page_text(file, text);
    fputs("</th>", file);
}

static void put_keys(FILE *file, const struct csv *keys)
{
    static const char *const heads[] = {"key", "value", "standard deviation", "range", "note"};
    put_heads(file, "Keys", heads, COUNT_OF(heads));
    for (int64_t row = 0; row < keys->rows; row++) {
        const char *unit = text_of(keys, row, "unit"), *note = text_of(keys, row, "note");
        put_row_head(file, text_of(keys, row, "key"));
        put_number(file, "value", number_of(keys, row, "value"), unit);
        put_number(file, "standard deviation", number_of(keys, row, "deviation"), unit);
        begin_number(file, "range");
        page_quantity(file, number_of(keys, row, "from"), unit);
        fputs(" to ", file);
        page_quantity(file, number_of(keys, row, "to"), unit);
        fprintf(file, "</td><td class=\"%s\" data-label=\"note\">%s", *note ? "warn" : "",
                *note ? "<span class=\"mark\">△ </span>" : "");
        page_text(file, note);
        fputs("</td></tr>\n", file);
    }
    fputs("</tbody></table>\n", file);
}

static void put_correlations(FILE *file, const struct csv *keys)
{
    static const char before[] = "correlation with ";
    if (keys->rows < 2)
        return;
    fputs("<table><caption>Correlations</caption>\n<thead><tr><th scope=\"col\">key</th>", file);
    for (int64_t row = 0; row < keys->rows; row++) {
        fputs("<th scope=\"col\" class=\"num\">", file);
        page_text(file, text_of(keys, row, "key"));
        fputs("</th>", file);
    }
    fputs("</tr></thead>\n<tbody>\n", file);
    for (int64_t row = 0; row < keys->rows; row++) {
        put_row_head(file, text_of(keys, row, "key"));
        for (int i = 0; i < keys->columns; i++)
            if (!strncmp(csv_head(keys, i), before, strlen(before)))
                fprintf(file, "<td class=\"num\">%.3f</td>", csv_number(keys, row, i));
        fputs("</tr>\n", file);
    }
    fputs("</tbody></table>\n", file);
}

static void put_targets(FILE *file, const struct csv *targets)
{
    static const char *const heads[] = {"target", "measured", "computed", "deviation", "misfit"};
    put_heads(file, "Targets", heads, COUNT_OF(heads));
    for (int64_t row = 0; row < targets->rows; row++) {
        const char *unit = text_of(targets, row, "unit");
        put_row_head(file, text_of(targets, row, "target"));
        for (size_t k = 1; k < COUNT_OF(heads); k++)
            put_number(file, heads[k], number_of(targets, row, heads[k]),
                       k + 1 < COUNT_OF(heads) ? unit : "");
        fputs("</tr>\n", file);
    }
    fputs("</tbody></table>\n<p class=\"note\">The misfit is the difference over the deviation; of "
          "a trace, whose values are not listed, its root mean square.</p>\n",
          file);
}

static void put_run(const struct page *page, const struct csv *runs, int64_t row, int keys)
{
    const char *folder = text_of(runs, row, "folder"), *verdict = text_of(runs, row, "verdict");
    char *report = text_format("%s/%s/report.html", page->folder, folder);
    const bool linked = report && access(report, R_OK) == 0;
    free(report);
    fputs("<tr><th scope=\"row\">", page->file);
    if (linked)
        fprintf(page->file, "<a href=\"%s/report.html\">", folder);
    page_text(page->file, folder);
    fprintf(page->file, "%s</th>", linked ? "</a>" : "");
    for (int k = 1; k <= keys; k++) {
        const char *head = csv_head(runs, k), *bracket = strrchr(head, '[');
        char unit[48] = "";
        if (bracket)
            snprintf(unit, sizeof unit, "%.*s", (int)strcspn(bracket + 1, "]"), bracket + 1);
        put_number(page->file, head, csv_number(runs, row, k), unit);
    }
    put_number(page->file, "mean square misfit", number_of(runs, row, "misfit"), "");
    put_cell(page->file, "verdict", verdict);
    fputs("</tr>\n", page->file);
}

static void put_runs(const struct page *page, const struct csv *runs, const struct csv *keys)
{
    FILE *file = page->file;
    fputs("<table class=\"cards\"><caption>Runs</caption>\n<thead><tr><th scope=\"col\">run</th>",
          file);
    for (int64_t k = 0; k < keys->rows; k++) {
        fputs("<th scope=\"col\" class=\"num\">", file);
        page_text(file, text_of(keys, k, "key"));
        fputs("</th>", file);
    }
    fputs("<th scope=\"col\" class=\"num\">mean square misfit</th><th "
          "scope=\"col\">verdict</th></tr></thead>\n<tbody>\n",
          file);
    for (int64_t row = 0; row < runs->rows; row++)
        put_run(page, runs, row, (int)keys->rows);
    fputs("</tbody></table>\n", file);
}

struct error *page_calibration(const struct page *page)
{
    struct calibration_tables tables = {0};
    struct error *error = page_read_table(page->folder, "calibrate-keys.csv", &tables.keys);
    if (!error)
        error = page_read_table(page->folder, "calibrate-targets.csv", &tables.targets);
    if (!error)
        error = page_read_table(page->folder, "calibrate.csv", &tables.runs);
    if (!error) {
        page_head(page, "Calibration");
        fprintf(page->file,
                "<header><h1>Calibration</h1>\n<p class=\"lead\">%lld keys · %lld targets · %lld "
                "runs</p></header>\n<main>\n<section id=\"calibration\"><h2>Result</h2>\n",
                (long long)tables.keys.rows, (long long)tables.targets.rows,
                (long long)tables.runs.rows);
        put_keys(page->file, &tables.keys);
        put_correlations(page->file, &tables.keys);
        put_targets(page->file, &tables.targets);
        put_runs(page, &tables.runs, &tables.keys);
        fputs("</section>\n", page->file);
        page_foot(page, false);
    }
    csv_free(&tables.keys);
    csv_free(&tables.targets);
    csv_free(&tables.runs);
    return error;
}
