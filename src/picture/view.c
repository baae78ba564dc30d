/* What of space a picture shows, and from where: once for all frames, from the first and the
 * last. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "picture/album_internal.h"

/* Of the mass of each body at the end so much is outside on each side. */
static const double STRAY = 0.005;
static const double MARGIN = 0.02;

/* What of a frame the search for a view looks at. */
struct bodies {
    struct range extent[3];        /* with the members' size */
    double diameter;               /* of the largest */
    int fastest;                   /* body; -1: none moves */
    double centre[3], velocity[3]; /* of it */
    bool particles, cells;
};

int view_images(const struct view *view)
{
    int images = 1;
    for (int axis = 0; axis < 3; axis++)
        images <<= view->mirrored[axis] && axis != view->normal;
    return images;
}

void view_image(const struct view *view, int image, double sign[3])
{
    for (int axis = 0, bit = 0; axis < 3; axis++) {
        sign[axis] = 1.0;
        if (view->mirrored[axis] && axis != view->normal)
            sign[axis] = image >> bit++ & 1 ? -1.0 : 1.0;
    }
}

void view_reflect(const struct view *view, const double sign[3], const float place[3], double at[3])
{
    for (int axis = 0; axis < 3; axis++)
        at[axis] = sign[axis] > 0.0 ? place[axis] : 2.0 * view->mirror_at[axis] - place[axis];
}

bool view_project(const struct view *view, const struct projection *projection,
                  const double place[3], double *x, double *y)
{
    double depth = 0.0, across = 0.0, up = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        const double from_eye = place[axis] - view->eye[axis];
        depth -= from_eye * view->direction[axis];
        across += from_eye * view->right[axis];
        up += from_eye * view->top[axis];
    }
    const double scale = view->parallel ? projection->scale : projection->scale / depth;
    *x = projection->x + scale * across;
    *y = projection->y - scale * up;
    return depth > 0.0;
}

static void include_member(struct bodies *bodies, const struct frame_group *group, int64_t i)
{
    const double half = 0.5 * group->diameter[i];
    for (int axis = 0; axis < 3; axis++) {
        range_include(&bodies->extent[axis], group->position[i][axis] - half);
        range_include(&bodies->extent[axis], group->position[i][axis] + half);
    }
    bodies->diameter = maximum(bodies->diameter, group->diameter[i]);
    bodies->cells |= group->cell_dimension > 0;
}

struct mean {
    double mass, place[3], momentum[3];
};

static void find_fastest(const struct mean *mean, int count, struct bodies *bodies)
{
    double fastest = 0.0;
    for (int b = 0; b < count; b++) {
        double speed = 0.0;
        for (int axis = 0; axis < 3; axis++)
            speed += square(mean[b].momentum[axis] / mean[b].mass);
        if (!(mean[b].mass > 0.0) || !(speed > fastest * (1.0 + 1e-9)))
            continue;
        fastest = speed;
        bodies->fastest = b;
        for (int axis = 0; axis < 3; axis++) {
            bodies->centre[axis] = mean[b].place[axis] / mean[b].mass;
            bodies->velocity[axis] = mean[b].momentum[axis] / mean[b].mass;
        }
    }
}

static struct error *look(const struct album *album, const struct picture *picture,
                          const struct frame *frame, struct bodies *bodies)
{
    static const char *const components[] = {"velocity.x", "velocity.y", "velocity.z"};
    const int count = album->bodies.count + 1;
    struct mean *mean = memory_allocate((size_t)count * sizeof *mean);
    if (!mean)
        return out_of_memory_for("a picture");
    *bodies =
        (struct bodies){.extent = {range_empty(), range_empty(), range_empty()}, .fastest = -1};
    for (int g = 0; g < frame->groups; g++) {
        const struct frame_group *group = &frame->group[g];
        const struct frame_field *velocity[3];
        for (int axis = 0; axis < 3; axis++)
            velocity[axis] = frame_field(group, components[axis]);
        bodies->particles |= group->count > 0 && group->cell_dimension == 0;
        for (int64_t i = 0; i < group->count; i++) {
            const int body = group->body[i] < count ? group->body[i] : count - 1;
            if (!picture_has_body(album, picture->input, group->body[i]))
                continue;
            include_member(bodies, group, i);
            if (group->cell_dimension)
                continue;
            mean[body].mass += group->mass[i];
            for (int axis = 0; axis < 3 && velocity[axis]; axis++) {
                mean[body].place[axis] += group->mass[i] * group->position[i][axis];
                mean[body].momentum[axis] += group->mass[i] * velocity[axis]->value[i];
            }
        }
    }
    find_fastest(mean, count, bodies);
    free(mean);
    return NULL;
}

