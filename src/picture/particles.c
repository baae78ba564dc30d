/* Pictures of particles coloured by a field: what is in the picture, how it fills the page, and
 * what stands around the particles. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/units.h"
#include "picture/dots.h"
#include "picture/picture.h"

/* The layout, in points. */
enum {
    PAGE_WIDTH = 800,
    PAGE_WIDTH_MIN = 420,
    PAGE_WIDTH_MAX = 1200, /* of long strips */
    HEIGHT_MIN = 24,       /* of the particles */
    HEIGHT_MAX = 820,
    WIDTH_MIN = 50,
    LEFT = 76,
    RIGHT = 22,
    AXIS_HEIGHT = 42,
    BAR_GAP = 10,
    BAR_THICKNESS = 11,
    MARGIN = 4, /* between the particles and the frame, but where a wall is the frame */
};

/* How the picture fills its page. */
struct page {
    struct axis x, y;
    double scale;              /* points a metre */
    double middle_x, middle_y; /* where the middle of the extents is, in points */
    double width, height;
};

/* Places the frame: equal axes, as large as the page allows; only the page's height follows the
 * particles, but for long strips and tall columns. FOOT is the height of what comes below. */
static struct page lay_out(const struct plane *plane, double head, double foot)
{
    double across = length_of(plane->extent[plane->across]);
    double up = length_of(plane->extent[plane->up]);
    const bool *wall_x = plane->wall[plane->across], *wall_y = plane->wall[plane->up];
    const double margin_x = MARGIN * (2 - wall_x[0] - wall_x[1]);
    const double margin_y = MARGIN * (2 - wall_y[0] - wall_y[1]);
    struct page page = {.scale = (PAGE_WIDTH - LEFT - RIGHT - margin_x) / across};
    if (page.scale * up < HEIGHT_MIN)
        page.scale = minimum(HEIGHT_MIN / up, (PAGE_WIDTH_MAX - LEFT - RIGHT - margin_x) / across);
    if (page.scale * up > HEIGHT_MAX)
        page.scale = HEIGHT_MAX / up;
    double width = maximum(page.scale * across, WIDTH_MIN) + margin_x;
    double height = maximum(page.scale * up, HEIGHT_MIN) + margin_y;
    page.width = ceil(maximum(width + LEFT + RIGHT, PAGE_WIDTH_MIN) - 1e-6);
    page.height = ceil(head + height + AXIS_HEIGHT + foot - 1e-6);
    page.x.start = LEFT + 0.5 * (page.width - LEFT - RIGHT - width);
    page.x.end = page.x.start + width;
    page.y.end = head;
    page.y.start = head + height;
    /* How far the margins shift the middle of the frame from that of the extents. */
    double aside_x = 0.5 * MARGIN * (wall_x[0] - wall_x[1]);
    double aside_y = 0.5 * MARGIN * (wall_y[0] - wall_y[1]);
    page.middle_x = 0.5 * (page.x.start + page.x.end) - aside_x;
    page.middle_y = 0.5 * (page.y.start + page.y.end) + aside_y;
    double x = middle_of(plane->extent[plane->across]) + aside_x / page.scale;
    double y = middle_of(plane->extent[plane->up]) + aside_y / page.scale;
    page.x.range = (struct range){x - 0.5 * width / page.scale, x + 0.5 * width / page.scale};
    page.y.range = (struct range){y - 0.5 * height / page.scale, y + 0.5 * height / page.scale};

    static const char *const axis_names[] = {"x", "y", "z"};
    /* One unit for both, unless one of them would need a thousandth of it. */
    double reach_x = range_reach(page.x.range), reach_y = range_reach(page.y.range);
    double reach = maximum(reach_x, reach_y);
    axis_name(&page.x, axis_names[plane->across], "m", reach_x > 1e-3 * reach ? reach : reach_x);
    axis_name(&page.y, axis_names[plane->up], "m", reach_y > 1e-3 * reach ? reach : reach_y);
    return page;
}

/* A pointed end tells that values lie beyond the scale. */
static void bar_end(const struct canvas *canvas, const struct colour_scale *colours, double value,
                    double x, double y, double point)
{
    canvas_colour(canvas, colour_of(colours, value));
    cairo_move_to(canvas->pen, x, y);
    cairo_line_to(canvas->pen, x + point, y + 0.5 * BAR_THICKNESS);
    cairo_line_to(canvas->pen, x, y + BAR_THICKNESS);
    cairo_fill(canvas->pen);
}

enum { LEGEND_MAX = 24 };

/* What a picture shows with the particles. */
struct surroundings {
    const struct simulation *simulation;
    const struct plane *plane;
    const struct shown *shown;
    const char *field;
    struct colour_scale colours;
    int entries;
    struct legend_entry entry[LEGEND_MAX];
};

