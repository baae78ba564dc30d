/* The bar of the colours of a panel. */
#include <stdio.h>

#include "picture/album_internal.h"
#include "picture/sheet.h"

void field_text(const char *field, char *buffer, size_t size)
{
    snprintf(buffer, size, "%s", field);
    for (char *letter = buffer; *letter; ++letter)
        if (*letter == '_' || *letter == '.')
            *letter = ' ';
}

/* A pointed end says that there are values outside of the scale. */
static void bar_end(const struct canvas *canvas, const struct colour_scale *colours, double value,
                    double x, double y, double point)
{
    canvas_colour(canvas, colour_of(colours, value));
    cairo_move_to(canvas->pen, x, y);
    cairo_line_to(canvas->pen, x + point, y + 0.5 * BAR_THICKNESS);
    cairo_line_to(canvas->pen, x, y + BAR_THICKNESS);
    cairo_fill(canvas->pen);
}

static void draw_shades(const struct canvas *canvas, const struct axis *bar, double top,
                        const struct colour_scale *colours)
{
    enum { shade_count = 96 };
    cairo_pattern_t *shades = cairo_pattern_create_linear(bar->start, 0.0, bar->end, 0.0);
    for (int i = 0; i <= shade_count; ++i) {
        const double part = (double)i / shade_count;
        const double value = bar->logarithmic
                                 ? bar->range.low * pow(bar->range.high / bar->range.low, part)
                                 : bar->range.low + part * (bar->range.high - bar->range.low);
        const struct colour colour = colour_of(colours, value);
        cairo_pattern_add_color_stop_rgb(shades, part, colour.red, colour.green, colour.blue);
    }
    cairo_set_source(canvas->pen, shades);
    cairo_rectangle(canvas->pen, bar->start, top, bar->end - bar->start, BAR_THICKNESS);
    cairo_fill(canvas->pen);
    cairo_pattern_destroy(shades);
}

/* A field that is the same everywhere at all times has one colour and no scale. */
static void draw_uniform(const struct canvas *canvas, const struct panel *panel, double middle,
                         double top)
{
    char name[LABEL_TEXT], value[UNIT_TEXT], text[LABEL_TEXT + UNIT_TEXT + 16];
    field_text(panel->field, name, sizeof name);
    multiple_text(panel->values.low, panel->unit, value, sizeof value);
    snprintf(text, sizeof text, "%s: uniform, %s", name, value);
    canvas_text(canvas, TEXT_LABEL, (struct text_place){middle, top + 14.0, 0.5, 2.0 * middle},
                text);
}

void colour_bar_draw(const struct canvas *canvas, const struct panel *panel, double middle,
                     double width, double top)
{
    const struct colour_scale *colours = &panel->scale;
    char name[LABEL_TEXT];
    field_text(panel->field, name, sizeof name);
    if (panel->schlieren) {
        char text[LABEL_TEXT + 32];
        snprintf(text, sizeof text, "schlieren of %s", name);
        canvas_text(canvas, TEXT_LABEL, (struct text_place){middle, top + 14.0, 0.5, width}, text);
        return;
    }
    if (panel->uniform) {
        draw_uniform(canvas, panel, middle, top);
        return;
    }
    const double half = 0.5 * minimum(maximum(0.7 * width, 260.0), 480.0);
    struct axis bar = {.range = colours->range,
                       .logarithmic = colours->logarithmic,
                       .start = middle - half,
                       .end = middle + half};
    axis_name(&bar, name, panel->unit, range_reach(bar.range));
    axis_ticks(&bar, canvas);
    draw_shades(canvas, &bar, top, colours);
    if (panel->extremes.low < bar.range.low)
        bar_end(canvas, colours, bar.range.low, bar.start - 1.0, top, -8.0);
    if (panel->extremes.high > bar.range.high)
        bar_end(canvas, colours, bar.range.high, bar.end + 1.0, top, 8.0);
    axis_draw_below(canvas, &bar, top + BAR_THICKNESS);
}
