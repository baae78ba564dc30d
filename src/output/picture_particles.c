/* Pictures of particles coloured by a field: what is in the picture, how it fills the page, and what stands
 * around the particles. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/units.h"
#include "output/picture.h"
#include "output/picture_internal.h"

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

enum { SLICE = 4096 };

/* The plane of the picture, and what of space is in it. */
struct plane {
    bool rings;             /* the particles are those of axisymmetry */
    int across, up, normal; /* axes of space; normal -1: none */
    struct range extent[3]; /* of the particles with their size */
    bool wall[3][2];        /* the low, the high end of the extent is a mirror wall */
    double middle;          /* of the slab, along the normal */
    double diameter;        /* geometric mean of the particles' */
};

/* A particle in the picture, in metres from the middle of the extents: floats halve the memory. */
struct dot {
    float across, up, depth, diameter, value;
};

struct dots {
    int64_t count, capacity;
    struct dot *dot;
    struct range values;
};

/* The edge of the square or cube that a particle fills; of RINGS that of their section. */
static double particle_diameter(const struct particles *particles, bool rings, int64_t i)
{
    double volume = particles->mass[i] / particles->density[i];
    if (rings) /* mass is that of a radian */
        volume /= fabs(particles->position[i][0]);
    return diameter_of_volume(volume, particles->dimension);
}

static double middle_of(struct range range) { return 0.5 * (range.low + range.high); }
static double length_of(struct range range) { return range.high - range.low; }

/* Where the matter lies on a wall, its extent ends there. */
static void end_at_walls(struct plane *plane, const struct mirrors *mirrors)
{
    for (int axis = 0; axis < 3; ++axis) {
        struct range *extent = &plane->extent[axis];
        const double low = mirrors->low[axis], high = mirrors->high[axis];
        plane->wall[axis][0] = fabs(extent->low - low) <= plane->diameter && low < extent->high;
        plane->wall[axis][1] = fabs(extent->high - high) <= plane->diameter && high > extent->low;
        extent->low = plane->wall[axis][0] ? low : extent->low;
        extent->high = plane->wall[axis][1] ? high : extent->high;
    }
}

/* Finds extents, mean diameter, and in 3-D the two longest axes. */
static struct plane survey(const struct particles *particles, const struct mirrors *mirrors,
                           bool rings)
{
    struct plane plane = {.rings = rings,
                          .across = 0,
                          .up = 1,
                          .normal = -1,
                          .extent = {range_empty(), range_empty(), range_empty()}};
    double logarithms = 0.0;
    int64_t counted = 0;
    for (int64_t i = 0; i < particles->count; ++i) {
        for (int axis = 0; axis < 3; ++axis)
            range_include(&plane.extent[axis], particles->position[i][axis]);
        double logarithm = log(particle_diameter(particles, rings, i));
        if (isfinite(logarithm)) {
            logarithms += logarithm;
            ++counted;
        }
    }
    plane.diameter = counted > 0 ? exp(logarithms / (double)counted) : 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        struct range *extent = &plane.extent[axis];
        if (!(extent->low <= extent->high))
            *extent = (struct range){0.0, plane.diameter > 0.0 ? 0.0 : 1.0};
        extent->low -= 0.5 * plane.diameter;
        extent->high += 0.5 * plane.diameter;
    }
    end_at_walls(&plane, mirrors);
    if (particles->dimension == 3) {
        /* Of equal axes the last, but for rounding, so that x and y are the picture's. */
        plane.normal = 2;
        for (int axis = 1; axis >= 0; --axis)
            if (length_of(plane.extent[axis]) < 0.99 * length_of(plane.extent[plane.normal]))
                plane.normal = axis;
        plane.across = plane.normal == 0;
        plane.up = plane.normal == 2 ? 1 : 2;
        plane.middle = middle_of(plane.extent[plane.normal]);
    }
    return plane;
}

/* Adds particle I, unless it lies outside of the slab: its centre within 3/4 of its diameter of the middle,
 * so that a lattice shows one or two layers and never a gap. */