/* "plastic strain" of "plastic_strain", "velocity x" of "velocity.x". */
static void field_text(const char *field, char *buffer, size_t size)
{
    snprintf(buffer, size, "%s", field);
    for (char *letter = buffer; *letter; ++letter)
        if (*letter == '_' || *letter == '.')
            *letter = ' ';
}

/* The scale of the field, at TOP. */
static void draw_colour_bar(const struct canvas *canvas, const struct page *page, double top,
                            const struct surroundings *around, const struct dots *dots)
{
    const struct colour_scale *colours = &around->colours;
    char name[LABEL_TEXT];
    field_text(around->field, name, sizeof name);
    double middle = 0.5 * (page->x.start + page->x.end);
    double half = 0.5 * minimum(maximum(0.7 * (page->x.end - page->x.start), 300.0), 480.0);
    struct axis bar = {.range = colours->range,
                       .logarithmic = colours->logarithmic,
                       .start = middle - half,
                       .end = middle + half};
    axis_name(&bar, name, around->shown->column->unit, range_reach(bar.range));
    axis_ticks(&bar, canvas);
    cairo_pattern_t *shades = cairo_pattern_create_linear(bar.start, 0.0, bar.end, 0.0);
    enum { shade_count = 96 };
    for (int i = 0; i <= shade_count; ++i) {
        double part = (double)i / shade_count;
        const double value = bar.logarithmic
                                 ? bar.range.low * pow(bar.range.high / bar.range.low, part)
                                 : bar.range.low + part * (bar.range.high - bar.range.low);
        struct colour colour = colour_of(colours, value);
        cairo_pattern_add_color_stop_rgb(shades, part, colour.red, colour.green, colour.blue);
    }
    cairo_set_source(canvas->pen, shades);
    cairo_rectangle(canvas->pen, bar.start, top, bar.end - bar.start, BAR_THICKNESS);
    cairo_fill(canvas->pen);
    cairo_pattern_destroy(shades);
    if (dots->values.low < bar.range.low)
        bar_end(canvas, colours, bar.range.low, bar.start - 1.0, top, -8.0);
    if (dots->values.high > bar.range.high)
        bar_end(canvas, colours, bar.range.high, bar.end + 1.0, top, 8.0);
    axis_draw_below(canvas, &bar, top + BAR_THICKNESS);
}

/* Collective: the categories that are in the picture; *count of them, at most LEGEND_MAX. */
static struct error *category_entries(const struct dots *dots, const struct ranks *ranks,
                                      const struct named_map *names, struct legend_entry *entries,
                                      int *count)
{
    static const struct legend_entry more = {MARK_NONE, {0.0, 0.0, 0.0}, "and others"};
    const int categories = dots->values.low <= dots->values.high ? (int)dots->values.high + 1 : 0;
    double *present = memory_allocate(((size_t)categories + 1) * sizeof *present);
    TRY(ranks_agree(ranks, present ? NULL : out_of_memory_for("a picture")));
    for (int64_t i = 0; i < dots->count; ++i)
        present[(int)dots->dot[i].value] = 1.0;
    ranks_maximum_of(ranks, present, categories);
    for (int i = 0; i < categories; ++i) {
        if (present[i] == 0.0)
            continue;
        if (*count == LEGEND_MAX) {
            entries[*count - 1] = more;
            break;
        }
        entries[(*count)++] = (struct legend_entry){
            MARK_SQUARE, colour_of_category(i),
            names && i < names->count && names->names[i] ? names->names[i] : "?"};
    }
    free(present);
    return NULL;
}

static const char *title_of(const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    return !input ? NULL : input->title ? input->title : input->name;
}

/* "t = 3.1 µs, plane z = 2 mm". */
static void note_text(const struct simulation *simulation, const struct plane *plane, char *buffer,
                      size_t size)
{
    char time[UNIT_TEXT], place[UNIT_TEXT];
    multiple_text(simulation->time, "s", time, sizeof time);
    if (plane && plane->normal >= 0) {
        double middle = plane->middle;
        /* What is zero but for rounding is zero. */
        if (fabs(middle) < 1e-6 * range_reach(plane->extent[plane->normal]))
            middle = 0.0;
        multiple_text(middle, "m", place, sizeof place);
        snprintf(buffer, size, "t = %s, plane %c = %s", time, "xyz"[plane->normal], place);
    } else {
        snprintf(buffer, size, "t = %s", time);
    }
}

