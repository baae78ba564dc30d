/* Places; see place.h. */
#include "model/place.h"

static const double nothing[3] = {-INFINITY, -INFINITY, -INFINITY};

/* What the boundaries of INPUT say of whole faces. */
static void find_faces(const struct simulation_case *input, struct face face[3][2])
{
    const struct face open = {.kind = -1, .at = NAN, .pressure = NAN, .boundary = -1};
    for (int axis = 0; axis < 3; axis++)
        face[axis][0] = face[axis][1] = open;
    if (geometry_power(input->geometry) > 0)
        face[0][0] =
            (struct face){.kind = BOUNDARY_SYMMETRY, .at = 0.0, .pressure = NAN, .boundary = -1};
    for (int b = 0; b < input->boundaries.count; b++) {
        const struct boundary_input *boundary = case_boundary(input, b);
        if (boundary->kind == BOUNDARY_RIGID_BODY || boundary->part.choice)
            continue;
        struct face one = {.kind = boundary->kind,
                           .at = boundary->place,
                           .cuts = !isnan(boundary->at),
                           .pressure = NAN,
                           .boundary = b};
        if (field_is_given(&boundary->pressure))
            one.pressure = boundary->pressure.constant;
        if (boundary->side != SIDE_HIGH)
            face[boundary->axis][0] = one;
        one.at = boundary->side < 0 ? boundary->opposite : boundary->place;
        if (boundary->side != SIDE_LOW)
            face[boundary->axis][1] = one;
    }
}

struct place place_whole(const struct simulation_case *input)
{
    struct place place = {.input = input,
                          .box = {vector_at(nothing), vec3_scale(-1.0, vector_at(nothing))},
                          .resolution = input->resolution};
    place.blocked = (struct bounds){place.box.high, place.box.low};
    for (int k = 0; k < PLACE_PINNED; k++)
        place.pinned[k] = place.blocked;
    find_faces(input, place.face);
    return place;
}

bool place_blocks(const struct place *place, struct vec3 at)
{
    const struct vec3 low = place->blocked.low, high = place->blocked.high;
    const bool inside = at.x >= low.x && at.x <= high.x && at.y >= low.y && at.y <= high.y &&
                        at.z >= low.z && at.z <= high.z;
    return inside || rigid_body_at(place->input, at) >= 0;
}

bool place_blocks_any(const struct place *place)
{
    return place->blocked.low.x < place->blocked.high.x || has_rigid_body(place->input);
}

bool place_has_face(const struct place *place, bool (*test)(const struct face *face))
{
    bool any = false;
    for (int axis = 0; axis < 3; axis++)
        any |= test(&place->face[axis][0]) || test(&place->face[axis][1]);
    return any;
}
