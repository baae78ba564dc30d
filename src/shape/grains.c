#include "shape/grains.h"

#include <stdlib.h>

#include "base/chance.h"
#include "base/exponential.h"
#include "base/memory.h"

/* How many places a grain tries; how many sweeps push grains apart, and visits of grains in them;
 * how many grains there may be; the largest relative change of the radii. */
enum { TRIES = 200, SWEEPS = 20000, MOST_GRAINS = 50000 };
static const double most_visits = 3e7, most_change = 0.05;

/* Grains push each other so much farther apart, relative to their distance, than they must be:
 * the last overlaps vanish after few sweeps. */
static const double margin = 1e-3;

enum { NEAR_CELLS = 27 };

static double sphere_volume(double radius, int dimension)
{
    return dimension == 2 ? M_PI * square(radius) : 4.0 / 3.0 * M_PI * square(radius) * radius;
}

static int64_t cell_along(const struct grains *grains, int axis, double at)
{
    const double low[3] = {grains->wanted.box.low.x, grains->wanted.box.low.y,
                           grains->wanted.box.low.z};
    if (grains->cells[axis] == 1)
        return 0;
    const double cell =
        floor((at - low[axis]) / grains->extent[axis] * (double)grains->cells[axis]);
    return (int64_t)minimum(maximum(cell, 0.0), (double)grains->cells[axis] - 1.0);
}

static int64_t cell_number(const struct grains *grains, const int64_t cell[3])
{
    return (cell[2] * grains->cells[1] + cell[1]) * grains->cells[0] + cell[0];
}

static int64_t cell_of(const struct grains *grains, const double at[3])
{
    const int64_t cell[3] = {cell_along(grains, 0, at[0]), cell_along(grains, 1, at[1]),
                             cell_along(grains, 2, at[2])};
    return cell_number(grains, cell);
}

/* The cells along AXIS within one of CELL, each once: how many. */
static int cells_along(const struct grains *grains, int axis, int64_t cell, int64_t near[3])
{
    const int64_t cells = grains->cells[axis];
    int count = 0;
    if (grains->wanted.periodic[axis] && cells > 2) {
        for (int64_t step = -1; step <= 1; step++)
            near[count++] = (cell + step + cells) % cells;
        return count;
    }
    for (int64_t at = cell > 0 ? cell - 1 : 0; at <= cell + 1 && at < cells; at++)
        near[count++] = at;
    return count;
}

/* The cells of all grains that reach a grain at AT; how many. */
static int cells_near(const struct grains *grains, const double at[3], int64_t near[NEAR_CELLS])
{
    int64_t along[3][3];
    int counts[3], count = 0;
    for (int axis = 0; axis < 3; axis++)
        counts[axis] = cells_along(grains, axis, cell_along(grains, axis, at[axis]), along[axis]);
    for (int k = 0; k < counts[2]; k++)
        for (int j = 0; j < counts[1]; j++)
            for (int i = 0; i < counts[0]; i++)
                near[count++] =
                    cell_number(grains, (const int64_t[3]){along[0][i], along[1][j], along[2][k]});
    return count;
}

/* The square of the vector BETWEEN a point and the nearest image of another. */
static double distance_square(const struct grains *grains, const double from[3], const double to[3],
                              double between[3])
{
    double sum = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        between[axis] = to[axis] - from[axis];
        if (grains->wanted.periodic[axis])
            between[axis] -=
                grains->extent[axis] * floor(between[axis] / grains->extent[axis] + 0.5);
        sum += square(between[axis]);
    }
    return sum;
}

static void insert(struct grains *grains, int64_t grain)
{
    const int64_t cell = cell_of(grains, grains->center[grain]);
    grains->next[grain] = grains->head[cell];
    grains->head[cell] = grain;
}

static void clear_cells(struct grains *grains)
{
    const int64_t cells = grains->cells[0] * grains->cells[1] * grains->cells[2];
    for (int64_t cell = 0; cell < cells; cell++)
        grains->head[cell] = -1;
}

/* Whole within the box where that ends, back through the opposite face where it is periodic. */
static void keep_in_box(const struct grains *grains, double at[3], double radius)
{
    const double low[3] = {grains->wanted.box.low.x, grains->wanted.box.low.y,
                           grains->wanted.box.low.z};
    const double reach = radius + grains->half_gap;
    for (int axis = 0; axis < grains->wanted.dimension; axis++) {
        const double extent = grains->extent[axis];
        if (grains->wanted.periodic[axis])
            at[axis] -= extent * floor((at[axis] - low[axis]) / extent);
        else
            at[axis] = maximum(minimum(at[axis], low[axis] + (extent - reach)), low[axis] + reach);
    }
}