/* Where the particles are painted. */
static struct viewport viewport_of(const struct page *page, const struct plane *plane,
                                   const struct colour_scale *colours)
{
    return (struct viewport){.left = (int)floor(page->x.start * PIXELS_PER_POINT),
                             .right = (int)floor(page->x.end * PIXELS_PER_POINT),
                             .top = (int)floor(page->y.end * PIXELS_PER_POINT),
                             .bottom = (int)floor(page->y.start * PIXELS_PER_POINT),
                             .x = page->middle_x * PIXELS_PER_POINT,
                             .y = page->middle_y * PIXELS_PER_POINT,
                             .scale = page->scale * PIXELS_PER_POINT,
                             .squares = plane->diameter * page->scale * PIXELS_PER_POINT < 14.0 ||
                                        plane->cells,
                             .cells = plane->cells,
                             .colours = colours};
}

/* Puts the IMAGE of the particles into the frame. */
static void put_image(const struct canvas *canvas, const struct viewport *viewport,
                      const uint32_t *image)
{
    cairo_surface_flush(canvas->surface);
    uint32_t *data = (uint32_t *)(void *)cairo_image_surface_get_data(canvas->surface);
    const int64_t stride = cairo_image_surface_get_stride(canvas->surface) / 4;
    for (int64_t row = viewport->top; row < viewport->bottom; ++row)
        memcpy(data + row * stride + viewport->left,
               image + (row - viewport->top) * viewport->right + viewport->left,
               (size_t)(viewport->right - viewport->left) * sizeof *data);
    cairo_surface_mark_dirty(canvas->surface);
}

/* The frame with the particles in it; below it the colour bar, unless a category is shown. */
static void draw_page(const struct canvas *canvas, struct page *page, const struct dots *dots,
                      const struct surroundings *around, const struct viewport *viewport,
                      const uint32_t *image)
{
    axis_ticks(&page->x, canvas);
    axis_ticks(&page->y, canvas);
    put_image(canvas, viewport, image);
    axes_frame(canvas, &page->x, &page->y);
    if (around->shown->column)
        draw_colour_bar(canvas, page, page->y.start + AXIS_HEIGHT + BAR_GAP, around, dots);
    const struct text_place middle = {0.5 * (page->x.start + page->x.end),
                                      0.5 * (page->y.start + page->y.end) + 4.0, 0.5,
                                      page->x.end - page->x.start - 8.0};
    if (dots->of_all == 0)
        canvas_text(canvas, TEXT_NOTE, middle, "no particles");
}

/* How tall the header is, with the legend of a page of WIDTH; needed before there is a canvas of
 * the right height. */
static struct error *measure_head(const struct surroundings *around, double width, double *head)
{
    struct canvas probe;
    struct error *error = canvas_create(1.0, 1.0, &probe);
    *head = canvas_header(&probe, 0.0, "", "") + 4.0;
    if (!error)
        *head += legend_height(&probe,
                               &(struct legend){around->entry, around->entries, 0.0, 0.0, width});
    canvas_destroy(&probe);
    return error;
}

/* The picture itself. */
static struct error *write_page(const char *path, struct page *page, const struct dots *dots,
                                const struct surroundings *around, const struct viewport *viewport,
                                const uint32_t *image)
{
    char note[2 * UNIT_TEXT + 32];
    note_text(around->simulation, around->plane, note, sizeof note);
    struct canvas canvas;
    struct error *error = canvas_create(page->width, page->height, &canvas);
    if (!error) {
        double top = canvas_header(&canvas, LEFT, title_of(around->simulation), note);
        legend_draw(&canvas, &(struct legend){around->entry, around->entries, LEFT, top,
                                              page->width - LEFT - RIGHT});
        draw_page(&canvas, page, dots, around, viewport, image);
        error = canvas_publish(&canvas, path, true);
    }
    canvas_destroy(&canvas);
    return error;
}

/* Lays the page out: rank 0 knows how large texts are. */
static struct error *find_page(const struct surroundings *around, struct page *page)
{
    const struct ranks *ranks = around->simulation->ranks;
    double head = 0.0, foot = around->shown->column ? BAR_GAP + BAR_THICKNESS + AXIS_HEIGHT : 4.0;
    /* The width of the page does not depend on its head. */
    double width = lay_out(around->plane, head, foot).width - LEFT - RIGHT;
    struct error *error = NULL;
    if (ranks->rank == 0)
        error = measure_head(around, width, &head);
    TRY(ranks_agree(ranks, error));
    ranks_broadcast(ranks, 0, &head, sizeof head);
    *page = lay_out(around->plane, head, foot);
    return NULL;
}

/* Peaks of a blast fall by decades. */
static bool is_map_of_peaks(const char *field)
{
    static const char start[] = "peak_";
    return !strncmp(field, start, sizeof start - 1);
}