static bool gather_one(const struct particles *particles, const struct plane *plane, int64_t i,
                       double value, struct dots *dots)
{
    const double *position = particles->position[i];
    double depth = plane->normal < 0 ? 0.0 : position[plane->normal] - plane->middle;
    double diameter = particle_diameter(particles, plane->rings, i);
    /* A particle blown to next to nothing would cover all others. */
    diameter = minimum(isfinite(diameter) ? diameter : plane->diameter, 4.0 * plane->diameter);
    if (!isfinite(position[plane->across]) || !isfinite(position[plane->up]) ||
        !(fabs(depth) <= 0.75 * diameter || plane->normal < 0))
        return true;
    if (dots->count == dots->capacity &&
        !memory_reserve((void **)&dots->dot, &dots->capacity, dots->count + 1, dots->count,
                        sizeof *dots->dot))
        return false;
    struct dot *dot = &dots->dot[dots->count++];
    dot->across = (float)(position[plane->across] - middle_of(plane->extent[plane->across]));
    dot->up = (float)(position[plane->up] - middle_of(plane->extent[plane->up]));
    dot->depth = (float)depth;
    dot->diameter = (float)diameter;
    dot->value = (float)value;
    range_include(&dots->values, value);
    return true;
}

static int compare_depth(const void *a, const void *b)
{
    float first = ((const struct dot *)a)->depth, second = ((const struct dot *)b)->depth;
    return (first > second) - (first < second);
}

static struct error *gather(const struct particles *particles, const struct shown *shown,
                            const struct plane *plane, struct dots *dots)
{
    double values[SLICE];
    *dots = (struct dots){.values = range_empty()};
    for (int64_t begin = 0; begin < particles->count; begin += SLICE) {
        int64_t end = begin + SLICE < particles->count ? begin + SLICE : particles->count;
        shown_read(shown, begin, end, values);
        for (int64_t i = begin; i < end; ++i)
            if (!gather_one(particles, plane, i, values[i - begin], dots))
                return error_new(ERROR_SYSTEM, "picture: out of memory");
    }
    if (plane->normal >= 0 && dots->count > 0)
        qsort(dots->dot, (size_t)dots->count, sizeof *dots->dot, compare_depth);
    return NULL;
}

/* How the picture fills its page. */
struct page {
    struct axis x, y;
    double scale;              /* points a metre */
    double middle_x, middle_y; /* where the middle of the extents is, in points */
    double width, height;
};

/* Paints every dot at FACTOR times its diameter by PAINT_ONE. */
static void paint_layer(const struct pixels *pixels, const struct page *page,
                        const struct dots *dots, const struct shown *shown,
                        const struct colour_scale *colours, double factor,
                        paint_function *paint_one)
{
    double scale = page->scale * PIXELS_PER_POINT;
    double x = page->middle_x * PIXELS_PER_POINT, y = page->middle_y * PIXELS_PER_POINT;
    for (int64_t i = 0; i < dots->count; ++i) {
        const struct dot *dot = &dots->dot[i];
        double diameter = factor * dot->diameter * scale;
        struct colour colour =
            shown->category ? colour_of_category((int)dot->value) : colour_of(colours, dot->value);
        paint_one(pixels, x + dot->across * scale, y - dot->up * scale, diameter, colour);
    }
}

static void paint(const struct canvas *canvas, const struct page *page, const struct dots *dots,
                  const struct shown *shown, const struct colour_scale *colours, double diameter)
{
    cairo_surface_flush(canvas->surface);
    struct pixels pixels = {
        .data = (uint32_t *)(void *)cairo_image_surface_get_data(canvas->surface),
        .stride = cairo_image_surface_get_stride(canvas->surface) / 4,
        .left = (int)floor(page->x.start * PIXELS_PER_POINT),
        .right = (int)floor(page->x.end * PIXELS_PER_POINT),
        .top = (int)floor(page->y.end * PIXELS_PER_POINT),
        .bottom = (int)floor(page->y.start * PIXELS_PER_POINT),
    };
    /* Small particles of one body should read as a solid: squares behind them fill the gaps, which a lattice of
     * discs has at its corners, and wherever it is compressed along one axis. */
    if (diameter * page->scale * PIXELS_PER_POINT < 14.0)
        paint_layer(&pixels, page, dots, shown, colours, 1.3, paint_square);
    paint_layer(&pixels, page, dots, shown, colours, 1.05, paint_disc);
    cairo_surface_mark_dirty(canvas->surface);
}

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
    page.height = ceil(head + height + AXIS_HEIGHT + foot);
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

