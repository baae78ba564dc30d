/* What is drawn of a frame, and how it is looked at. Private to the pictures. */
#ifndef BOLIDE_PICTURE_SCENE_H
#define BOLIDE_PICTURE_SCENE_H

#include "case/case.h"
#include "measure/frame.h"
#include "model/place.h"
#include "picture/internal.h"

/* A particle, or a cell: a square or cube. */
struct scene_item {
    float place[3], diameter, value;
    uint16_t body;    /* outlines are between different ones */
    bool cell, apart; /* apart: debris, which closes no gap to the next */
};

struct scene {
    int64_t count;
    struct scene_item *item; /* in a fixed order: of two that are equally near the first is seen */
};

/* A half-space: all with normal . x > offset. */
struct half_space {
    int axis;
    double sign, offset;
};

/* How space is seen: the same for all frames. */
struct view {
    bool perspective;
    int dimension;
    bool mirrored[3]; /* across a plane of the axis */
    double mirror_at[3];
    struct range computed[3], window[3]; /* without and with mirrored halves */
    int across, up, normal;              /* of a section; normal -1: none */
    double middle, slab;                 /* of a section; slab 0: what the plane cuts */
    double up_sign;                      /* -1 where the axis points down */
    double diameter;                     /* of the largest particle at the start */
    double dot;                          /* points */
    double fill; /* a section is filled up to so many diameters from a particle */
    bool outlines, parallel;
    double direction[3], right[3], top[3]; /* of a perspective: to the eye; on the page */
    double eye[3];
    int cuts;
    struct half_space cut[3];
};

/* A picture in the making: colours of pixels, 0 alpha where nothing is. */
struct raster {
    int width, height;
    uint32_t *pixel;
};

/* Where the world is in a raster: pixels a metre (a section), or pixels a unit of the slope
 * (a perspective); the middle of the window, or the axis of the eye, is at (x, y). */
struct projection {
    double scale, x, y;
    double density; /* pixels a point */
};

/* The colours of values; of categories where SCALE is NULL. */
enum { COLOUR_SHADES = 1024 };
struct colouring {
    const struct colour_scale *scale;
    bool fragments;
    double schlieren, steepest; /* strength and scale of a schlieren picture; 0: none */
    struct colour shade[COLOUR_SHADES];
};

/* Fills the shades, once the rest is there. */
void colouring_prepare(struct colouring *colouring);

struct colour colouring_of(const struct colouring *colouring, double value);

/* The pixel of a colour, darkened to SHADE of it. */
uint32_t pixel_of(struct colour colour, double shade);

/* The images of the scene across mirror planes: image K of 1 << mirrors; SIGN gets 1 or -1 for
 * each axis. */
int view_images(const struct view *view);
void view_image(const struct view *view, int image, double sign[3]);
void view_reflect(const struct view *view, const double sign[3], const float place[3],
                  double at[3]);

/* What both renderers get. */
struct drawing_of {
    const struct scene *scene;
    const struct view *view;
    const struct projection *projection;
    const struct colouring *colouring;
    int width, height, threads; /* of the raster */
    float dot;                  /* smallest diameter, pixels */
};

/* Marks are images of items, one image after the other. */
BOLIDE_INLINE const struct scene_item *drawing_item(const struct drawing_of *of, int32_t mark)
{
    return &of->scene->item[mark % of->scene->count];
}

/* section.c: cells of the nearest particle, filled, with values blended inside a body. STEEPEST:
 * NULL, or gets the 99.9 percentile of the gradient of the values, per pixel; then nothing is
 * drawn. */
struct error *section_draw(const struct drawing_of *of, struct raster *raster, double *steepest);

/* solid.c: spheres with a z-buffer, flat where cut. */
struct error *solid_draw(const struct drawing_of *of, struct raster *raster);

/* The projection of a point; false where it is behind the eye. */
bool view_project(const struct view *view, const struct projection *projection,
                  const double place[3], double *x, double *y);

/* Bands of rows and the items that touch them: threads draw bands, each item in its order. */
enum { BAND_ROWS = 32 };
struct row_bands {
    int count;
    int64_t *begin; /* of each band, and the end of the last */
    int32_t *item;  /* image * items + index */
};
struct span {
    float top, bottom; /* rows; top above bottom: not drawn */
};
/* Of all marks; PLACE keeps what CONTEXT wants of the one at AT and says which rows it touches. */
typedef struct span (*mark_place)(void *context, int64_t mark, const double at[3]);
struct error *row_bands_make(const struct drawing_of *of, mark_place place, void *context,
                             struct row_bands *bands);
void row_bands_free(struct row_bands *bands);

/* The pixels of BAND within REACH of (x, y), in a raster of WIDTH x HEIGHT. */
struct pixel_box {
    int left, right, top, bottom; /* last ones included */
};
struct pixel_box row_bands_box(float x, float y, float reach, int band, int width, int height);

#endif
