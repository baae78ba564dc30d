/* The histories of report.html: plots of history.csv, what of it is conserved, and the probes.
 * Columns are found by their names, "NAME [unit]"; "CAUSE.energy" is what the ledger booked under a
 * cause. */
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"
#include "page/internal.h"

struct column {
    char name[64], unit[32];
    double *value;
};

struct table {
    int64_t rows;
    int columns;
    struct column *column;
};

static void split_head(const char *head, struct column *column)
{
    const char *bracket = strstr(head, " [");
    int length = bracket ? (int)(bracket - head) : (int)strlen(head);
    snprintf(column->name, sizeof column->name, "%.*s", length, head);
    if (bracket)
        snprintf(column->unit, sizeof column->unit, "%.*s", (int)strcspn(bracket + 2, "]"),
                 bracket + 2);
}

static void table_free(struct table *table)
{
    for (int i = 0; table->column && i < table->columns; i++)
        free(table->column[i].value);
    free(table->column);
    *table = (struct table){0};
}

/* The numbers of CSV, column by column. */
static struct error *table_make(const struct csv *csv, struct table *table)
{
    *table = (struct table){csv->rows, csv->columns, NULL};
    table->column = memory_allocate((size_t)csv->columns * sizeof *table->column);
    bool whole = table->column;
    for (int i = 0; i < csv->columns && whole; i++) {
        struct column *column = &table->column[i];
        split_head(csv_head(csv, i), column);
        column->value = memory_allocate((size_t)csv->rows * sizeof *column->value);
        whole = column->value;
        for (int64_t row = 0; row < csv->rows && whole; row++)
            column->value[row] = csv_number(csv, row, i);
    }
    if (whole)
        return NULL;
    table_free(table);
    return out_of_memory_for("a report");
}

static const struct column *find(const struct table *table, const char *name)
{
    for (int i = 0; i < table->columns; i++)
        if (!strcmp(table->column[i].name, name))
            return &table->column[i];
    return NULL;
}

/* What stands before ENDING in the name of COLUMN, in PREFIX; false when it ends otherwise. */
static bool name_before(const struct column *column, const char *ending, char prefix[64])
{
    size_t length = strlen(column->name), end = strlen(ending);
    if (length <= end || strcmp(column->name + length - end, ending) != 0)
        return false;
    snprintf(prefix, 64, "%.*s", (int)(length - end), column->name);
    return true;
}

/* Adds COLUMN, if there is one; returns its series. */
static struct page_series *add(struct page_plot *plot, const char *label,
                               const struct column *column)
{
    if (!column || plot->series_count == PLOT_SERIES)
        return NULL;
    struct page_series *series = &plot->series[plot->series_count++];
    snprintf(series->label, sizeof series->label, "%s", label);
    series->value = column->value;
    plot->unit = column->unit;
    return series;
}

/* What each cause booked of QUANTITY. */
static void add_causes(const struct table *table, struct page_plot *plot, const char *quantity,
                       const char *words)
{
    char ending[72], cause[64], label[160];
    snprintf(ending, sizeof ending, ".%s", quantity);
    for (int i = 0; i < table->columns; i++)
        if (name_before(&table->column[i], ending, cause)) {
            snprintf(label, sizeof label, "%sby %s", words, cause);
            struct page_series *series = add(plot, label, &table->column[i]);
            if (series)
                series->dashed = series->optional = true;
        }
}

static struct page_plot plot_over_time(const struct table *table, const char *title)
{
    const struct column *first = &table->column[0];
    return (struct page_plot){.title = title,
                              .x_name = first->name,
                              .x_unit = first->unit,
                              .unit = "",
                              .count = table->rows,
                              .x = first->value};
}

static void plot_energy(const struct page *page, const struct table *table)
{
    struct page_plot plot = plot_over_time(table, "Energy");
    add(&plot, "kinetic", find(table, "kinetic_energy"));
    add(&plot, "internal", find(table, "internal_energy"));
    add(&plot, "total", find(table, "energy"));
    add_causes(table, &plot, "energy", "");
    page_plot(page->file, &plot);
}

