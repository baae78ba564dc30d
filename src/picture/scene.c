/* From a frame to what is drawn of it, and its colours. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "picture/album_internal.h"

/* Of fragments the heaviest have colours. */
enum { FRAGMENT_COLOURS = 12 };

struct colour colouring_of(const struct colouring *colouring, double value)
{
    static const struct colour dust = {0.25, 0.25, 0.25}, small = {0.78, 0.78, 0.78};
    const struct colour_scale *scale = colouring->scale;
    if (scale) {
        const double place = colour_place(scale, value);
        return isnan(place) ? colour_of(scale, value)
                            : colouring->shade[(int)(place * (COLOUR_SHADES - 1) + 0.5)];
    }
    const int number = isfinite(value) ? (int)value : 0;
    if (!colouring->fragments)
        return colour_of_category(number);
    return number < 1 ? dust : number > FRAGMENT_COLOURS ? small : colour_of_category(number - 1);
}

void colouring_prepare(struct colouring *colouring)
{
    for (int i = 0; i < COLOUR_SHADES && colouring->scale; i++)
        colouring->shade[i] = colour_at_place(colouring->scale, (double)i / (COLOUR_SHADES - 1));
}

uint32_t pixel_of(struct colour colour, double shade)
{
    return 0xff000000u | (uint32_t)(colour.red * shade * 255.0 + 0.5) << 16 |
           (uint32_t)(colour.green * shade * 255.0 + 0.5) << 8 |
           (uint32_t)(colour.blue * shade * 255.0 + 0.5);
}

static bool is_outside(const struct view *view, const float place[3])
{
    for (int axis = 0; axis < view->dimension; axis++)
        if (axis != view->normal &&
            (place[axis] < view->window[axis].low || place[axis] > view->window[axis].high))
            return true;
    return false;
}

/* Whether the section shows a member at PLACE: in 3-D one that the plane cuts, two layers of a
 * tie. */
static bool is_in_section(const struct view *view, const float place[3], float diameter, bool cell)
{
    if (view->normal < 0)
        return true;
    const double off = fabs(place[view->normal] - view->middle);
    return off <= (view->slab > 0.0 ? 0.5 * view->slab : (cell ? 0.500001 : 0.75) * diameter);
}

static float value_of(const struct panel *panel, const struct frame_group *group,
                      const struct frame_field *field, int64_t i)
{
    if (field)
        return field->value[i];
    if (!panel->category || panel->fragments)
        return NAN;
    return !strcmp(panel->field, "material") ? group->material[i] : group->body[i];
}

struct error *scene_take(const struct album *album, const struct picture *picture,
                         const struct panel *panel, const struct frame *frame, struct scene *scene,
                         int64_t *outside)
{
    const struct view *view = &picture->view;
    scene->item = memory_allocate((size_t)frame_members(frame) * sizeof *scene->item + 1);
    scene->count = *outside = 0;
    if (!scene->item)
        return out_of_memory_for("a picture");
    bool particles = false;
    for (int g = 0; g < frame->groups; g++)
        particles |= frame->group[g].count && !frame->group[g].cell_dimension;
    for (int g = 0; g < frame->groups; g++) {
        const struct frame_group *group = &frame->group[g];
        const struct frame_field *field = frame_field(group, panel->field);
        const bool cell = group->cell_dimension > 0;
        /* In 3-D cells would hide the particles. */
        if (cell && particles && view->perspective)
            continue;
        for (int64_t i = 0; i < group->count; i++) {
            const int body =
                group->body[i] < album->bodies.count ? group->body[i] : album->bodies.count;
            const float diameter = cell ? group->diameter[i]
                                        : stretch_apply(&album->stretch[body], group->diameter[i]);
            if (!picture_has_body(album, picture->input, group->body[i]) ||
                !is_in_section(view, group->position[i], diameter, cell))
                continue;
            const bool out = is_outside(view, group->position[i]);
            *outside += out;
            if (out && view->perspective) /* it would hang beside the box */
                continue;
            struct scene_item *item = &scene->item[scene->count++];
            *item = (struct scene_item){.diameter = diameter,
                                        .apart = diameter < group->diameter[i],
                                        .value = value_of(panel, group, field, i),
                                        .body = cell ? UINT16_MAX : group->body[i],
                                        .cell = cell};
            memcpy(item->place, group->position[i], sizeof item->place);
        }
    }
    return NULL;
}
