/* The page of a picture: header with time and what is outside, legend, panels side by side, each
 * with axes and the bar of its colours. All frames of a picture have the same page. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "picture/album_internal.h"
#include "picture/sheet.h"

/* The layout, in points. */
enum {
    PAGE_WIDTH = 800,
    PAGE_WIDTH_MIN = 420,
    PAGE_WIDTH_MAX = 1200, /* of long strips */
    PANEL_WIDTH = 460,     /* of several side by side, with its axes */
    HEIGHT_MIN = 24,       /* of what is drawn */
    HEIGHT_MAX = 640,
    WIDTH_MIN = 50,
    LEFT = 76,
    RIGHT = 22,
    AXIS_HEIGHT = 42,
    BAR_GAP = 10,
    BOX_SIDE = 80, /* beside a perspective, for its axes; below it */
    BOX_MARGIN = 52,
    BOX_TOP = 10,
    SOLID_HEIGHT = 600,
    SIZED_HEIGHT = 600, /* of a page whose pixels are given */
    MARGIN = 24,        /* of title and legend */
    NOTE_ROOM = 300,    /* of time and what is outside */
    LEGEND_MAX = 24,
    FRAGMENTS_NAMED = 5
};

/* Pixels a point: screens have one to two, and drawing takes time by the pixel. */
static const double DENSITY = 1.5;

/* Text of a legend that is made for it. */
struct legend_words {
    int count;
    struct legend_entry entry[LEGEND_MAX];
    char text[LEGEND_MAX][112];
};

/* Where everything is, in points. */
struct sheet {
    double width, height, head, density;                 /* pixels a point */
    double left;                                         /* of the panels on a wider page */
    double text;                                         /* of title and legend */
    double tallest;                                      /* what is drawn can be */
    double panel_width, box_left, box_width, box_height; /* box_left: in the panel */
    struct projection projection;                        /* of a raster of a panel, in pixels */
    struct axis x, y;                                    /* of a section, in the first panel */
};

static double length_of(struct range range) { return range.high - range.low; }

static const char *title_of(const struct album *album)
{
    return album->input->title ? album->input->title : album->input->name;
}

static bool has_bar(const struct picture *picture)
{
    bool any = false;
    for (int k = 0; k < picture->panels; k++)
        any |= !picture->panel[k].category;
    return any;
}

/* Equal axes, as large as the page allows; the height follows what is drawn. */
static void lay_section(const struct picture *picture, struct sheet *sheet)
{
    const struct view *view = &picture->view;
    const struct range *across = &view->window[view->across], *up = &view->window[view->up];
    const double room = sheet->panel_width - LEFT - RIGHT;
    double scale = room / length_of(*across);
    if (scale * length_of(*up) < HEIGHT_MIN)
        scale = minimum(HEIGHT_MIN / length_of(*up),
                        (PAGE_WIDTH_MAX - LEFT - RIGHT) / length_of(*across));
    if (scale * length_of(*up) > sheet->tallest)
        scale = sheet->tallest / length_of(*up);
    sheet->box_width = ceil(maximum(scale * length_of(*across), WIDTH_MIN) - 1e-6);
    sheet->box_height = ceil(maximum(scale * length_of(*up), HEIGHT_MIN) - 1e-6);
    sheet->panel_width = ceil(maximum(sheet->box_width + LEFT + RIGHT,
                                      picture->panels > 1 ? PAGE_WIDTH_MIN / 2 : PAGE_WIDTH_MIN));
    sheet->box_left = LEFT + floor(0.5 * (sheet->panel_width - LEFT - RIGHT - sheet->box_width));
    sheet->projection =
        (struct projection){scale * sheet->density, 0.5 * sheet->box_width * sheet->density,
                            0.5 * sheet->box_height * sheet->density, sheet->density};
    const double x = 0.5 * (across->low + across->high), y = 0.5 * (up->low + up->high);
    const double half = 0.5 * sheet->box_width / scale, tall = 0.5 * sheet->box_height / scale;
    sheet->x.range = (struct range){x - half, x + half};
    sheet->y.range = (struct range){y - tall, y + tall};
    const double reach_x = range_reach(sheet->x.range), reach_y = range_reach(sheet->y.range);
    const double reach = maximum(reach_x, reach_y);
    static const char *const names[] = {"x", "y", "z"};
    /* One unit for both, unless one of them would need a thousandth of it. */
    axis_name(&sheet->x, names[view->across], "m", reach_x > 1e-3 * reach ? reach : reach_x);
    axis_name(&sheet->y, names[view->up], "m", reach_y > 1e-3 * reach ? reach : reach_y);
}

