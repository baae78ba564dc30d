/* The box that the gas solver computes, in cells, what is outside its faces, the planes there that
 * no rule of the halo fills, and what leaves through faces. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "gas/gas_internal.h"
#include "grid/levels.h"
#include "material/material.h"
#include "model/boundaries.h"
#include "parallel/block.h"
#include "shape/shape.h"

/* A face inside the domain would be none. */
static struct error *check_faces(const struct simulation_case *input,
                                 const struct face_place (*face)[2], double edge)
{
    struct error *error = NULL;
    for (int b = 0; b < input->boundaries.count; b++) {
        const struct boundary_input *boundary = case_boundary(input, b);
        if (isnan(boundary->at))
            continue;
        const double at = face[boundary->axis][boundary->side].at;
        if (fabs(boundary->at - at) > 1e-6 * edge)
            error = error_join(error, input_error(input, "boundaries", input->boundaries.names[b],
                                                  "in the solver gas this is a face of the domain, "
                                                  "which lies at %.6g m",
                                                  at));
    }
    return error;
}

/* The error of a domain that ends beyond all bodies; what blocks cells may fill what is there. */
static struct error *check_filled(const struct place *place, const struct face_place (*face)[2],
                                  double edge)
{
    const struct simulation_case *input = place->input;
    struct error *error = NULL;
    if (place_blocks_any(place) || (!input->domain.low.count && !input->domain.high.count))
        return NULL;
    for (int axis = 0; axis < input->dimension; axis++)
        for (int side = 0; side < 2; side++) {
            double reached = side ? -INFINITY : INFINITY;
            for (int b = 0; b < input->bodies.count; b++) {
                const struct bounds bounds = shape_bounds(&case_body(input, b)->shape);
                const struct vec3 end = side ? bounds.high : bounds.low;
                const double at = axis == 0 ? end.x : axis == 1 ? end.y : end.z;
                reached = side ? maximum(reached, at) : minimum(reached, at);
            }
            const double lacks = side ? face[axis][1].at - reached : reached - face[axis][0].at;
            if (lacks > 1e-6 * edge)
                error = error_join(
                    error, input_error(input, face[axis][side].section, face[axis][side].name,
                                       "no body fills the domain beyond %.6g m along %c", reached,
                                       "xyz"[axis]));
        }
    return error;
}

/* Cells of the finest level in a box, and so many AROUND it. */
static void pin(struct cell_blocks *cells, struct bounds box, int around)
{
    struct cell_region *region = &cells->region[cells->regions++];
    for (int axis = 0; axis < 3; axis++) {
        const double low = vec3_at(box.low, axis) + 1e-6 * cells->edge,
                     high = vec3_at(box.high, axis) - 1e-6 * cells->edge;
        region->low[axis] = cell_index(low, cells->edge, INT32_MAX) - around;
        region->high[axis] = cell_index(high, cells->edge, INT32_MAX) + 1 + around;
    }
}

/* Where levels meet no cell is blocked or has yet to burn, up to two of the next wider ones from
 * there. */
struct error *gas_take_levels(const struct place *place, struct cell_blocks *cells, int *lasting)
{
    const struct simulation_case *input = place->input;
    cells->levels = (int)input->levels;
    *lasting = 0;
    if (cells->levels < 2)
        return NULL;
    for (int b = 0; b < input->boundaries.count; b++)
        if (case_boundary(input, b)->kind == BOUNDARY_PERIODIC &&
            case_boundary(input, b)->axis >= 0)
            cells->periodic[case_boundary(input, b)->axis] = true;
    enum { AROUND_BODIES = 4 };
    const int most =
        input->fine.count + input->boundaries.count + input->bodies.count + PLACE_PINNED + 1;
    cells->region = memory_allocate((size_t)most * sizeof *cells->region);
    if (!cells->region)
        return out_of_memory();
    for (int k = 0; k < input->fine.count; k++)
        pin(cells, shape_bounds(&case_fine(input, k)->shape), 0);
    for (int b = 0; b < input->boundaries.count; b++)
        if (case_boundary(input, b)->kind == BOUNDARY_RIGID_BODY)
            pin(cells, shape_bounds(&case_boundary(input, b)->part), AROUND_BODIES);
    for (int k = 0; k < PLACE_PINNED; k++)
        if (place->pinned[k].low.x < place->pinned[k].high.x)
            pin(cells, place->pinned[k], AROUND_BODIES);
    *lasting = cells->regions;
    for (int b = 0; b < input->bodies.count; b++)
        if (material_is_lit(case_material(input, case_body(input, b)->material_index)->material))
            pin(cells, shape_bounds(&case_body(input, b)->shape), AROUND_BODIES);
    return NULL;
}

