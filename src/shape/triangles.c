#include "shape/triangles.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* Columns along an axis at most; triangles that all columns list together, for each triangle. */
enum { MOST_COLUMNS = 1024, MOST_LISTED = 16 };

/* The six coordinates of an edge, the lower end first. */
struct edge {
    double end[2][3];
    int64_t of; /* the triangle */
};

/* By x, then y, then z. */
static int compare_points(const double a[3], const double b[3])
{
    for (int axis = 0; axis < 3; axis++)
        if (a[axis] != b[axis])
            return a[axis] < b[axis] ? -1 : 1;
    return 0;
}

static int compare_edges(const void *a, const void *b)
{
    const struct edge *first = a, *second = b;
    const int order = compare_points(first->end[0], second->end[0]);
    return order ? order : compare_points(first->end[1], second->end[1]);
}

static void take_corner(const float from[3][3], double to[3][3])
{
    for (int j = 0; j < 9; j++)
        to[j / 3][j % 3] = (double)from[j / 3][j % 3] + 0.0; /* -0 is 0 */
}

static bool has_area(const double corner[3][3])
{
    return compare_points(corner[0], corner[1]) && compare_points(corner[1], corner[2]) &&
           compare_points(corner[2], corner[0]);
}

static int by_place(const void *a, const void *b)
{
    const struct edge *first = a, *second = b;
    const int order = compare_edges(first, second);
    return order ? order : (first->of > second->of) - (first->of < second->of);
}

static bool has_corner(const double corner[3][3], const double at[3])
{
    return !compare_points(corner[0], at) || !compare_points(corner[1], at) ||
           !compare_points(corner[2], at);
}

static bool are_same(const double a[3][3], const double b[3][3])
{
    return has_corner(a, b[0]) && has_corner(a, b[1]) && has_corner(a, b[2]);
}

/* The number in the file, from 1, of TRIANGLE: those without area were left out. */
static long long facet_of(const float (*corners)[3][3], int64_t triangle)
{
    for (int64_t i = 0;; i++) {
        double corner[3][3];
        take_corner(corners[i], corner);
        if (has_area((const double(*)[3])corner) && triangle-- == 0)
            return i + 1;
    }
}

/* Why the COUNT triangles that share EDGE, an odd number, enclose nothing. */
static const char *explain_open(const struct triangles *triangles, const float (*corners)[3][3],
                                const struct edge *edge, int64_t count, char *said)
{
    const double(*const all)[3][3] = (const double(*)[3][3])triangles->corners;
    const long long first = facet_of(corners, edge->of);
    for (int64_t i = 1; i < count; i++)
        for (int64_t j = 0; j < i; j++)
            if (are_same(all[edge[j].of], all[edge[i].of])) {
                snprintf(said, MESH_TEXT,
                         "facet %lld of this mesh repeats facet %lld: remove one of the two",
                         facet_of(corners, edge[i].of), facet_of(corners, edge[j].of));
                return said;
            }
    const double *from = edge->end[0], *to = edge->end[1];
    snprintf(said, MESH_TEXT,
             "the surface of this mesh is open: the edge from [%.9g, %.9g, %.9g] to [%.9g, %.9g, "
             "%.9g] of facet %lld belongs to %lld facet%s, not to two. Repair it, and write shared "
             "corners with the same digits",
             from[0], from[1], from[2], to[0], to[1], to[2], first, (long long)count,
             count == 1 ? "" : "s");
    return said;
}

