/* The domain of a solver on a grid, and what is outside its faces: keys, what the keys must be, and
 * the state of what flows in. */
#include "case/checking.h"
#include "material/material.h"
#include "shape/shape.h"

static const char *const axis_names[] = {"x", "y", "z", NULL};
static const char *const side_names[] = {"low", "high", NULL};
static const char *const kind_names[] = {"transmitting", "reflecting", "inflow", "periodic", NULL};

const struct parameter case_domain_table[] = {
    {.key = "low",
     .kind = PARAMETER_VECTOR,
     .offset = offsetof(struct domain_input, low),
     .unit = "m",
     .standard = PARAMETER_OPTIONAL,
     .help =
         "low corner, one value for each dimension; default: the walls, and where there are none "
         "the bounds of all bodies"},
    {.key = "high",
     .kind = PARAMETER_VECTOR,
     .offset = offsetof(struct domain_input, high),
     .unit = "m",
     .standard = PARAMETER_OPTIONAL,
     .help = "high corner, with the same default"},
    PARAMETER_END,
};

const struct parameter case_boundary_table[] = {
    {.key = "axis",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct boundary_input, axis),
     .standard = PARAMETER_REQUIRED,
     .names = axis_names,
     .help = "the axis across which the face lies"},
    {.key = "side",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct boundary_input, side),
     .standard = PARAMETER_OPTIONAL,
     .names = side_names,
     .help = "the face of the axis; none for a periodic axis"},
    {.key = "kind",
     .kind = PARAMETER_CHOICE,
     .offset = offsetof(struct boundary_input, kind),
     .standard = PARAMETER_REQUIRED,
     .names = kind_names,
     .help = "transmitting: waves leave; reflecting: a rigid wall without friction; inflow: the "
             "state outside is given; periodic: what leaves comes in at the opposite face. Gas has "
             "all, "
             "SPH reflecting and periodic, MPM none"},
    {.key = "part",
     .kind = PARAMETER_ONE_OF,
     .offset = offsetof(struct boundary_input, part),
     .standard = PARAMETER_OPTIONAL,
     .kind_of_thing = "shape",
     .help = "a shape that contains the part of the face; default: the whole face. The last "
             "boundary that names a position counts"},
    {.key = "density",
     .kind = PARAMETER_FIELD,
     .offset = offsetof(struct boundary_input, density),
     .arguments = ARGUMENT_POSITION | ARGUMENT_TIME,
     .unit = "kg/m^3",
     .standard = PARAMETER_OPTIONAL,
     .below = INFINITY,
     .help = "density of what flows in; of density, pressure and energy two at most"},
    {.key = "pressure",
     .kind = PARAMETER_FIELD,
     .offset = offsetof(struct boundary_input, pressure),
     .arguments = ARGUMENT_POSITION | ARGUMENT_TIME,
     .unit = "Pa",
     .standard = PARAMETER_OPTIONAL,
     .help = "pressure of what flows in"},
    {.key = "energy",
     .kind = PARAMETER_FIELD,
     .offset = offsetof(struct boundary_input, energy),
     .arguments = ARGUMENT_POSITION | ARGUMENT_TIME,
     .unit = "J/kg",
     .standard = PARAMETER_OPTIONAL,
     .help = "specific internal energy of what flows in"},
    {.key = "velocity",
     .kind = PARAMETER_FIELDS,
     .offset = offsetof(struct boundary_input, velocity),
     .arguments = ARGUMENT_POSITION | ARGUMENT_TIME,
     .unit = "m/s",
     .standard = PARAMETER_OPTIONAL,
     .help = "velocity of what flows in, one value for each dimension"},
    PARAMETER_END,
};

const struct parameter case_obstacle_table[] = {
    {.kind = PARAMETER_ONE_OF,
     .offset = offsetof(struct obstacle_input, shape),
     .standard = PARAMETER_REQUIRED,
     .kind_of_thing = "shape",
     .help = "where the obstacle is"},
    PARAMETER_END,
};

