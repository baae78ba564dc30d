/* Line plots of report.html as inline SVG. Their colours come from the page's style, so that they
 * suit light, dark and paper; letters keep their size from a telephone to a desk. */
#include <string.h>

#include "page/internal.h"

enum {
    WIDTH = 400,
    HEIGHT = 220,
    RIGHT = 12,
    TOP = 10,
    BOTTOM = 38,
    COLUMNS = 400 /* of points: more than the plot has pixels are not told apart */
};

/* The plot's area and what it shows. */
struct frame {
    double left;
    struct range x, y;
    struct ticks x_ticks, y_ticks;
};

static double place_x(const struct frame *frame, double value)
{
    double part = (value - frame->x.low) / (frame->x.high - frame->x.low);
    return frame->left + part * (WIDTH - RIGHT - frame->left);
}

static double place_y(const struct frame *frame, double value)
{
    double part = (value - frame->y.low) / (frame->y.high - frame->y.low);
    return HEIGHT - BOTTOM - part * (HEIGHT - BOTTOM - TOP);
}

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

/* The points of one column of pixels, drawn as their first, lowest, highest and last. */
struct stroke {
    FILE *file;
    const struct frame *frame;
    bool begun, drawing;
    int column;
    double x, first, low, high, last;
};

static void stroke_point(struct stroke *stroke, double y)
{
    fprintf(stroke->file, "%s%.1f %.1f", stroke->drawing ? "L" : "M", stroke->x,
            place_y(stroke->frame, y));
    stroke->drawing = true;
}

static void stroke_flush(struct stroke *stroke)
{
    if (!stroke->begun)
        return;
    stroke_point(stroke, stroke->first);
    if (stroke->low < minimum(stroke->first, stroke->last))
        stroke_point(stroke, stroke->low);
    if (stroke->high > maximum(stroke->first, stroke->last))
        stroke_point(stroke, stroke->high);
    if (stroke->last != stroke->first)
        stroke_point(stroke, stroke->last);
    stroke->begun = false;
}

/* The part of a band from FIRST on that has no gap; returns what is behind it. */
static int64_t draw_band_part(FILE *file, const struct frame *frame, const struct page_plot *plot,
                              const struct page_series *series, int64_t first)
{
    int64_t end = first;
    for (; end < plot->count && isfinite(series->low[end]) && isfinite(series->high[end]); end++)
        fprintf(file, "%s%.1f %.1f", end == first ? "M" : "L", place_x(frame, plot->x[end]),
                place_y(frame, series->high[end]));
    for (int64_t i = end; i > first; i--)
        fprintf(file, "L%.1f %.1f", place_x(frame, plot->x[i - 1]),
                place_y(frame, series->low[i - 1]));
    if (end > first)
        fputc('Z', file);
    return end > first ? end : first + 1;
}

static void draw_band(FILE *file, const struct frame *frame, const struct page_plot *plot,
                      int index)
{
    const struct page_series *series = &plot->series[index];
    if (!series->low)
        return;
    fprintf(file, "<path class=\"band b%d\" d=\"", index % 6);
    for (int64_t i = 0; i < plot->count;)
        i = draw_band_part(file, frame, plot, series, i);
    fputs("\"/>\n", file);
}

static void draw_series(FILE *file, const struct frame *frame, const struct page_plot *plot,
                        int index)
{
    const struct page_series *series = &plot->series[index];
    struct stroke stroke = {.file = file, .frame = frame};
    fprintf(file, "<path class=\"s%d%s\" d=\"", index % 6, series->dashed ? " dashed" : "");
    for (int64_t i = 0; i < plot->count; i++) {
        double x = plot->x[i], y = series->value[i];
        if (!isfinite(x) || !isfinite(y)) {
            stroke_flush(&stroke);
            stroke.drawing = false;
            continue;
        }
        int column = (int)((x - frame->x.low) / (frame->x.high - frame->x.low) * COLUMNS);
        if (stroke.begun && stroke.column == column) {
            stroke.low = minimum(stroke.low, y);
            stroke.high = maximum(stroke.high, y);
            stroke.last = y;
            continue;
        }
        stroke_flush(&stroke);
        stroke = (struct stroke){file, frame, true, stroke.drawing, column, place_x(frame, x), y,
                                 y,    y,     y};
    }
    stroke_flush(&stroke);
    fputs("\"/>\n", file);
}