/* Sorts the edges: those of a closed surface come in pairs. */
static const char *check_closed(const struct triangles *triangles, const float (*corners)[3][3],
                                char *said)
{
    const int64_t count = 3 * triangles->count;
    struct edge *edges = malloc((size_t)count * sizeof *edges);
    if (!edges)
        return "there is no memory for the edges of this mesh";
    for (int64_t i = 0; i < count; i++) {
        const double *from = triangles->corners[i / 3][i % 3];
        const double *to = triangles->corners[i / 3][(i + 1) % 3];
        const bool is_up = compare_points(from, to) < 0;
        memcpy(edges[i].end[0], is_up ? from : to, sizeof edges[i].end[0]);
        memcpy(edges[i].end[1], is_up ? to : from, sizeof edges[i].end[1]);
        edges[i].of = i / 3;
    }
    qsort(edges, (size_t)count, sizeof *edges, by_place);
    const char *text = NULL;
    for (int64_t i = 0, same; i < count && !text; i += same) {
        for (same = 1; i + same < count && !compare_edges(&edges[i], &edges[i + same]);)
            same++;
        if (same % 2 == 1)
            text = explain_open(triangles, corners, &edges[i], same, said);
    }
    free(edges);
    return text;
}

/* The column of a coordinate along y (0) or z (1). */
static int64_t column_along(const struct triangles *triangles, int axis, double at)
{
    const double low = axis == 0 ? triangles->bounds.low.y : triangles->bounds.low.z;
    const double high = axis == 0 ? triangles->bounds.high.y : triangles->bounds.high.z;
    const double columns = (double)triangles->columns[axis];
    const double column = floor((at - low) / (high - low) * columns);
    return (int64_t)minimum(maximum(column, 0.0), columns - 1.0);
}

/* The columns that a triangle may meet: first and last along y and z. */
static void columns_of(const struct triangles *triangles, int64_t triangle, int64_t range[2][2])
{
    const double(*corner)[3] = triangles->corners[triangle];
    for (int axis = 0; axis < 2; axis++) {
        const double a = corner[0][axis + 1], b = corner[1][axis + 1], c = corner[2][axis + 1];
        range[axis][0] = column_along(triangles, axis, minimum(minimum(a, b), c));
        range[axis][1] = column_along(triangles, axis, maximum(maximum(a, b), c));
    }
}

static double listed(const struct triangles *triangles)
{
    double sum = 0.0;
    for (int64_t triangle = 0; triangle < triangles->count; triangle++) {
        int64_t range[2][2];
        columns_of(triangles, triangle, range);
        sum += (double)(range[0][1] - range[0][0] + 1) * (double)(range[1][1] - range[1][0] + 1);
    }
    return sum;
}

/* About one triangle of the near side and one of the far side a column, fewer columns where
 * triangles are long. */
static void choose_columns(struct triangles *triangles)
{
    double columns = minimum(MOST_COLUMNS, ceil(sqrt(0.5 * (double)triangles->count)));
    for (;; columns = floor(0.5 * columns)) {
        triangles->columns[0] = triangles->columns[1] = (int64_t)maximum(columns, 1.0);
        if (columns <= 1.0 || listed(triangles) <= MOST_LISTED * (double)triangles->count)
            return;
    }
}

/* Counts the triangles of each column, then lists them, in the order of their numbers. */
static void list_columns(struct triangles *triangles)
{
    const int64_t columns = triangles->columns[0] * triangles->columns[1];
    for (int pass = 0; pass < 2; pass++) {
        for (int64_t triangle = 0; triangle < triangles->count; triangle++) {
            int64_t range[2][2];
            columns_of(triangles, triangle, range);
            for (int64_t k = range[1][0]; k <= range[1][1]; k++)
                for (int64_t j = range[0][0]; j <= range[0][1]; j++) {
                    int64_t *next = &triangles->start[k * triangles->columns[0] + j + 1];
                    if (pass == 0)
                        ++*next;
                    else
                        triangles->list[(*next)++] = triangle;
                }
        }
        if (pass == 1)
            return;
        /* Each start[column + 1] is where the next triangle of the column goes: in the end it is
         * where those of the next column begin. */
        int64_t sum = 0;
        for (int64_t column = 0; column < columns; column++) {
            const int64_t here = triangles->start[column + 1];
            triangles->most = here > triangles->most ? here : triangles->most;
            triangles->start[column + 1] = sum;
            sum += here;
        }
    }
}

