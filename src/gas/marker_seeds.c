/* Where markers are: near the interface, as many as its cells need; see markers.h. */
#include "gas/marker_grid.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "material/material.h"

/* Marks the places within 3 cells of the interface: of mixed cells, and of pure ones with a pure
 * one of the other material at a face. */
void marker_mark_near(const struct marker_grid *grid)
{
    enum { FAR = 3 };
    struct gas_markers *markers = grid->gas->markers;
    memset(markers->near, 0, (size_t)markers->cells);
    for (int64_t n = 0; n < markers->cells; n++) {
        const double own = marker_fraction_at(grid, n);
        int64_t at[3], other;
        marker_at_place(grid, n, at);
        bool is = !marker_is_pure(own);
        for (int face = 0; face < 2 * grid->dimension && !is; face++) {
            int delta[3] = {0, 0, 0};
            delta[face / 2] = face % 2 ? 1 : -1;
            is = marker_beside(grid, at, delta, &other) && marker_fraction_at(grid, other) != own;
        }
        if (!is)
            continue;
        FOR_AROUND(grid, FAR, delta)
        if (marker_beside(grid, at, delta, &other))
            markers->near[other] = 1;
    }
}

struct error *marker_add(struct gas_markers *markers, const double at[3], bool second)
{
    if (!memory_reserve((void **)&markers->marker, &markers->capacity, markers->count + 1,
                        markers->count, sizeof *markers->marker))
        return out_of_memory_for("markers");
    markers->marker[markers->count++] =
        (struct gas_marker){{at[0], at[1], at[2]}, second, 0.0, 0.0};
    return NULL;
}

/* Puts EACH markers along each axis into the cell at PLACE. Of a mixed one the second material gets
 * those that lie furthest towards the cells which have more of it, as many as its fraction says. */
struct error *marker_seed(const struct marker_grid *grid, int64_t place, int each)
{
    struct gas_markers *markers = grid->gas->markers;
    const struct cell_blocks *cells = grid->gas->cells;
    const double fraction = marker_fraction_at(grid, place),
                 *centre = cells->position[markers->cell[place]];
    int64_t at[3], other;
    double slope[3] = {0.0, 0.0, 0.0};
    marker_at_place(grid, place, at);
    FOR_AROUND(grid, 1, delta)
    for (int axis = 0; axis < 3 && marker_beside(grid, at, delta, &other); axis++)
        slope[axis] += delta[axis] * marker_fraction_at(grid, other);
    int all = 1, seconds = 0;
    for (int axis = 0; axis < grid->dimension; axis++)
        all *= each;
    if (fraction > 0.0)
        seconds = fraction < 1.0
                      ? (int)minimum(maximum(floor(fraction * all + 0.5), 1.0), (double)(all - 1))
                      : all;
    const int64_t first = markers->count;
    for (int k = 0; k < all; k++) {
        double to[3] = {centre[0], centre[1], centre[2]};
        for (int axis = 0, rest = k; axis < grid->dimension; axis++, rest /= each)
            to[axis] += cells->edge * ((rest % each + 0.5) / each - 0.5);
        TRY(marker_add(markers, to, false));
    }
    for (int n = 0; n < seconds; n++) {
        int64_t best = -1;
        double most = -INFINITY;
        for (int64_t k = first; k < markers->count; k++) {
            double along = 0.0;
            for (int axis = 0; axis < grid->dimension; axis++)
                along += slope[axis] * (markers->marker[k].at[axis] - centre[axis]);
            if (markers->marker[k].second == 0.0 && along > most) {
                most = along;
                best = k;
            }
        }
        markers->marker[best].second = 1.0;
    }
    return NULL;
}

/* How many markers of both materials the places have, into NUMBER. */
void marker_count(const struct marker_grid *grid, int32_t (*number)[2])
{
    const struct gas_markers *markers = grid->gas->markers;
    memset(number, 0, (size_t)markers->cells * sizeof *number);
    for (int64_t k = 0; k < markers->count; k++)
        number[marker_place_of(grid, &markers->marker[k])][markers->marker[k].second != 0.0]++;
}

/* Removes those that are deleted. */
void marker_close_up(struct gas_markers *markers)
{
    int64_t kept = 0;
    for (int64_t k = 0; k < markers->count; k++)
        if (markers->marker[k].deleted == 0.0)
            markers->marker[kept++] = markers->marker[k];
    markers->count = kept;
}

/* More markers where pure cells near the interface have hardly any, fewer where many lie far from
 * it. */
struct error *marker_reseed(const struct marker_grid *grid, int32_t (*number)[2])
{
    enum { FEW = 2, MANY = 16 };
    struct gas_markers *markers = grid->gas->markers;
    marker_count(grid, number);
    marker_mark_near(grid);
    for (int64_t k = 0; k < markers->count; k++) {
        const int64_t place = marker_place_of(grid, &markers->marker[k]);
        int32_t *of = number[place];
        if (!markers->near[place] && marker_is_pure(marker_fraction_at(grid, place)) &&
            of[0] + of[1] > MANY) {
            markers->marker[k].deleted = 1.0;
            of[markers->marker[k].second != 0.0]--;
        }
    }
    marker_close_up(markers);
    for (int64_t n = 0; n < markers->cells; n++) {
        const double own = marker_fraction_at(grid, n);
        if (!markers->near[n] || !marker_is_pure(own) || number[n][0] + number[n][1] >= FEW)
            continue;
        int64_t at[3], other;
        bool pure = !grid->gas->open || grid->gas->open[markers->cell[n]] != 0.0;
        marker_at_place(grid, n, at);
        FOR_AROUND(grid, 1, delta)
        if (marker_beside(grid, at, delta, &other))
            pure &= marker_is_pure(marker_fraction_at(grid, other));
        if (pure)
            TRY(marker_seed(grid, n, grid->dimension == 1 ? 4 : 2));
    }
    return NULL;
}