static void corner_of(const struct view *view, int k, double at[3])
{
    for (int axis = 0; axis < 3; axis++)
        at[axis] = k >> axis & 1 ? view->window[axis].high : view->window[axis].low;
}

/* The window's corners fill the page. */
static void lay_solid(const struct picture *picture, struct sheet *sheet)
{
    const struct view *view = &picture->view;
    struct range x = range_empty(), y = range_empty();
    for (int k = 0; k < 8; k++) {
        double at[3], column, row;
        corner_of(view, k, at);
        view_project(view, &(struct projection){.scale = 1.0}, at, &column, &row);
        range_include(&x, column);
        range_include(&y, row);
    }
    const double room = sheet->panel_width - 2 * BOX_SIDE;
    double scale = room / length_of(x);
    if (scale * length_of(y) > sheet->tallest)
        scale = sheet->tallest / length_of(y);
    sheet->box_left = 0.0;
    sheet->box_width = ceil(maximum(scale * length_of(x) + 2 * BOX_SIDE, PAGE_WIDTH_MIN));
    sheet->box_height = ceil(scale * length_of(y) + BOX_TOP + BOX_MARGIN);
    sheet->panel_width = sheet->box_width;
    sheet->projection = (struct projection){
        scale * sheet->density,
        sheet->density * (0.5 * sheet->box_width - scale * 0.5 * (x.low + x.high)),
        sheet->density * (BOX_TOP - scale * y.low), sheet->density};
}

/* A page of the album's size; else as wide as usual and as tall as what is on it. */
static void lay_out(const struct album *album, const struct picture *picture, double head,
                    struct sheet *sheet)
{
    const bool solid = picture->view.perspective;
    const double foot = (has_bar(picture) ? BAR_GAP + BAR_THICKNESS + AXIS_HEIGHT : 4.0) +
                        (solid ? 0.0 : AXIS_HEIGHT);
    const double density = album->size[1] ? (double)album->size[1] / SIZED_HEIGHT : 0.0;
    *sheet = (struct sheet){.head = head, .density = density > 0.0 ? density : DENSITY};
    sheet->panel_width = picture->panels > 1 ? PANEL_WIDTH : PAGE_WIDTH;
    sheet->tallest = solid ? SOLID_HEIGHT : HEIGHT_MAX;
    if (density > 0.0) {
        sheet->panel_width = album->size[0] / density / picture->panels;
        sheet->tallest =
            maximum(SIZED_HEIGHT - head - foot - (solid ? BOX_TOP + BOX_MARGIN : 0.0), HEIGHT_MIN);
    }
    if (solid)
        lay_solid(picture, sheet);
    else
        lay_section(picture, sheet);
    sheet->width = picture->panels * sheet->panel_width;
    sheet->height = ceil(head + sheet->box_height + foot);
    if (density > 0.0) {
        const double width = album->size[0] / density;
        sheet->left = maximum(floor(0.5 * (width - sheet->width)), 0.0);
        sheet->width = width;
        sheet->height = SIZED_HEIGHT;
    }
}

/* MASS of what is computed: "1.4 mg", of a plane case a metre of it. */
static void mass_text(const struct album *album, double mass, char *buffer, size_t size)
{
    static const char *const units[] = {"kg", "g", "mg", "µg"};
    const bool round = album->dimension == 2 && album->input->geometry == GEOMETRY_AXISYMMETRIC;
    double shown = round ? 2.0 * acos(-1.0) * mass : mass;
    size_t k = 0;
    while (shown < 1.0 && k + 1 < COUNT_OF(units)) {
        shown *= 1e3;
        k++;
    }
    snprintf(buffer, size, "%.3g %s%s", shown, units[k],
             album->dimension == 2 && !round ? "/m" : "");
}

/* How heavy and fast the heaviest fragments of FRAME are; where it is NULL, as wide a text as there
 * may be: the page of all frames has room for it. */
