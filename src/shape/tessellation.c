#include "shape/tessellation.h"

#include <stdlib.h>

#include "base/chance.h"
#include "base/exponential.h"
#include "base/memory.h"
#include "shape/grains.h"

/* The fraction of the box that the packing of the sites fills, in 2-D and 3-D. */
static const double packed[2] = {0.4, 0.3};

/* Samples along the axes on which volumes are measured, in 2-D and 3-D. */
static const int samples[2] = {512, 72};

/* A grain nearest a point, and the squared distance of its site. */
struct nearest {
    int64_t grain;
    double place[3], distance_square;
};

/* A walk over the sites of the cells around a point, nearer cells first: those REACH cells away,
 * with their images where the box is periodic. */
struct ring_walk {
    const struct tessellation *grains;
    const double *at;
    int64_t home[3];
    int reach;
};

typedef void visit_site(void *context, const double at[3], const double place[3], int64_t grain);

static void visit_cell(const struct ring_walk *walk, const int step[3], visit_site *visit,
                       void *context)
{
    const struct tessellation *grains = walk->grains;
    int64_t cell[3];
    double shift[3] = {0.0, 0.0, 0.0};
    for (int axis = 0; axis < 3; axis++) {
        const int64_t cells = grains->cells[axis];
        cell[axis] = walk->home[axis] + step[axis];
        if (cell[axis] >= 0 && cell[axis] < cells)
            continue;
        if (!grains->wanted.periodic[axis])
            return;
        const int64_t inside = (cell[axis] % cells + cells) % cells;
        shift[axis] = (double)((cell[axis] - inside) / cells) * grains->extent[axis];
        cell[axis] = inside;
    }
    const int64_t number = (cell[2] * grains->cells[1] + cell[1]) * grains->cells[0] + cell[0];
    for (int64_t grain = grains->head[number]; grain >= 0; grain = grains->next[grain]) {
        const double *site = grains->site[grain];
        const double place[3] = {site[0] + shift[0], site[1] + shift[1], site[2] + shift[2]};
        visit(context, walk->at, place, grain);
    }
}

static void visit_ring(const struct ring_walk *walk, visit_site *visit, void *context)
{
    const int reach = walk->reach, up = walk->grains->wanted.dimension == 3 ? reach : 0;
    for (int k = -up; k <= up; k++)
        for (int j = -reach; j <= reach; j++)
            for (int i = -reach; i <= reach; i++)
                if (abs(i) == reach || abs(j) == reach || abs(k) == reach)
                    visit_cell(walk, (const int[3]){i, j, k}, visit, context);
}

static int64_t cell_of(const struct tessellation *grains, int axis, double at)
{
    const double cell = floor((at - grains->low[axis]) / grains->cell[axis]);
    return (int64_t)minimum(maximum(cell, 0.0), (double)grains->cells[axis] - 1.0);
}

static double between_square(const double a[3], const double b[3])
{
    return square(a[0] - b[0]) + square(a[1] - b[1]) + square(a[2] - b[2]);
}

/* Of two sites as far the one with the lower number, so that the order of the lists is nothing. */
static void keep_nearest(void *context, const double at[3], const double place[3], int64_t grain)
{
    struct nearest *nearest = context;
    const double distance_square = between_square(at, place);
    if (distance_square > nearest->distance_square ||
        (distance_square == nearest->distance_square && grain > nearest->grain))
        return;
    *nearest = (struct nearest){grain, {place[0], place[1], place[2]}, distance_square};
}

struct to_face {
    struct nearest own;
    double distance;
};

/* The plane half-way between two sites is (|p - b|^2 - |p - a|^2)/(2 |a - b|) from p. */
static void keep_nearest_face(void *context, const double at[3], const double place[3],
                              int64_t grain)
{
    struct to_face *face = context;
    (void)grain;
    const double apart_square = between_square(face->own.place, place);
    if (apart_square > 0.0)
        face->distance =
            minimum(face->distance, (between_square(at, place) - face->own.distance_square) /
                                        (2.0 * sqrt(apart_square)));
}