void case_check_obstacle(struct checking *checking, int index)
{
    const struct obstacle_input *obstacle = case_obstacle(checking->input, index);
    const struct choice *shape = obstacle->shape.choice;
    if (!shape || !case_dimension_known(checking) || case_is_wrong(checking, shape->name))
        return;
    const char *text = shape_wrong(&obstacle->shape, (int)checking->input->dimension);
    if (text)
        case_wrong(checking, shape->name, "%s", text);
}

void case_check_domain(struct checking *checking)
{
    const struct simulation_case *input = checking->input;
    const struct vector_value *ends[] = {&input->domain.low, &input->domain.high};
    static const char *const keys[] = {"low", "high"};
    checking->map = "domain";
    checking->name = NULL;
    for (int end = 0; end < 2 && case_dimension_known(checking); end++)
        if (ends[end]->count && ends[end]->count != input->dimension)
            case_wrong(checking, keys[end],
                       "expected %d component%s, one for each dimension; found %d",
                       (int)input->dimension, input->dimension == 1 ? "" : "s", ends[end]->count);
    for (int axis = 0; axis < ends[0]->count && axis < ends[1]->count; axis++)
        if (!(ends[0]->at[axis] < ends[1]->at[axis]))
            case_wrong(checking, "high", "the high corner does not lie above the low one along %c",
                       "xyz"[axis]);
}

/* A state belongs to an inflow alone. */
static void check_state(struct checking *checking, const struct boundary_input *boundary)
{
    const bool inflow = boundary->kind == BOUNDARY_INFLOW;
    const int64_t dimension = checking->input->dimension;
    const bool given = field_is_given(&boundary->density) || field_is_given(&boundary->pressure) ||
                       field_is_given(&boundary->energy) || boundary->velocity.count > 0;
    if (!inflow && given)
        case_wrong(checking, "kind", "only an inflow has a density, pressure, energy or velocity");
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
    if (case_dimension_known(checking) && boundary->velocity.count != dimension)
        case_wrong(checking, "velocity",
                   "expected %d component%s, one for each dimension; found %d", (int)dimension,
                   dimension == 1 ? "" : "s", boundary->velocity.count);
}

void case_check_boundary(struct checking *checking, int index)
{
    const struct simulation_case *input = checking->input;
    const struct boundary_input *boundary = case_boundary(input, index);
    case_check_axis(checking, "axis", boundary->axis);
    if (case_is_wrong(checking, ""))
        return;
    const bool periodic = boundary->kind == BOUNDARY_PERIODIC;
    if (periodic && (boundary->side >= 0 || boundary->part.choice))
        case_wrong(checking, boundary->side >= 0 ? "side" : "part",
                   "a periodic axis has no side and no part: remove this key");
    if (!periodic && boundary->side < 0)
        case_wrong(checking, "side", "expected `low` or `high`");
    if (geometry_power(input->geometry) > 0 && boundary->axis == 0 && periodic)
        case_wrong(checking, "axis", "x is the radius, which does not repeat");
    if (boundary->part.choice && case_dimension_known(checking)) {
        const char *text = shape_wrong(&boundary->part, (int)input->dimension);
        if (text)
            case_wrong(checking, "part", "%s", text);
    }
    check_state(checking, boundary);
    for (int i = 0; i < index; i++) {
        const struct boundary_input *other = case_boundary(input, i);
        if (other->axis == boundary->axis && !boundary->part.choice && !other->part.choice &&
            (other->side == boundary->side || periodic || other->side < 0))
            case_wrong(checking, "axis", "\"%s\" names this face already",
                       input->boundaries.names[i]);
    }
    for (int i = 0; i < input->walls.count; i++)
        if (case_wall(input, i)->axis == boundary->axis && !boundary->part.choice &&
            (periodic || case_wall(input, i)->side == boundary->side))
            case_wrong(checking, "axis",
                       "the wall \"%s\" closes this face: leave one of the two out",
                       input->walls.names[i]);
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
