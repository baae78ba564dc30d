/* What the tables cannot say of what acts on a case from outside: walls, gravity. */
#include "model/case_checking.h"
#include "model/document_internal.h"

void case_check_wall(struct checking *checking, int index)
{
    static const char *const axes = "xyz";
    const struct simulation_case *input = checking->input;
    const struct wall_input *wall = case_wall(input, index);
    case_check_axis(checking, "mirror", wall->axis);
    if (input->geometry == GEOMETRY_AXISYMMETRIC && wall->axis == 0 &&
        (wall->side == WALL_LOW ? wall->at != 0.0 : wall->at <= 0.0))
        case_wrong(checking, "at", "the axis of symmetry bounds x from below, at 0 m: %s",
                   wall->side == WALL_LOW ? "leave this wall out" : "put this wall beyond it");
    for (int i = 0; i < index && !case_is_wrong(checking, ""); i++) {
        const struct wall_input *other = case_wall(input, i);
        char path[PATH_TEXT];
        snprintf(path, sizeof path, "walls.%s", input->walls.names[i]);
        if (other->axis != wall->axis || document_is_wrong(input->document, path))
            continue;
        double low = wall->side == WALL_LOW ? wall->at : other->at;
        double high = wall->side == WALL_LOW ? other->at : wall->at;
        if (other->side == wall->side)
            case_wrong(checking, "side", "\"%s\" is a %s wall on the %c axis already",
                       input->walls.names[i], wall->side == WALL_LOW ? "low" : "high",
                       axes[wall->axis]);
        else if (low >= high)
            case_wrong(checking, "at",
                       "the low wall on the %c axis does not lie below the high wall",
                       axes[wall->axis]);
    }
}

void case_check_gravity(struct checking *checking)
{
    const struct simulation_case *input = checking->input;
    const struct vector_value *gravity = &input->gravity;
    checking->map = "gravity";
    if (!case_dimension_known(checking) || gravity->count == 0)
        return;
    if (gravity->count != input->dimension)
        case_wrong(checking, "", "%d component%s wanted, one a dimension; found %d",
                   (int)input->dimension, input->dimension == 1 ? " is" : "s are", gravity->count);
    else if (input->geometry == GEOMETRY_AXISYMMETRIC && gravity->at[0] != 0.0)
        case_wrong(checking, "1", "gravity that is symmetric about the axis points along it");
}
