/* Line plots: several series over one pair of axes, lines (exact solutions) and dots
 * (particles). */
#include <stdlib.h>

#include "base/memory.h"
#include "picture/internal.h"
#include "picture/picture.h"

enum { PLOT_WIDTH = 800, PLOT_HEIGHT = 520, LEFT = 76, RIGHT = 22, BOTTOM = 46 };

static bool drawable(double value, bool logarithmic)
{
    return isfinite(value) && (!logarithmic || value > 0.0);
}

/* The ranges of the points that can be drawn. */
static void find_ranges(const struct plot *plot, struct range *x, struct range *y)
{
    *x = *y = range_empty();
    for (int s = 0; s < plot->count; ++s) {
        const struct series *series = &plot->series[s];
        for (int64_t i = 0; i < series->count; ++i) {
            if (!drawable(series->x[i], plot->log_x) || !drawable(series->y[i], plot->log_y))
                continue;
            range_include(x, series->x[i]);
            range_include(y, series->y[i]);
        }
    }
}

static bool is_line(const struct series *series)
{
    return series->line != LINE_NONE && series->line != LINE_BARS;
}

/* Whether the plot compares lines (exact solutions) with dots (particles). */
static bool compares(const struct plot *plot)
{
    bool lines = false, dots = false;
    for (int s = 0; s < plot->count; ++s) {
        lines |= is_line(&plot->series[s]);
        dots |= !is_line(&plot->series[s]);
    }
    return lines && dots;
}

/* An exact solution among particles is grey, so that the particles have the colours. */
static struct colour series_colour(const struct plot *plot, int index)
{
    static const struct colour grey = {0.60, 0.60, 0.60};
    if (plot->series[index].line == LINE_FAINT)
        return grey;
    int first_line = 0;
    while (first_line < plot->count && !is_line(&plot->series[first_line]))
        ++first_line;
    if (!compares(plot))
        return colour_of_category(index);
    return index == first_line ? grey : colour_of_category(index - (index > first_line));
}

/* A line as it is drawn: the points that fall one after the other on one column of pixels become
 * their first, lowest, highest and last, since Cairo would take minutes over a million segments. */
struct stroke {
    cairo_t *pen;
    bool down;    /* a column is begun */
    bool started; /* the path has a point */
    int points;   /* in the path */
    double column, x, first, low, high, last;
};

static void stroke_to(struct stroke *stroke, double y)
{
    enum { path_max = 500 }; /* crossing segments cost more than in proportion */
    if (stroke->started)
        cairo_line_to(stroke->pen, stroke->x, y);
    else
        cairo_move_to(stroke->pen, stroke->x, y);
    stroke->started = true;
    if (++stroke->points >= path_max) {
        cairo_stroke(stroke->pen);
        cairo_move_to(stroke->pen, stroke->x, y);
        stroke->points = 0;
    }
}

/* Ends the column. */
static void stroke_flush(struct stroke *stroke)
{
    if (!stroke->down)
        return;
    stroke_to(stroke, stroke->first);
    if (stroke->low < minimum(stroke->first, stroke->last))
        stroke_to(stroke, stroke->low);
    if (stroke->high > maximum(stroke->first, stroke->last))
        stroke_to(stroke, stroke->high);
    if (stroke->last != stroke->first)
        stroke_to(stroke, stroke->last);
    stroke->down = false;
}

static void stroke_add(struct stroke *stroke, double x, double y)
{
    double column = floor(x * PIXELS_PER_POINT);
    if (stroke->down && stroke->column == column) {
        stroke->low = minimum(stroke->low, y);
        stroke->high = maximum(stroke->high, y);
        stroke->last = y;
        return;
    }
    stroke_flush(stroke);
    stroke->down = true;
    stroke->column = column;
    stroke->x = x;
    stroke->first = stroke->low = stroke->high = stroke->last = y;
}

static void draw_line(const struct canvas *canvas, const struct axis *x, const struct axis *y,
                      const struct series *series, double width)
{
    struct stroke stroke = {.pen = canvas->pen};
    cairo_new_path(canvas->pen);
    cairo_set_line_width(canvas->pen, width);
    cairo_set_line_join(canvas->pen, CAIRO_LINE_JOIN_ROUND);
    for (int64_t i = 0; i < series->count; ++i) {
        if (!drawable(series->x[i], x->logarithmic) || !drawable(series->y[i], y->logarithmic)) {
            stroke_flush(&stroke);
            stroke.started = false;
            continue;
        }
        /* Cairo's coordinates end at 2^23 pixels; what leaves a fixed y axis ends far outside of
         * it. */
        double at_y = minimum(maximum(axis_place(y, series->y[i]), -1e5), 1e5);
        stroke_add(&stroke, axis_place(x, series->x[i]), at_y);
    }
    stroke_flush(&stroke);
    cairo_stroke(canvas->pen);
}

/* Draws each dot that would not lie on another one of the series: TAKEN has a bit for every
 * pixel. */
static void draw_dots(const struct canvas *canvas, const struct axis *x, const struct axis *y,
                      const struct series *series, uint8_t *taken)
{
    int columns = (int)canvas->width * PIXELS_PER_POINT,
        rows = (int)canvas->height * PIXELS_PER_POINT;
    double radius = series->count <= 60 ? 2.6 : series->count <= 200 ? 1.8 : 1.3;
    for (int64_t i = 0; i < series->count; ++i) {
        if (!drawable(series->x[i], x->logarithmic) || !drawable(series->y[i], y->logarithmic))
            continue;
        double at_x = axis_place(x, series->x[i]), at_y = axis_place(y, series->y[i]);
        double column = floor(at_x * PIXELS_PER_POINT), row = floor(at_y * PIXELS_PER_POINT);
        if (!(column >= 0.0 && column < columns && row >= 0.0 && row < rows))
            continue;
        const int64_t pixel = (int64_t)row * columns + (int64_t)column;
        const uint8_t bit = (uint8_t)(1 << pixel % 8);
        if (taken[pixel / 8] & bit)
            continue;
        taken[pixel / 8] |= bit;
        cairo_new_path(canvas->pen);
        cairo_arc(canvas->pen, at_x, at_y, radius, 0.0, 4.0 * acos(0.0));
        cairo_fill(canvas->pen);
    }
}

