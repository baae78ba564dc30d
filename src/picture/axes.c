/* Canvas, text, axes and legends: what all pictures share, drawn by Cairo. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/file.h"
#include "base/memory.h"
#include "picture/internal.h"

static const struct colour frame_colour = {0.35, 0.35, 0.35};
static const struct colour grid_colour = {0.89, 0.89, 0.89};

static const struct {
    double size, grey;
    cairo_font_weight_t weight;
} styles[] = {
    [TEXT_TITLE] = {15.0, 0.10, CAIRO_FONT_WEIGHT_BOLD},
    [TEXT_NOTE] = {12.0, 0.35, CAIRO_FONT_WEIGHT_NORMAL},
    [TEXT_LABEL] = {12.0, 0.13, CAIRO_FONT_WEIGHT_NORMAL},
    [TEXT_TICK] = {11.0, 0.20, CAIRO_FONT_WEIGHT_NORMAL},
};

struct error *canvas_create(double width, double height, double density, struct canvas *canvas)
{
    canvas->width = width;
    canvas->height = height;
    canvas->density = density;
    canvas->surface = cairo_image_surface_create(
        CAIRO_FORMAT_RGB24, (int)ceil(width * density - 1e-6), (int)ceil(height * density - 1e-6));
    canvas->pen = cairo_create(canvas->surface);
    if (cairo_status(canvas->pen) != CAIRO_STATUS_SUCCESS)
        return error_new(ERROR_SYSTEM, "picture: %s",
                         cairo_status_to_string(cairo_status(canvas->pen)));
    cairo_set_source_rgb(canvas->pen, 1.0, 1.0, 1.0);
    cairo_paint(canvas->pen);
    cairo_scale(canvas->pen, density, density);
    return NULL;
}

void canvas_destroy(struct canvas *canvas)
{
    cairo_destroy(canvas->pen);
    cairo_surface_destroy(canvas->surface);
    canvas->pen = NULL;
    canvas->surface = NULL;
}

struct png_image canvas_image(cairo_surface_t *surface)
{
    cairo_surface_flush(surface);
    return (struct png_image){cairo_image_surface_get_width(surface),
                              cairo_image_surface_get_height(surface),
                              (size_t)cairo_image_surface_get_stride(surface),
                              cairo_image_surface_get_data(surface), false};
}

struct error *canvas_publish(const struct canvas *canvas, const char *path, bool own_folder,
                             bool flat)
{
    char *beside;
    if (own_folder)
        TRY(file_check_folder(path));
    TRY(file_clear_beside(path, &beside));
    const cairo_status_t status = cairo_status(canvas->pen);
    struct png_image image = canvas_image(canvas->surface);
    image.flat = flat;
    const bool drawn = status == CAIRO_STATUS_SUCCESS;
    struct error *error = NULL;
    if (drawn && png_write(beside, &image)) {
        error = file_publish(path);
    } else {
        error = error_new(ERROR_SYSTEM, "%s: cannot write the picture: %s", path,
                          drawn ? strerror(errno) : cairo_status_to_string(status));
        remove(beside);
    }
    free(beside);
    return error;
}

void canvas_colour(const struct canvas *canvas, struct colour colour)
{
    cairo_set_source_rgb(canvas->pen, colour.red, colour.green, colour.blue);
}

/* Bytes of the UTF-8 character that TEXT starts with, 0 when it is none. */
static size_t character_length(const char *text)
{
    unsigned char first = (unsigned char)*text;
    size_t length = first < 0x80                     ? 1
                    : first >= 0xc2 && first < 0xe0  ? 2
                    : first >= 0xe0 && first < 0xf0  ? 3
                    : first >= 0xf0 && first <= 0xf4 ? 4
                                                     : 0;
    for (size_t i = 1; i < length; ++i)
        if (((unsigned char)text[i] & 0xc0) != 0x80)
            return 0;
    bool overlong = (first == 0xe0 && (unsigned char)text[1] < 0xa0) ||
                    (first == 0xf0 && (unsigned char)text[1] < 0x90);
    bool outside = (first == 0xed && (unsigned char)text[1] >= 0xa0) ||
                   (first == 0xf4 && (unsigned char)text[1] >= 0x90);
    return overlong || outside ? 0 : length;
}