double gas_part_of_cells(const struct place *place)
{
    static const double reach = 1e6; /* cells */
    const struct simulation_case *input = place->input;
    const double width = ldexp(1.0, (int)input->levels);
    struct cell_blocks cells = {
        .dimension = (int)input->dimension, .edge = place->resolution, .high = {1, 1, 1}};
    double all = 1.0, found = 0.0;
    for (int axis = 0; axis < cells.dimension; axis++) {
        const double low = nearbyint(domain_face(input, axis, 0).at / cells.edge),
                     high = nearbyint(domain_face(input, axis, 1).at / cells.edge);
        if (!(fabs(low) < reach && fabs(high) < reach && high > low) || fmod(low, width) != 0.0 ||
            fmod(high, width) != 0.0)
            return 1.0;
        cells.low[axis] = (int64_t)low;
        cells.high[axis] = (int64_t)high;
        all *= high - low;
    }
    struct cell_block *list = NULL;
    int64_t count = 0;
    int lasting;
    struct error *error = gas_take_levels(place, &cells, &lasting);
    if (!error)
        error = levels_list(&cells, NULL, 0, &list, &count);
    for (int64_t b = 0; b < count && !error; b++)
        found += (double)list[b].count[0] * list[b].count[1] * list[b].count[2];
    free(cells.region);
    free(list);
    error_free(error);
    return found > 0.0 ? found / all : 1.0;
}

struct error *gas_find_domain(const struct simulation *simulation, struct cell_blocks *cells)
{
    static const double reach = 1e9; /* cells; beyond, places lose too many digits */
    const struct simulation_case *input = simulation->problem->input;
    const double edge = cells->edge;
    struct face_place face[3][2];
    struct error *error = NULL;
    for (int axis = 0; axis < 3; axis++) {
        cells->low[axis] = 0;
        cells->high[axis] = 1;
    }
    for (int axis = 0; axis < cells->dimension; axis++)
        for (int side = 0; side < 2; side++) {
            const struct face_place place = face[axis][side] = domain_face(input, axis, side);
            const double planes = place.at / edge, nearest = nearbyint(planes);
            if (!(fabs(planes) < reach))
                error = error_join(error, input_error(input, place.section, place.name,
                                                      "the face of the domain at %g m along %c is "
                                                      "beyond the grid: give a `domain`",
                                                      place.at, "xyz"[axis]));
            else if (fabs(planes - nearest) > 1e-6)
                error = error_join(
                    error, input_error(input, place.section, place.name,
                                       "the face of the domain at %.9g m along %c does not lie on "
                                       "a plane of the grid, whose cells are %.9g m wide from 0 "
                                       "on; the nearest is at %.9g m",
                                       place.at, "xyz"[axis], edge, nearest * edge));
            else
                (side ? cells->high : cells->low)[axis] = (int64_t)nearest;
        }
    if (error)
        return error;
    for (int axis = 0; axis < cells->dimension; axis++)
        if (cells->high[axis] <= cells->low[axis])
            return input_error(input, face[axis][1].section, face[axis][1].name,
                               "the domain has no cell along %c", "xyz"[axis]);
    if (geometry_power(input->geometry) > 0 && cells->low[0] < 0)
        return input_error(input, face[0][0].section, face[0][0].name,
                           "x is the radius: the domain may begin at x = 0");
    double all = 1.0;
    for (int axis = 0; axis < cells->dimension; axis++)
        all *= (double)(cells->high[axis] - cells->low[axis]);
    const int64_t width = (int64_t)1 << (cells->levels > 1 ? cells->levels : 0);
    for (int axis = 0; axis < cells->dimension; axis++)
        for (int side = 0; side < 2; side++)
            if ((side ? cells->high : cells->low)[axis] % width != 0)
                error = error_join(
                    error,
                    input_error(input, face[axis][side].section, face[axis][side].name,
                                "with %d levels the faces of the domain lie on planes of two "
                                "of the widest cells: choose a multiple of %.6g m along %c",
                                cells->levels, (double)width * edge, "xyz"[axis]));
    if (error)
        return error;
    if (all > 2e9 * simulation->ranks->size && cells->levels < 2)
        return input_error(input, "resolution", NULL,
                           "the domain has %.3g cells, and a rank computes 2e9 at most", all);
    const struct face_place(*faces)[2] = (const struct face_place(*)[2])face;
    return error_join(check_faces(input, faces, edge),
                      check_filled(&simulation->problem->place, faces, edge));
}

