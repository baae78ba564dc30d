/* Samples the surface of a body; see surface.h. Cells of the size of a particle at the surface are
 * divided, and each face between a part inside the body and one outside counts. The normal is that
 * of the shape itself, from where lines across the face leave the shape. */

#include <assert.h>
#include <stdlib.h>

#include "base/memory.h"
#include "model/surface_sampler.h"
#include "model/walk.h"

/* Parts of a cell along each axis, by dimension. */
static const int parts_of_cell[] = {1, 1, 16, 4};

/* Cells between a particle and what of the surface it may carry. */
enum { SAMPLER_REACH = 2 };

/* Elements of a particle whose normals are as near to each other become one. */
static const double SAME_NORMAL = 0.99;

static struct vec3 moved(struct vec3 at, int axis, double by)
{
    at.x += axis == 0 ? by : 0.0;
    at.y += axis == 1 ? by : 0.0;
    at.z += axis == 2 ? by : 0.0;
    return at;
}

static bool body_has(const struct sampler *s, int body, struct vec3 at)
{
    return shape_inside(&case_body(s->input, body)->shape, at);
}

static bool is_inside(const struct sampler *s, struct vec3 at)
{
    if (geometry_power(s->input->geometry) > 0 &&
        !(at.x > 0.0 && at.y > s->bounds.low.y && at.y < s->bounds.high.y))
        return false;
    if (!body_has(s, s->body, at))
        return false;
    for (int k = 0; k < s->others; k++)
        if (replaces(s->replacements, s->other[k], s->body) && body_has(s, s->other[k], at))
            return false;
    return true;
}

/* What is at a place outside the body. */
static enum surface_cover cover_at(const struct sampler *s, struct vec3 at)
{
    const double x[3] = {at.x, at.y, at.z};
    if (geometry_power(s->input->geometry) > 0 && at.x <= 0.0)
        return SURFACE_AT_WALL;
    for (int axis = 0; axis < s->dimension; axis++)
        for (int side = 0; side < 2; side++) {
            const struct face *face = &s->place->face[axis][side];
            if (face->boundary >= 0 && (side ? x[axis] > face->at : x[axis] < face->at))
                return SURFACE_AT_WALL;
        }
    for (int k = 0; k < s->others; k++)
        if (body_has(s, s->other[k], at))
            return SURFACE_COVERED;
    return SURFACE_FREE;
}

/* How far from AT along AXIS towards SIGN the body ends, near GUESS; NAN where nothing shows. */
static double crossing(const struct sampler *s, struct vec3 at, int axis, double sign, double guess)
{
    enum { TRIES = 8, HALVES = 14 };
    const double step = 0.5 * s->step[axis];
    double in = guess, out = guess;
    if (is_inside(s, moved(at, axis, sign * guess)))
        for (int k = 0; k < TRIES && in == out; k++) {
            if (is_inside(s, moved(at, axis, sign * (in + step))))
                in = out = in + step;
            else
                out = in + step;
        }
    else
        for (int k = 0; k < TRIES && in == out; k++) {
            if (is_inside(s, moved(at, axis, sign * (out - step))))
                in = out - step;
            else
                in = out = out - step;
        }
    if (in == out)
        return NAN;
    for (int k = 0; k < HALVES; k++) {
        const double middle = 0.5 * (in + out);
        if (is_inside(s, moved(at, axis, sign * middle)))
            in = middle;
        else
            out = middle;
    }
    return 0.5 * (in + out);
}

/* The gradient, outward, of what is inside where the line from AT along AXIS leaves the body at the
 * distance END: 1 along the axis and the slopes across it; a slope that nothing shows is STEEP. */
static struct vec3 gradient_at(const struct sampler *s, struct vec3 at, int axis, double sign,
                               double end)
{
    static const double smallest = 3e-4, /* more than the error of bisection */
        steep = 1e3;
    struct vec3 gradient = moved((struct vec3){0.0, 0.0, 0.0}, axis, sign);
    for (int across = 0; across < s->dimension; across++) {
        if (across == axis)
            continue;
        const double away = 0.5 * s->step[across];
        const double before = crossing(s, moved(at, across, -away), axis, sign, end),
                     after = crossing(s, moved(at, across, away), axis, sign, end);
        const double low = (end - before) / away, high = (after - end) / away;
        double slope = isnan(before) ? high : isnan(after) ? low : 0.5 * (low + high);
        if (isnan(slope))
            slope = is_inside(s, moved(at, across, -s->step[across])) ? -steep : steep;
        if (fabs(slope) > smallest)
            gradient = moved(gradient, across, -slope);
    }
    return gradient;
}