static void draw_colour_bar(const struct canvas *canvas, const struct page *page, double top,
                            const struct colour_scale *colours, const struct dots *dots,
                            const char *name, const char *unit)
{
    double middle = 0.5 * (page->x.start + page->x.end);
    double half = 0.5 * minimum(maximum(0.7 * (page->x.end - page->x.start), 300.0), 480.0);
    struct axis bar = {.range = colours->range, .start = middle - half, .end = middle + half};
    axis_name(&bar, name, unit, range_reach(bar.range));
    axis_ticks(&bar, canvas);
    cairo_pattern_t *shades = cairo_pattern_create_linear(bar.start, 0.0, bar.end, 0.0);
    enum { shade_count = 96 };
    for (int i = 0; i <= shade_count; ++i) {
        double part = (double)i / shade_count;
        struct colour colour =
            colour_of(colours, bar.range.low + part * (bar.range.high - bar.range.low));
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

/* The categories that are in the picture; returns their number, at most LEGEND_MAX. */
enum { LEGEND_MAX = 24, CATEGORIES_MAX = UINT16_MAX + 1 };
static int category_entries(const struct dots *dots, const struct named_map *names,
                            struct legend_entry *entries)
{
    static const struct legend_entry more = {MARK_NONE, {0.0, 0.0, 0.0}, "and others"};
    bool present[CATEGORIES_MAX] = {false};
    for (int64_t i = 0; i < dots->count; ++i)
        present[(int)dots->dot[i].value] = true;
    int count = 0;
    for (int i = 0; i < CATEGORIES_MAX; ++i) {
        if (!present[i])
            continue;
        if (count == LEGEND_MAX) {
            entries[count - 1] = more;
            break;
        }
        entries[count++] = (struct legend_entry){
            MARK_SQUARE, colour_of_category(i),
            names && i < names->count && names->names[i] ? names->names[i] : "?"};
    }
    return count;
}

/* "plastic strain" of "plastic_strain", "velocity x" of "velocity.x". */
static void field_text(const char *field, char *buffer, size_t size)
{
    snprintf(buffer, size, "%s", field);
    for (char *letter = buffer; *letter; ++letter)
        if (*letter == '_' || *letter == '.')
            *letter = ' ';
}

static const char *title_of(const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->input;
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

/* The frame with the particles in it; below it the colour bar, unless SHOWN is a category. */
static void draw_page(const struct canvas *canvas, struct page *page, const struct dots *dots,
                      const struct shown *shown, const struct colour_scale *colours,
                      double diameter, const char *field)
{
    axis_ticks(&page->x, canvas);
    axis_ticks(&page->y, canvas);
    paint(canvas, page, dots, shown, colours, diameter);
    axes_frame(canvas, &page->x, &page->y);
    if (!shown->category) {
        char name[LABEL_TEXT];
        field_text(field, name, sizeof name);
        draw_colour_bar(canvas, page, page->y.start + AXIS_HEIGHT + BAR_GAP, colours, dots, name,
                        shown->view->unit);
    }
    if (dots->count == 0)
        canvas_text(canvas, TEXT_NOTE, 0.5 * (page->x.start + page->x.end),
                    0.5 * (page->y.start + page->y.end) + 4.0, 0.5,
                    page->x.end - page->x.start - 8.0, "no particles");
}

/* How tall the header is, with the legend of a page of WIDTH; needed before there is a canvas of the right
 * height. */
static struct error *measure_head(const struct legend_entry *entries, int count, double width,
                                  double *head)
{
    struct canvas probe;
    struct error *error = canvas_create(1.0, 1.0, &probe);
    *head = canvas_header(&probe, 0.0, "", "") + 4.0;
    if (!error)
        *head += legend_draw(&probe, entries, count, 0.0, 0.0, width, false);
    canvas_destroy(&probe);
    return error;
}

static struct error *draw_plane(const char *path, const struct simulation *simulation,
                                const struct plane *plane, const struct shown *shown,
                                const struct dots *dots, const char *field, struct range fixed)
{
    struct legend_entry entries[LEGEND_MAX];
    int count = shown->category ? category_entries(dots, shown->names, entries) : 0;
    double head = 0.0, foot = shown->category ? 4.0 : BAR_GAP + BAR_THICKNESS + AXIS_HEIGHT;
    /* The width of the page does not depend on its head. */
    double width = lay_out(plane, head, foot).width - LEFT - RIGHT;
    TRY(measure_head(entries, count, width, &head));
    struct page page = lay_out(plane, head, foot);

    struct range range = range_drawable(dots->values, false);
    if (!isnan(fixed.low))
        range = (struct range){fixed.low, maximum(range.high, fixed.low)};
    if (!isnan(fixed.high))
        range = (struct range){minimum(range.low, fixed.high), fixed.high};
    struct colour_scale colours = colour_scale_make(range);
    char note[2 * UNIT_TEXT + 32];
    note_text(simulation, plane, note, sizeof note);

    struct canvas canvas;
    struct error *error = canvas_create(page.width, page.height, &canvas);
    if (!error) {
        double top = canvas_header(&canvas, LEFT, title_of(simulation), note);
        legend_draw(&canvas, entries, count, LEFT, top, width, true);
        draw_page(&canvas, &page, dots, shown, &colours, plane->diameter, field);
        error = canvas_publish(&canvas, path);
    }
    canvas_destroy(&canvas);
    return error;
}

/* In 1-D: the field over x, as dots. */
static struct error *draw_line_problem(const char *path, const struct simulation *simulation,
                                       const struct shown *shown, const char *field,
                                       struct range fixed)
{
    const struct particles *particles = &simulation->particles;
    int64_t count = particles->count;
    double *x = memory_allocate((size_t)(count + 1) * sizeof *x);
    double *y = memory_allocate((size_t)(count + 1) * sizeof *y);
    struct error *error = NULL;
    if (x && y) {
        char note[2 * UNIT_TEXT + 32], name[LABEL_TEXT];
        note_text(simulation, NULL, note, sizeof note);
        field_text(field, name, sizeof name);
        for (int64_t i = 0; i < count; ++i)
            x[i] = particles->position[i][0];
        shown_read(shown, 0, count, y);
        struct series series = {.count = count, .x = x, .y = y};
        struct plot plot = {.title = title_of(simulation),
                            .x_name = "x",
                            .x_unit = "m",
                            .y_name = name,
                            .y_unit = shown->view ? shown->view->unit : "",
                            .count = 1,
                            .series = &series,
                            .note = note,
                            .y_low = isnan(fixed.high) ? NAN : fixed.low,
                            .y_high = fixed.high};
        error = picture_plot(path, &plot);
    } else {
        error = error_new(ERROR_SYSTEM, "picture: out of memory");
    }
    free(x);
    free(y);
    return error;
}

struct error *picture_particles(const char *path, const struct simulation *simulation,
                                const struct views *views, const char *field, double low,
                                double high)
{
    struct shown shown;
    struct range fixed = {low, high};
    TRY(shown_find(simulation, views, field, &shown));
    if (simulation->particles.dimension == 1)
        return draw_line_problem(path, simulation, &shown, field, fixed);
    struct plane plane = survey(&simulation->particles, &simulation->mirrors,
                                simulation->geometry == GEOMETRY_AXISYMMETRIC);
    struct dots dots;
    struct error *error = gather(&simulation->particles, &shown, &plane, &dots);
    if (!error)
        error = draw_plane(path, simulation, &plane, &shown, &dots, field, fixed);
    free(dots.dot);
    return error;
}
