/* Line plots of report.html: their data as JSON, which plots.js draws with dygraphs, and their
 * words for who cannot see them. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "page/internal.h"

/* Parts of time and variation together: of the points in each the first, lowest, highest and last
 * are kept. A short pulse takes many of them, a long rest few. */
enum { PARTS = 1200, COLOURS = 6 };

static struct range range_of(const double *values, int64_t count)
{
    struct range range = range_empty();
    for (int64_t i = 0; i < count; i++)
        range_include(&range, values[i]);
    return range;
}

static double reach_of(const double *values, int64_t count)
{
    struct range range = range_of(values, count);
    return range.low <= range.high ? range_reach(range) : 0.0;
}

/* Which series are worth a line; returns how many. */
static int choose_series(const struct page_plot *plot, bool *shown)
{
    double reach[PLOT_SERIES], largest = 0.0;
    int count = 0;
    for (int s = 0; s < plot->series_count; s++) {
        reach[s] = reach_of(plot->series[s].value, plot->count);
        largest = maximum(largest, reach[s]);
    }
    for (int s = 0; s < plot->series_count; s++) {
        shown[s] = !plot->series[s].optional || reach[s] > 1e-9 * largest;
        count += shown[s];
    }
    return count;
}

static void put_number(FILE *file, double value, int digits)
{
    if (isfinite(value))
        fprintf(file, "%.*g", digits, value);
    else
        fputs("null", file);
}

/* How far point I lies from the one before, as a part of all time, and of each series' range. */
static double step_at(const struct page_plot *plot, const bool *shown, const struct range *range,
                      double length, int64_t i)
{
    double step = length > 0.0 ? fabs(plot->x[i] - plot->x[i - 1]) / length : 0.0;
    for (int s = 0; s < plot->series_count; s++) {
        const double *value = plot->series[s].value;
        const double span = range[s].high - range[s].low;
        if (shown[s] && span > 0.0 && isfinite(value[i]) && isfinite(value[i - 1]))
            step += fabs(value[i] - value[i - 1]) / span;
    }
    return isfinite(step) ? step : 0.0;
}

/* Marks in KEPT, by the points, which are shown; NULL stands for all. */
static bool *thin(const struct page_plot *plot, const bool *shown)
{
    struct range range[PLOT_SERIES];
    const struct range time = range_of(plot->x, plot->count);
    const double length = time.high - time.low;
    double total = 0.0, sum = 0.0;
    bool *kept = plot->count > 4 * PARTS ? memory_allocate((size_t)plot->count) : NULL;
    if (!kept)
        return NULL;
    for (int s = 0; s < plot->series_count; s++)
        range[s] = range_of(plot->series[s].value, plot->count);
    for (int64_t i = 1; i < plot->count; i++)
        total += step_at(plot, shown, range, length, i);
    for (int64_t first = 0, i = 1; i <= plot->count; i++) {
        const double before = floor(sum / total * PARTS);
        if (i < plot->count) {
            sum += step_at(plot, shown, range, length, i);
            if (floor(sum / total * PARTS) == before)
                continue;
        }
        kept[first] = kept[i - 1] = true;
        for (int s = 0; s < plot->series_count; s++) {
            const double *value = plot->series[s].value;
            int64_t low = first, high = first;
            for (int64_t k = first; k < i && shown[s]; k++) {
                low = value[k] < value[low] ? k : low;
                high = value[k] > value[high] ? k : high;
            }
            kept[low] = kept[high] = true;
        }
        first = i;
    }
    return kept;
}

static void put_column(FILE *file, const double *value, double scale, int64_t count,
                       const bool *kept, int digits)
{
    fputc('[', file);
    for (int64_t i = 0, put = 0; i < count; i++) {
        if (kept && !kept[i])
            continue;
        if (put++)
            fputc(',', file);
        put_number(file, value[i] / scale, digits);
    }
    fputc(']', file);
}

/* The multiples of the units that suit what is shown. */
static void find_units(const struct page_plot *plot, const bool *shown, struct multiple *x,
                       struct multiple *y)
{
    double reach = 0.0;
    for (int s = 0; s < plot->series_count; s++)
        if (shown[s])
            reach = maximum(reach, reach_of(plot->series[s].value, plot->count));
    *x = multiple_find(reach_of(plot->x, plot->count), plot->x_unit);
    *y = multiple_find(reach, plot->unit);
}