static bool varies(const struct boundary_input *boundary)
{
    bool varies =
        boundary->density.varying || boundary->pressure.varying || boundary->energy.varying;
    for (int axis = 0; axis < boundary->velocity.count; axis++)
        varies |= boundary->velocity.at[axis].varying != NULL;
    return varies;
}

/* What is wrong with what flows in through BOUNDARY at the start: of a state that varies, at the
 * cells outside the face, as fill_plane takes them; NULL: nothing is. */
static const char *inflow_wrong(const struct simulation *simulation,
                                const struct boundary_input *boundary,
                                const struct cell_blocks *cells, int material, struct vec3 *place,
                                const char **key)
{
    const struct material *of = &simulation->problem->material[material];
    const int axis = boundary->axis, a = (axis + 1) % 3, b = (axis + 2) % 3;
    struct point point;
    double velocity[3], at[3] = {0.0, 0.0, 0.0};
    *place = vec3_make(0.0, 0.0, 0.0);
    if (!varies(boundary))
        return boundary_state_at(boundary, of, *place, 0.0, &point, velocity, key);
    at[axis] = ((double)(boundary->side ? cells->high : cells->low)[axis] +
                (boundary->side ? 0.5 : -0.5)) *
               cells->edge;
    const int64_t rows = cells->high[a] - cells->low[a], columns = cells->high[b] - cells->low[b];
    const char *wrong = NULL;
    for (int64_t k = 0; k < rows * columns && !wrong; k++) {
        if (a < cells->dimension)
            at[a] = ((double)(cells->low[a] + k % rows) + 0.5) * cells->edge;
        if (b < cells->dimension)
            at[b] = ((double)(cells->low[b] + k / rows) + 0.5) * cells->edge;
        *place = vector_at(at);
        if (!boundary->part.choice || shape_inside(&boundary->part, *place))
            wrong = boundary_state_at(boundary, of, *place, 0.0, &point, velocity, key);
    }
    return wrong;
}

struct error *gas_check_inflows(const struct simulation *simulation,
                                const struct cell_blocks *cells, int material)
{
    const struct simulation_case *input = simulation->problem->input;
    struct error *error = NULL;
    for (int b = 0; b < input->boundaries.count; b++) {
        const struct boundary_input *boundary = case_boundary(input, b);
        const char *key = "", *wrong = NULL;
        char name[160];
        struct vec3 place;
        if (boundary->kind == BOUNDARY_INFLOW)
            wrong = inflow_wrong(simulation, boundary, cells, material, &place, &key);
        if (!wrong)
            continue;
        snprintf(name, sizeof name, "%.100s%s%s", input->boundaries.names[b], *key ? "." : "", key);
        error = error_join(error, varies(boundary)
                                      ? input_error(input, "boundaries", name,
                                                    "%s (at [%.6g, %.6g, %.6g] m, t = 0)", wrong,
                                                    place.x, place.y, place.z)
                                      : input_error(input, "boundaries", name, "%s", wrong));
    }
    return error;
}

void gas_find_faces(const struct simulation *simulation, const struct cell_blocks *cells,
                    struct cell_halo *halo)
{
    const struct simulation_case *input = simulation->problem->input;
    if (geometry_power(input->geometry) > 0 && cells->low[0] == 0)
        halo->face[0][0] = CELL_FACE_MIRROR;
    for (int b = 0; b < input->boundaries.count; b++) {
        const struct boundary_input *boundary = case_boundary(input, b);
        enum cell_face *face = boundary->axis < 0 ? NULL : halo->face[boundary->axis];
        if (boundary->kind == BOUNDARY_RIGID_BODY)
            continue;
        if (boundary->kind == BOUNDARY_PERIODIC)
            face[0] = face[1] = CELL_FACE_PERIODIC;
        else if (boundary->kind == BOUNDARY_INFLOW || boundary->part.choice)
            face[boundary->side] = CELL_FACE_FILLED;
        else if (face[boundary->side] != CELL_FACE_FILLED)
            face[boundary->side] =
                boundary_kind_closes(boundary->kind) ? CELL_FACE_MIRROR : CELL_FACE_COPIES;
    }
}

/* What is outside a face at PLACE: the last boundary that names it, -1 for none. */
static int boundary_at(const struct simulation_case *input, int axis, int side, struct vec3 place)
{
    for (int b = input->boundaries.count - 1; b >= 0; b--) {
        const struct boundary_input *boundary = case_boundary(input, b);
        if (boundary->axis == axis && boundary->side == side &&
            (!boundary->part.choice || shape_inside(&boundary->part, place)))
            return b;
    }
    return -1;
}

