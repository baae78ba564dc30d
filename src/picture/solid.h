/* How the rays of a perspective meet spheres, cells and the faces of a cut. Private to solid.c. */
#ifndef BOLIDE_PICTURE_SOLID_H
#define BOLIDE_PICTURE_SOLID_H

#include "picture/scene.h"
#include "picture/vector.h"

/* Radii over diameters: of the spheres, of the discs of a cut face, which close the corners between
 * them, and within which the values of cells are blended. */
static const float SPHERE = 0.62f, DISC = 0.87f, BLEND = 1.3f;

/* A sphere on the page: its middle and radius in pixels, its place before the eye in metres. */
struct mark {
    float x, y, radius, depth, metres;
    struct vector place;
};

/* What a pixel shows. FACE: that of a cut, from FACES on one of a cell, low and high across each
 * axis; -1: a sphere. */
enum { FACES = 3 };
struct sample {
    float depth, smooth, value, weight;
    int32_t item; /* mark; -1: nothing */
    signed char face;
};

enum { OCCLUSION_SAMPLES = 24 };
struct drawing {
    struct drawing_of of;
    float size; /* of the window, m */
    struct vector eye, away, right, top, light;
    struct mark *mark;
    struct row_bands bands;
    struct sample *sample;
    float *surface, *scratch;
    float around[OCCLUSION_SAMPLES][2]; /* directions on the page, of one at most */
};

BOLIDE_INLINE const struct scene_item *item_of(const struct drawing *d, int32_t mark)
{
    return drawing_item(&d->of, mark);
}

/* The ray of pixel (x, y): where it starts, and its direction, of which a step of one goes one
 * metre away. */
BOLIDE_INLINE struct vector ray_start(const struct drawing *d, float x, float y)
{
    if (!d->of.view->parallel)
        return d->eye;
    const float across = (x - (float)d->of.projection->x) / (float)d->of.projection->scale;
    const float up = ((float)d->of.projection->y - y) / (float)d->of.projection->scale;
    return plus(d->eye, plus(times(d->right, across), times(d->top, up)));
}
BOLIDE_INLINE struct vector ray_direction(const struct drawing *d, float x, float y)
{
    if (d->of.view->parallel)
        return d->away;
    const float across = (x - (float)d->of.projection->x) / (float)d->of.projection->scale;
    const float up = ((float)d->of.projection->y - y) / (float)d->of.projection->scale;
    return plus(d->away, plus(times(d->right, across), times(d->top, up)));
}
BOLIDE_INLINE struct vector place_of(const struct drawing *d, int x, int y, float depth)
{
    const float column = (float)x + 0.5f, row = (float)y + 0.5f;
    return plus(ray_start(d, column, row), times(ray_direction(d, column, row), depth));
}

/* Where the ray of a pixel that is outside of a cut corner's material leaves the corner: how much
 * deeper, and through which face; -1: nowhere; -2: the place is not in the corner. */
BOLIDE_INLINE int leave_corner(const struct drawing *d, struct vector place, struct vector ray,
                               float *deeper)
{
    int face = -1;
    *deeper = INFINITY;
    for (int k = 0; k < d->of.view->cuts; k++) {
        const struct half_space *cut = &d->of.view->cut[k];
        const float at = (&place.x)[cut->axis], rate = (float)cut->sign * (&ray.x)[cut->axis];
        const float inside = (float)cut->sign * at - (float)cut->offset;
        if (inside <= 0.0f)
            return -2;
        if (rate < 0.0f && -inside / rate < *deeper) {
            *deeper = -inside / rate;
            face = k;
        }
    }
    return face;
}

/* Where pixel (x, y) meets MARK: its depth, the squared distance from the middle in radii, and the
 * face that it lies on, as in a sample. */
struct meeting {
    float depth, distance;
    signed char face;
};
BOLIDE_INLINE bool meet(const struct drawing *d, const struct mark *mark, int x, int y,
                        struct meeting *meeting)
{
    const float column = (float)x + 0.5f, row = (float)y + 0.5f;
    const float radius = maximum(mark->radius, 0.5f * d->of.dot);
    const float dx = (column - mark->x) / radius, dy = (row - mark->y) / radius;
    const float distance = dx * dx + dy * dy, widest = DISC * DISC / (SPHERE * SPHERE);
    if (distance >= (d->of.view->cuts ? widest : 1.0f))
        return false;
    *meeting = (struct meeting){mark->depth - mark->metres * sqrtf(maximum(1.0f - distance, 0.0f)),
                                distance, -1};
    if (!d->of.view->cuts)
        return true;
    const struct vector ray = ray_direction(d, column, row);
    struct vector place = plus(ray_start(d, column, row), times(ray, meeting->depth));
    float deeper;
    const int face = leave_corner(d, place, ray, &deeper);
    if (face == -2)
        return distance < 1.0f;
    if (face < 0)
        return false;
    place = plus(place, times(ray, deeper));
    const struct vector off = minus(place, mark->place);
    const float disc = mark->metres * DISC / SPHERE;
    meeting->depth += deeper;
    meeting->distance = dot(off, off) / (disc * disc);
    meeting->face = (signed char)face;
    return meeting->distance < 1.0f;
}

/* The same of a cell, a cube along the axes. */
BOLIDE_INLINE bool meet_cell(const struct drawing *d, const struct mark *mark, int x, int y,
                             struct meeting *meeting)
{
    const float column = (float)x + 0.5f, row = (float)y + 0.5f;
    const float half = 0.5f * mark->metres / SPHERE;
    const struct vector ray = ray_direction(d, column, row), start = ray_start(d, column, row);
    const struct vector from = minus(start, mark->place);
    float enter = -INFINITY, leave = INFINITY, deeper;
    int face = -1;
    for (int axis = 0; axis < 3; axis++) {
        const float rate = (&ray.x)[axis], at = (&from.x)[axis];
        const float per = 1.0f / (fabsf(rate) > 1e-20f ? rate : 1e-20f);
        const float low = (-half - at) * per, high = (half - at) * per;
        const float first = low < high ? low : high, last = low < high ? high : low;
        if (first > enter) {
            enter = first;
            face = FACES + 2 * axis + (low > high);
        }
        leave = last < leave ? last : leave;
    }
    if (enter >= leave)
        return false;
    if (d->of.view->cuts) {
        const int cut = leave_corner(d, plus(start, times(ray, enter)), ray, &deeper);
        if (cut == -1 || (cut >= 0 && enter + deeper >= leave))
            return false;
        enter += cut >= 0 ? deeper : 0.0f;
        face = cut >= 0 ? cut : face;
    }
    *meeting = (struct meeting){enter, 0.0f, (signed char)face};
    return true;
}

/* The squared distance of a place on a cell's face, from the middle of a cell, in reaches of its
 * values; the middles of the layer behind the face are half a cell away from it. */
BOLIDE_INLINE float cell_distance(const struct mark *mark, struct vector place)
{
    const struct vector off = minus(place, mark->place);
    const float reach = mark->metres * BLEND / SPHERE;
    return dot(off, off) / (reach * reach);
}

#endif