static void put_data(FILE *file, const struct page_plot *plot, const bool *shown,
                     const struct multiple *x, const struct multiple *y)
{
    bool *kept = thin(plot, shown);
    int put = 0;
    fprintf(file,
            "<script type=\"application/json\">{\"rows\":%lld,\"x\":", (long long)plot->count);
    page_json_text(file, plot->x_name);
    fputs(",\"xunit\":", file);
    page_json_text(file, x->name);
    fputs(",\"unit\":", file);
    page_json_text(file, y->name);
    fputs(",\"at\":", file);
    put_column(file, plot->x, x->scale, plot->count, kept, 10);
    fputs(",\"series\":[", file);
    for (int s = 0; s < plot->series_count; s++) {
        const struct page_series *series = &plot->series[s];
        if (!shown[s])
            continue;
        fprintf(file, "%s{\"name\":", put++ ? "," : "");
        page_json_text(file, series->label);
        fprintf(file, ",\"colour\":%d,\"dashed\":%d,\"dots\":%d,\"value\":", s, series->dashed,
                series->dots);
        put_column(file, series->value, y->scale, plot->count, kept, 6);
        if (series->low) {
            fputs(",\"low\":", file);
            put_column(file, series->low, y->scale, plot->count, kept, 6);
            fputs(",\"high\":", file);
            put_column(file, series->high, y->scale, plot->count, kept, 6);
        }
        fputc('}', file);
    }
    fputs("]}</script>", file);
    free(kept);
}

static void draw_caption(FILE *file, const struct page_plot *plot, const bool *shown, int count,
                         const char *unit)
{
    fputs("<figcaption>", file);
    page_text(file, plot->title);
    if (*unit) {
        fputs(" <span class=\"unit\">(", file);
        page_text(file, unit);
        fputs(")</span>", file);
    }
    if (count > 1) {
        fputs("<span class=\"legend\">", file);
        for (int s = 0; s < plot->series_count; s++)
            if (shown[s]) {
                const struct page_series *series = &plot->series[s];
                fprintf(file, "<span class=\"k%d%s%s\">", s % COLOURS,
                        series->dashed ? " dashed" : "", series->dots ? " dots" : "");
                page_text(file, plot->series[s].label);
                fputs("</span> ", file);
            }
        fputs("</span>", file);
    }
    fputs("</figcaption>\n", file);
}

/* The first finite one of COUNT values, from their end on with STEP -1; NAN when there is none. */
static double first_number(const double *value, int64_t count, int step)
{
    for (int64_t i = 0; i < count; i++) {
        double here = value[step > 0 ? i : count - 1 - i];
        if (isfinite(here))
            return here;
    }
    return NAN;
}

/* The plot in words, for who cannot see it: where each line begins and ends. */
static void draw_words(FILE *file, const struct page_plot *plot, const bool *shown)
{
    page_text(file, plot->title);
    fputs(" over ", file);
    page_text(file, plot->x_name);
    for (int s = 0; s < plot->series_count; s++) {
        if (!shown[s])
            continue;
        fputs("; ", file);
        page_text(file, plot->series[s].label);
        fputs(" from ", file);
        page_quantity(file, first_number(plot->series[s].value, plot->count, 1), plot->unit);
        fputs(" to ", file);
        page_quantity(file, first_number(plot->series[s].value, plot->count, -1), plot->unit);
    }
}

void page_plot(FILE *file, const struct page_plot *plot)
{
    bool shown[PLOT_SERIES];
    struct multiple x_unit, y_unit;
    if (plot->count < 2)
        return;
    int count = choose_series(plot, shown);
    if (!count)
        return;
    find_units(plot, shown, &x_unit, &y_unit);
    fputs("<figure class=\"plot\">", file);
    draw_caption(file, plot, shown, count, y_unit.name);
    fputs("<div class=\"chart\" role=\"img\" aria-label=\"", file);
    draw_words(file, plot, shown);
    fputs("\"></div>\n", file);
    put_data(file, plot, shown, &x_unit, &y_unit);
    fputs("</figure>\n", file);
}