static void plot_momentum(const struct page *page, const struct table *table)
{
    struct page_plot plot = plot_over_time(table, "Momentum");
    for (const char *axis = "xyz"; *axis; axis++) {
        char name[16], words[8];
        snprintf(name, sizeof name, "momentum.%c", *axis);
        snprintf(words, sizeof words, "%c, ", *axis);
        struct page_series *series = add(&plot, (char[]){*axis, '\0'}, find(table, name));
        if (series)
            series->optional = true;
        add_causes(table, &plot, name, words);
    }
    page_plot(page->file, &plot);
}

/* Mass is worth a plot only where it comes or goes. */
static void plot_mass(const struct page *page, const struct table *table)
{
    const struct column *mass = find(table, "mass");
    bool changes = false;
    for (int64_t i = 1; mass && i < table->rows; i++)
        changes |= fabs(mass->value[i] - mass->value[0]) > 1e-9 * fabs(mass->value[0]);
    if (!changes)
        return;
    struct page_plot plot = plot_over_time(table, "Mass");
    add(&plot, "there", mass);
    add_causes(table, &plot, "mass", "");
    page_plot(page->file, &plot);
}

/* Every pair of columns NAME.min and NAME.max. */
static void plot_extremes(const struct page *page, const struct table *table)
{
    for (int i = 0; i < table->columns; i++) {
        char name[64], partner[72], title[72];
        if (!name_before(&table->column[i], ".min", name))
            continue;
        snprintf(partner, sizeof partner, "%s.max", name);
        snprintf(title, sizeof title, "%s", name);
        if (title[0] >= 'a' && title[0] <= 'z')
            title[0] = (char)(title[0] - 'a' + 'A');
        struct page_plot plot = plot_over_time(table, title);
        add(&plot, "largest", find(table, partner));
        add(&plot, "smallest", &table->column[i]);
        page_plot(page->file, &plot);
    }
}

/* The row of time zero had no step. */
static void plot_step(const struct page *page, const struct table *table)
{
    const struct column *step = find(table, "dt");
    if (!step || table->rows < 2)
        return;
    struct page_plot plot = plot_over_time(table, "Time step");
    int64_t skipped = step->value[0] == 0.0;
    plot.x += skipped;
    plot.count -= skipped;
    plot.series[plot.series_count++] =
        (struct page_series){.label = "step", .value = step->value + skipped};
    plot.unit = step->unit;
    page_plot(page->file, &plot);
}

/* What all causes together booked of QUANTITY up to ROW. */
static double booked(const struct table *table, const char *quantity, int64_t row)
{
    char ending[72], cause[64];
    double sum = 0.0;
    snprintf(ending, sizeof ending, ".%s", quantity);
    for (int i = 0; i < table->columns; i++)
        if (name_before(&table->column[i], ending, cause))
            sum += table->column[i].value[row];
    return sum;
}

/* The largest of |there - booked - there at the start|, NAN where one of them is no number. */
static double unaccounted(const struct table *table, const struct column *column)
{
    double most = 0.0;
    for (int64_t i = 0; i < table->rows; i++) {
        double lost = fabs(column->value[i] - booked(table, column->name, i) - column->value[0]);
        if (isnan(lost))
            return NAN;
        most = maximum(most, lost);
    }
    return most;
}

/* The largest magnitude of all rows, NAN where one of them is no number. */
static double largest(const struct table *table, const double *value)
{
    double found = 0.0;
    for (int64_t i = 0; i < table->rows; i++) {
        if (isnan(value[i]))
            return NAN;
        found = maximum(found, fabs(value[i]));
    }
    return found;
}

/* What is unaccounted for of COLUMN as a fraction: of the mass at the start; for momentum of
 * sqrt(2 m E), no less than the sum of m |u|; energy has a column for it. */