/* Percentiles by mass of the places in FRAME. */
static struct error *look_at_end(const struct album *album, const struct picture *picture,
                                 const struct frame *frame, struct range range[3])
{
    const size_t members = (size_t)frame_members(frame);
    const bool apart = album->bodies.count <= BODIES_APART;
    float *at = memory_allocate((2 * members + 1) * sizeof *at), *mass = at + members;
    uint8_t *body = memory_allocate(members + 1);
    struct error *error = at && body ? NULL : out_of_memory_for("a picture");
    for (int axis = 0; axis < 3 && !error; axis++) {
        struct range extremes = range_empty();
        int64_t count = 0;
        for (int g = 0; g < frame->groups; g++)
            for (int64_t i = 0; i < frame->group[g].count; i++) {
                const struct frame_group *group = &frame->group[g];
                if (!picture_has_body(album, picture->input, group->body[i]))
                    continue;
                at[count] = group->position[i][axis];
                mass[count] = group->mass[i];
                body[count++] = group->cell_dimension ? 255 : apart ? (uint8_t)group->body[i] : 0;
            }
        error = spread_find(at, mass, body, count, STRAY, 1.0 - STRAY, &range[axis], &extremes);
    }
    free(at);
    free(body);
    return error;
}

/* Whether a face is a plane of symmetry, not a wall: bodies that touch it do not fly at it, and
 * the opposite face is open. */
static bool is_mirror(const struct album *album, const struct bodies *bodies, int axis, int side)
{
    const struct face *face = &album->place.face[axis][side];
    const struct face *other = &album->place.face[axis][!side];
    const struct range *extent = &bodies->extent[axis];
    if (face->kind == BOUNDARY_SYMMETRY)
        return true;
    if (face->kind != BOUNDARY_REFLECTING || face_closes(other) ||
        other->kind == BOUNDARY_PERIODIC || !bodies->particles)
        return false;
    const double edge = side ? extent->high : extent->low;
    double speed = 0.0;
    for (int k = 0; k < 3; k++)
        speed += square(bodies->velocity[k]);
    return fabs(edge - face->at) <= bodies->diameter &&
           square(bodies->velocity[axis]) <= 1e-6 * speed;
}

static void find_mirrors(const struct album *album, const struct bodies *bodies, bool wanted,
                         struct view *view)
{
    for (int axis = 0; axis < album->dimension && wanted; axis++)
        for (int side = 0; side < 2 && !view->mirrored[axis]; side++)
            if (is_mirror(album, bodies, axis, side)) {
                view->mirrored[axis] = true;
                view->mirror_at[axis] = album->place.face[axis][side].at;
            }
}

static void find_window(const struct picture_input *input, const struct bodies *bodies,
                        const struct range end[3], struct view *view)
{
    for (int axis = 0; axis < 3; axis++) {
        struct range *own = &view->computed[axis];
        *own = bodies->extent[axis];
        if (!bodies->cells) {
            range_include(own, end[axis].low - 0.5 * bodies->diameter);
            range_include(own, end[axis].high + 0.5 * bodies->diameter);
        }
        if (!(own->low < own->high))
            *own = (struct range){0.0, 1.0};
        const double margin = bodies->cells ? 0.0 : MARGIN * (own->high - own->low),
                     at = view->mirror_at[axis];
        const bool low = view->mirrored[axis] && own->low > at - bodies->diameter;
        const bool high = view->mirrored[axis] && own->high < at + bodies->diameter;
        own->low = low ? at : own->low - margin;
        own->high = high ? at : own->high + margin;
        view->window[axis] = *own;
        if (view->mirrored[axis]) {
            const double reach = maximum(own->high - at, at - own->low);
            view->window[axis] = (struct range){at - reach, at + reach};
        }
        if (input->window.from.count > axis)
            view->window[axis].low = input->window.from.at[axis];
        if (input->window.to.count > axis)
            view->window[axis].high = input->window.to.at[axis];
    }
}

