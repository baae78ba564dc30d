/* What the files of markers share: the places of the domain, and what each file does. Private to
 * gas/. */
#ifndef BOLIDE_GAS_MARKER_GRID_H
#define BOLIDE_GAS_MARKER_GRID_H

#include "gas/markers.h"

/* Places of the domain: their counts along the axes, and the number of the one AT. */
struct marker_grid {
    const struct gas *gas;
    int dimension;
    int64_t count[3];
};

BOLIDE_INLINE struct marker_grid marker_grid_of(const struct gas *gas)
{
    struct marker_grid grid = {.gas = gas, .dimension = gas->cells->dimension};
    for (int axis = 0; axis < 3; axis++)
        grid.count[axis] = gas->cells->high[axis] - gas->cells->low[axis];
    return grid;
}

BOLIDE_INLINE int64_t marker_place_at(const struct marker_grid *grid, const int64_t at[3])
{
    return at[0] + grid->count[0] * (at[1] + grid->count[1] * at[2]);
}

BOLIDE_INLINE void marker_at_place(const struct marker_grid *grid, int64_t place, int64_t at[3])
{
    at[0] = place % grid->count[0];
    at[1] = place / grid->count[0] % grid->count[1];
    at[2] = place / (grid->count[0] * grid->count[1]);
}

/* The place around AT that is DELTA from it; false beyond the domain and where it is blocked. */
BOLIDE_INLINE bool marker_beside(const struct marker_grid *grid, const int64_t at[3],
                                 const int delta[3], int64_t *place)
{
    int64_t to[3];
    for (int axis = 0; axis < 3; axis++) {
        to[axis] = at[axis] + delta[axis];
        if (to[axis] < 0 || to[axis] >= grid->count[axis])
            return false;
    }
    *place = marker_place_at(grid, to);
    const struct gas *gas = grid->gas;
    return !gas->open || gas->open[gas->markers->cell[*place]] != 0.0;
}

/* A loop over the ways, DELTA, to the places around one, up to FAR away along each axis. */
#define FOR_AROUND(grid, far, delta)                                                            \
    for (int a_ = 0, s_ = 2 * (far) + 1,                                                        \
             all_ = s_ * ((grid)->dimension > 1 ? s_ : 1) * ((grid)->dimension > 2 ? s_ : 1);   \
         a_ < all_; a_++)                                                                       \
        for (int delta[3] = {a_ % s_ - (far), (grid)->dimension > 1 ? a_ / s_ % s_ - (far) : 0, \
                             (grid)->dimension > 2 ? a_ / (s_ * s_) - (far) : 0},               \
                 once_ = 1;                                                                     \
             once_; once_ = 0)

BOLIDE_INLINE double marker_fraction_at(const struct marker_grid *grid, int64_t place)
{
    return grid->gas->u[GAS_FRACTION][grid->gas->markers->cell[place]];
}

BOLIDE_INLINE bool marker_is_pure(double fraction) { return fraction == 0.0 || fraction == 1.0; }

/* The place of the marker, -1 beyond the domain. */
BOLIDE_INLINE int64_t marker_place_of(const struct marker_grid *grid,
                                      const struct gas_marker *marker)
{
    const struct cell_blocks *cells = grid->gas->cells;
    int64_t at[3] = {0, 0, 0};
    for (int axis = 0; axis < grid->dimension; axis++) {
        at[axis] = (int64_t)floor(marker->at[axis] / cells->edge) - cells->low[axis];
        if (at[axis] < 0 || at[axis] >= grid->count[axis])
            return -1;
    }
    return marker_place_at(grid, at);
}

/* Of marker_seeds.c: one more marker; EACH markers along each axis in the cell at PLACE; how many
 * of both materials places have; removes those that are deleted; which places are near the
 * interface; more markers where there are few, and fewer where there are many, with room for
 * NUMBER. */
struct error *marker_add(struct gas_markers *markers, const double at[3], bool second);
struct error *marker_seed(const struct marker_grid *grid, int64_t place, int each);
void marker_count(const struct marker_grid *grid, int32_t (*number)[2]);
void marker_close_up(struct gas_markers *markers);
void marker_mark_near(const struct marker_grid *grid);
struct error *marker_reseed(const struct marker_grid *grid, int32_t (*number)[2]);

/* Of marker_cells.c: the volumes that markers stand for; the states of all cells by these; those at
 * the start, with fractions as they are. */
void marker_find_volumes(const struct marker_grid *grid, int32_t (*number)[2]);
struct error *marker_put_states(const struct marker_grid *grid);
void marker_begin_states(const struct marker_grid *grid);

#endif
