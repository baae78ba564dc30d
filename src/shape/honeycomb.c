/* The walls of a honeycomb in a box: the places that are at most half of a wall's thickness from
 * the nearest edge between two cells. The cells are those of Voronoi about centers on a triangular
 * or a square lattice. */
#include "shape/kinds.h"

static const char *const cell_names[] = {"hexagon", "square", NULL};
enum { CELLS_HEXAGON, CELLS_SQUARE };

const struct parameter shape_honeycomb_table[] = {
    PARAMETER(VECTOR, struct shape_honeycomb, from, REQUIRED, "the lowest corner of its box",
              .unit = "m"),
    PARAMETER(VECTOR, struct shape_honeycomb, to, REQUIRED, "the highest corner of its box",
              .unit = "m"),
    PARAMETER(NUMBER, struct shape_honeycomb, pitch, REQUIRED,
              "the distance of neighbouring cells from center to center", .unit = "m",
              .below = INFINITY),
    PARAMETER(NUMBER, struct shape_honeycomb, wall, REQUIRED, "the thickness of the walls",
              .unit = "m", .below = INFINITY),
    PARAMETER(CHOICE, struct shape_honeycomb, cells, "hexagon", "the form of the cells",
              .names = cell_names),
    PARAMETER(CHOICE, struct shape_honeycomb, along, "z",
              "the axis that the walls are parallel to; z in 2-D", .names = parameter_axes),
    PARAMETER(VECTOR, struct shape_honeycomb, center, OPTIONAL,
              "the center of a cell: two numbers, on the other axes in the order x, y, z; default: "
              "the origin",
              .unit = "m"),
    PARAMETER(NUMBER, struct shape_honeycomb, angle, "0",
              "the direction from a cell to its neighbour, from the first of the other axes, such "
              "as 30 deg",
              .unit = "", .above = -INFINITY, .below = INFINITY),
    PARAMETER_END,
};

/* How far (X, Y) is from the nearest edge of a cell, in pitches, as X and Y are. */
static double to_edge_of_square(double x, double y)
{
    return 0.5 - maximum(fabs(x - round(x)), fabs(y - round(y)));
}

static double to_edge_of_hexagon(double x, double y)
{
    const double high = 0.5 * sqrt(3.0); /* of a row of cells */
    double nearest[2] = {INFINITY, INFINITY}, edge = INFINITY;
    for (int next = 0; next < 2; next++) { /* the center is in the row below or above */
        const double row = floor(y / high) + next, shift = 0.5 * fmod(fabs(row), 2.0);
        const double dx = x - (round(x - shift) + shift), dy = y - row * high;
        if (square(dx) + square(dy) < square(nearest[0]) + square(nearest[1])) {
            nearest[0] = dx;
            nearest[1] = dy;
        }
    }
    const double to[3][2] = {{1.0, 0.0}, {0.5, high}, {-0.5, high}}; /* neighbours */
    for (int k = 0; k < 3; k++)
        edge = minimum(edge, 0.5 - fabs(nearest[0] * to[k][0] + nearest[1] * to[k][1]));
    return edge;
}

static bool inside(const void *shape, struct vec3 point)
{
    const struct shape_honeycomb *comb = shape;
    double place[2];
    for (int axis = 0, k = 0; axis < 3; axis++) {
        if (axis < comb->from.count && !(vec3_at(point, axis) >= comb->from.at[axis] &&
                                         vec3_at(point, axis) < comb->to.at[axis]))
            return false;
        if (axis != comb->along && k < 2) {
            const double center = k < comb->center.count ? comb->center.at[k] : 0.0;
            place[k++] = vec3_at(point, axis) - center;
        }
    }
    const double c = cos(comb->angle) / comb->pitch, s = sin(comb->angle) / comb->pitch;
    const double x = c * place[0] + s * place[1], y = c * place[1] - s * place[0];
    const double edge =
        comb->cells == CELLS_SQUARE ? to_edge_of_square(x, y) : to_edge_of_hexagon(x, y);
    return edge * comb->pitch < 0.5 * comb->wall;
}

static struct bounds bounds(const void *shape)
{
    const struct shape_honeycomb *comb = shape;
    return (struct bounds){vec3_of(&comb->from), vec3_of(&comb->to)};
}

static const char *wrong(const void *shape, int dimension)
{
    const struct shape_honeycomb *comb = shape;
    if (dimension < 2)
        return "a honeycomb needs two or three dimensions";
    if (comb->from.count != dimension || comb->to.count != dimension)
        return "a honeycomb needs one number per dimension in `from` and `to`";
    for (int axis = 0; axis < dimension; axis++)
        if (!(comb->from.at[axis] < comb->to.at[axis]))
            return "each number of `from` must be smaller than that of `to`";
    if (dimension == 2 && comb->along != 2)
        return "the walls of a honeycomb in 2-D are parallel to z: leave `along` out";
    if (comb->center.count && comb->center.count != 2)
        return "the `center` of a cell has two numbers, for the axes other than `along`";
    if (!(comb->wall < comb->pitch))
        return "the `wall` of a honeycomb must be thinner than its `pitch`";
    return NULL;
}

const struct shape_class shape_honeycomb_class = {inside, bounds, wrong, NULL, NULL, NULL, NULL};