static void draw_bars(const struct canvas *canvas, const struct axis *x, const struct axis *y,
                      const struct series *series)
{
    const double cap = 5.0, radius = 3.2;
    cairo_set_line_width(canvas->pen, 1.6);
    for (int64_t i = 0; i + 2 < series->count; i += 3) {
        if (!drawable(series->x[i], x->logarithmic) || !drawable(series->y[i + 1], y->logarithmic))
            continue;
        const double at_x = axis_place(x, series->x[i]), middle = axis_place(y, series->y[i + 1]);
        cairo_new_path(canvas->pen);
        for (int end = 0; end <= 2; end += 2) {
            if (!drawable(series->y[i + end], y->logarithmic))
                continue;
            const double at_y = axis_place(y, series->y[i + end]);
            cairo_move_to(canvas->pen, at_x, middle);
            cairo_line_to(canvas->pen, at_x, at_y);
            cairo_move_to(canvas->pen, at_x - cap, at_y);
            cairo_line_to(canvas->pen, at_x + cap, at_y);
        }
        cairo_stroke(canvas->pen);
        cairo_arc(canvas->pen, at_x, middle, radius, 0.0, 4.0 * acos(0.0));
        cairo_fill(canvas->pen);
    }
}

static struct error *draw_series(const struct canvas *canvas, const struct plot *plot,
                                 const struct axis *x, const struct axis *y)
{
    size_t pixels = (size_t)PLOT_WIDTH * PLOT_HEIGHT * PIXELS_PER_POINT * PIXELS_PER_POINT;
    cairo_save(canvas->pen);
    cairo_rectangle(canvas->pen, x->start, y->end, x->end - x->start, y->start - y->end);
    cairo_clip(canvas->pen);
    struct error *error = NULL;
    for (int s = 0; s < plot->count && !error; ++s) {
        const struct series *series = &plot->series[s];
        canvas_colour(canvas, series_colour(plot, s));
        if (series->line == LINE_BARS) {
            draw_bars(canvas, x, y, series);
            continue;
        }
        /* Broad behind dots, so that it is seen where they lie on it. */
        if (series->line)
            draw_line(canvas, x, y, series,
                      compares(plot)               ? 3.4
                      : series->line == LINE_FAINT ? 0.8
                                                   : 1.6);
        if (series->line != LINE_NONE && series->line != LINE_MARKED)
            continue;
        uint8_t *taken = memory_allocate(pixels / 8 + 1);
        if (taken)
            draw_dots(canvas, x, y, series, taken);
        else
            error = out_of_memory_for("a picture");
        free(taken);
    }
    cairo_restore(canvas->pen);
    return error;
}

/* Returns the height of the legend. */
static double draw_legend(const struct canvas *canvas, const struct plot *plot, double top)
{
    enum { entries_max = 24 };
    struct legend_entry entries[entries_max];
    int count = 0;
    for (int s = 0; s < plot->count && count < entries_max; ++s) {
        const struct series *series = &plot->series[s];
        if (!series->label)
            continue;
        entries[count++] = (struct legend_entry){is_line(series) ? MARK_LINE : MARK_DOT,
                                                 series_colour(plot, s), series->label};
    }
    return legend_draw(canvas,
                       &(struct legend){entries, count, LEFT, top, PLOT_WIDTH - LEFT - RIGHT});
}

static struct error *draw_plot(const struct canvas *canvas, const struct plot *plot)
{
    struct axis x = {.logarithmic = plot->log_x}, y = {.logarithmic = plot->log_y};
    find_ranges(plot, &x.range, &y.range);
    x.range = range_padded(range_drawable(x.range, plot->log_x), 0.02, plot->log_x);
    y.range = range_padded(range_drawable(y.range, plot->log_y), 0.05, plot->log_y);
    if (plot->y_high > plot->y_low && (!plot->log_y || plot->y_low > 0.0))
        y.range = (struct range){plot->y_low, plot->y_high};
    if (plot->x_high > plot->x_low && !plot->log_x)
        x.range = (struct range){plot->x_low, plot->x_high};
    axis_name(&x, plot->x_name, plot->x_unit, range_reach(x.range));
    axis_name(&y, plot->y_name, plot->y_unit, range_reach(y.range));

    double head = canvas_header(canvas, LEFT, plot->title, plot->note);
    head += draw_legend(canvas, plot, head) + 6.0;
    x.start = LEFT;
    x.end = PLOT_WIDTH - RIGHT;
    y.start = PLOT_HEIGHT - BOTTOM;
    y.end = minimum(head, y.start - 100.0);
    axis_ticks(&x, canvas);
    axis_ticks(&y, canvas);
    axes_grid(canvas, &x, &y);
    TRY(draw_series(canvas, plot, &x, &y));
    axes_frame(canvas, &x, &y);
    return NULL;
}

struct error *picture_plot(const char *path, const struct plot *plot)
{
    struct canvas canvas;
    struct error *error = canvas_create(PLOT_WIDTH, PLOT_HEIGHT, PIXELS_PER_POINT, &canvas);
    if (!error)
        error = draw_plot(&canvas, plot);
    if (!error)
        error = canvas_publish(&canvas, path, plot->own_folder, !plot->frame);
    canvas_destroy(&canvas);
    return error;
}