static void name_fragments(const struct album *album, const struct frame *frame,
                           struct legend_words *words)
{
    double mass[FRAGMENTS_NAMED + 1] = {0.0}, momentum[FRAGMENTS_NAMED + 1][3] = {{0.0}};
    static const char *const components[] = {"velocity.x", "velocity.y", "velocity.z"};
    for (int g = 0; frame && g < frame->groups; g++) {
        const struct frame_group *group = &frame->group[g];
        const struct frame_field *number = frame_field(group, "fragment");
        for (int64_t i = 0; number && i < group->count; i++) {
            const int n = (int)number->value[i];
            if (n < 1 || n > FRAGMENTS_NAMED)
                continue;
            mass[n] += group->mass[i];
            for (int axis = 0; axis < 3; axis++) {
                const struct frame_field *velocity = frame_field(group, components[axis]);
                momentum[n][axis] += velocity ? group->mass[i] * velocity->value[i] : 0.0;
            }
        }
    }
    const struct colouring colouring = {.fragments = true};
    for (int n = 0; n <= FRAGMENTS_NAMED; n++) {
        char speed[UNIT_TEXT], heavy[24];
        const double size =
            sqrt(square(momentum[n][0]) + square(momentum[n][1]) + square(momentum[n][2]));
        multiple_text(mass[n] > 0.0 ? size / mass[n] : 0.0, "m/s", speed, sizeof speed);
        char *text = words->text[words->count];
        mass_text(album, mass[n], heavy, sizeof heavy);
        if (n && frame && !(mass[n] > 0.0))
            continue;
        if (n == 0)
            snprintf(text, sizeof words->text[0], "dust");
        else if (frame)
            snprintf(text, sizeof words->text[0], "%d: %s, %s", n, heavy, speed);
        else
            snprintf(text, sizeof words->text[0], "8: 8.88 mg/m, 888.8 m/s");
        words->entry[words->count++] =
            (struct legend_entry){MARK_SQUARE, colouring_of(&colouring, n), text};
    }
}

/* Those that any frame of the run has. */
static void name_categories(const struct album *album, const struct picture *picture,
                            const struct panel *panel, struct legend_words *words)
{
    const bool material = !strcmp(panel->field, "material");
    const struct frame_names *names = material ? &album->materials : &album->bodies;
    for (int i = 0; i < names->count && i < 256; i++) {
        if (!album->present[material][i] ||
            (!material && !picture_has_body(album, picture->input, i)))
            continue;
        if (words->count == LEGEND_MAX - 1) {
            words->entry[words->count++] =
                (struct legend_entry){MARK_NONE, {0.0, 0.0, 0.0}, "and others"};
            return;
        }
        words->entry[words->count++] =
            (struct legend_entry){MARK_SQUARE, colour_of_category(i), names->name[i]};
    }
}

/* FRAME: NULL: of none, as wide as of any. */
static void find_legend(const struct album *album, const struct picture *picture,
                        const struct frame *frame, struct legend_words *words)
{
    words->count = 0;
    for (int k = 0; k < picture->panels; k++) {
        const struct panel *panel = &picture->panel[k];
        if (panel->fragments)
            name_fragments(album, frame, words);
        else if (panel->category)
            name_categories(album, picture, panel, words);
        if (panel->category)
            return;
    }
}

/* "t = 3.1 µs, plane z = 2 mm, 214 particles outside". */
static void note_text(const struct picture *picture, const struct frame *frame, int64_t outside,
                      char *buffer, size_t size)
{
    const struct view *view = &picture->view;
    char time[UNIT_TEXT], plane[UNIT_TEXT + 16] = "", out[64] = "";
    multiple_text(frame->time, "s", time, sizeof time);
    if (view->normal >= 0) {
        const struct range *range = &view->window[view->normal];
        char place[UNIT_TEXT];
        /* What is zero but for rounding is zero. */
        const bool zero = fabs(view->middle) < 1e-6 * range_reach(*range);
        multiple_text(zero ? 0.0 : view->middle, "m", place, sizeof place);
        snprintf(plane, sizeof plane, ", plane %c = %s", "xyz"[view->normal], place);
    }
    if (outside)
        snprintf(out, sizeof out, ", %lld %s outside", (long long)outside,
                 outside == 1 ? "particle" : "particles");
    snprintf(buffer, size, "t = %s%s%s", time, plane, out);
}

