/* The profiles of report.html: the last table of each, every field a line for its mean within a
 * band of one standard deviation to either side; one line a material or body where the table is
 * split by these. */
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"
#include "page/internal.h"

/* The rows FIRST .. FIRST + COUNT - 1 of a table belong to the same material or body; all do where
 * the first column is no name. */
struct profile_part {
    const char *name;
    int64_t first, count;
};

static struct profile_part next_part(const struct csv *csv, bool named, int64_t first)
{
    struct profile_part part = {named ? csv_field(csv, first, 0) : "mean", first, 0};
    while (first + part.count < csv->rows &&
           (!named || !strcmp(csv_field(csv, first + part.count, 0), part.name)))
        part.count++;
    return part;
}

/* "pressure.mean [Pa]" in two; false for another column. */
static bool split_mean(const char *head, char name[64], char unit[UNIT_TEXT])
{
    const char *mean = strstr(head, ".mean"), *bracket = strchr(head, '[');
    if (!mean)
        return false;
    snprintf(name, 64, "%.*s", (int)(mean - head), head);
    snprintf(unit, UNIT_TEXT, "%.*s", bracket ? (int)strcspn(bracket + 1, "]") : 0,
             bracket ? bracket + 1 : "");
    return true;
}

/* Numbers of a plot: places, and for each series its mean and the edges of its band. */
enum { LINES = 3 };

static void fill_series(const struct csv *csv, const struct profile_part *part, int column,
                        double *numbers, struct page_series *series)
{
    double *mean = numbers, *low = mean + part->count, *high = low + part->count;
    for (int64_t i = 0; i < part->count; i++) {
        double spread = csv_number(csv, part->first + i, column + 1);
        mean[i] = csv_number(csv, part->first + i, column);
        low[i] = mean[i] - spread;
        high[i] = mean[i] + spread;
    }
    *series = (struct page_series){.value = mean, .low = low, .high = high};
    snprintf(series->label, sizeof series->label, "%.150s", part->name);
}

/* One field of the table; every part has the same places. */
static struct error *plot_field(const struct page *page, const struct csv *csv, const char *title,
                                bool named, int column)
{
    char name[64], unit[UNIT_TEXT], axis[8];
    if (!split_mean(csv_head(csv, column), name, unit))
        return NULL;
    char *whole = text_format("%s: %s", title, name);
    struct profile_part part = next_part(csv, named, 0);
    const int64_t count = part.count;
    double *numbers = memory_allocate((size_t)(csv->rows * LINES + count + 1) * sizeof *numbers);
    struct error *error = whole && numbers ? NULL : out_of_memory_for("a report");
    if (!error) {
        snprintf(axis, sizeof axis, "%.1s", csv_head(csv, named));
        struct page_plot plot = {.title = whole,
                                 .x_name = axis,
                                 .x_unit = "m",
                                 .unit = unit,
                                 .count = count,
                                 .x = numbers};
        for (int64_t i = 0; i < count; i++)
            numbers[i] = csv_number(csv, i, named);
        for (; part.count == count && part.first < csv->rows && plot.series_count < PLOT_SERIES;
             part = next_part(csv, named, part.first + count))
            fill_series(csv, &part, column, numbers + count + part.first * LINES,
                        &plot.series[plot.series_count++]);
        page_plot(page->file, &plot);
    }
    free(whole);
    free(numbers);
    return error;
}

static struct error *plot_profile(const struct page *page, const struct csv *csv, const char *title)
{
    struct error *error = NULL;
    const bool named = !strcmp(csv_head(csv, 0), "material") || !strcmp(csv_head(csv, 0), "body");
    for (int i = 0; i < csv->columns && csv->rows && !error; i++)
        error = plot_field(page, csv, title, named, i);
    return error;
}

/* The table FILE of FOLDER, by PLOT. */
static struct error *plot_table(const struct page *page, const char *folder, const char *file,
                                page_table *plot)
{
    struct csv csv = {0};
    char *title = text_copy_part(file, strlen(file) - strlen("-000000.csv"));
    struct error *error =
        title ? page_read_table(folder, file, &csv) : out_of_memory_for("a report");
    if (!error)
        error = plot(page, &csv, title);
    csv_free(&csv);
    free(title);
    return error;
}

/* True when FILE and NEXT are tables of one profile, that is but for their numbers the same. */
static bool same_profile(const char *file, const char *next)
{
    size_t length = strlen(file), tail = strlen("-000000.csv");
    return length == strlen(next) && length > tail && !strncmp(file, next, length - tail + 1);
}

struct error *page_last_tables(const struct page *page, const char *name, const char *head,
                               const char *foot, page_table *plot)
{
    char **names = NULL;
    int count = 0;
    char *folder = path_join(page->folder, name);
    struct error *error =
        folder ? folder_names(folder, ".csv", &names, &count) : out_of_memory_for("a report");
    if (!error && count)
        fputs(head, page->file);
    for (int i = 0; i < count && !error; i++)
        if (strlen(names[i]) > strlen("-000000.csv") &&
            (i + 1 == count || !same_profile(names[i], names[i + 1])))
            error = plot_table(page, folder, names[i], plot);
    if (!error && count)
        fputs(foot, page->file);
    names_free(names, count);
    free(folder);
    return error;
}

struct error *page_profiles(const struct page *page)
{
    return page_last_tables(
        page, "profiles",
        "<section id=\"profiles\"><h2>Profiles at the end</h2>\n<div class=\"plots\">\n",
        "</div>\n<p class=\"note\">Lines: means over bins. Bands: one standard deviation to either "
        "side.</p></section>\n",
        plot_profile);
}