/* Whether a place of a face with parts is closed where no boundary names it. */
static bool is_closed(const struct simulation *simulation, const struct cell_blocks *cells,
                      int axis, int side)
{
    return geometry_power((int)simulation->problem->geometry) > 0 && axis == 0 && side == 0 &&
           cells->low[0] == 0;
}

/* Conserved numbers of what flows in. */
static struct error *inflow(const struct simulation *simulation, int material, int boundary,
                            struct vec3 place, double time, double *number)
{
    const struct simulation_case *input = simulation->problem->input;
    struct point point;
    const char *key = "";
    double velocity[3] = {0.0}, kinetic = 0.0;
    const char *wrong =
        boundary_state_at(case_boundary(input, boundary), &simulation->problem->material[material],
                          place, time, &point, velocity, &key);
    if (wrong)
        return error_new(ERROR_STATE, "boundaries.%s%s%s: %s (at t = %.6g s)",
                         input->boundaries.names[boundary], *key ? "." : "", key, wrong, time);
    for (int axis = 0; axis < 3; axis++) {
        number[GAS_MOMENTUM + axis] = point.density * velocity[axis];
        kinetic += 0.5 * square(velocity[axis]);
    }
    number[GAS_DENSITY] = point.density;
    number[GAS_ENERGY] = point.density * (point.energy + kinetic);
    number[GAS_SHOCK] = 0.0;
    return NULL;
}

/* The value of number N at place C of a plane from a cell inside the domain. */
static double from_source(const struct gas *gas, const struct cell_blocks *cells, int axis,
                          const struct cell_source *source, int i, int j, int rows, int n)
{
    double value;
    if (source->block >= 0) {
        const struct cell_block *block = &cells->block[source->block];
        const int first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
        value = gas->u[n][block->first + source->at * cell_stride(block, axis) +
                          i * cell_stride(block, first) + j * cell_stride(block, second)];
    } else
        value = cell_plane(&gas->halo, cells->dimension, axis, source->at, n)[i + j * rows];
    return source->turned && n == GAS_MOMENTUM + axis ? -value : value;
}

/* The place of a row across an axis, at its first two other axes FIRST and SECOND. */
static void row_place(const struct cell_blocks *cells, const struct cell_block *block, int first,
                      int second, int row, double at[3])
{
    const double edge = cell_block_edge(cells, block);
    const int64_t cell[2] = {block->corner[first] + row % block->count[first],
                             block->corner[second] + row / block->count[first]};
    at[first] = first < cells->dimension ? ((double)cell[0] + 0.5) * edge : 0.0;
    at[second] = second < cells->dimension ? ((double)cell[1] + 0.5) * edge : 0.0;
}

static struct error *fill_plane(const struct gas *gas, const struct simulation *simulation,
                                int axis, const struct cell_filled *filled, double time)
{
    const struct simulation_case *input = simulation->problem->input;
    const struct cell_blocks *cells = gas->cells;
    const struct cell_block *block = &cells->block[filled->block];
    const int first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2, rows = block->count[first];
    const double edge = cell_block_edge(cells, block);
    const bool closed = is_closed(simulation, cells, axis, filled->side);
    for (int j = 0; j < block->count[second]; j++)
        for (int i = 0; i < rows; i++) {
            double at[3] = {0.0, 0.0, 0.0}, number[GAS_FIELDS] = {0.0};
            if (gas->layout.open >= 0)
                number[gas->layout.open] = 1.0;
            if (gas->layout.burnt >= 0)
                number[gas->layout.burnt] = 1.0;
            row_place(cells, block, first, second, i + j * rows, at);
            at[axis] = (double)(filled->side ? cells->high : cells->low)[axis] * cells->edge;
            const int b = boundary_at(input, axis, filled->side, vec3_make(at[0], at[1], at[2]));
            const bool mirror =
                b < 0 ? closed : boundary_kind_closes(case_boundary(input, b)->kind);
            if (b >= 0 && case_boundary(input, b)->kind == BOUNDARY_INFLOW) {
                /* the state is one of the cell outside */
                at[axis] = ((double)filled->at + 0.5) * edge;
                TRY(inflow(simulation, gas->material[0], b, vec3_make(at[0], at[1], at[2]), time,
                           number));
            } else
                for (int n = 0; n < gas->halo.numbers; n++)
                    number[n] = from_source(
                        gas, cells, axis, mirror ? &filled->mirror : &filled->copy, i, j, rows, n);
            for (int n = 0; n < gas->halo.numbers; n++)
                cell_plane(&gas->halo, cells->dimension, axis, filled->plane, n)[i + j * rows] =
                    number[n];
        }
    return NULL;
}

