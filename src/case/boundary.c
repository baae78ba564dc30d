/* The domain and what is outside its faces: keys, what the keys must be, where the faces are, and
 * the state of what flows in. */
#include "case/checking.h"
#include "material/material.h"
#include "shape/shape.h"

static const char *const kind_names[] = {[BOUNDARY_REFLECTING] = "reflecting",
                                         [BOUNDARY_SYMMETRY] = "symmetry",
                                         [BOUNDARY_TRANSMITTING] = "transmitting",
                                         [BOUNDARY_OUTFLOW] = "outflow",
                                         [BOUNDARY_INFLOW] = "inflow",
                                         [BOUNDARY_PERIODIC] = "periodic",
                                         [BOUNDARY_RIGID_BODY] = "rigid-body",
                                         [BOUNDARY_KINDS] = NULL};

const char *boundary_kind_name(int kind) { return kind_names[kind]; }

const struct parameter case_domain_table[] = {
    PARAMETER(VECTOR, struct domain_input, low, OPTIONAL,
              "low corner, one value for each dimension; default: `at` of the boundaries, and "
              "where there is none the bounds of all bodies",
              .unit = "m"),
    PARAMETER(VECTOR, struct domain_input, high, OPTIONAL, "high corner, with the same default",
              .unit = "m"),
    PARAMETER_END,
};

const struct parameter case_boundary_table[] = {
    PARAMETER(CHOICE, struct boundary_input, kind, REQUIRED,
              "reflecting: a rigid wall without friction; symmetry: the same, as a plane of "
              "symmetry; transmitting: waves leave; outflow: particles leave; inflow: the state "
              "outside is given; periodic: what leaves comes in at the opposite face; rigid-body: "
              "no face, a body at rest that blocks the cells whose centres it contains",
              .names = kind_names),
    PARAMETER(CHOICE, struct boundary_input, axis, OPTIONAL,
              "the axis normal to the face; none for a rigid body", .names = parameter_axes,
              .change = CHANGE_NEVER),
    PARAMETER(CHOICE, struct boundary_input, side, OPTIONAL,
              "which end of the bodies the face is at; none for a periodic axis",
              .names = parameter_sides, .change = CHANGE_NEVER),
    PARAMETER(NUMBER, struct boundary_input, at, OPTIONAL,
              "position of the face on the axis; bodies are cut there. Default: that of `domain`, "
              "and without one where the bodies end",
              .unit = "m", .change = CHANGE_NEVER),
    PARAMETER(ONE_OF, struct boundary_input, part, OPTIONAL,
              "a shape that contains the part of the face, or the rigid body; default: the whole "
              "face. The last boundary that names a position counts",
              .kind_of_thing = "shape", .change = CHANGE_NEVER),
    PARAMETER(FIELD, struct boundary_input, density, OPTIONAL,
              "density of what flows in; of density, pressure and energy two at most",
              .arguments = ARGUMENT_POSITION | ARGUMENT_TIME, .unit = "kg/m^3", .below = INFINITY),
    PARAMETER(
        FIELD, struct boundary_input, pressure, OPTIONAL,
        "pressure of what flows in; of an outflow, the ambient pressure outside (transmitting "
        "boundary); default there: the stress of what leaves, for supersonic flow",
        .arguments = ARGUMENT_POSITION | ARGUMENT_TIME, .unit = "Pa"),
    PARAMETER(FIELD, struct boundary_input, energy, OPTIONAL,
              "specific internal energy of what flows in",
              .arguments = ARGUMENT_POSITION | ARGUMENT_TIME, .unit = "J/kg"),
    PARAMETER(FIELDS, struct boundary_input, velocity, OPTIONAL,
              "velocity of what flows in, one value for each dimension",
              .arguments = ARGUMENT_POSITION | ARGUMENT_TIME, .unit = "m/s"),
    PARAMETER_END,
};

struct face_place domain_face(const struct simulation_case *input, int axis, int side)
{
    const struct vector_value *given = side ? &input->domain.high : &input->domain.low;
    if (given->count > axis)
        return (struct face_place){given->at[axis], "domain", side ? "high" : "low"};
    for (int b = 0; b < input->boundaries.count; b++) {
        const struct boundary_input *boundary = case_boundary(input, b);
        if (boundary->axis == axis && boundary->side == side && !isnan(boundary->at))
            return (struct face_place){boundary->at, "boundaries", input->boundaries.names[b]};
    }
    struct face_place place = {side ? -INFINITY : INFINITY, "bodies", NULL};
    for (int b = 0; b < input->bodies.count; b++) {
        const struct bounds bounds = shape_bounds(&case_body(input, b)->shape);
        double at = vec3_at(side ? bounds.high : bounds.low, axis);
        if (geometry_power(input->geometry) > 0 && axis == 0 && !side)
            at = maximum(at, 0.0);
        if (side ? at > place.at : at < place.at)
            place = (struct face_place){at, "bodies", input->bodies.names[b]};
    }
    return place;
}

