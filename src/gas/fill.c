/* What the bodies of a case put into cells: means over cells of mass, momentum and energy. A cell
 * that lies in one body has those of its Gauss points, one that more bodies share those of its
 * parts. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "gas/gas_internal.h"
#include "gas/markers.h"
#include "material/material.h"
#include "shape/shape.h"

/* Points along an axis of a cell that bodies share: some thousand of a cell. */
static int parts_of(int dimension) { return dimension == 1 ? 1024 : dimension == 2 ? 32 : 10; }

/* What is summed over a cell: the fields that sweeps write, and the energies of both materials at
 * rest, J/m^3. */
enum { FILL_ENERGY = GAS_FIELDS, FILLS = FILL_ENERGY + 2 };

struct filling {
    const struct simulation *simulation;
    struct gas *gas;
    struct replacements replacements;
    struct bounds *bounds; /* of each body */
    int *near, nears;      /* bodies that meet the block */
    int *here, heres;      /* bodies among them that meet the cell */
    double edge;           /* of the cells of the block, m */
    double around; /* the pressure at which an explosive that is lit rests: that of the gas, Pa */
    struct error *error;
};

static bool meets(const struct bounds *bounds, const double low[3], const double high[3],
                  int dimension)
{
    bool meets = true;
    for (int axis = 0; axis < dimension; axis++)
        meets &= vec3_at(bounds->low, axis) < high[axis] && low[axis] < vec3_at(bounds->high, axis);
    return meets;
}

/* PLACE as the case writes it. */
static struct error *tell(const struct filling *f, int body, const char *key, struct vec3 place,
                          const char *text)
{
    const struct simulation_case *input = f->simulation->problem->input;
    const double at[3] = {place.x, place.y, place.z};
    char name[128], where[96];
    int used = 0;
    for (int axis = 0; axis < input->dimension; axis++)
        used += snprintf(where + used, sizeof where - (size_t)used, "%s%.6g m", axis ? ", " : "",
                         at[axis]);
    snprintf(name, sizeof name, "%.80s%s%.40s", body < 0 ? "" : input->bodies.names[body],
             key[0] ? "." : "", key);
    return input_error(input, "bodies", body < 0 ? NULL : name, "%s (at [%s])", text, where);
}

/* The body at PLACE, -1 for none: of several the one that replaces the others. */
static int body_at(struct filling *f, struct vec3 place)
{
    const struct simulation_case *input = f->simulation->problem->input;
    int found = -1;
    for (int k = 0; k < f->heres; k++) {
        const int body = f->here[k];
        if (!place_has(&f->simulation->problem->place, body) ||
            !shape_inside(&case_body(input, body)->shape, place))
            continue;
        const bool wins = found >= 0 && replaces(&f->replacements, body, found);
        if (found >= 0 && wins == replaces(&f->replacements, found, body) && !f->error) {
            char text[160];
            snprintf(text, sizeof text,
                     "overlaps \"%.60s\": let one of the two, and only one, name the other in "
                     "`replaces`",
                     input->bodies.names[found]);
            f->error = tell(f, body, "", place, text);
        }
        if (found < 0 || wins)
            found = body;
    }
    return found;
}

/* Adds to SUM what BODY has at PLACE, as much as WEIGHT says. */
static void add_state(struct filling *f, int body, struct vec3 place, double weight, double *sum)
{
    const struct simulation_case *input = f->simulation->problem->input;
    const struct body_input *of = case_body(input, body);
    struct point point;
    double velocity[3] = {0.0}, kinetic = 0.0;
    const double none[POINT_HISTORY] = {0.0};
    const char *key = "";
    const char *wrong = body_start_at(of, &f->simulation->problem->material[of->material_index],
                                      place, &point, velocity, &key);
    if (wrong && !f->error)
        f->error = tell(f, body, key, place, wrong);
    if (wrong)
        return;
    if (f->gas->layout.lit && of->material_index == f->gas->material[f->gas->layout.explosive])
        point.energy +=
            f->around /
            eos_evaluate(&f->gas->eos[f->gas->layout.explosive], point.density, 0.0, none).dp_de;
    const bool second = f->gas->layout.two && of->material_index == f->gas->material[1];
    point.energy += f->gas->heat[second];
    sum[GAS_DENSITY] += weight * point.density;
    for (int axis = 0; axis < 3; axis++) {
        sum[GAS_MOMENTUM + axis] += weight * point.density * velocity[axis];
        kinetic += 0.5 * square(velocity[axis]);
    }
    sum[GAS_ENERGY] += weight * point.density * (point.energy + kinetic);
    sum[FILL_ENERGY + second] += weight * point.density * point.energy;
    if (second) {
        sum[GAS_SECOND] += weight * point.density;
        sum[GAS_FRACTION] += weight;
    }
}

