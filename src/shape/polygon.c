/* The area within a closed chain of straight edges; 2-D. */
#include "shape/kinds.h"

const struct parameter shape_polygon_table[] = {
    PARAMETER(VECTORS, struct shape_polygon, points, REQUIRED,
              "the corners in order, in either direction; the last is joined to the first. Areas "
              "enclosed twice are left out",
              .unit = "m"),
    PARAMETER_END,
};

/* Whether the edge between two corners crosses the line that runs from POINT to the right. An edge
 * has its low end and not its high one, and is computed from the low one: polygons with a common
 * edge share no point and miss none. */
static bool edge_crosses(const double *from, const double *to, struct vec3 point)
{
    const double *low = from[1] < to[1] ? from : to, *high = from[1] < to[1] ? to : from;
    if (!(low[1] <= point.y && point.y < high[1]))
        return false;
    return point.x < low[0] + (point.y - low[1]) / (high[1] - low[1]) * (high[0] - low[0]);
}

static bool inside(const void *shape, struct vec3 point)
{
    const struct vector_list *points = &((const struct shape_polygon *)shape)->points;
    bool odd = false;
    for (int i = 0; i < points->count; i++)
        odd ^= edge_crosses(points->items[i].at, points->items[(i + 1) % points->count].at, point);
    return odd;
}

static struct bounds bounds(const void *shape)
{
    const struct vector_list *points = &((const struct shape_polygon *)shape)->points;
    struct bounds all = {vec3_of(&points->items[0]), vec3_of(&points->items[0])};
    for (int i = 1; i < points->count; i++) {
        const double *at = points->items[i].at;
        all.low = vec3_make(minimum(all.low.x, at[0]), minimum(all.low.y, at[1]), 0.0);
        all.high = vec3_make(maximum(all.high.x, at[0]), maximum(all.high.y, at[1]), 0.0);
    }
    return all;
}

static const char *wrong(const void *shape, int dimension)
{
    const struct vector_list *points = &((const struct shape_polygon *)shape)->points;
    if (dimension != 2)
        return "a polygon needs two dimensions";
    if (points->count < 3)
        return "a polygon needs at least three points";
    for (int i = 0; i < points->count; i++)
        if (points->items[i].count != 2)
            return "every point of a polygon has two numbers";
    const struct bounds all = bounds(shape);
    if (!(all.low.x < all.high.x && all.low.y < all.high.y))
        return "the points of this polygon lie on one line";
    return NULL;
}

static double work(const void *shape)
{
    return ((const struct shape_polygon *)shape)->points.count;
}

const struct shape_class shape_polygon_class = {inside, bounds, wrong, NULL, work, NULL, NULL};