struct bounds domain_bounds(const struct simulation_case *input)
{
    double end[2][3] = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
    for (int axis = 0; axis < input->dimension; axis++)
        for (int side = 0; side < 2; side++)
            end[side][axis] = domain_face(input, axis, side).at;
    return (struct bounds){vector_at(end[0]), vector_at(end[1])};
}

int rigid_body_at(const struct simulation_case *input, struct vec3 place)
{
    for (int b = 0; b < input->boundaries.count; b++)
        if (case_boundary(input, b)->kind == BOUNDARY_RIGID_BODY &&
            shape_inside(&case_boundary(input, b)->part, place))
            return b;
    return -1;
}

bool has_rigid_body(const struct simulation_case *input)
{
    bool has = false;
    for (int b = 0; b < input->boundaries.count; b++)
        has |= case_boundary(input, b)->kind == BOUNDARY_RIGID_BODY;
    return has;
}

void case_check_domain(struct checking *checking)
{
    const struct simulation_case *input = checking->input;
    const struct vector_value *ends[] = {&input->domain.low, &input->domain.high};
    static const char *const keys[] = {"low", "high"};
    checking->map = "domain";
    checking->name = NULL;
    for (int end = 0; end < 2; end++)
        if (ends[end]->count)
            case_check_components(checking, keys[end], ends[end]->count);
    for (int axis = 0; axis < ends[0]->count && axis < ends[1]->count; axis++)
        if (!(ends[0]->at[axis] < ends[1]->at[axis]))
            case_wrong(checking, "high", "the high corner does not lie above the low one along %c",
                       "xyz"[axis]);
}

/* What is outside is given for an inflow, and the pressure alone for an outflow. */
static void check_state(struct checking *checking, const struct boundary_input *boundary)
{
    const bool inflow = boundary->kind == BOUNDARY_INFLOW,
               outflow = boundary->kind == BOUNDARY_OUTFLOW;
    const bool given = field_is_given(&boundary->density) || field_is_given(&boundary->energy) ||
                       boundary->velocity.count > 0;
    if (!inflow && (given || (!outflow && field_is_given(&boundary->pressure))))
        case_wrong(checking, "kind", "only an inflow has a density, pressure, energy or velocity");
    if (outflow && boundary->pressure.varying)
        case_wrong(checking, "pressure", "the pressure outside an outflow is constant");
    if (!inflow)
        return;
    if (!field_is_given(&boundary->density))
        case_wrong(checking, "density", "an inflow needs the density of what flows in");
    if (!field_is_given(&boundary->pressure) && !field_is_given(&boundary->energy))
        case_wrong(checking, "pressure",
                   "an inflow needs the pressure or the energy of what flows in");
    if (field_is_given(&boundary->density) && field_is_given(&boundary->pressure) &&
        field_is_given(&boundary->energy))
        case_wrong(checking, "energy", "give two of density, pressure and energy, not all three");
    case_check_components(checking, "velocity", boundary->velocity.count);
}

/* The shape of the part of a face, or of a rigid body. */
static void check_part(struct checking *checking, const struct one_of *part)
{
    if (!part->choice || !case_dimension_known(checking) || case_is_wrong(checking, "part"))
        return;
    const char *text = shape_wrong(part, (int)checking->input->dimension);
    if (text)
        case_wrong(checking, "part", "%s", text);
}

static void check_rigid_body(struct checking *checking, const struct boundary_input *boundary)
{
    const bool face = boundary->axis >= 0 || boundary->side >= 0 || !isnan(boundary->at);
    if (face)
        case_wrong(checking,
                   boundary->axis >= 0   ? "axis"
                   : boundary->side >= 0 ? "side"
                                         : "at",
                   "a rigid body is no face: remove this key");
    if (!boundary->part.choice)
        case_wrong(checking, "part", "give the shape of the body");
    check_part(checking, &boundary->part);
    check_state(checking, boundary);
}