static double relative_loss(const struct table *table, const struct column *column)
{
    const struct column *drift = find(table, "energy_drift"), *mass = find(table, "mass"),
                        *kinetic = find(table, "kinetic_energy");
    double lost = unaccounted(table, column);
    if (!strcmp(column->name, "energy") && drift)
        return largest(table, drift->value);
    if (lost == 0.0 || !mass || !kinetic)
        return lost == 0.0 ? 0.0 : NAN;
    if (!strcmp(column->name, "mass"))
        return lost / mass->value[0];
    return lost / sqrt(2.0 * largest(table, mass->value) * largest(table, kinetic->value));
}

/* True when CAUSE has booked anything at all. */
static bool has_booked(const struct table *table, const char *cause)
{
    size_t length = strlen(cause);
    for (int i = 0; i < table->columns; i++) {
        const struct column *column = &table->column[i];
        if (!strncmp(column->name, cause, length) && column->name[length] == '.' &&
            largest(table, column->value) != 0.0)
            return true;
    }
    return false;
}

static void put_cell(FILE *file, const char *label, double value, const char *unit)
{
    fputs("<td class=\"num\" data-label=\"", file);
    page_text(file, label);
    fputs("\">", file);
    page_quantity(file, value, unit);
    fputs("</td>", file);
}

static void put_balance(const struct page *page, const struct table *table, const char *quantity,
                        const char *words)
{
    const struct column *column = find(table, quantity);
    if (!column ||
        (largest(table, column->value) == 0.0 && booked(table, quantity, table->rows - 1) == 0.0))
        return;
    char ending[72], cause[64];
    snprintf(ending, sizeof ending, ".%s", quantity);
    fprintf(page->file, "<tr><th scope=\"row\">%s</th>", words);
    put_cell(page->file, "at the start", column->value[0], column->unit);
    put_cell(page->file, "at the end", column->value[table->rows - 1], column->unit);
    for (int i = 0; i < table->columns; i++)
        if (name_before(&table->column[i], ending, cause) && has_booked(table, cause))
            put_cell(page->file, cause, table->column[i].value[table->rows - 1], column->unit);
    put_cell(page->file, "conservation error", relative_loss(table, column), "");
    fputs("</tr>\n", page->file);
}

static void put_conservation(const struct page *page, const struct table *table)
{
    char cause[64];
    fputs("<table class=\"cards\"><caption>Conservation</caption>\n<thead><tr><th "
          "scope=\"col\">quantity</th><th scope=\"col\" class=\"num\">at the start</th><th "
          "scope=\"col\" class=\"num\">at the end</th>",
          page->file);
    for (int i = 0; i < table->columns; i++)
        if (name_before(&table->column[i], ".energy", cause) && has_booked(table, cause)) {
            fputs("<th scope=\"col\" class=\"num\">booked: ", page->file);
            page_text(page->file, cause);
            fputs("</th>", page->file);
        }
    fputs("<th scope=\"col\" class=\"num\">conservation error</th></tr></thead>\n<tbody>\n",
          page->file);
    put_balance(page, table, "mass", "mass");
    put_balance(page, table, "momentum.x", "momentum, x");
    put_balance(page, table, "momentum.y", "momentum, y");
    put_balance(page, table, "momentum.z", "momentum, z");
    put_balance(page, table, "energy", "energy");
    fputs(
        "</tbody></table>\n<p class=\"note\">Conservation error: the largest unexplained change at "
        "any time, relative to the mass at the start, for momentum to √(2 <i>m</i> "
        "<i>E</i><sub>kinetic</sub>), for energy to the largest energy of the case.</p>\n",
        page->file);
}

/* A plot of a probe says in its title what a line alone is. */
static void put_probe_plot(const struct page *page, struct page_plot *plot, const char *name)
{
    char title[256];
    bool alone = plot->series_count == 1;
    snprintf(title, sizeof title, "%.100s%s%.120s", name, alone ? ": " : "",
             alone ? plot->series[0].label : "");
    struct page_plot titled = *plot;
    titled.title = title;
    page_plot(page->file, &titled);
    plot->series_count = 0;
}