/* Puts what RASTER shows onto the page, with its corner at (LEFT, TOP) in points. */
static void put_raster(const struct canvas *canvas, const struct raster *raster, double left,
                       double top)
{
    cairo_surface_flush(canvas->surface);
    uint32_t *data = (uint32_t *)(void *)cairo_image_surface_get_data(canvas->surface);
    const int64_t stride = cairo_image_surface_get_stride(canvas->surface) / 4;
    const int64_t column = (int64_t)(left * canvas->density);
    const int64_t row = (int64_t)(top * canvas->density);
    const int64_t width = cairo_image_surface_get_width(canvas->surface) - column,
                  height = cairo_image_surface_get_height(canvas->surface) - row;
    for (int64_t y = 0; y < raster->height && y < height; y++)
        for (int64_t x = 0; x < raster->width && x < width; x++)
            if (raster->pixel[y * raster->width + x])
                data[(row + y) * stride + column + x] = raster->pixel[y * raster->width + x];
    cairo_surface_mark_dirty(canvas->surface);
}

/* Marks where the computed part ends and its mirror image begins. */
static void draw_mirror_marks(const struct canvas *canvas, const struct view *view,
                              const struct axis *x, const struct axis *y)
{
    const int axis[2] = {view->across, view->up};
    for (int k = 0; k < 2; k++) {
        if (!view->mirrored[axis[k]] || axis[k] == view->normal)
            continue;
        const double at = axis_place(k ? y : x, view->mirror_at[axis[k]]);
        for (int end = 0; end < 2; end++) {
            const double edge = k ? (end ? x->end : x->start) : end ? y->end : y->start;
            const double inwards = k ? (end ? -7.0 : 7.0) : end ? 7.0 : -7.0;
            cairo_move_to(canvas->pen, k ? edge : at, k ? at : edge);
            cairo_line_to(canvas->pen, k ? edge + inwards : at, k ? at : edge + inwards);
        }
    }
    canvas_colour(canvas, (struct colour){0.1, 0.1, 0.1});
    cairo_set_line_width(canvas->pen, 1.2);
    cairo_stroke(canvas->pen);
}

static void draw_section_axes(const struct canvas *canvas, const struct sheet *sheet,
                              const struct view *view, double left)
{
    struct axis x = sheet->x, y = sheet->y;
    x.start = left + sheet->box_left;
    x.end = x.start + sheet->box_width;
    y.start = sheet->head + sheet->box_height;
    y.end = sheet->head;
    axis_ticks(&x, canvas);
    axis_ticks(&y, canvas);
    if (view->up_sign < 0.0) /* the axis points down: places change, the ticks stay */
        y.range = (struct range){y.range.high, y.range.low};
    axes_frame(canvas, &x, &y);
    draw_mirror_marks(canvas, view, &x, &y);
}

static struct error *draw_raster(const struct album *album, const struct picture *picture,
                                 const struct panel *panel, const struct frame *frame,
                                 const struct sheet *sheet, struct raster *raster, int64_t *outside,
                                 double *steepest)
{
    struct scene scene;
    struct colouring colouring = {.scale = panel->category ? NULL : &panel->scale,
                                  .fragments = panel->fragments,
                                  .schlieren =
                                      panel->schlieren ? picture->input->schlieren.strength : 0.0,
                                  .steepest = panel->steepest};
    colouring_prepare(&colouring);
    *raster = (struct raster){.width = (int)(sheet->box_width * sheet->density),
                              .height = (int)(sheet->box_height * sheet->density)};
    raster->pixel =
        memory_allocate((size_t)raster->width * (size_t)raster->height * sizeof(uint32_t));
    struct error *error = scene_take(album, picture, panel, frame, &scene, outside);
    if (!raster->pixel && !error)
        error = out_of_memory_for("a picture");
    const struct drawing_of of = {&scene,
                                  &picture->view,
                                  &sheet->projection,
                                  &colouring,
                                  raster->width,
                                  raster->height,
                                  album->threads,
                                  (float)(picture->view.dot * sheet->density)};
    if (!error)
        error = picture->view.perspective ? solid_draw(&of, raster)
                                          : section_draw(&of, raster, steepest);
    free(scene.item);
    return error;
}

struct error *sheet_measure(const struct album *album, const struct picture *picture,
                            const struct panel *panel, const struct frame *frame, double *steepest)
{
    struct sheet sheet;
    struct raster raster;
    int64_t outside;
    lay_out(album, picture, 60.0, &sheet);
    struct error *error =
        picture->view.perspective
            ? error_new(ERROR_INPUT, "schlieren needs a section")
            : draw_raster(album, picture, panel, frame, &sheet, &raster, &outside, steepest);
    if (!picture->view.perspective)
        free(raster.pixel);
    return error;
}