static struct ring_walk walk_around(const struct tessellation *grains, const double at[3])
{
    struct ring_walk walk = {.grains = grains, .at = at};
    for (int axis = 0; axis < 3; axis++)
        walk.home[axis] = cell_of(grains, axis, at[axis]);
    return walk;
}

/* Sites of farther rings are at least as many cells away. There is a site. */
static struct nearest find_nearest(const struct tessellation *grains, const double at[3])
{
    struct ring_walk walk = walk_around(grains, at);
    struct nearest nearest = {.grain = -1, .distance_square = INFINITY};
    for (;
         walk.reach == 0 || nearest.distance_square > square((walk.reach - 1) * grains->least_cell);
         walk.reach++)
        visit_ring(&walk, keep_nearest, &nearest);
    return nearest;
}

/* How far AT is from the faces of the cell of its site OWN, as far as that is below MOST. A site
 * at the distance d has its face (d - own distance)/2 from the point, or farther. */
static double distance_to_face(const struct tessellation *grains, const double at[3],
                               const struct nearest *own, double most)
{
    struct ring_walk walk = walk_around(grains, at);
    struct to_face face = {*own, most};
    const double own_distance = sqrt(own->distance_square);
    for (; (walk.reach - 1) * grains->least_cell <= own_distance + 2.0 * face.distance;
         walk.reach++)
        visit_ring(&walk, keep_nearest_face, &face);
    return face.distance;
}

bool tessellation_holds(const struct tessellation *grains, struct vec3 point)
{
    const double at[3] = {point.x, point.y, grains->wanted.dimension == 3 ? point.z : 0.0};
    const struct nearest own = find_nearest(grains, at);
    if (!grains->is_picked[own.grain])
        return false;
    return grains->half_gap <= 0.0 ||
           distance_to_face(grains, at, &own, grains->half_gap) >= grains->half_gap;
}

/* The memory of the sites and their cells, about one site a cell. */
static struct tessellation *open_cells(const struct tessellation_wanted *wanted,
                                       const struct grains *packing)
{
    struct tessellation plan = {.wanted = *wanted,
                                .count = packing->count,
                                .half_gap = 0.5 * wanted->gap,
                                .least_cell = INFINITY};
    for (int axis = 0; axis < 3; axis++) {
        const bool has = axis < wanted->dimension;
        plan.low[axis] = has ? vec3_at(wanted->box.low, axis) : 0.0;
        plan.extent[axis] = has ? packing->extent[axis] : 1.0;
        plan.cells[axis] = has ? (int64_t)maximum(1.0, floor(plan.extent[axis] / wanted->size)) : 1;
        plan.cell[axis] = plan.extent[axis] / (double)plan.cells[axis];
        if (has)
            plan.least_cell = minimum(plan.least_cell, plan.cell[axis]);
    }
    const size_t cells = (size_t)(plan.cells[0] * plan.cells[1] * plan.cells[2]);
    const size_t count = (size_t)plan.count;
    struct tessellation *grains = memory_allocate(
        sizeof plan + count * (sizeof *plan.site + sizeof *plan.next + sizeof *plan.is_picked) +
        cells * sizeof *plan.head);
    if (!grains)
        return NULL;
    *grains = plan;
    grains->site = (double(*)[3])(grains + 1);
    grains->next = (int64_t *)(grains->site + count);
    grains->head = grains->next + count;
    grains->is_picked = (bool *)(grains->head + cells);
    for (size_t cell = 0; cell < cells; cell++)
        grains->head[cell] = -1;
    return grains;
}

static void fill_cells(struct tessellation *grains, const struct grains *packing)
{
    for (int64_t grain = 0; grain < grains->count; grain++) {
        double *site = grains->site[grain];
        for (int axis = 0; axis < grains->wanted.dimension; axis++)
            site[axis] = packing->center[grain][axis];
        const int64_t cell =
            (cell_of(grains, 2, site[2]) * grains->cells[1] + cell_of(grains, 1, site[1])) *
                grains->cells[0] +
            cell_of(grains, 0, site[0]);
        grains->next[grain] = grains->head[cell];
        grains->head[cell] = grain;
        grains->is_picked[grain] = true;
    }
}

/* What a lattice of samples sees: how many are in each grain and how far each is from a face. */
struct survey {
    int64_t count, *in_grain;
    double *to_face;
};