/* The K-th of POINTS^dimension points of a cell, at PART of its edge along each axis. */
static struct vec3 point_of(const struct filling *f, const double centre[3], const double *part,
                            int points, int64_t k)
{
    double at[3] = {0.0, 0.0, 0.0};
    for (int axis = 0; axis < f->gas->cells->dimension; axis++) {
        at[axis] = centre[axis] + part[k % points] * f->edge;
        k /= points;
    }
    return vector_at(at);
}

static int64_t points_in(int64_t base, int exponent)
{
    int64_t result = 1;
    for (int i = 0; i < exponent; i++)
        result *= base;
    return result;
}

/* The weight of a place: along a radius its power. */
static double weight_of(const struct filling *f, struct vec3 place)
{
    const int round = f->gas->round;
    return round == 0 ? 1.0 : round == 1 ? place.x : square(place.x);
}

/* Whether BODY, that of the centre, has the whole cell: its corners lie in it, and no body is so
 * small that it might lie between them. */
static bool has_all(struct filling *f, int body, const double centre[3])
{
    static const double corner[2] = {-0.5 + 1e-6, 0.5 - 1e-6};
    const struct cell_blocks *cells = f->gas->cells;
    for (int k = 0; k < f->heres; k++) {
        const struct bounds *b = &f->bounds[f->here[k]];
        const double size[3] = {b->high.x - b->low.x, b->high.y - b->low.y, b->high.z - b->low.z};
        for (int axis = 0; axis < cells->dimension && f->heres > 1; axis++)
            if (size[axis] < 2.0 * f->edge)
                return false;
    }
    for (int64_t k = 0; k < points_in(2, cells->dimension); k++) {
        const struct vec3 place = point_of(f, centre, corner, 2, k);
        if (body_at(f, place) != body && !place_blocks(&f->simulation->problem->place, place))
            return false;
    }
    return true;
}

/* The mean over a cell that lies in BODY. */
static void fill_whole(struct filling *f, int body, const double centre[3], double *sum)
{
    static const double middle[1] = {0.0}, gauss[2] = {-0.28867513459481287, 0.28867513459481287};
    const struct cell_blocks *cells = f->gas->cells;
    const int points = case_body(f->simulation->problem->input, body)->varies ? 2 : 1;
    double all = 0.0;
    for (int64_t k = 0; k < points_in(points, cells->dimension); k++) {
        const struct vec3 place = point_of(f, centre, points == 2 ? gauss : middle, points, k);
        const double weight = points == 1 ? 1.0 : weight_of(f, place); /* exact where it can be */
        add_state(f, body, place, weight, sum);
        all += weight;
    }
    for (int n = 0; n < FILLS; n++)
        sum[n] /= all;
}

static void fill_parts(struct filling *f, const double centre[3], double *sum)
{
    const struct cell_blocks *cells = f->gas->cells;
    const int parts = parts_of(cells->dimension);
    double part[1024], all = 0.0;
    for (int k = 0; k < parts; k++)
        part[k] = (k + 0.5) / parts - 0.5;
    for (int64_t k = 0; k < points_in(parts, cells->dimension) && !f->error; k++) {
        const struct vec3 place = point_of(f, centre, part, parts, k);
        const int body = body_at(f, place);
        const double weight = weight_of(f, place);
        if (body >= 0) {
            add_state(f, body, place, weight, sum);
            all += weight;
        } else if (!place_blocks(&f->simulation->problem->place, place))
            f->error = tell(f, -1, "", place,
                            "no body fills the domain here: bodies and rigid ones must fill all of "
                            "it");
    }
    for (int n = 0; n < FILLS && all > 0.0; n++)
        sum[n] /= all;
}

