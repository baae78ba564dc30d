/* What the pictures share: a canvas, text, axes and legends, drawn by Cairo. Lengths are points; a
 * point is PIXELS_PER_POINT pixels where no size is asked for; y runs downwards. */
#ifndef BOLIDE_PICTURE_INTERNAL_H
#define BOLIDE_PICTURE_INTERNAL_H

#include <cairo.h>

#include "base/error.h"
#include "model/columns.h"
#include "model/simulation.h"
#include "picture/png.h"
#include "picture/scale.h"

enum { PIXELS_PER_POINT = 2, LEGEND_ROW = 18, LABEL_TEXT = 128 };

struct canvas {
    cairo_surface_t *surface;
    cairo_t *pen;
    double width, height, density; /* points, pixels a point */
};

/* A white canvas; destroy it in every case, after failure too. */
struct error *canvas_create(double width, double height, double density, struct canvas *canvas);
void canvas_destroy(struct canvas *canvas);

/* Writes the picture to PATH as PNG; OWN_FOLDER: in a folder of the run, which is no link. FLAT:
 * of lines and text, see struct png_image. */
struct error *canvas_publish(const struct canvas *canvas, const char *path, bool own_folder,
                             bool flat);

/* The pixels of SURFACE, which is RGB24, with what has been drawn. */
struct png_image canvas_image(cairo_surface_t *surface);

enum text_style { TEXT_TITLE, TEXT_NOTE, TEXT_LABEL, TEXT_TICK };

/* Where a text goes: its base line at y; ALONG says which part of it is at x: 0 its start, 0.5 its
 * middle, 1 its end. What is wider than ROOM is made smaller, then cut. */
struct text_place {
    double x, y, along, room;
};
void canvas_text(const struct canvas *canvas, enum text_style style, struct text_place place,
                 const char *text);
double canvas_text_width(const struct canvas *canvas, enum text_style style, const char *text);

void canvas_colour(const struct canvas *canvas, struct colour colour);

/* Title and note at the top, from LEFT on; NULL leaves one out. Returns the height that they
 * take. */
double canvas_header(const struct canvas *canvas, double left, const char *title, const char *note);

/* One axis: RANGE (SI units) lies between the points START and END. */
struct axis {
    char label[LABEL_TEXT];
    struct range range;
    double scale;
    bool logarithmic;
    double start, end;
    struct ticks ticks;
};

/* Names AXIS "NAME (multiple of UNIT)", the multiple fit for MAGNITUDE; a logarithmic axis keeps
 * UNIT. */
void axis_name(struct axis *axis, const char *name, const char *unit, double magnitude);

/* Finds as many ticks as fit between start and end without touching. */
void axis_ticks(struct axis *axis, const struct canvas *canvas);

/* The point where VALUE stands. */
double axis_place(const struct axis *axis, double value);

/* Grid lines, behind the data; frame, ticks and labels, before the data. */
void axes_grid(const struct canvas *canvas, const struct axis *x, const struct axis *y);
void axes_frame(const struct canvas *canvas, const struct axis *x, const struct axis *y);

/* Ticks of a horizontal axis below y, with its label. */
void axis_draw_below(const struct canvas *canvas, const struct axis *axis, double y);

/* "plastic strain" of "plastic_strain", "velocity x" of "velocity.x". */
void field_text(const char *field, char *buffer, size_t size);

enum legend_mark { MARK_NONE, MARK_DOT, MARK_LINE, MARK_SQUARE };
struct legend_entry {
    enum legend_mark mark;
    struct colour colour;
    const char *text;
};

/* Entries in rows from LEFT, TOP on, no wider than WIDTH. */
struct legend {
    const struct legend_entry *entry;
    int entries;
    double left, top, width;
};

/* The height that the rows take; legend_draw draws them too. */
double legend_height(const struct canvas *canvas, const struct legend *legend);
double legend_draw(const struct canvas *canvas, const struct legend *legend);

#endif