/* Copies TEXT, with '?' for what is not UTF-8 and blanks for control characters: Cairo would refuse
 * the whole picture for one bad byte. */
static void clean_copy(char *buffer, size_t size, const char *text)
{
    size_t used = 0;
    while (*text && used + 5 < size) {
        size_t length = character_length(text);
        if (length <= 1) {
            char letter = *text++;
            buffer[used++] = !length ? '?' : letter < ' ' || letter == 127 ? ' ' : letter;
        } else {
            memcpy(buffer + used, text, length);
            used += length;
            text += length;
        }
    }
    buffer[used] = 0;
}

static void choose_font(const struct canvas *canvas, enum text_style style, double factor)
{
    cairo_select_font_face(canvas->pen, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           styles[style].weight);
    cairo_set_font_size(canvas->pen, styles[style].size * factor);
}

static double advance(const struct canvas *canvas, const char *clean)
{
    cairo_text_extents_t extents;
    cairo_text_extents(canvas->pen, clean, &extents);
    return extents.x_advance;
}

double canvas_text_width(const struct canvas *canvas, enum text_style style, const char *text)
{
    char clean[512];
    clean_copy(clean, sizeof clean, text);
    choose_font(canvas, style, 1.0);
    return advance(canvas, clean);
}

/* Takes characters from the end of CLEAN until it fits with an ellipsis. */
static void cut_to(const struct canvas *canvas, char *clean, double room)
{
    static const char ellipsis[] = "…";
    size_t length = strlen(clean);
    while (length > 0) {
        do
            --length;
        while (length > 0 && ((unsigned char)clean[length] & 0xc0) == 0x80);
        memcpy(clean + length, ellipsis, sizeof ellipsis);
        if (advance(canvas, clean) <= room)
            return;
    }
}

void canvas_text(const struct canvas *canvas, enum text_style style, struct text_place place,
                 const char *text)
{
    enum { smallest_percent = 75 };
    char clean[512 + 8];
    clean_copy(clean, sizeof clean - 8, text);
    choose_font(canvas, style, 1.0);
    double width = advance(canvas, clean);
    if (width > place.room) {
        choose_font(canvas, style, maximum(place.room / width, smallest_percent / 100.0));
        width = advance(canvas, clean);
        if (width > 1.01 * place.room) {
            cut_to(canvas, clean, place.room);
            width = advance(canvas, clean);
        }
    }
    double grey = styles[style].grey;
    cairo_set_source_rgb(canvas->pen, grey, grey, grey);
    cairo_move_to(canvas->pen, place.x - place.along * width, place.y);
    cairo_show_text(canvas->pen, clean);
}

double canvas_header(const struct canvas *canvas, double left, const char *title, const char *note)
{
    double room = canvas->width - left - 12.0;
    if (title)
        canvas_text(canvas, TEXT_TITLE, (struct text_place){left, 25.0, 0.0, room}, title);
    if (note)
        canvas_text(canvas, TEXT_NOTE, (struct text_place){left, 44.0, 0.0, room}, note);
    return note ? 52.0 : 36.0;
}

void axis_name(struct axis *axis, const char *name, const char *unit, double magnitude)
{
    struct multiple multiple = multiple_find(axis->logarithmic ? 1.0 : magnitude, unit);
    axis->scale = multiple.scale;
    snprintf(axis->label, LABEL_TEXT, *multiple.name ? "%s (%s)" : "%s", name ? name : "",
             multiple.name);
}

double axis_place(const struct axis *axis, double value)
{
    double low = axis->range.low, high = axis->range.high;
    double part =
        axis->logarithmic ? log(value / low) / log(high / low) : (value - low) / (high - low);
    return axis->start + part * (axis->end - axis->start);
}