static void find_bounds(struct triangles *triangles)
{
    struct bounds bounds = {vec3_make(INFINITY, INFINITY, INFINITY),
                            vec3_make(-INFINITY, -INFINITY, -INFINITY)};
    for (int64_t i = 0; i < 3 * triangles->count; i++) {
        const double *corner = triangles->corners[i / 3][i % 3];
        const struct vec3 at = vec3_make(corner[0], corner[1], corner[2]);
        bounds = bounds_around(bounds, (struct bounds){at, at});
    }
    triangles->bounds = bounds;
}

/* The triangles with area, from CORNERS. */
static void take_corners(struct triangles *triangles, const float (*corners)[3][3], int64_t count)
{
    for (int64_t i = 0; i < count; i++) {
        double(*corner)[3] = triangles->corners[triangles->count];
        take_corner(corners[i], corner);
        if (has_area((const double(*)[3])corner))
            triangles->count++;
    }
}

static const char *check_finite(const float (*corners)[3][3], int64_t count, char *said)
{
    for (int64_t i = 0; i < 9 * count; i++)
        if (!isfinite(corners[i / 9][i % 9 / 3][i % 3])) {
            snprintf(said, MESH_TEXT,
                     "a corner of facet %lld of this mesh is not a number, or infinite",
                     (long long)(i / 9 + 1));
            return said;
        }
    return NULL;
}

/* PLAN with room for its columns behind its corners. */
static struct triangles *with_columns(struct triangles *plan)
{
    const size_t corners = (size_t)plan->count * sizeof *plan->corners;
    const size_t starts = (size_t)(plan->columns[0] * plan->columns[1] + 1) * sizeof *plan->start;
    const size_t lists = (size_t)listed(plan) * sizeof *plan->list;
    const size_t nests = (size_t)plan->shells * sizeof *plan->nest;
    const size_t shells = (size_t)plan->count * sizeof *plan->shell;
    struct triangles *triangles =
        memory_allocate(sizeof *plan + corners + starts + lists + nests + shells);
    if (!triangles)
        return NULL;
    *triangles = *plan;
    triangles->corners = (double(*)[3][3])(triangles + 1);
    triangles->start = (int64_t *)(triangles->corners + plan->count);
    triangles->list = triangles->start + plan->columns[0] * plan->columns[1] + 1;
    triangles->nest = (struct shell_nest *)((char *)triangles->list + lists);
    triangles->shell = (int32_t *)(triangles->nest + plan->shells);
    memcpy(triangles->corners, plan->corners, corners);
    memcpy(triangles->shell, plan->shell, shells);
    return triangles;
}

/* Whether an edge, seen along x, passes the line that runs from POINT along y. It has its low end
 * and not its high one, and is computed from the low one: triangles with a common edge share no
 * line along x and miss none. */
static bool edge_passes(const double *from, const double *to, struct vec3 point)
{
    const bool is_up = from[2] < to[2] || (from[2] == to[2] && from[1] < to[1]);
    const double *low = is_up ? from : to, *high = is_up ? to : from;
    if (!(low[2] <= point.z && point.z < high[2]))
        return false;
    return point.y < low[1] + (point.z - low[2]) / (high[2] - low[2]) * (high[1] - low[1]);
}

/* Whether the line along x through POINT meets the triangle at a higher x. */
static bool is_above(const double corner[3][3], struct vec3 point)
{
    bool is_met = false;
    for (int i = 0; i < 3; i++)
        is_met ^= edge_passes(corner[i], corner[(i + 1) % 3], point);
    if (!is_met)
        return false;
    const double y1 = corner[1][1] - corner[0][1], z1 = corner[1][2] - corner[0][2];
    const double y2 = corner[2][1] - corner[0][1], z2 = corner[2][2] - corner[0][2];
    const double y = point.y - corner[0][1], z = point.z - corner[0][2];
    const double area = y1 * z2 - y2 * z1;
    const double first = (y * z2 - y2 * z) / area, second = (y1 * z - y * z1) / area;
    return corner[0][0] + first * (corner[1][0] - corner[0][0]) +
               second * (corner[2][0] - corner[0][0]) >
           point.x;
}