static void fill_cell(struct filling *f, int32_t i)
{
    struct cell_blocks *cells = f->gas->cells;
    struct gas *gas = f->gas;
    const double *centre = cells->position[i];
    const struct vec3 place = vector_at(centre);
    double low[3], high[3], sum[FILLS] = {0.0};
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = centre[axis] - 0.5 * f->edge;
        high[axis] = centre[axis] + 0.5 * f->edge;
    }
    f->heres = 0;
    for (int k = 0; k < f->nears; k++)
        if (meets(&f->bounds[f->near[k]], low, high, cells->dimension))
            f->here[f->heres++] = f->near[k];
    const int body = body_at(f, place);
    cells->body[i] = (uint16_t)(body < 0 ? 0 : body);
    cells->material[i] = (uint16_t)gas->material[0];
    gas->u[GAS_SHOCK][i] = 0.0;
    if (gas->layout.blocked) {
        gas->open[i] = place_blocks(&f->simulation->problem->place, place) ? 0.0 : 1.0;
        if (gas->layout.lit && gas->open[i] == 0.0) /* nothing in it will ever burn */
            gas->u[gas->layout.burnt][i] = 1.0;
        if (gas->open[i] == 0.0)
            return;
    }
    if (body >= 0 && has_all(f, body, centre))
        fill_whole(f, body, centre, sum);
    else
        fill_parts(f, centre, sum);
    if (sum[GAS_FRACTION] > 0.0 && sum[GAS_FRACTION] < 1.0) {
        const double mass[2] = {sum[GAS_DENSITY] - sum[GAS_SECOND], sum[GAS_SECOND]};
        if (!gas->layout.lit)
            sum[GAS_FRACTION] =
                gas_relax(gas->eos, mass, sum + FILL_ENERGY, sum[GAS_FRACTION], 1.0);
    }
    if (gas->layout.lit)
        gas->u[gas->layout.burnt][i] = gas->layout.two && sum[GAS_FRACTION] == 0.0 ? 1.0 : 0.0;
    for (int n = 0; n < GAS_NUMBERS; n++)
        gas->u[n][i] = sum[n];
    for (int n = GAS_SECOND; n < gas->layout.written; n++)
        gas->u[n][i] = sum[n];
}

static void fill_block(struct filling *f, const struct cell_block *block)
{
    const struct cell_blocks *cells = f->gas->cells;
    double low[3], high[3];
    f->edge = cell_block_edge(cells, block);
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = (double)block->corner[axis] * f->edge;
        high[axis] = (double)(block->corner[axis] + block->count[axis]) * f->edge;
    }
    f->nears = 0;
    for (int b = 0; b < f->simulation->problem->input->bodies.count; b++)
        if (meets(&f->bounds[b], low, high, cells->dimension))
            f->near[f->nears++] = b;
    const int32_t end = block->first + cell_block_cells(block);
    for (int32_t i = block->first; i < end && !f->error; i++)
        fill_cell(f, i);
}

/* The state of BODY at its middle; false where it has none. */
static bool state_of(const struct simulation *simulation, int body, struct point *point)
{
    const struct body_input *of = case_body(simulation->problem->input, body);
    const struct bounds bounds = shape_bounds(&of->shape);
    const struct vec3 middle = vec3_scale(0.5, vec3_add(bounds.low, bounds.high));
    const char *key = "";
    double velocity[3];
    return !body_start_at(of, &simulation->problem->material[of->material_index], middle, point,
                          velocity, &key);
}

bool gas_starts_warm(const struct simulation *simulation, const struct gas *gas)
{
    const struct simulation_case *input = simulation->problem->input;
    const struct heat any = {1.0, 1.0, 1.0};  /* the curve of a gas does not depend on it */
    bool warm = eos_traits(&gas->eos[1]).gas; /* the curve of a liquid is not that of 0 K */
    for (int b = 0; b < input->bodies.count; b++) {
        struct point point;
        if (case_body(input, b)->material_index == gas->material[1] &&
            state_of(simulation, b, &point))
            warm &= point.energy >= eos_curve(&gas->eos[1], &any, point.density).energy;
    }
    return warm;
}

bool gas_state_of_air(const struct gas *gas, const struct simulation *simulation,
                      struct point *point)
{
    const struct simulation_case *input = simulation->problem->input;
    for (int b = 0; b < input->bodies.count; b++)
        if (case_body(input, b)->material_index == gas->material[0] &&
            state_of(simulation, b, point))
            return true;
    return false;
}