/* The axis, 0 to 2, and the sign, that points up. */
static int find_up(const struct picture_input *input, const struct bodies *bodies, double *sign)
{
    *sign = 1.0;
    if (input->up >= 0) {
        *sign = input->up < 3 ? 1.0 : -1.0;
        return input->up % 3;
    }
    int up = 2;
    if (bodies->fastest < 0)
        return up;
    for (int axis = 0; axis < 2; axis++)
        if (fabs(bodies->velocity[axis]) > fabs(bodies->velocity[up]) * (1.0 + 1e-9))
            up = axis;
    *sign = bodies->velocity[up] > 0.0 ? -1.0 : 1.0;
    return up;
}

static void find_section(const struct picture_input *input, const struct bodies *bodies,
                         struct view *view)
{
    double sign;
    const int up = find_up(input, bodies, &sign);
    view->normal = up == 1 ? 2 : 1;
    view->middle = 0.5 * (view->window[view->normal].low + view->window[view->normal].high);
    if (bodies->fastest >= 0)
        view->middle = bodies->centre[view->normal];
    for (int axis = 2; axis >= 0; axis--)
        if (view->mirrored[axis]) {
            view->normal = axis;
            view->middle = view->mirror_at[axis];
        }
    for (int axis = 0; axis < 3; axis++)
        if (!isnan(input->plane.at[axis])) {
            view->normal = axis;
            view->middle = input->plane.at[axis];
        }
    view->slab = isnan(input->slab) ? 0.0 : input->slab;
    const bool free = up != view->normal;
    view->up = free ? up : view->normal == 2 ? 1 : 2;
    view->up_sign = free ? sign : 1.0;
    view->across = 3 - view->normal - view->up;
}

static void cross_of(const double a[3], const double b[3], double out[3])
{
    for (int axis = 0; axis < 3; axis++) {
        const int next = (axis + 1) % 3, last = (axis + 2) % 3;
        out[axis] = a[next] * b[last] - a[last] * b[next];
    }
}

/* Directions of a perspective: azimuth about the axis that is up, elevation above its plane. */
static void find_directions(const struct picture_input *input, const struct bodies *bodies,
                            struct view *view)
{
    const double degree = acos(-1.0) / 180.0;
    const double azimuth = (input->direction.count > 0 ? input->direction.at[0] : 30.0) * degree;
    const double elevation = (input->direction.count > 1 ? input->direction.at[1] : 25.0) * degree;
    double sign, up[3] = {0.0}, first[3] = {0.0}, second[3];
    const int axis = find_up(input, bodies, &sign);
    up[axis] = sign;
    first[(axis + 1) % 3] = 1.0;
    cross_of(up, first, second);
    for (int k = 0; k < 3; k++)
        view->direction[k] = cos(elevation) * (cos(azimuth) * first[k] + sin(azimuth) * second[k]) +
                             sin(elevation) * up[k];
    const double away[3] = {-view->direction[0], -view->direction[1], -view->direction[2]};
    cross_of(away, up, view->right);
    double length = 0.0;
    for (int k = 0; k < 3; k++)
        length += square(view->right[k]);
    for (int k = 0; k < 3; k++)
        view->right[k] /= sqrt(maximum(length, 1e-30));
    cross_of(view->right, away, view->top);
    view->up = axis;
    view->up_sign = sign;
}