static int steepest_axis(struct vec3 v)
{
    const double x = fabs(v.x), y = fabs(v.y), z = fabs(v.z);
    return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

/* The outward normal there, from lines along the axis that it is nearest to. */
static struct vec3 normal_at(const struct sampler *s, struct vec3 at, int axis, double sign,
                             double end)
{
    struct vec3 normal = gradient_at(s, at, axis, sign, end);
    const int best = steepest_axis(normal);
    if (best != axis) {
        const double to = vec3_at(normal, best) > 0.0 ? 1.0 : -1.0,
                     there = crossing(s, at, best, to, 0.0);
        if (!isnan(there))
            normal = gradient_at(s, at, best, to, there);
    }
    return vec3_scale(1.0 / sqrt(vec3_dot(normal, normal)), normal);
}

/* The cells within REACH of AT, from LOW to HIGH. */
static void cells_within(const struct sampler *s, const int64_t at[3], int64_t reach,
                         int64_t low[3], int64_t high[3])
{
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = at[axis] - (axis < s->dimension ? reach : 0);
        high[axis] = at[axis] + (axis < s->dimension ? reach : 0);
    }
}

static int32_t first_carrier(const struct sampler *s, const int64_t at[3])
{
    static const int none[3] = {0, 0, 0};
    const int64_t cell = sampler_cell(s, at, none);
    return cell < 0 ? -1 : s->cell[cell];
}

/* The carrier nearest to PLACE in the cells around it, or else in those around these. */
static int32_t nearest_carrier(const struct sampler *s, struct vec3 place)
{
    int64_t at[3], low[3], high[3], k[3];
    int32_t found = -1;
    double least = INFINITY;
    sampler_cell_of(s, place, at);
    for (int64_t reach = 1; reach <= SAMPLER_REACH && found < 0; reach++) {
        cells_within(s, at, reach, low, high);
        for (k[0] = low[0]; k[0] <= high[0]; k[0]++)
            for (k[1] = low[1]; k[1] <= high[1]; k[1]++)
                for (k[2] = low[2]; k[2] <= high[2]; k[2]++)
                    for (int32_t c = first_carrier(s, k); c >= 0; c = s->carrier[c].next) {
                        const double away = sampler_distance(s, &s->carrier[c], place);
                        if (away < least || (away == least && c < found)) {
                            least = away;
                            found = c;
                        }
                    }
    }
    return found;
}

/* A face along AXIS of a part of a cell with its centre at AT, inside the body. */
struct cell_side {
    struct vec3 at;
    int axis;
    double sign, end; /* the body ends so far from the centre */
    struct vec3 normal;
    enum surface_cover cover;
};

static bool fits(const struct piece *piece, const struct cell_side *face)
{
    const struct vec3 sum = piece->element.start.normal;
    return piece->element.cover == face->cover &&
           vec3_dot(sum, face->normal) > SAME_NORMAL * sqrt(vec3_dot(sum, sum));
}

/* Whether the body ends at the plane of PIECE, which fills in FACE without a search. */
static bool is_on_plane(const struct sampler *s, const struct piece *piece, struct cell_side *face)
{
    static const double steepest = 0.1, margin = 1e-3;
    const double slope = face->sign * vec3_at(piece->normal, face->axis),
                 step = s->step[face->axis],
                 end = vec3_dot(vec3_sub(piece->point, face->at), piece->normal) / slope;
    if (piece->element.cover != face->cover || !(slope > steepest) ||
        !is_inside(s, moved(face->at, face->axis, face->sign * (end - margin * step))) ||
        is_inside(s, moved(face->at, face->axis, face->sign * (end + margin * step))))
        return false;
    face->end = end;
    face->normal = piece->normal;
    return true;
}

/* The piece of the carrier OF that FACE, which is then known, is a part of; -1: there is none. */
static int32_t find_piece(const struct sampler *s, int32_t of, struct cell_side *face)
{
    int32_t found = s->carrier[of].element;
    while (found >= 0 && !is_on_plane(s, &s->piece[found], face))
        found = s->piece[found].next;
    if (found >= 0)
        return found;
    face->end = crossing(s, face->at, face->axis, face->sign, 0.0);
    if (isnan(face->end))
        return -1;
    face->normal = normal_at(s, face->at, face->axis, face->sign, face->end);
    found = s->carrier[of].element;
    while (found >= 0 && !fits(&s->piece[found], face))
        found = s->piece[found].next;
    return found;
}