/* What a column is of: columns of one quantity share a plot, whatever else has its unit. */
static const char *quantity_of(const struct column *column)
{
    static const char *const words[][2] = {
        {"sound", "sound speed"},       {"velocity", "velocity"}, {"speed", "velocity"},
        {"stress", "stress"},           {"pressure", "stress"},   {"density", "density"},
        {"temperature", "temperature"}, {"strain", "strain"},     {"damage", "damage"},
        {"displacement", "position"},   {"position", "position"}, {"low", "position"},
        {"high", "position"},           {"energy", "energy"}};
    for (size_t i = 0; i < COUNT_OF(words); i++)
        if (strstr(column->name, words[i][0]))
            return words[i][1];
    return "";
}

static bool same_quantity(const struct column *a, const struct column *b)
{
    return !strcmp(a->unit, b->unit) && !strcmp(quantity_of(a), quantity_of(b));
}

/* One plot for all columns of a quantity, or more where they are many. */
static void plot_probe(const struct page *page, const struct table *table, const char *name)
{
    for (int i = 1; i < table->columns; i++) {
        bool plotted = false;
        for (int k = 1; k < i; k++)
            plotted |= same_quantity(&table->column[k], &table->column[i]);
        if (plotted)
            continue;
        struct page_plot plot = plot_over_time(table, name);
        for (int k = i; k < table->columns; k++)
            if (same_quantity(&table->column[k], &table->column[i]) &&
                !add(&plot, table->column[k].name, &table->column[k])) {
                put_probe_plot(page, &plot, name);
                add(&plot, table->column[k].name, &table->column[k]);
            }
        put_probe_plot(page, &plot, name);
    }
}

/* A line or two of the table of waves, after its head, if the probe has a wave. */
static void list_wave(const struct page *page, const struct table *table, const char *name,
                      bool *listed)
{
    const struct column *gauge = find(table, "particles"), *pressure = find(table, "pressure"),
                        *exact = find(table, "exact");
    if (!gauge || !pressure || !page_is_wave(pressure->value, table->rows))
        return;
    if (!*listed)
        page_waves_head(page->file);
    *listed = true;
    const struct page_wave wave = {table->rows, table->column[0].value, pressure->value,
                                   exact ? exact->value : NULL};
    page_wave(page->file, name, &wave);
}

/* Plots every probe, or lists those that have a wave. */
static struct error *each_probe(const struct page *page, bool plots, bool *listed)
{
    char **names = NULL;
    int count = 0;
    char *folder = path_join(page->folder, "probes");
    struct error *error =
        folder ? folder_names(folder, ".csv", &names, &count) : out_of_memory_for("a report");
    for (int i = 0; i < count && !error; i++) {
        struct csv csv = {0};
        struct table table = {0};
        error = page_read_table(folder, names[i], &csv);
        if (!error)
            error = table_make(&csv, &table);
        names[i][strlen(names[i]) - 4] = '\0';
        if (!error && plots) {
            fputs("<div class=\"plots\">\n", page->file); /* with a common cursor */
            plot_probe(page, &table, names[i]);
            fputs("</div>\n", page->file);
        } else if (!error)
            list_wave(page, &table, names[i], listed);
        table_free(&table);
        csv_free(&csv);
    }
    names_free(names, count);
    free(folder);
    return error;
}

struct error *page_history(const struct page *page)
{
    struct table table;
    TRY(table_make(&page->history, &table));
    fputs("<section id=\"history\"><h2>History</h2>\n", page->file);
    if (table.rows) {
        put_conservation(page, &table);
        fputs("<div class=\"plots\">\n", page->file);
        plot_energy(page, &table);
        plot_momentum(page, &table);
        plot_mass(page, &table);
        plot_extremes(page, &table);
        plot_step(page, &table);
        fputs("</div>\n", page->file);
    } else
        fputs("<p>There is no history: history.csv has no row.</p>\n", page->file);
    bool listed = false;
    struct error *error = each_probe(page, true, &listed);
    if (!error)
        error = each_probe(page, false, &listed);
    if (listed)
        page_waves_foot(page->file);
    fputs("</section>\n", page->file);
    table_free(&table);
    return error;
}