static void put_cut(struct view *view, int axis, double sign, double at)
{
    if (view->cuts < 3)
        view->cut[view->cuts++] = (struct half_space){axis, sign, sign * at};
}

/* "+x": everything on the positive side of the plane of symmetry, or of the middle. */
static void add_cut(struct view *view, int axis, double sign)
{
    const double middle = view->mirrored[axis]
                              ? view->mirror_at[axis]
                              : 0.5 * (view->window[axis].low + view->window[axis].high);
    put_cut(view, axis, sign, middle);
}

/* Whether a gas has one wall across AXIS, at the side away from the eye, to which SIGN points: a
 * ground, or a plane of symmetry of a blast. What happens there is most of the event. */
static bool has_wall(const struct album *album, int axis, double sign, double *at)
{
    const struct face *face = album->place.face[axis];
    const int away = sign > 0.0 ? 0 : 1;
    *at = face[away].at;
    return face_closes(&face[away]) && !face_closes(&face[1 - away]);
}

static struct error *find_cuts(const struct album *album, const struct picture_input *input,
                               struct view *view)
{
    for (int i = 0; i < input->cut.count; i++) {
        const char *text = input->cut.names[i];
        if (!strcmp(text, "none"))
            return NULL;
        if ((*text != '+' && *text != '-') || text[1] < 'x' || text[1] > 'z' || text[2])
            return error_new(ERROR_INPUT, "\"%s\" is no side: +x, -x, +y, -y, +z, -z or none",
                             text);
        add_cut(view, text[1] - 'x', *text == '+' ? 1.0 : -1.0);
    }
    if (input->cut.count)
        return NULL;
    for (int axis = 0; axis < 3; axis++) {
        const double sign = view->direction[axis] > 0.0 ? 1.0 : -1.0;
        double wall;
        if (!view->mirrored[axis] && album->gas_alone && has_wall(album, axis, sign, &wall))
            put_cut(view, axis, sign, wall + sign * 0.5 * view->diameter);
        else if (view->mirrored[axis] || (album->gas_alone && axis != view->up))
            add_cut(view, axis, sign);
    }
    return NULL;
}

/* The eye of a perspective, so far away that near and far edges differ by less than a half. */
static void find_eye(struct view *view)
{
    double size = 0.0;
    for (int axis = 0; axis < 3; axis++)
        size += square(view->window[axis].high - view->window[axis].low);
    for (int axis = 0; axis < 3; axis++)
        view->eye[axis] = 0.5 * (view->window[axis].low + view->window[axis].high) +
                          2.4 * sqrt(size) * view->direction[axis];
}

/* Material points in a cell or next to each other belong together, as far as they are stretched. */
static double fill_of(const struct simulation_case *input)
{
    const struct choice *solver = input->solver.choice;
    return !solver || !strcmp(solver->name, "sph") ? 0.8 : 1.6;
}

struct error *view_find(const struct album *album, const struct frame *first,
                        const struct frame *last, struct picture *picture)
{
    const struct picture_input *input = picture->input;
    struct view *view = &picture->view;
    struct bodies bodies = {0};
    struct range end[3] = {range_empty(), range_empty(), range_empty()};
    *view = (struct view){.dimension = album->dimension,
                          .across = 0,
                          .up = 1,
                          .normal = -1,
                          .up_sign = 1.0,
                          .dot = input->dot,
                          .fill = fill_of(album->input),
                          .outlines = input->outlines,
                          .parallel = input->parallel};
    TRY(look(album, picture, first, &bodies));
    TRY(look_at_end(album, picture, last, end));
    view->perspective = album->dimension == 3 && input->view != VIEW_SECTION;
    view->diameter = bodies.diameter;
    find_mirrors(album, &bodies, input->mirror && album->dimension > 1, view);
    find_window(input, &bodies, end, view);
    if (view->perspective) {
        find_directions(input, &bodies, view);
        TRY(find_cuts(album, input, view));
        find_eye(view);
    } else if (album->dimension == 3) {
        find_section(input, &bodies, view);
    }
    return NULL;
}