static void add_face(struct sampler *s, struct vec3 at, int axis, double sign)
{
    const int32_t of = nearest_carrier(s, at);
    struct cell_side face = {.at = at,
                             .axis = axis,
                             .sign = sign,
                             .cover = cover_at(s, moved(at, axis, sign * s->step[axis]))};
    if (of < 0)
        return;
    int32_t found = find_piece(s, of, &face);
    if (isnan(face.end))
        return;
    if (found < 0) {
        s->out_of_memory |=
            s->pieces == INT32_MAX || !memory_reserve((void **)&s->piece, &s->piece_capacity,
                                                      s->pieces + 1, s->pieces, sizeof *s->piece);
        if (s->out_of_memory)
            return;
        found = (int32_t)s->pieces++;
        s->piece[found] = (struct piece){.element = {.site = of, .cover = face.cover},
                                         .point = moved(at, axis, sign * face.end),
                                         .normal = face.normal,
                                         .next = s->carrier[of].element};
        s->carrier[of].element = found;
    }
    double size = 1.0;
    for (int other = 0; other < s->dimension; other++)
        size *= other == axis ? 1.0 : s->step[other];
    struct piece *piece = &s->piece[found];
    struct surface_state *sum = &piece->element.start;
    const double weight = size * maximum(sign * vec3_at(face.normal, axis), 1e-6);
    piece->weight += weight;
    sum->area = moved(sum->area, axis, sign * size);
    sum->normal = vec3_add(sum->normal, vec3_scale(weight, face.normal));
    sum->place = vec3_add(sum->place, vec3_scale(weight, moved(at, axis, sign * face.end)));
}

/* Whether a part of the surface may be in the cell AT: it has a particle, and a cell around it has
 * none; or the other way round, up to two cells away, as at the tip of an edge. */
static bool is_at_surface(const struct sampler *s, const int64_t at[3])
{
    const bool has = first_carrier(s, at) >= 0;
    int64_t low[3], high[3], k[3];
    cells_within(s, at, has ? 1 : SAMPLER_REACH, low, high);
    for (k[0] = low[0]; k[0] <= high[0]; k[0]++)
        for (k[1] = low[1]; k[1] <= high[1]; k[1]++)
            for (k[2] = low[2]; k[2] <= high[2]; k[2]++)
                if ((first_carrier(s, k) >= 0) != has)
                    return true;
    return false;
}

static void sample_cell(struct sampler *s, const int64_t cell[3])
{
    const int parts = parts_of_cell[s->dimension];
    int count[3] = {1, 1, 1}, k[3];
    assert(1 <= s->dimension && s->dimension <= 3);
    for (int axis = 0; axis < s->dimension; axis++)
        count[axis] = parts;
    for (k[0] = 0; k[0] < count[0]; k[0]++)
        for (k[1] = 0; k[1] < count[1]; k[1]++)
            for (k[2] = 0; k[2] < count[2]; k[2]++) {
                struct vec3 at = {0.0, 0.0, 0.0};
                for (int axis = 0; axis < s->dimension; axis++)
                    at = moved(at, axis,
                               s->origin[axis] + s->spacing[axis] * (double)cell[axis] +
                                   s->step[axis] * (k[axis] + 0.5));
                if (!is_inside(s, at))
                    continue;
                for (int face = 0; face < 2 * s->dimension; face++) {
                    const double sign = face % 2 ? 1.0 : -1.0;
                    if (!is_inside(s, moved(at, face / 2, sign * s->step[face / 2])))
                        add_face(s, at, face / 2, sign);
                }
            }
}

static void sample_cells(struct sampler *s)
{
    int64_t at[3];
    for (at[0] = 0; at[0] < s->count[0]; at[0]++)
        for (at[1] = 0; at[1] < s->count[1]; at[1]++)
            for (at[2] = 0; at[2] < s->count[2]; at[2]++)
                if (is_at_surface(s, at))
                    sample_cell(s, at);
}

