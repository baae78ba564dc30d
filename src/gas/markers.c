/* Markers of the interface of two materials: how they move, and their memory; see markers.h. */
#include "gas/marker_grid.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "material/material.h"

void gas_count_heat(struct gas *gas)
{
    for (int m = 0; m < 2; m++)
        gas->heat[m] = eos_take_heat(&gas->eos[m]);
}

/* The value at XI, -1 to 1 of a cell from the middle of three, of the parabola through A, B and C
 * (3-11). */
static double parabola(double a, double b, double c, double xi)
{
    return 0.5 * (a - 2.0 * b + c) * xi * xi + 0.5 * (c - a) * xi + b;
}

/* The velocity at a marker, from the cells around it (3-9) to (3-12), within what these have.
 * Beyond walls the gas flows back, beyond other ends as in the cell. */
static void velocity_at(const struct marker_grid *grid, const struct gas_marker *marker,
                        double out[3])
{
    const struct gas *gas = grid->gas;
    const struct cell_blocks *cells = gas->cells;
    double values[27][3], low[3], high[3], xi[3] = {0.0, 0.0, 0.0};
    int64_t at[3], other;
    const int64_t place = marker_place_of(grid, marker);
    const int32_t own = gas->markers->cell[place];
    marker_at_place(grid, place, at);
    for (int axis = 0; axis < grid->dimension; axis++)
        xi[axis] = (marker->at[axis] - cells->position[own][axis]) / cells->edge;
    for (int axis = 0; axis < 3; axis++)
        low[axis] = high[axis] = cells->velocity[own][axis];
    int n = 0;
    FOR_AROUND(grid, 1, delta)
    {
        const bool inside = marker_beside(grid, at, delta, &other);
        for (int axis = 0; axis < 3; axis++) {
            double value = cells->velocity[inside ? gas->markers->cell[other] : own][axis];
            const int64_t to = at[axis] + delta[axis];
            const int side = to < 0 ? 0 : 1;
            const bool beyond = to < 0 || to >= grid->count[axis];
            if (!inside && delta[axis] != 0 &&
                (!beyond || gas->halo.face[axis][side] == CELL_FACE_MIRROR))
                value = -value;
            low[axis] = minimum(low[axis], value);
            high[axis] = maximum(high[axis], value);
            values[n][axis] = value;
        }
        n++;
    }
    for (int axis = 0; axis < 3; axis++) {
        double line[9], row[3];
        const int lines = n / 3, rows = n / 9;
        for (int k = 0; k < lines; k++)
            line[k] = parabola(values[3 * k][axis], values[3 * k + 1][axis],
                               values[3 * k + 2][axis], xi[0]);
        for (int k = 0; k < rows; k++)
            row[k] = parabola(line[3 * k], line[3 * k + 1], line[3 * k + 2], xi[1]);
        const double value = lines == 1  ? line[0]
                             : rows == 1 ? row[0]
                                         : parabola(row[0], row[1], row[2], xi[2]);
        out[axis] = minimum(maximum(value, low[axis]), high[axis]);
    }
}

/* Carries a marker over DT: walls throw it back, other faces let it go, and it does not enter
 * blocked cells. */
static void move(const struct marker_grid *grid, struct gas_marker *marker, double dt)
{
    const struct gas *gas = grid->gas;
    const struct cell_blocks *cells = gas->cells;
    const struct gas_marker before = *marker;
    double velocity[3];
    velocity_at(grid, marker, velocity);
    for (int axis = 0; axis < grid->dimension; axis++) {
        double *x = &marker->at[axis];
        *x += dt * velocity[axis];
        for (int side = 0; side < 2; side++) {
            const double plane = cells->edge * (double)(side ? cells->high : cells->low)[axis];
            if (side ? *x < plane : *x >= plane)
                continue;
            if (gas->halo.face[axis][side] == CELL_FACE_MIRROR)
                *x = side ? minimum(2.0 * plane - *x, nextafter(plane, -INFINITY))
                          : 2.0 * plane - *x;
            else
                marker->deleted = 1.0;
        }
    }
    const int64_t place = marker->deleted != 0.0 ? 0 : marker_place_of(grid, marker);
    if (marker->deleted == 0.0 && gas->open && gas->open[gas->markers->cell[place]] == 0.0)
        *marker = before;
}

struct error *gas_move_markers(struct gas *gas, const struct simulation *simulation, double dt)
{
    const struct marker_grid grid = marker_grid_of(gas);
    struct gas_markers *markers = gas->markers;
    int32_t(*number)[2] = memory_allocate((size_t)markers->cells * sizeof *number + 1);
    if (!number)
        return out_of_memory_for("markers");
    marker_find_volumes(&grid, number);
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int64_t k = 0; k < markers->count; k++)
        move(&grid, &markers->marker[k], dt);
    marker_close_up(markers);
    struct error *error = marker_put_states(&grid);
    if (!error)
        error = marker_reseed(&grid, number);
    free(number);
    return error;
}