/* Letters of a tick, of which "−" takes more bytes than one. */
static int letters(const char *text)
{
    int count = 0;
    for (; *text; text++)
        count += ((unsigned char)*text & 0xC0) != 0x80;
    return count;
}

static void draw_axes(FILE *file, const struct frame *frame, const char *x_label)
{
    double bottom = HEIGHT - BOTTOM, right = WIDTH - RIGHT;
    fputs("<g class=\"axes\">\n", file);
    for (int i = 0; i < frame->y_ticks.count; i++) {
        double y = place_y(frame, frame->y_ticks.at[i]);
        fprintf(file,
                "<path d=\"M%.1f %.1fH%.1f\"/><text class=\"y\" x=\"%.1f\" y=\"%.1f\">%s</text>\n",
                frame->left, y, right, frame->left - 6.0, y + 4.0, frame->y_ticks.text[i]);
    }
    for (int i = 0; i < frame->x_ticks.count; i++) {
        double x = place_x(frame, frame->x_ticks.at[i]);
        fprintf(file,
                "<path d=\"M%.1f %dV%.1f\"/><text class=\"x\" x=\"%.1f\" y=\"%.1f\">%s</text>\n", x,
                TOP, bottom, x, bottom + 15.0, frame->x_ticks.text[i]);
    }
    fprintf(file, "<text class=\"x\" x=\"%.1f\" y=\"%d\">", 0.5 * (frame->left + right),
            HEIGHT - 6);
    page_text(file, x_label);
    fputs("</text></g>\n", file);
}

/* Ranges and ticks; names the multiples of the units. */
static struct frame make_frame(const struct page_plot *plot, const bool *shown,
                               struct multiple *x_unit, struct multiple *y_unit)
{
    struct frame frame = {.x = range_of(plot->x, plot->count), .y = range_empty()};
    for (int s = 0; s < plot->series_count; s++)
        for (int64_t i = 0; shown[s] && i < plot->count; i++) {
            range_include(&frame.y, plot->series[s].value[i]);
            if (plot->series[s].low) {
                range_include(&frame.y, plot->series[s].low[i]);
                range_include(&frame.y, plot->series[s].high[i]);
            }
        }
    frame.x = range_drawable(frame.x, false);
    frame.y = range_padded(range_drawable(frame.y, false), 0.06, false);
    *x_unit = multiple_find(range_reach(frame.x), plot->x_unit);
    *y_unit = multiple_find(range_reach(frame.y), plot->unit);
    frame.x_ticks = ticks_linear(frame.x, x_unit->scale, 6);
    frame.y_ticks = ticks_linear(frame.y, y_unit->scale, 7);
    int longest = 1;
    for (int i = 0; i < frame.y_ticks.count; i++)
        longest = (int)maximum(longest, letters(frame.y_ticks.text[i]));
    frame.left = minimum(14.0 + 6.5 * longest, 0.5 * WIDTH);
    return frame;
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
                fprintf(file, "<span class=\"k%d%s\">", s % 6,
                        plot->series[s].dashed ? " dashed" : "");
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
    struct frame frame = make_frame(plot, shown, &x_unit, &y_unit);
    char x_label[UNIT_TEXT + 96];
    snprintf(x_label, sizeof x_label, *x_unit.name ? "%.90s (%s)" : "%.90s%s", plot->x_name,
             x_unit.name);
    fputs("<figure class=\"plot\">", file);
    draw_caption(file, plot, shown, count, y_unit.name);
    fprintf(file, "<svg viewBox=\"0 0 %d %d\" role=\"img\" aria-label=\"", WIDTH, HEIGHT);
    draw_words(file, plot, shown);
    fputs("\">\n", file);
    draw_axes(file, &frame, x_label);
    for (int s = 0; s < plot->series_count; s++)
        if (shown[s])
            draw_band(file, &frame, plot, s);
    for (int s = 0; s < plot->series_count; s++)
        if (shown[s])
            draw_series(file, &frame, plot, s);
    fprintf(file, "<rect x=\"%.1f\" y=\"%d\" width=\"%.1f\" height=\"%d\"/></svg></figure>\n",
            frame.left, TOP, WIDTH - RIGHT - frame.left, HEIGHT - BOTTOM - TOP);
}