/* x is the radius. */
static void check_radius(struct checking *checking, const struct boundary_input *boundary)
{
    const bool low = boundary->side == SIDE_LOW;
    if (boundary->kind == BOUNDARY_PERIODIC)
        case_wrong(checking, "axis", "x is the radius, which does not repeat");
    else if (boundary->kind == BOUNDARY_OUTFLOW && low)
        case_wrong(checking, "side", "nothing flows out through the axis of symmetry");
    else if (boundary_kind_closes(boundary->kind) &&
             (low ? boundary->at != 0.0 && !isnan(boundary->at) : boundary->at <= 0.0))
        case_wrong(checking, "at", "x is a radius, which begins at 0 m: %s",
                   low ? "leave this boundary out" : "put this boundary above it");
}

/* What the whole boundaries I and INDEX of an axis say of each other. */
static bool check_pair(struct checking *checking, int i, int index)
{
    const struct simulation_case *input = checking->input;
    const struct boundary_input *other = case_boundary(input, i),
                                *own = case_boundary(input, index);
    const struct boundary_input *low = own->side == SIDE_LOW ? own : other,
                                *high = own->side == SIDE_LOW ? other : own;
    char path[PATH_TEXT];
    snprintf(path, sizeof path, "boundaries.%s", input->boundaries.names[i]);
    if (other->axis != own->axis || own->part.choice || other->part.choice ||
        other->kind == BOUNDARY_RIGID_BODY || document_is_wrong(input->document, path))
        return true;
    if (other->side == own->side || own->kind == BOUNDARY_PERIODIC || other->side < 0)
        case_wrong(checking, "axis", "\"%s\" names this face already: leave one of the two out",
                   input->boundaries.names[i]);
    else if (low->at >= high->at)
        case_wrong(checking, "at", "the low face on the %c axis does not lie below the high one",
                   "xyz"[own->axis]);
    else
        return true;
    return false;
}

void case_check_boundary(struct checking *checking, int index)
{
    const struct simulation_case *input = checking->input;
    const struct boundary_input *boundary = case_boundary(input, index);
    if (boundary->axis >= 0)
        case_check_axis(checking, "axis", boundary->axis);
    if (case_is_wrong(checking, ""))
        return;
    if (boundary->kind == BOUNDARY_RIGID_BODY) {
        check_rigid_body(checking, boundary);
        return;
    }
    if (boundary->axis < 0) {
        case_wrong(checking, "axis", "expected `x`, `y` or `z`");
        return;
    }
    const bool periodic = boundary->kind == BOUNDARY_PERIODIC, placed = !isnan(boundary->at);
    if (periodic && (boundary->side >= 0 || boundary->part.choice || placed))
        case_wrong(checking,
                   boundary->side >= 0 ? "side"
                   : placed            ? "at"
                                       : "part",
                   "a periodic axis has no side and no part, and is as long as the domain: remove "
                   "this key");
    if (!periodic && boundary->side < 0)
        case_wrong(checking, "side", "expected `low` or `high`");
    if (geometry_power(input->geometry) > 0 && boundary->axis == 0)
        check_radius(checking, boundary);
    check_part(checking, &boundary->part);
    check_state(checking, boundary);
    for (int i = 0; i < index; i++)
        if (!check_pair(checking, i, index))
            break; /* one of many that are alike is enough */
}

void case_check_fine(struct checking *checking, int index)
{
    const struct simulation_case *input = checking->input;
    const struct one_of *shape = &case_fine(input, index)->shape;
    if (!shape->choice || !case_dimension_known(checking) || case_is_wrong(checking, ""))
        return;
    const char *text = shape_wrong(shape, (int)input->dimension);
    if (text)
        case_wrong(checking, "", "%s", text);
}

const char *boundary_state_at(const struct boundary_input *boundary,
                              const struct material *material, struct vec3 place, double time,
                              struct point *point, double velocity[3], const char **key)
{
    const struct start_given given = {.density = field_at(&boundary->density, place, time),
                                      .pressure = field_at(&boundary->pressure, place, time),
                                      .energy = field_at(&boundary->energy, place, time),
                                      .temperature = NAN};
    for (int axis = 0; axis < boundary->velocity.count && axis < 3; axis++) {
        velocity[axis] = field_at(&boundary->velocity.at[axis], place, time);
        *key = "velocity";
        if (!isfinite(velocity[axis]))
            return "the velocity is not finite";
        if (fabs(velocity[axis]) > SPEED_OF_LIGHT)
            return "this is faster than light";
    }
    return start_state(&given, material, point, key);
}