struct error *gas_fill_planes(const struct gas *gas, const struct simulation *simulation, int axis,
                              double time)
{
    const struct cell_halo_axis *halo = &gas->halo.axis[axis];
    for (int32_t f = 0; f < halo->fills; f++)
        TRY(fill_plane(gas, simulation, axis, &halo->filled[f], time));
    return NULL;
}

/* The area of a face whose centre is AT; of a radian or steradian where x is a radius. */
static double area_of(const struct simulation *simulation, double edge, const double at[3])
{
    const double area = simulation->problem->dimension == 1   ? 1.0
                        : simulation->problem->dimension == 2 ? edge
                                                              : edge * edge;
    const int power = geometry_power(simulation->problem->geometry);
    return power == 0 ? area : power == 1 ? area * at[0] : area * square(at[0]);
}

/* Whether the cell above the face at AT across AXIS, or with SIGN -1 that below, lies in the box
 * that a coupling watches: what it holds does not count. */
static bool is_watched(const struct gas *gas, const double at[3], int axis, double sign)
{
    bool inside = gas->cut != NULL;
    for (int k = 0; k < gas->cells->dimension && inside; k++) {
        const double place = at[k] / gas->cells->edge + (k == axis ? 0.5 * sign : 0.0);
        inside = place > (double)gas->cut->low[k] && place < (double)gas->cut->high[k];
    }
    return inside;
}

/* Books what a FLUX along AXIS has brought to the gas above a face at AT of a cell of EDGE, or,
 * with SIGN -1, to that below. */
static void book(const struct gas *gas, const struct simulation *simulation, int axis, double edge,
                 const double at[3], const double *flux, double sign, double dt,
                 enum ledger_cause cause, struct ledger *ledger)
{
    if (is_watched(gas, at, axis, sign))
        return;
    const double amount = sign * dt * area_of(simulation, edge, at);
    const struct vec3 momentum =
        vec3_make(amount * flux[GAS_MOMENTUM], amount * flux[GAS_MOMENTUM + 1],
                  amount * flux[GAS_MOMENTUM + 2]);
    if (amount != 0.0)
        ledger_book(ledger, cause, amount * flux[GAS_DENSITY], momentum,
                    vec3_make(at[0], at[1], at[2]), amount * flux[GAS_ENERGY]);
}

void gas_book(const struct gas *gas, const struct simulation *simulation,
              const struct gas_strip *strip, const struct gas_through *through, int axis, double dt,
              struct ledger *ledger)
{
    const struct cell_blocks *cells = gas->cells;
    const struct cell_block *low = &cells->block[strip->block[0]],
                            *high = &cells->block[strip->block[strip->count - 1]];
    const int first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2, rows = low->count[first];
    const double edge = cell_block_edge(cells, low);
    const int64_t end = high->corner[axis] + high->count[axis];
    for (int row = 0; row < rows * low->count[second]; row++)
        for (int side = 0; side < 2; side++) {
            const enum cell_face face = gas->halo.face[axis][side];
            if ((side ? end : low->corner[axis]) !=
                    cell_domain_end(cells, low->level, axis, side) ||
                face == CELL_FACE_PERIODIC)
                continue;
            double at[3] = {0.0, 0.0, 0.0};
            row_place(cells, low, first, second, row, at);
            at[axis] = (double)(side ? cells->high : cells->low)[axis] * cells->edge;
            book(gas, simulation, axis, edge, at, through->end[side][row], side ? -1.0 : 1.0, dt,
                 face == CELL_FACE_MIRROR ? LEDGER_WALLS : LEDGER_OUTFLOWS, ledger);
        }
    for (int row = 0; row < rows * low->count[second] && axis == 0 && gas->round; row++) {
        double at[3] = {0.0, 0.0, 0.0};
        row_place(cells, low, first, second, row, at);
        const double section = cells->dimension == 1 && gas->round == 1 ? edge : edge * edge;
        for (int s = 0; s < strip->count; s++)
            ledger_book(ledger, LEDGER_AXIS, 0.0,
                        vec3_make(dt * section * through->push[row][s], 0.0, 0.0),
                        vec3_make(at[0], at[1], at[2]), 0.0);
    }
    for (int k = 0; k < through->obstacles; k++) {
        double at[3] = {0.0, 0.0, 0.0};
        row_place(cells, low, first, second, through->obstacle[k].row, at);
        at[axis] = (double)(low->corner[axis] + through->obstacle[k].face) * edge;
        book(gas, simulation, axis, edge, at, through->obstacle[k].flux,
             (double)through->obstacle[k].side, dt, LEDGER_WALLS, ledger);
    }
}