static void take_samples(const struct tessellation *grains, struct survey *survey)
{
    const int dimension = grains->wanted.dimension, along_axis = samples[dimension - 2];
    const int up = dimension == 3 ? along_axis : 1;
    for (int k = 0; k < up; k++)
        for (int j = 0; j < along_axis; j++)
            for (int i = 0; i < along_axis; i++) {
                const int step[3] = {i, j, k};
                double at[3] = {0.0, 0.0, 0.0};
                for (int axis = 0; axis < dimension; axis++)
                    at[axis] =
                        grains->low[axis] + (step[axis] + 0.5) / along_axis * grains->extent[axis];
                const struct nearest own = find_nearest(grains, at);
                survey->in_grain[own.grain]++;
                survey->to_face[survey->count++] =
                    isnan(grains->wanted.fraction)
                        ? 0.0
                        : distance_to_face(grains, at, &own, grains->wanted.size);
            }
}

static int lower_first(const void *a, const void *b)
{
    const double first = *(const double *)a, second = *(const double *)b;
    return first < second ? -1 : first > second;
}

/* Grains in the order of their numbers, which is random in place, as long as they fit in what is
 * wanted. */
static void pick_grains(struct tessellation *grains, const struct survey *survey)
{
    double room = grains->wanted.picked * (double)survey->count;
    for (int64_t grain = 0; grain < grains->count; grain++) {
        const double samples_here = (double)survey->in_grain[grain];
        grains->is_picked[grain] = samples_here <= room;
        if (grains->is_picked[grain])
            room -= samples_here;
    }
}

/* Sets the gap that leaves the fraction of the box to the grains, and picks some of them. */
static const char *measure(struct tessellation *grains)
{
    const double fraction = grains->wanted.fraction;
    if (isnan(fraction) && grains->wanted.picked >= 1.0)
        return NULL;
    const int dimension = grains->wanted.dimension;
    size_t all = 1;
    for (int axis = 0; axis < dimension; axis++)
        all *= (size_t)samples[dimension - 2];
    struct survey survey = {.in_grain = memory_allocate((size_t)grains->count * sizeof(int64_t)),
                            .to_face = memory_allocate(all * sizeof(double))};
    const bool has_memory = survey.in_grain && survey.to_face;
    if (has_memory) {
        take_samples(grains, &survey);
        pick_grains(grains, &survey);
        qsort(survey.to_face, (size_t)survey.count, sizeof(double), lower_first);
        const double left_out = (1.0 - fraction) * (double)survey.count;
        if (!isnan(fraction))
            grains->half_gap =
                survey.to_face[(int64_t)minimum(left_out, (double)survey.count - 1.0)];
    }
    free(survey.in_grain);
    free(survey.to_face);
    return has_memory ? NULL : "there is no memory to measure the grains";
}

const char *tessellation_make(const struct tessellation_wanted *wanted, struct tessellation **made)
{
    const bool is_plane = wanted->dimension == 2;
    const double fill = packed[wanted->dimension - 2];
    const double radius =
        wanted->size * (is_plane ? sqrt(fill / M_PI) : cube_root(fill * 0.75 / M_PI));
    struct grains_wanted sites = {.dimension = wanted->dimension,
                                  .box = wanted->box,
                                  .fraction = fill,
                                  .smallest = radius,
                                  .largest = radius,
                                  .seed = wanted->seed};
    for (int axis = 0; axis < 3; axis++) {
        sites.periodic[axis] = wanted->periodic[axis];
        const double extent = vec3_at(wanted->box.high, axis) - vec3_at(wanted->box.low, axis);
        if (axis < wanted->dimension && extent < 3.0 * wanted->size)
            return "the box must be at least three grains wide";
    }
    struct grains *packing = NULL;
    const char *text = grains_make(&sites, &packing);
    if (text)
        return "there are more than 50000 grains: repeat a smaller box that is periodic";
    struct tessellation *grains = open_cells(wanted, packing);
    if (grains)
        fill_cells(grains, packing);
    free(packing);
    text = grains ? measure(grains) : "there is no memory for these grains";
    if (text)
        free(grains);
    else
        *made = grains;
    return text;
}