static struct error *draw_panel(const struct canvas *canvas, const struct album *album,
                                const struct picture *picture, int k, const struct frame *frame,
                                const struct sheet *sheet, int64_t *outside)
{
    const struct panel *panel = &picture->panel[k];
    const double left = sheet->left + k * sheet->panel_width;
    struct raster raster;
    struct error *error = draw_raster(album, picture, panel, frame, sheet, &raster, outside, NULL);
    if (!error) {
        const struct box_axes axes = {&picture->view, &sheet->projection, left + sheet->box_left,
                                      sheet->head};
        if (picture->view.perspective)
            box_axes_behind(canvas, &axes);
        put_raster(canvas, &raster, left + sheet->box_left, sheet->head);
        if (picture->view.perspective)
            box_axes_before(canvas, &axes);
        else
            draw_section_axes(canvas, sheet, &picture->view, left);
        const double foot = sheet->head + sheet->box_height + BAR_GAP +
                            (picture->view.perspective ? 0.0 : AXIS_HEIGHT);
        if (!panel->category)
            colour_bar_draw(canvas, panel, left + sheet->box_left + 0.5 * sheet->box_width,
                            sheet->box_width, foot);
    }
    free(raster.pixel);
    return error;
}

/* Where title and legend begin: above what is drawn, but not so far to the right that the title, or
 * a note of usual length, would not fit. The same for all frames. */
static double find_text(const struct canvas *canvas, const struct album *album,
                        const struct picture *picture, const struct sheet *sheet)
{
    const double least = picture->view.perspective ? MARGIN : LEFT;
    const double over = picture->view.perspective ? least : sheet->box_left;
    const double title = canvas_text_width(canvas, TEXT_TITLE, title_of(album));
    const double most = sheet->width - MARGIN - maximum(title, NOTE_ROOM);
    return maximum(least, minimum(sheet->left + over, most));
}

/* Lays out a page with the header and legend that it has: how tall these are depends on how wide
 * the page is, and what is drawn is as tall as they leave it. */
static struct error *lay_all(const struct album *album, const struct picture *picture,
                             const struct legend_words *words, struct sheet *sheet)
{
    enum { ROUNDS = 3 };
    struct canvas probe;
    struct error *error = canvas_create(1.0, 1.0, DENSITY, &probe);
    double head = 0.0;
    for (int round = 0; round < ROUNDS && !error; round++) {
        lay_out(album, picture, head, sheet);
        sheet->text = find_text(&probe, album, picture, sheet);
        const struct legend legend = {words->entry, words->count, 0.0, 0.0,
                                      sheet->width - sheet->text - MARGIN};
        const double needed =
            canvas_header(&probe, 0.0, "", "") + 4.0 + legend_height(&probe, &legend);
        head = maximum(head, needed);
    }
    lay_out(album, picture, head, sheet);
    sheet->text = error ? LEFT : find_text(&probe, album, picture, sheet);
    canvas_destroy(&probe);
    return error;
}

struct error *sheet_draw(const struct album *album, const struct picture *picture,
                         const struct frame *frame, const char *path)
{
    struct sheet sheet;
    struct legend_words words;
    struct canvas canvas;
    char note[256];
    int64_t outside = 0;
    find_legend(album, picture, NULL, &words);
    TRY(lay_all(album, picture, &words, &sheet));
    find_legend(album, picture, frame, &words);
    struct error *error = canvas_create(sheet.width, sheet.height, sheet.density, &canvas);
    for (int k = 0; k < picture->panels && !error; k++)
        error = draw_panel(&canvas, album, picture, k, frame, &sheet, &outside);
    if (!error) {
        note_text(picture, frame, outside, note, sizeof note);
        const double top = canvas_header(&canvas, sheet.text, title_of(album), note);
        legend_draw(&canvas, &(struct legend){words.entry, words.count, sheet.text, top,
                                              sheet.width - sheet.text - MARGIN});
        if (frame_members(frame) == 0)
            canvas_text(&canvas, TEXT_NOTE,
                        (struct text_place){0.5 * sheet.width, sheet.head + 0.5 * sheet.box_height,
                                            0.5, sheet.width},
                        "no particles");
        error = canvas_publish(&canvas, path, true, false);
    }
    canvas_destroy(&canvas);
    return error;
}