/* Whether GRAIN is clear of all grains of the cells. */
static bool is_free(const struct grains *grains, int64_t grain)
{
    int64_t near[NEAR_CELLS];
    double between[3];
    const double *at = grains->center[grain];
    const int count = cells_near(grains, at, near);
    for (int i = 0; i < count; i++)
        for (int64_t other = grains->head[near[i]]; other >= 0; other = grains->next[other]) {
            const double apart = grains->radius[grain] + grains->radius[other] + grains->wanted.gap;
            if (other != grain &&
                distance_square(grains, at, grains->center[other], between) < square(apart))
                return false;
        }
    return true;
}

/* Places the grains one after the other; whether all have room. */
static bool place_grains(struct grains *grains)
{
    const double low[3] = {grains->wanted.box.low.x, grains->wanted.box.low.y,
                           grains->wanted.box.low.z};
    uint64_t draws = 200001; /* those before are of the radii */
    bool all_free = true;
    clear_cells(grains);
    for (int64_t grain = 0; grain < grains->count; grain++) {
        double *at = grains->center[grain];
        const double reach = grains->radius[grain] + grains->half_gap;
        bool is_placed = false;
        for (int try = 0; try < TRIES && !is_placed; try++) {
            for (int axis = 0; axis < grains->wanted.dimension; axis++) {
                const double rim = grains->wanted.periodic[axis] ? 0.0 : reach;
                at[axis] =
                    low[axis] + rim +
                    (grains->extent[axis] - 2.0 * rim) * chance_of(draws++, grains->wanted.seed);
            }
            keep_in_box(grains, at, grains->radius[grain]);
            is_placed = is_free(grains, grain);
        }
        all_free = all_free && is_placed;
        insert(grains, grain);
    }
    return all_free;
}

/* Moves GRAIN and OTHER apart, each by half of what is missing; whether they overlapped. */
static bool push_apart(struct grains *grains, int64_t grain, int64_t other)
{
    double between[3];
    const double apart = grains->radius[grain] + grains->radius[other] + grains->wanted.gap;
    const double wanted = apart * (1.0 + margin);
    const double now =
        distance_square(grains, grains->center[grain], grains->center[other], between);
    if (now >= square(wanted))
        return false;
    const double distance = sqrt(now), push = 0.5 * (wanted - distance);
    for (int axis = 0; axis < grains->wanted.dimension; axis++) {
        const double along = distance > 0.0 ? between[axis] / distance : axis == 0 ? 1.0 : 0.0;
        grains->center[grain][axis] -= push * along;
        grains->center[other][axis] += push * along;
    }
    keep_in_box(grains, grains->center[grain], grains->radius[grain]);
    keep_in_box(grains, grains->center[other], grains->radius[other]);
    return now < square(apart);
}

/* Pushes all grains apart that are too close; whether any overlapped. */
static bool sweep(struct grains *grains)
{
    bool overlapped = false;
    int64_t near[NEAR_CELLS];
    for (int64_t grain = 0; grain < grains->count; grain++) {
        const int count = cells_near(grains, grains->center[grain], near);
        for (int i = 0; i < count; i++)
            for (int64_t other = grains->head[near[i]]; other >= 0; other = grains->next[other])
                if (other < grain && push_apart(grains, grain, other))
                    overlapped = true;
    }
    return overlapped;
}

static void sort_into_cells(struct grains *grains)
{
    clear_cells(grains);
    for (int64_t grain = 0; grain < grains->count; grain++)
        insert(grains, grain);
}

static bool all_free(const struct grains *grains)
{
    for (int64_t grain = 0; grain < grains->count; grain++)
        if (!is_free(grains, grain))
            return false;
    return true;
}

/* Pushes grains apart until none overlaps; false when that takes too long. */
static bool relax(struct grains *grains)
{
    const double sweeps = minimum(SWEEPS, most_visits / (double)grains->count);
    for (int i = 0; i < sweeps; i++) {
        const bool overlapped = sweep(grains);
        sort_into_cells(grains);
        if (!overlapped && all_free(grains))
            return true;
    }
    return false;
}

static double radius_of(const struct grains_wanted *wanted, int64_t grain)
{
    return wanted->smallest +
           (wanted->largest - wanted->smallest) * chance_of((uint64_t)grain, wanted->seed);
}

/* The number of grains whose volume is nearest the wanted one, and the factor of their radii. */
static int64_t count_grains(const struct grains_wanted *wanted, double volume, double *factor)
{
    double sum = 0.0;
    for (int64_t grain = 0; grain < MOST_GRAINS; grain++) {
        const double one = sphere_volume(radius_of(wanted, grain), wanted->dimension);
        sum += one;
        if (sum < volume)
            continue;
        const bool is_last_one_left_out = grain > 0 && sum - volume > volume - (sum - one);
        const double ratio = volume / (is_last_one_left_out ? sum - one : sum);
        *factor = wanted->dimension == 2 ? sqrt(ratio) : cube_root(ratio);
        return is_last_one_left_out ? grain : grain + 1;
    }
    return MOST_GRAINS + 1;
}