/* Whether the tick texts keep a distance: side by side on a horizontal axis, one above the other
 * else. */
static bool ticks_fit(const struct axis *axis, const struct canvas *canvas, bool horizontal)
{
    double last = -INFINITY;
    for (int i = 0; i < axis->ticks.count; ++i) {
        double place = fabs(axis_place(axis, axis->ticks.at[i]) - axis->start);
        double half = 0.6 * styles[TEXT_TICK].size;
        if (horizontal)
            half = 0.5 * canvas_text_width(canvas, TEXT_TICK, axis->ticks.text[i]) + 6.0;
        if (place - half < last)
            return false;
        last = place + half;
    }
    return true;
}

void axis_ticks(struct axis *axis, const struct canvas *canvas)
{
    /* y runs downwards, so that a vertical axis starts at its larger coordinate. */
    bool horizontal = axis->end > axis->start;
    double length = fabs(axis->end - axis->start);
    int most = (int)minimum(maximum(length / (horizontal ? 60.0 : 14.0), 2.0), 12.0);
    for (; most >= 1; --most) {
        axis->ticks = axis->logarithmic ? ticks_logarithmic(axis->range, most)
                                        : ticks_linear(axis->range, axis->scale, most);
        if (ticks_fit(axis, canvas, horizontal))
            return;
    }
}

static void line(const struct canvas *canvas, double x0, double y0, double x1, double y1)
{
    cairo_move_to(canvas->pen, x0, y0);
    cairo_line_to(canvas->pen, x1, y1);
}

void axes_grid(const struct canvas *canvas, const struct axis *x, const struct axis *y)
{
    for (int i = 0; i < x->ticks.count; ++i) {
        double place = axis_place(x, x->ticks.at[i]);
        line(canvas, place, y->start, place, y->end);
    }
    for (int i = 0; i < y->ticks.count; ++i) {
        double place = axis_place(y, y->ticks.at[i]);
        line(canvas, x->start, place, x->end, place);
    }
    canvas_colour(canvas, grid_colour);
    cairo_set_line_width(canvas->pen, 0.75);
    cairo_stroke(canvas->pen);
}

/* Short marks at 2 .. 9 times the powers of ten. */
static void minor_marks(const struct canvas *canvas, const struct axis *axis, double x, double y)
{
    bool horizontal = axis->end > axis->start;
    if (!axis->logarithmic || axis->range.high > 1e10 * axis->range.low)
        return;
    int first = (int)floor(log10(axis->range.low)), last = (int)ceil(log10(axis->range.high));
    for (int exponent = first; exponent <= last; ++exponent) {
        for (int factor = 2; factor < 10; ++factor) {
            double at = factor * pow(10.0, exponent), place = axis_place(axis, at);
            if (at < axis->range.low || at > axis->range.high)
                continue;
            if (horizontal)
                line(canvas, place, y, place, y + 2.5);
            else
                line(canvas, x, place, x - 2.5, place);
        }
    }
}

static void stroke_frame(const struct canvas *canvas)
{
    canvas_colour(canvas, frame_colour);
    cairo_set_line_width(canvas->pen, 1.0);
    cairo_stroke(canvas->pen);
}

void axis_draw_below(const struct canvas *canvas, const struct axis *axis, double y)
{
    for (int i = 0; i < axis->ticks.count; ++i) {
        double place = axis_place(axis, axis->ticks.at[i]);
        line(canvas, place, y, place, y + 4.0);
    }
    minor_marks(canvas, axis, 0.0, y);
    stroke_frame(canvas);
    for (int i = 0; i < axis->ticks.count; ++i)
        canvas_text(
            canvas, TEXT_TICK,
            (struct text_place){axis_place(axis, axis->ticks.at[i]), y + 16.0, 0.5, canvas->width},
            axis->ticks.text[i]);
    canvas_text(
        canvas, TEXT_LABEL,
        (struct text_place){0.5 * (axis->start + axis->end), y + 33.0, 0.5, canvas->width - 16.0},
        axis->label);
}