/* The shells that are around POINT, AROUND, at most as many as it has room for; how many. Triangles
 * of a column are sorted by shell. */
static int shells_around(const struct triangles *triangles, struct vec3 point,
                         int32_t around[SHELLS_AROUND])
{
    const struct bounds *bounds = &triangles->bounds;
    if (!(point.x >= bounds->low.x && point.x < bounds->high.x && point.y >= bounds->low.y &&
          point.y < bounds->high.y && point.z >= bounds->low.z && point.z < bounds->high.z))
        return 0;
    const int64_t column = column_along(triangles, 1, point.z) * triangles->columns[0] +
                           column_along(triangles, 0, point.y);
    int count = 0;
    bool is_odd = false;
    const int64_t end = triangles->start[column + 1];
    for (int64_t i = triangles->start[column]; i < end; i++) {
        const int64_t triangle = triangles->list[i];
        const int32_t shell = triangles->shell[triangle];
        is_odd ^= is_above((const double(*)[3])triangles->corners[triangle], point);
        if (i + 1 < end && triangles->shell[triangles->list[i + 1]] == shell)
            continue;
        if (is_odd && count < SHELLS_AROUND)
            around[count++] = shell;
        is_odd = false;
    }
    return count;
}

/* Which shells are within which others, by all of their corners. */
static void find_nests(struct triangles *triangles)
{
    for (int64_t i = 0; i < 3 * triangles->count && triangles->shells > 1; i++) {
        const double *corner = triangles->corners[i / 3][i % 3];
        const int32_t own = triangles->shell[i / 3];
        const bool first = i == 0 || (i % 3 == 0 && triangles->shell[i / 3 - 1] != own);
        int32_t around[SHELLS_AROUND];
        const int count =
            shells_around(triangles, vec3_make(corner[0], corner[1], corner[2]), around);
        shells_nest(&triangles->nest[own], first, around, count, own);
    }
}

const char *triangles_make(const float (*corners)[3][3], int64_t count, char *said,
                           struct triangles **made)
{
    const char *text = check_finite(corners, count, said);
    if (text)
        return text;
    struct triangles plan = {.corners = malloc((size_t)(count + 1) * sizeof *plan.corners),
                             .shell = malloc((size_t)(count + 1) * sizeof *plan.shell)};
    if (!plan.corners || !plan.shell) {
        free(plan.corners);
        free(plan.shell);
        return "there is no memory for this mesh";
    }
    take_corners(&plan, corners, count);
    if (plan.count < 4)
        text = "this mesh has less than four triangles, the fewest that enclose anything";
    if (!text)
        text = check_closed(&plan, corners, said);
    if (!text && !shells_sort(plan.corners, plan.count, plan.shell, &plan.shells))
        text = "there is no memory for this mesh";
    if (!text) {
        find_bounds(&plan);
        if (!(plan.bounds.low.x < plan.bounds.high.x && plan.bounds.low.y < plan.bounds.high.y &&
              plan.bounds.low.z < plan.bounds.high.z))
            text = "this mesh is flat: it encloses nothing";
    }
    if (!text) {
        choose_columns(&plan);
        *made = with_columns(&plan);
        if (*made) {
            list_columns(*made);
            find_nests(*made);
        } else
            text = "there is no memory for this mesh";
    }
    free(plan.corners);
    free(plan.shell);
    return text;
}

bool triangles_hold(const struct triangles *triangles, struct vec3 point)
{
    int32_t around[SHELLS_AROUND];
    const int count = shells_around(triangles, point, around);
    return count > 0 && (triangles->shells == 1 || shells_enclose(triangles->nest, around, count));
}