/* The grid of cells, which are those of the particles on a square lattice, and one more around. */
static bool make_cells(struct sampler *s, const struct lattice *lattice)
{
    const double low[3] = {s->bounds.low.x, s->bounds.low.y, s->bounds.low.z},
                 high[3] = {s->bounds.high.x, s->bounds.high.y, s->bounds.high.z},
                 spacing[3] = {lattice->spacing.x, lattice->spacing.y, lattice->spacing.z};
    s->cells = 1;
    for (int axis = 0; axis < 3; axis++) {
        s->count[axis] = 1;
        s->spacing[axis] = s->step[axis] = 1.0;
        s->origin[axis] = -0.5;
        if (axis < s->dimension) {
            const double wanted = lattice->kind == LATTICE_RINGS ? lattice->arc : spacing[axis];
            const double cells = maximum(1.0, nearbyint((high[axis] - low[axis]) / wanted));
            s->spacing[axis] = (high[axis] - low[axis]) / cells;
            s->step[axis] = s->spacing[axis] / parts_of_cell[s->dimension];
            s->origin[axis] = low[axis] - s->spacing[axis];
            s->count[axis] = (int64_t)cells + 2;
        }
        s->cells *= s->count[axis];
    }
    s->cell = malloc((size_t)s->cells * sizeof *s->cell);
    for (int64_t k = 0; s->cell && k < s->cells; k++)
        s->cell[k] = -1;
    return s->cell != NULL;
}

static bool take_carrier(struct sampler *s, int64_t site, struct vec3 place)
{
    static const int none[3] = {0, 0, 0};
    int64_t at[3];
    if (s->carriers == INT32_MAX ||
        !memory_reserve((void **)&s->carrier, &s->carrier_capacity, s->carriers + 1, s->carriers,
                        sizeof *s->carrier))
        return false;
    sampler_cell_of(s, place, at);
    int32_t *first = &s->cell[sampler_cell(s, at, none)];
    s->carrier[s->carriers] = (struct carrier){place, site, *first, -1};
    *first = (int32_t)s->carriers++;
    return true;
}

static bool bounds_touch(const struct bounds *a, const struct bounds *b, const double margin[3])
{
    return a->low.x <= b->high.x + margin[0] && b->low.x <= a->high.x + margin[0] &&
           a->low.y <= b->high.y + margin[1] && b->low.y <= a->high.y + margin[1] &&
           a->low.z <= b->high.z + margin[2] && b->low.z <= a->high.z + margin[2];
}

/* The bodies that may touch this one. */
static bool find_others(struct sampler *s)
{
    s->other = memory_allocate((size_t)s->input->bodies.count * sizeof *s->other);
    for (int body = 0; s->other && body < s->input->bodies.count; body++) {
        const struct bounds bounds = shape_bounds(&case_body(s->input, body)->shape);
        if (body != s->body && bounds_touch(&s->bounds, &bounds, s->spacing))
            s->other[s->others++] = body;
    }
    return s->other != NULL;
}

/* The particles of the body: all of them on every rank. */
static struct error *find_carriers(struct sampler *s, const struct overlaps *overlaps)
{
    const struct ranks alone = ranks_alone();
    struct walk walk;
    struct error *error = walk_begin(&walk, overlaps, s->body, &alone);
    int64_t site;
    struct vec3 place;
    if (!error && !(make_cells(s, &walk.lattice) && find_others(s)))
        error = out_of_memory_for("the surface of a body");
    while (!error && walk_next(&walk, &site, &place))
        if (!take_carrier(s, site, place))
            error = out_of_memory_for("the surface of a body");
    walk_end(&walk);
    return error;
}

struct error *surface_create(const struct place *place, int body, struct body_surface *surface)
{
    const struct simulation_case *input = place->input;
    struct overlaps overlaps;
    struct sampler s = {.place = place,
                        .input = input,
                        .body = body,
                        .dimension = (int)input->dimension,
                        .bounds = place_bounds(place, body)};
    *surface = (struct body_surface){
        .body = body, .dimension = s.dimension, .round = input->geometry == GEOMETRY_AXISYMMETRIC};
    struct error *error = overlaps_make(place, &overlaps);
    s.replacements = &overlaps.replacements;
    if (!error)
        error = find_carriers(&s, &overlaps);
    if (!error) {
        sample_cells(&s);
        for (int axis = 0; axis < s.dimension; axis++)
            surface->spacing = maximum(surface->spacing, s.spacing[axis]);
        if (s.out_of_memory || !sampler_make_surface(&s, surface))
            error = out_of_memory_for("the surface of a body");
    }
    overlaps_free(&overlaps);
    free(s.other);
    free(s.cell);
    free(s.carrier);
    free(s.piece);
    return error;
}
