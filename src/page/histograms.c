/* The histograms of report.html: the last table of each, the fraction in each bin over its
 * middle. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "page/internal.h"

/* "speed.low [m/s]" in two. */
static void split_low(const char *head, char name[64], char unit[UNIT_TEXT])
{
    const char *low = strstr(head, ".low"), *bracket = strchr(head, '[');
    snprintf(name, 64, "%.*s", low ? (int)(low - head) : 0, head);
    snprintf(unit, UNIT_TEXT, "%.*s", bracket ? (int)strcspn(bracket + 1, "]") : 0,
             bracket ? bracket + 1 : "");
}

static struct error *plot_histogram(const struct page *page, const struct csv *csv,
                                    const char *title)
{
    char name[64], unit[UNIT_TEXT];
    const int64_t count = csv->rows;
    const int fraction = csv_column(csv, "fraction");
    split_low(csv_head(csv, 0), name, unit);
    char *whole = text_format("%s: fraction of the %.20s", title, csv_head(csv, 2));
    double *numbers = memory_allocate((2 * (size_t)count + 1) * sizeof *numbers);
    struct error *error = whole && numbers ? NULL : out_of_memory_for("a report");
    if (!error && fraction >= 0) {
        struct page_plot plot = {.title = whole,
                                 .x_name = name,
                                 .x_unit = unit,
                                 .unit = "",
                                 .count = count,
                                 .x = numbers,
                                 .series_count = 1};
        for (int64_t i = 0; i < count; i++) {
            numbers[i] = 0.5 * (csv_number(csv, i, 0) + csv_number(csv, i, 1));
            numbers[count + i] = csv_number(csv, i, fraction);
        }
        plot.series[0] = (struct page_series){.label = "fraction", .value = numbers + count};
        page_plot(page->file, &plot);
    }
    free(whole);
    free(numbers);
    return error;
}

struct error *page_histograms(const struct page *page)
{
    return page_last_tables(page, "histograms",
                            "<section id=\"histograms\"><h2>Histograms at the end</h2>\n"
                            "<div class=\"plots\">\n",
                            "</div></section>\n", plot_histogram);
}