static void axis_draw_left(const struct canvas *canvas, const struct axis *axis, double x)
{
    double widest = 0.0, room = x - 30.0;
    for (int i = 0; i < axis->ticks.count; ++i) {
        double place = axis_place(axis, axis->ticks.at[i]);
        line(canvas, x, place, x - 4.0, place);
    }
    minor_marks(canvas, axis, x, 0.0);
    stroke_frame(canvas);
    for (int i = 0; i < axis->ticks.count; ++i) {
        double width = canvas_text_width(canvas, TEXT_TICK, axis->ticks.text[i]);
        widest = maximum(widest, minimum(width, room));
        /* A long number may become small, but never loses digits. */
        canvas_text(canvas, TEXT_TICK,
                    (struct text_place){x - 7.0, axis_place(axis, axis->ticks.at[i]) + 4.0, 1.0,
                                        maximum(room, 0.76 * width)},
                    axis->ticks.text[i]);
    }
    double middle = 0.5 * (axis->start + axis->end);
    cairo_save(canvas->pen);
    cairo_translate(canvas->pen, x - 7.0 - widest - 9.0, middle);
    cairo_rotate(canvas->pen, -acos(0.0));
    double room_along = 2.0 * minimum(middle, canvas->height - middle) - 8.0;
    canvas_text(canvas, TEXT_LABEL, (struct text_place){0.0, 0.0, 0.5, room_along}, axis->label);
    cairo_restore(canvas->pen);
}

void axes_frame(const struct canvas *canvas, const struct axis *x, const struct axis *y)
{
    cairo_rectangle(canvas->pen, x->start, y->end, x->end - x->start, y->start - y->end);
    stroke_frame(canvas);
    axis_draw_below(canvas, x, y->start);
    axis_draw_left(canvas, y, x->start);
}

static void draw_mark(const struct canvas *canvas, const struct legend_entry *entry, double x,
                      double y)
{
    enum { mark_width = 18 };
    canvas_colour(canvas, entry->colour);
    cairo_new_path(canvas->pen);
    if (entry->mark == MARK_LINE) {
        cairo_set_line_width(canvas->pen, 2.0);
        line(canvas, x, y, x + mark_width, y);
        cairo_stroke(canvas->pen);
    } else if (entry->mark == MARK_DOT) {
        cairo_arc(canvas->pen, x + 0.5 * mark_width, y, 3.0, 0.0, 4.0 * acos(0.0));
        cairo_fill(canvas->pen);
    } else if (entry->mark == MARK_SQUARE) {
        cairo_rectangle(canvas->pen, x + 4.0, y - 5.5, 11.0, 11.0);
        cairo_fill(canvas->pen);
    }
}

static double legend_walk(const struct canvas *canvas, const struct legend *legend, bool draw)
{
    int rows = legend->entries > 0;
    double x = 0.0;
    for (int i = 0; i < legend->entries; ++i) {
        const struct legend_entry *entry = &legend->entry[i];
        double mark = entry->mark == MARK_NONE ? 0.0 : 24.0;
        double text = canvas_text_width(canvas, TEXT_TICK, entry->text);
        text = minimum(text, legend->width - mark);
        if (x > 0.0 && x + mark + text > legend->width) {
            ++rows;
            x = 0.0;
        }
        double middle = legend->top + (rows - 0.5) * LEGEND_ROW, left = legend->left + x;
        if (draw) {
            draw_mark(canvas, entry, left, middle);
            canvas_text(canvas, TEXT_TICK,
                        (struct text_place){left + mark, middle + 4.0, 0.0, text + 1.0},
                        entry->text);
        }
        x += mark + text + 20.0;
    }
    return rows * LEGEND_ROW;
}

double legend_height(const struct canvas *canvas, const struct legend *legend)
{
    return legend_walk(canvas, legend, false);
}

double legend_draw(const struct canvas *canvas, const struct legend *legend)
{
    return legend_walk(canvas, legend, true);
}
