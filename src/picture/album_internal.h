/* The parts of an album. Private to the pictures. */
#ifndef BOLIDE_ALBUM_INTERNAL_H
#define BOLIDE_ALBUM_INTERNAL_H

#include "picture/album.h"
#include "picture/scene.h"

enum { PANELS_MAX = 6, BODIES_APART = 32 };

/* One field of a picture. */
struct panel {
    const char *field; /* what is read: of schlieren the field of the gradient */
    bool category, fragments, schlieren;
    char unit[32];
    struct range values; /* percentiles of bodies, united over the frames */
    struct range extremes;
    double magnitude; /* what a spread is small against */
    double steepest;
    bool uniform;
    struct colour_scale scale;
};

struct picture {
    const char *name;
    const struct picture_input *input;
    struct view view;
    int panels;
    struct panel panel[PANELS_MAX];
};

/* How large particles of a body are drawn: up to MOST as they are; what has expanded further is no
 * cell of a whole any more, but debris: the larger it is the smaller it is drawn, down to LEAST,
 * the size at the start. */
struct stretch {
    float least, most; /* m */
};

struct album {
    const struct simulation_case *input;
    struct place place;
    int threads, dimension;
    int size[2];    /* pixels; 0: as the page needs */
    bool gas_alone; /* no particles at the start */
    struct picture_input standard;
    int count;
    struct picture *picture;
    int fields;
    const char *field[FRAME_FIELDS];
    struct frame_names bodies, materials; /* of the first frame, copied */
    struct stretch *stretch;              /* of each body */
    bool present[2][256];                 /* bodies, materials that any frame has */
};

/* Whether the picture shows the members of BODY. */
bool picture_has_body(const struct album *album, const struct picture_input *input, int body);

/* view.c: what of space PICTURE shows. */
struct error *view_find(const struct album *album, const struct frame *first,
                        const struct frame *last, struct picture *picture);

/* spread.c: extremes, percentiles by mass of COUNT values: LOW and HIGH are fractions. Each of
 * GROUP < BODIES_APART by itself; the result is their union. */
struct error *spread_find(const float *value, const float *mass, const uint8_t *group,
                          int64_t count, double low, double high, struct range *percentiles,
                          struct range *extremes);

/* stretch.c */
struct error *stretch_find(const struct album *album, const struct frame *first,
                           struct stretch **stretch);
/* The diameter that is drawn of a particle of DIAMETER. */
BOLIDE_INLINE float stretch_apply(const struct stretch *stretch, float diameter)
{
    const float shrunk = stretch->most * (stretch->most / diameter);
    return diameter <= stretch->most ? diameter : shrunk > stretch->least ? shrunk : stretch->least;
}

/* What of FRAME the panel shows; free scene->item. *OUTSIDE counts members out of the window. */
struct error *scene_take(const struct album *album, const struct picture *picture,
                         const struct panel *panel, const struct frame *frame, struct scene *scene,
                         int64_t *outside);

/* sheet.c: the picture on its page. */
struct error *sheet_draw(const struct album *album, const struct picture *picture,
                         const struct frame *frame, const char *path);
/* The steepest gradients of a schlieren panel. */
struct error *sheet_measure(const struct album *album, const struct picture *picture,
                            const struct panel *panel, const struct frame *frame, double *steepest);

/* line.c: the fields over x, in 1-D. */
struct error *line_draw(const struct album *album, const struct picture *picture,
                        const struct frame *frame, const char *path);

#endif
