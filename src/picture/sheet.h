/* The axes of a perspective, the bar of colours. Private to the pictures. */
#ifndef BOLIDE_PICTURE_SHEET_H
#define BOLIDE_PICTURE_SHEET_H

#include "picture/scene.h"

/* The box of the window: its raster has its corner at (LEFT, TOP), in points. */
struct box_axes {
    const struct view *view;
    const struct projection *projection;
    double left, top;
};

/* The edges behind what is drawn, and ticks and names on three edges of the outline. */
void box_axes_behind(const struct canvas *canvas, const struct box_axes *axes);
void box_axes_before(const struct canvas *canvas, const struct box_axes *axes);

/* The bar of PANEL about MIDDLE below TOP, on a picture of WIDTH. */
enum { BAR_THICKNESS = 11 };
struct panel;
void colour_bar_draw(const struct canvas *canvas, const struct panel *panel, double middle,
                     double width, double top);

#endif