static struct error *draw_plane(const char *path, struct surroundings *around, struct dots *dots,
                                struct range fixed)
{
    const struct ranks *ranks = around->simulation->ranks;
    const struct shown *shown = around->shown;
    struct page page;
    uint32_t *image;
    dots->of_all = ranks_sum(ranks, dots->count);
    dots->values = range_of_all(ranks, dots->values);
    if (!shown->column)
        TRY(category_entries(dots, ranks, shown->names, around->entry, &around->entries));
    TRY(find_page(around, &page));

    struct range range = range_drawable(dots->values, false);
    if (!isnan(fixed.low))
        range = (struct range){fixed.low, maximum(range.high, fixed.low)};
    if (!isnan(fixed.high))
        range = (struct range){minimum(range.low, fixed.high), fixed.high};
    around->colours =
        is_map_of_peaks(around->field) ? colour_scale_logarithmic(range) : colour_scale_make(range);
    struct viewport viewport =
        viewport_of(&page, around->plane, shown->column ? &around->colours : NULL);
    TRY(dots_paint(ranks, dots, &viewport, &image));
    struct error *error = NULL;
    if (ranks->rank == 0)
        error = write_page(path, &page, dots, around, &viewport, image);
    free(image);
    return ranks_agree(ranks, error);
}

static struct error *plot_line_problem(const char *path, const struct simulation *simulation,
                                       const struct shown *shown, const char *field,
                                       struct range fixed, const struct scatter *scatter)
{
    char note[2 * UNIT_TEXT + 32], name[LABEL_TEXT];
    note_text(simulation, NULL, note, sizeof note);
    field_text(field, name, sizeof name);
    struct series series = {.count = scatter->count, .x = scatter->x, .y = scatter->y};
    struct plot plot = {.title = title_of(simulation),
                        .x_name = "x",
                        .x_unit = "m",
                        .y_name = name,
                        .y_unit = shown->column ? shown->column->unit : "",
                        .count = 1,
                        .series = &series,
                        .note = note,
                        .own_folder = true,
                        .y_low = isnan(fixed.high) ? NAN : fixed.low,
                        .y_high = fixed.high};
    return picture_plot(path, &plot);
}

/* In 1-D: the field over x, as dots, of so many populations that have it. */
static struct error *draw_line_problem(const char *path, const struct simulation *simulation,
                                       const struct shown *shown, int shows, const char *field,
                                       struct range fixed)
{
    struct scatter scatter;
    struct error *error = NULL;
    int64_t count = 0;
    for (int k = 0; k < shows; k++)
        count += shown[k].population->count;
    if (!scatter_allocate(&scatter, count))
        error = out_of_memory_for("a picture");
    count = 0;
    for (int k = 0; k < shows && !error; k++) {
        const struct population *particles = shown[k].population;
        shown_read(&shown[k], 0, particles->count, scatter.y + count);
        for (int64_t i = 0; i < particles->count; ++i, ++count) {
            scatter.x[count] = particles->position[i][0];
            if (shows > 1 && !population_has(particles, (int32_t)i))
                scatter.y[count] = NAN; /* another has what is there */
        }
    }
    error = ranks_agree(simulation->ranks, error);
    if (!error)
        error = scatter_gather(simulation->ranks, &scatter);
    if (!error && simulation->ranks->rank == 0)
        error = plot_line_problem(path, simulation, shown, field, fixed, &scatter);
    scatter_free(&scatter);
    return ranks_agree(simulation->ranks, error);
}

struct error *picture_particles(const char *path, const struct simulation *simulation,
                                const struct population *population, const char *field, double low,
                                double high)
{
    const struct population *all[POPULATIONS_MAX];
    struct shown shown[POPULATIONS_MAX];
    struct range fixed = {low, high};
    const int populations = simulation_shown(simulation, population, all);
    int shows = 0;
    TRY(shown_find(simulation, population, field, &shown[shows++]));
    for (int k = 1; k < populations; k++) {
        struct error *without = shown_find(simulation, all[k], field, &shown[shows]);
        shows += without == NULL;
        error_free(without);
    }
    if (population->dimension == 1)
        return draw_line_problem(path, simulation, shown, shows, field, fixed);
    struct plane plane = plane_find(simulation, population);
    struct dots dots = {.values = range_empty()};
    struct surroundings around = {
        .simulation = simulation, .plane = &plane, .shown = shown, .field = field};
    struct error *error = NULL;
    for (int k = 0; k < shows && !error; k++)
        error = dots_take(&shown[k], &plane, &dots);
    error = ranks_agree(simulation->ranks, error);
    if (!error)
        error = draw_plane(path, &around, &dots, fixed);
    free(dots.dot);
    return error;
}