static int larger_first(const void *a, const void *b)
{
    const double first = *(const double *)a, second = *(const double *)b;
    return first > second ? -1 : first < second;
}

/* Grains that reach one another are in neighbouring cells; not many more cells than grains. */
static void choose_cells(struct grains *grains)
{
    const double most = grains->wanted.dimension == 2 ? sqrt((double)grains->count)
                                                      : cube_root((double)grains->count);
    for (int axis = 0; axis < 3; axis++) {
        const double fit =
            floor(grains->extent[axis] / (2.0 * grains->reach * (1.0 + 2.0 * margin)));
        grains->cells[axis] = axis < grains->wanted.dimension
                                  ? (int64_t)maximum(1.0, minimum(fit, 4.0 * ceil(most)))
                                  : 1;
    }
}

/* The memory of COUNT grains with their radii, and cells. NULL: memory is out. */
static struct grains *open_grains(const struct grains_wanted *wanted, const double extent[3],
                                  int64_t count, double factor)
{
    struct grains plan = {.wanted = *wanted, .count = count, .half_gap = 0.5 * wanted->gap};
    plan.reach = wanted->largest * factor + plan.half_gap;
    for (int axis = 0; axis < 3; axis++)
        plan.extent[axis] = extent[axis];
    choose_cells(&plan);
    const size_t cells = (size_t)(plan.cells[0] * plan.cells[1] * plan.cells[2]);
    struct grains *grains = memory_allocate(
        sizeof plan +
        (size_t)count * (sizeof *plan.center + sizeof *plan.radius + sizeof *plan.next) +
        cells * sizeof *plan.head);
    if (!grains)
        return NULL;
    *grains = plan;
    grains->center = (double(*)[3])(grains + 1);
    grains->radius = (double *)(grains->center + count);
    grains->next = (int64_t *)(grains->radius + count);
    grains->head = grains->next + count;
    for (int64_t grain = 0; grain < count; grain++)
        grains->radius[grain] = factor * radius_of(wanted, grain);
    qsort(grains->radius, (size_t)count, sizeof *grains->radius, larger_first);
    return grains;
}

/* The part of the box that grains with half a gap around each fill. */
static double filled(const struct grains *grains, double volume)
{
    double sum = 0.0;
    for (int64_t grain = 0; grain < grains->count; grain++)
        sum += sphere_volume(grains->radius[grain] + grains->half_gap, grains->wanted.dimension);
    return sum / volume;
}

const char *grains_make(const struct grains_wanted *wanted, struct grains **made)
{
    const struct vec3 size = vec3_sub(wanted->box.high, wanted->box.low);
    const double extent[3] = {size.x, size.y, size.z};
    const double volume = size.x * size.y * (wanted->dimension == 3 ? size.z : 1.0);
    double factor = 1.0;
    for (int axis = 0; axis < wanted->dimension; axis++)
        if (extent[axis] < 4.0 * wanted->largest + 2.0 * wanted->gap)
            return "the box of a packing must be at least two of its largest grains wide, with "
                   "their gaps";
    const int64_t count = count_grains(wanted, wanted->fraction * volume, &factor);
    if (count > MOST_GRAINS)
        return "this packing has more than 50000 grains: repeat a smaller one that is periodic";
    if (fabs(factor - 1.0) > most_change)
        return "no whole number of grains gives this `fraction`, unless their radii change by more "
               "than 5 %: make the box larger or the grains smaller";
    struct grains *grains = open_grains(wanted, extent, count, factor);
    if (!grains)
        return "there is no memory for the grains of this packing";
    /* The densest packings of equal discs and spheres; those of grains of two radii are hardly
     * denser before they are far from random. */
    const bool is_possible = filled(grains, volume) < (wanted->dimension == 2 ? 0.9069 : 0.7405) &&
                             (place_grains(grains) || relax(grains));
    if (!is_possible) {
        free(grains);
        return "this `fraction` was not reached: choose a smaller one, a smaller `gap` or a "
               "larger box. Random packings, with half a gap around each grain, reach about 0.82 "
               "for discs and 0.62 for spheres, and less in a box of few grains; the grains of "
               "`voronoi` fill all of a box";
    }
    *made = grains;
    return NULL;
}

bool grains_hold(const struct grains *grains, struct vec3 point)
{
    const double at[3] = {point.x, point.y, grains->wanted.dimension == 3 ? point.z : 0.0};
    int64_t near[NEAR_CELLS];
    double between[3];
    const int count = cells_near(grains, at, near);
    for (int i = 0; i < count; i++)
        for (int64_t grain = grains->head[near[i]]; grain >= 0; grain = grains->next[grain])
            if (distance_square(grains, at, grains->center[grain], between) <
                square(grains->radius[grain]))
                return true;
    return false;
}