static struct error *reserve(struct gas *gas)
{
    struct gas_markers *markers = gas->markers = memory_allocate(sizeof *markers);
    const struct marker_grid grid = marker_grid_of(gas);
    const struct cell_blocks *cells = gas->cells;
    if (!markers)
        return out_of_memory_for("markers");
    *markers = (struct gas_markers){.cells = grid.count[0] * grid.count[1] * grid.count[2]};
    const size_t size = (size_t)markers->cells;
    markers->cell = memory_allocate(size * sizeof *markers->cell + 1);
    markers->near = memory_allocate(size + 1);
    markers->before = memory_allocate(size * sizeof(double) + 1);
    for (int m = 0; m < 2; m++) {
        markers->energy[m] = memory_allocate(size * sizeof(double) + 1);
        markers->volume[m] = memory_allocate(size * sizeof(double) + 1);
        if (!markers->energy[m] || !markers->volume[m])
            return out_of_memory_for("markers");
        memset(markers->energy[m], 0, size * sizeof(double));
    }
    if (!markers->cell || !markers->near || !markers->before)
        return out_of_memory_for("markers");
    for (int32_t i = 0; i < cells->count; i++) {
        int64_t at[3] = {0, 0, 0};
        for (int axis = 0; axis < grid.dimension; axis++)
            at[axis] = (int64_t)floor(cells->position[i][axis] / cells->edge) - cells->low[axis];
        markers->cell[marker_place_at(&grid, at)] = i;
    }
    return NULL;
}

struct error *gas_make_markers(struct gas *gas)
{
    if (!gas->markers)
        TRY(reserve(gas));
    const struct marker_grid grid = marker_grid_of(gas);
    struct gas_markers *markers = gas->markers;
    markers->count = 0;
    marker_mark_near(&grid);
    for (int64_t n = 0; n < markers->cells; n++) {
        const int32_t i = markers->cell[n];
        const bool mixed = !marker_is_pure(marker_fraction_at(&grid, n));
        if (gas->open && gas->open[i] == 0.0)
            continue;
        if (mixed || markers->near[n])
            TRY(marker_seed(&grid, n, (grid.dimension == 1 ? 4 : 2) * (mixed ? 2 : 1)));
    }
    marker_begin_states(&grid);
    return NULL;
}

void gas_forget_markers(struct gas *gas)
{
    if (gas->markers)
        gas->markers->count = 0;
}

struct error *gas_add_marker(struct gas *gas, const double at[3], bool second)
{
    if (!gas->layout.marked)
        return NULL;
    if (!gas->markers) /* resumed before there were any */
        TRY(reserve(gas));
    return marker_add(gas->markers, at, second);
}

struct error *gas_settle_markers(struct gas *gas)
{
    if (!gas->markers)
        return NULL;
    const struct marker_grid grid = marker_grid_of(gas);
    struct gas_markers *markers = gas->markers;
    int32_t(*number)[2] = memory_allocate((size_t)markers->cells * sizeof *number + 1);
    if (!number)
        return out_of_memory_for("markers");
    for (int64_t k = 0; k < markers->count; k++)
        if (marker_place_of(&grid, &markers->marker[k]) < 0)
            markers->marker[k].deleted = 1.0;
    marker_close_up(markers);
    marker_count(&grid, number);
    for (int64_t n = 0; n < markers->cells; n++) {
        const int32_t i = markers->cell[n], *of = number[n];
        double *fraction = &gas->u[GAS_FRACTION][i];
        if (gas->open && gas->open[i] == 0.0)
            continue;
        if (of[0] > 0 && of[1] > 0)
            *fraction = minimum(maximum(*fraction, 0.01), 0.99);
        else
            *fraction = of[0] + of[1] > 0 ? of[1] > 0 : *fraction > 0.5;
    }
    marker_begin_states(&grid);
    struct error *error = marker_reseed(&grid, number);
    free(number);
    return error;
}

void gas_free_markers(struct gas *gas)
{
    struct gas_markers *markers = gas->markers;
    if (!markers)
        return;
    free(markers->marker);
    free(markers->cell);
    free(markers->near);
    free(markers->before);
    for (int m = 0; m < 2; m++) {
        free(markers->energy[m]);
        free(markers->volume[m]);
    }
    free(markers);
    gas->markers = NULL;
}

struct error *gas_visit_markers(struct gas *gas, struct visitor *visitor)
{
    if (!gas->markers)
        TRY(reserve(gas));
    struct gas_markers *markers = gas->markers;
    const int64_t known = markers->count;
    TRY(visitor->visit(visitor, "markers/count", NUMBER_INT64, &markers->count, 1, 1));
    if (markers->count < 0 || (visitor->most && markers->count > visitor->most))
        return error_new(ERROR_SYSTEM, "markers/count is %lld: a file of this size has 0 to %lld",
                         (long long)markers->count, (long long)visitor->most);
    if (!memory_reserve((void **)&markers->marker, &markers->capacity, markers->count + 1,
                        minimum(known, markers->count), sizeof *markers->marker))
        return out_of_memory_for("markers");
    TRY(visitor->visit(visitor, "markers/marker", NUMBER_DOUBLE, markers->marker, markers->count,
                       (int)(sizeof(struct gas_marker) / sizeof(double))));
    TRY(visitor->visit(visitor, "markers/first", NUMBER_DOUBLE, markers->energy[0], markers->cells,
                       1));
    TRY(visitor->visit(visitor, "markers/second", NUMBER_DOUBLE, markers->energy[1], markers->cells,
                       1));
    return visitor->visit(visitor, "markers/before", NUMBER_DOUBLE, markers->before, markers->cells,
                          1);
}