/* The pressure of the gas around an explosive that is lit, at the middle of the first body of gas;
 * that of the atmosphere where there is none. */
static double pressure_around(const struct filling *f)
{
    const struct gas *gas = f->gas;
    const double none[POINT_HISTORY] = {0.0};
    struct point point;
    return gas->layout.two && gas_state_of_air(gas, f->simulation, &point)
               ? eos_evaluate(&gas->eos[0], point.density, point.energy, none).pressure
               : 101325.0;
}

static void fill_blocks(struct filling *f)
{
    for (int32_t b = 0; b < f->gas->cells->blocks && !f->error; b++)
        fill_block(f, &f->gas->cells->block[b]);
}

/* Collective: the blocks of LIST, COUNT of them, replace those that there are, and are filled. */
static struct error *fill_again(struct filling *f, struct simulation *simulation,
                                struct cell_block *list, int64_t count)
{
    struct cell_blocks *cells = f->gas->cells, old;
    struct error *error = cell_blocks_renew(cells, list, (int32_t)count, &old);
    cell_blocks_destroy(&old);
    TRY(ranks_agree(simulation->ranks, error));
    TRY(cell_blocks_distribute(cells, NULL, true));
    gas_bind(f->gas, cells);
    fill_blocks(f);
    return ranks_agree(simulation->ranks, f->error);
}

/* Collective: fills all cells again as long as what is in them asks for finer ones. */
static struct error *fill_levels(struct filling *f, struct simulation *simulation)
{
    struct gas *gas = f->gas;
    const int times =
        gas->cells->levels > 1 && gas->parameters.regrid > 0 ? 2 * gas->cells->levels : 0;
    for (int k = 0; k < times; k++) {
        struct cell_block *list = NULL;
        int64_t count = 0;
        bool changed = false;
        gas->cells->threads = simulation->threads;
        TRY(gas_plan(gas, simulation));
        TRY(ranks_agree(simulation->ranks, gas_derive(gas, simulation, NULL)));
        TRY(gas_ask_levels(gas, simulation->threads, &list, &count, &changed));
        if (!changed)
            break;
        TRY(fill_again(f, simulation, list, count));
    }
    return NULL;
}

/* Fills all cells with what the bodies say, and in its place with the blast of `start`. */
static struct error *fill_all(struct filling *f, struct simulation *simulation)
{
    struct blast *blast = NULL;
    fill_blocks(f);
    TRY(ranks_agree(simulation->ranks, f->error));
    struct error *error = gas_compute_start(f->gas, simulation, &blast);
    if (!error)
        error = fill_levels(f, simulation);
    if (!error && blast)
        error = gas_fill_blast(f->gas, simulation, blast);
    f->gas->start_reach = 0.0;
    gas_free_blast(blast);
    return error;
}

struct error *gas_fill(void *solver, struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    const size_t bodies = (size_t)input->bodies.count;
    struct gas *gas = solver;
    struct cell_blocks *cells = gas->cells;
    struct filling f = {.simulation = simulation, .gas = gas};
    TRY(ranks_agree(simulation->ranks, cell_blocks_fill(cells)));
    if (cells->levels > 1)
        TRY(cell_blocks_distribute(cells, NULL, true));
    gas_bind(f.gas, cells);
    f.around = pressure_around(&f);
    struct error *error = case_replacements(input, &f.replacements);
    f.bounds = memory_allocate(bodies * sizeof *f.bounds);
    f.near = memory_allocate(bodies * sizeof *f.near);
    f.here = memory_allocate(bodies * sizeof *f.here);
    if (!error && (!f.bounds || !f.near || !f.here))
        error = out_of_memory();
    for (size_t b = 0; b < bodies && !error; b++)
        f.bounds[b] = shape_bounds(&case_body(input, (int)b)->shape);
    error = ranks_agree(simulation->ranks, error);
    if (!error)
        error = fill_all(&f, simulation);
    free(f.replacements.at);
    free(f.bounds);
    free(f.near);
    free(f.here);
    TRY(error);
    gas_count_air(gas, simulation);
    return gas->layout.marked ? gas_make_markers(gas) : NULL;
}
