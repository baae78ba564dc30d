/* The gas solver as the run loop sees it: its parts from create to destroy, and the forecast of
 * `bolide check`. The sweeps themselves are in strips.c. */
#include "gas/gas.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "gas/gas_internal.h"
#include "gas/markers.h"
#include "material/any.h"
#include "material/material.h"
#include "model/bodies.h"
#include "model/maps.h"

static const struct field_row field_rows[] = {
    {.field = {"sound_long", "m/s", "longitudinal sound speed", NUMBER_DOUBLE, 1, FIELD_DERIVED}},
    {.field = {"momentum_x", NULL, "momentum per volume", NUMBER_DOUBLE, 1, FIELD_STATE}},
    {.field = {"momentum_y", NULL, "momentum per volume", NUMBER_DOUBLE, 1, FIELD_STATE}},
    {.field = {"momentum_z", NULL, "momentum per volume", NUMBER_DOUBLE, 1, FIELD_STATE}},
    {.field = {"total_energy", NULL, "energy per volume, kinetic energy included", NUMBER_DOUBLE, 1,
               FIELD_STATE}},
    {.field = {"shock", NULL, "sum of 1, 2, 4 for the axes x, y, z of strong shocks", NUMBER_DOUBLE,
               1, FIELD_STATE}},
    {.field = {"second", "kg/m^3", "mass of the second material per volume of the cell",
               NUMBER_DOUBLE, 1, FIELD_STATE}},
    {.field = {"fraction", "1", "fraction of the volume that the second material fills",
               NUMBER_DOUBLE, 1, FIELD_STATE | FIELD_FRACTION}},
    {.field = {"afterburnt", "kg/m^3",
               "mass of the second material per volume of the cell that has burnt in the air",
               NUMBER_DOUBLE, 1, FIELD_STATE}},
    {.field = {"burnt", "1", "burnt fraction of the explosive", NUMBER_DOUBLE, 1,
               FIELD_STATE | FIELD_FRACTION}},
    {.field = {"open", NULL, "1, or 0 where an obstacle blocks the cell", NUMBER_DOUBLE, 1,
               FIELD_STATE | FIELD_FRACTION}},
    {.field = {"gamma", NULL, "pressure over energy per volume", NUMBER_DOUBLE, 1, FIELD_STATE}},
    {.field = {"size", "m", "edge of the cell", NUMBER_DOUBLE, 1, FIELD_DERIVED}},
    FIELD_ROWS_END,
};
enum {
    FIELD_SECOND = 6,
    FIELD_AFTERBURNT = 8,
    FIELD_BURNT,
    FIELD_OPEN,
    FIELD_GAMMA,
    FIELD_SIZE,
    OWN_FIELDS
};

void gas_lay_out(struct gas_layout *layout)
{
    layout->written = layout->afterburns ? GAS_AFTERBURNT + 1
                      : layout->two      ? GAS_FRACTION + 1
                                         : GAS_SHOCK + 1;
    layout->fields = layout->written;
    layout->burnt = layout->lit ? layout->fields++ : -1;
    layout->open = layout->blocked ? layout->fields++ : -1;
    layout->gamma = layout->marked ? layout->fields++ : -1;
}

static struct error *make_store(struct cell_blocks *cells, const struct gas_layout *layout)
{
    struct field_declaration own[OWN_FIELDS];
    int count = 0;
    for (int k = 0; k < OWN_FIELDS; k++)
        if (k < FIELD_SECOND || (k < FIELD_AFTERBURNT    ? layout->two
                                 : k == FIELD_AFTERBURNT ? layout->afterburns
                                 : k == FIELD_BURNT      ? layout->lit
                                 : k == FIELD_OPEN       ? layout->blocked
                                 : k == FIELD_SIZE       ? cells->levels > 1
                                                         : layout->marked))
            own[count++] = field_rows[k].field;
    return cell_blocks_create(cells, own, count);
}

static double courant_of(const struct gas_parameters *parameters)
{
    if (!isnan(parameters->courant))
        return parameters->courant;
    return parameters->method.index == GAS_LAX_WENDROFF ? 0.2 : 0.8;
}

static void choose_scheme(struct gas *gas)
{
    gas->second_order = gas->parameters.method.index == GAS_MUSCL_HANCOCK;
    if (gas->second_order) {
        gas->riemann =
            ((const struct muscl_hancock_options *)gas->parameters.method.value)->riemann;
        return;
    }
    const struct lax_wendroff_options *options = gas->parameters.method.value;
    gas->mixing = options->mixing;
    gas->scheme = (struct lax_wendroff){.form = options->form,
                                        .viscosity = options->viscosity_of,
                                        .eta = options->viscosity,
                                        .guarded = true};
}

/* Of the pressure over AMBIENT, where that is given. */
static void add_maps_of_peaks(struct simulation *simulation, double ambient)
{
    const struct map peak = {.name = "peak_overpressure",
                             .field = "pressure",
                             .kind = MAP_PEAK,
                             .above = ambient,
                             .of_cells = true};
    struct map impulse = peak;
    impulse.name = "peak_impulse";
    impulse.kind = MAP_IMPULSE;
    if (isnan(ambient))
        return;
    maps_add(simulation, &peak);
    maps_add(simulation, &impulse);
}

static struct error *gas_create(void *solver, struct simulation *simulation, const void *parameters)
{
    struct gas *gas = solver;
    gas->parameters = *(const struct gas_parameters *)parameters;
    gas->parameters.courant = courant_of(&gas->parameters);
    if (!gas->parameters.center.count) /* and no start: the origin */
        gas->parameters.center = simulation->problem->input->start.center;
    choose_scheme(gas);
    gas_find_materials(simulation, gas->material);
    for (int k = 0; k < 2; k++) {
        const struct material *material = &simulation->problem->material[gas->material[k]];
        gas->eos[k] = material->eos;
        if (material_is_lit(material)) {
            gas->layout.lit = true;
            gas->layout.explosive = k;
            gas->detonation = material_detonation_speed(material);
        }
    }
    gas->unburnt = gas->layout.lit;
    gas->layout.two = gas->material[1] != gas->material[0];
    gas->layout.marked = gas->layout.two && !gas->second_order;
    for (int k = 0; k < 2; k++) {
        gas->floor[k] =
            gas_floor_of(&simulation->problem->material[gas->material[k]], gas->layout.two);
        gas->liquid |= gas->floor[k] > -(double)INFINITY;
    }
    gas->thaws = gas->layout.two && gas_starts_warm(simulation, gas);
    gas->layout.blocked = place_blocks_any(&simulation->problem->place);
    gas->afterburn = simulation->problem->material[gas->material[1]].afterburn;
    gas->layout.afterburns = gas->layout.two && gas->afterburn.energy > 0.0;
    gas->most_afterburnt = 1.0;
    gas->layout.explosive = gas->layout.two ? gas->layout.explosive : 0;
    if (gas->layout.marked)
        gas_count_heat(gas);
    gas_lay_out(&gas->layout);
    gas->round = geometry_power(simulation->problem->geometry);
    gas->sleepless = problem_has_gravity(simulation->problem);
    struct cell_blocks *cells = gas->cells = memory_allocate(sizeof *cells);
    if (!cells)
        return out_of_memory();
    cells->dimension = simulation->problem->dimension;
    cells->edge = simulation->problem->place.resolution;
    TRY(gas_take_levels(&simulation->problem->place, cells, &gas->lasting));
    cells->ranks = simulation->ranks;
    cells->partition = &simulation->partition;
    cells->threads = simulation->threads;
    TRY(gas_find_domain(simulation, cells));
    TRY(error_join(gas_check_inflows(simulation, cells, gas->material[0]),
                   gas_check_source(gas, simulation)));
    TRY(gas_check_shapes(simulation, cells));
    gas_find_faces(simulation, cells, &gas->halo);
    gas->halo.depth = gas->second_order ? 2 : CELL_GHOSTS;
    gas->halo.numbers = gas->layout.fields;
    TRY(make_store(cells, &gas->layout));
    if (gas->second_order)
        simulation_add_event(simulation, gas_repetition);
    add_maps_of_peaks(simulation, gas->parameters.ambient);
    simulation_add_population(simulation, "gas", &cell_population, cells);
    return NULL;
}

void gas_bind(struct gas *gas, const struct cell_blocks *cells)
{
    gas->u[GAS_DENSITY] = cells->density;
    gas->u[GAS_MOMENTUM] = cell_blocks_field(cells, "momentum_x");
    gas->u[GAS_MOMENTUM + 1] = cell_blocks_field(cells, "momentum_y");
    gas->u[GAS_MOMENTUM + 2] = cell_blocks_field(cells, "momentum_z");
    gas->u[GAS_ENERGY] = cell_blocks_field(cells, "total_energy");
    gas->u[GAS_SHOCK] = cell_blocks_field(cells, "shock");
    if (gas->layout.two) {
        gas->u[GAS_SECOND] = cell_blocks_field(cells, "second");
        gas->u[GAS_FRACTION] = cell_blocks_field(cells, "fraction");
    }
    if (gas->layout.afterburns)
        gas->u[GAS_AFTERBURNT] = cell_blocks_field(cells, "afterburnt");
    if (gas->layout.lit)
        gas->u[gas->layout.burnt] = cell_blocks_field(cells, "burnt");
    gas->open = gas->layout.blocked ? cell_blocks_field(cells, "open") : NULL;
    if (gas->open)
        gas->u[gas->layout.open] = gas->open;
    if (gas->layout.marked)
        gas->u[gas->layout.gamma] = cell_blocks_field(cells, "gamma");
    gas->sound = cell_blocks_field(cells, "sound_long");
}

struct gas_closure gas_closure_of(const struct gas *gas)
{
    const struct gas_layout *layout = &gas->layout;
    const struct gas_closure closure = {.eos = &gas->eos[0],
                                        .other = layout->two ? &gas->eos[1] : NULL,
                                        .lit = gas->unburnt ? &gas->eos[layout->explosive] : NULL,
                                        .marked = layout->marked,
                                        .liquid = gas->liquid,
                                        .floor = {gas->floor[0], gas->floor[1]}};
    return closure;
}

struct error *gas_derive(struct gas *gas, const struct simulation *simulation, const bool *blocks)
{
    const struct cell_blocks *cells = gas->cells;
    struct gas_look look = {.cells = cells,
                            .closure = gas_closure_of(gas),
                            .material = {(uint16_t)gas->material[0], (uint16_t)gas->material[1]},
                            .open = gas->open,
                            .layout = &gas->layout,
                            .sound = gas->sound,
                            .round = gas->round};
    struct ranked first = {INFINITY, UINT64_MAX, 0};
    memcpy(look.u, gas->u, sizeof look.u);
#pragma omp parallel num_threads(simulation->threads)
    {
        struct ranked own = {INFINITY, UINT64_MAX, 0};
#pragma omp for schedule(static)
        for (int32_t b = 0; b < cells->blocks; b++) {
            struct gas_block *block = &gas->block[b];
            if (blocks ? blocks[b] : block->awake)
                block->fastest = gas_look_at_block(&look, b);
            block->awake = gas->sleepless || !block->fastest.still || block->burns;
            const struct gas_fastest fastest = block->fastest;
            const struct ranked found = {-fastest.speed, cells->id[fastest.cell], fastest.cell};
            if (ranked_before(&found, &own))
                own = found;
        }
#pragma omp critical(bolide_gas_look)
        if (ranked_before(&own, &first))
            first = own;
    }
    gas->fastest = -first.value;
    gas->fastest_id = first.id;
    return isnan(first.value) ? simulation_impossible(simulation, (int32_t)first.what) : NULL;
}

struct error *gas_plan(struct gas *gas, struct simulation *simulation)
{
    struct cell_blocks *cells = gas->cells;
    struct error *error = NULL;
    for (int n = 0; n < gas->layout.written; n++) {
        if (gas->other[n] && cells->held <= gas->room) /* a rank may have no cell */
            continue;
        free(gas->other[n]);
        gas->other[n] = memory_allocate(((size_t)cells->held + 1) * sizeof(double));
        if (!gas->other[n])
            error = out_of_memory_for("cells");
    }
    gas->room = cells->held > gas->room ? cells->held : gas->room;
    if (!memory_reserve((void **)&gas->block, &gas->block_capacity, cells->blocks + 1, 0,
                        sizeof *gas->block))
        error = error_join(error, out_of_memory_for("blocks of cells"));
    free(gas->shocked);
    gas->shocked = memory_allocate(((size_t)cells->blocks + 1) * sizeof *gas->shocked);
    if (gas->shocked)
        memset(gas->shocked, 0, ((size_t)cells->blocks + 1) * sizeof *gas->shocked);
    else
        error = error_join(error, out_of_memory_for("blocks of cells"));
    for (int32_t b = 0; !error && b < cells->blocks; b++)
        gas->block[b] = (struct gas_block){.awake = true, .shocked = true, .stale = true};
    gas_bind(gas, cells);
    TRY(ranks_agree(simulation->ranks, error));
    TRY(cell_halo_plan(&gas->halo, cells));
    TRY(cell_copies_plan(&gas->copies, cells, gas->layout.written));
    TRY(gas_plan_seams(gas));
    return ranks_agree(simulation->ranks, gas_plan_strips(gas, simulation->threads));
}

static struct error *gas_start(void *solver, struct simulation *simulation)
{
    struct gas *gas = solver;
    const bool unburnt = gas->unburnt;
    gas->cells->threads = simulation->threads;
    if (gas->cells->levels > 1 || simulation->ranks->size > 1)
        memory_keep_freed();
    TRY(gas_plan(gas, simulation));
    TRY(gas_burn(gas, simulation, simulation->time));
    if (simulation->step > 0) /* a coupling may have burnt all since the last step */
        gas->unburnt = unburnt;
    return gas_derive(gas, simulation, NULL);
}

/* The part of the step that the first steps of two materials take: products that begin to expand
 * into air are soon faster than any wave before. */
static double start_part(const struct gas *gas, int64_t step)
{
    double part = gas->layout.two ? 0.1 : 1.0;
    for (int64_t k = 0; k < step && part < 1.0; k++)
        part *= 1.15;
    return minimum(part, 1.0);
}

static struct error *gas_prepare(void *solver, struct simulation *simulation, struct limit *limit)
{
    static const char *const reasons[] = {"a wave that crosses a cell"};
    struct gas *gas = solver;
    TRY(gas_balance(gas, simulation));
    TRY(gas_regrid(gas, simulation));
    const double edge = gas->cells->edge;
    if (gas->unburnt)
        gas->fastest = maximum(gas->fastest, gas->detonation);
    const double most = start_part(gas, simulation->step) * gas->parameters.courant * edge;
    /* a rank may have no open cell */
    const struct ranked own = {gas->fastest > 0.0 ? most / gas->fastest : (double)INFINITY,
                               gas->fastest_id, 0};
    *limit = limit_of_ranks(simulation->ranks, own, reasons);
    simulation_end_phase(simulation, PHASE_SHARED, "time step");
    return NULL;
}

/* Gravity acts on all open cells for DT: the internal energy stays. */
static void pull(const struct gas *gas, struct simulation *simulation, double dt)
{
    const struct cell_blocks *cells = gas->cells;
    const double *g = simulation->problem->gravity;
#pragma omp parallel num_threads(simulation->threads)
    {
        struct ledger own = {0};
#pragma omp for schedule(static)
        for (int32_t i = 0; i < cells->count; i++) {
            double work = 0.0, impulse[3];
            if (gas->open && gas->open[i] == 0.0)
                continue;
            for (int axis = 0; axis < 3; axis++) {
                double *momentum = &gas->u[GAS_MOMENTUM + axis][i];
                impulse[axis] = dt * gas->u[GAS_DENSITY][i] * g[axis];
                work += dt * g[axis] * (*momentum + 0.5 * impulse[axis]);
                *momentum += impulse[axis];
            }
            gas->u[GAS_ENERGY][i] += work;
            const double size = gas_volume_of(gas, i);
            ledger_book(&own, LEDGER_GRAVITY, 0.0,
                        vec3_make(size * impulse[0], size * impulse[1], size * impulse[2]),
                        vector_at(cells->position[i]), size * work);
        }
#pragma omp critical(bolide_gas_pull)
        ledger_join(&simulation->ledger, &own);
    }
}

/* MUSCL-Hancock sweeps along the axes in one order and in the next step back (Strang, SIAM J.
 * Numer. Anal. 5 (1968) 506); Lax-Wendroff in both halves of each step (2-52), along the first axis
 * too: the viscosity of a sweep does not depend on its duration, and acts alike along all axes. */
static struct error *gas_advance(void *solver, struct simulation *simulation, double dt)
{
    struct gas *gas = solver;
    const int last = simulation->problem->dimension - 1;
    const bool heavy = problem_has_gravity(simulation->problem);
    if (heavy)
        pull(gas, simulation, 0.5 * dt);
    for (int k = 0; k <= last && gas->second_order; k++)
        TRY(gas_sweep(gas, simulation, simulation->step % 2 ? last - k : k, dt));
    for (int k = last; k >= 0 && !gas->second_order && last > 0; k--)
        TRY(gas_sweep(gas, simulation, k, 0.5 * dt));
    for (int k = 0; k <= last && !gas->second_order; k++)
        TRY(gas_sweep(gas, simulation, k, last > 0 ? 0.5 * dt : dt));
    if (heavy)
        pull(gas, simulation, 0.5 * dt);
    gas_afterburn(gas, simulation, dt);
    simulation_end_phase(simulation, PHASE_BLOCKS, "sweeps");
    if (gas->layout.marked)
        TRY(gas_move_markers(gas, simulation, dt));
    TRY(gas_burn(gas, simulation, simulation->time + dt));
    struct error *error = gas_derive(gas, simulation, NULL);
    simulation_end_phase(simulation, PHASE_BLOCKS, "states");
    return error;
}

static struct error *gas_state(void *solver, struct visitor *visitor)
{
    struct gas *gas = solver;
    int64_t unburnt = gas->unburnt;
    if (gas->layout.lit)
        TRY(visitor->visit(visitor, "burn/unburnt", NUMBER_INT64, &unburnt, 1, 1));
    gas->unburnt = unburnt != 0;
    if (gas->layout.afterburns && gas->afterburn.air > 0.0)
        TRY(visitor->visit(visitor, "afterburn/most", NUMBER_DOUBLE, &gas->most_afterburnt, 1, 1));
    if (gas->layout.afterburns && gas->afterburn.mixing > 0.0)
        TRY(visitor->visit(visitor, "afterburn/mixing", NUMBER_DOUBLE, &gas->mixing_heat, 1, 1));
    return gas->layout.marked ? gas_visit_markers(gas, visitor) : NULL;
}

static void gas_destroy(void *solver)
{
    struct gas *gas = solver;
    gas_free_strips(gas);
    gas_free_seams(gas);
    gas_free_markers(gas);
    cell_halo_free(&gas->halo);
    cell_copies_free(&gas->copies);
    for (int n = 0; n < GAS_FIELDS; n++)
        free(gas->other[n]);
    free(gas->block);
    free(gas->shocked);
    free(gas->through);
    free(gas->kept_passed);
    if (gas->cells)
        cell_blocks_destroy(gas->cells);
    free(gas->cells);
}

static double gas_bytes(const void *parameters, int dimension)
{
    (void)parameters;
    struct cell_blocks store = {.dimension = dimension};
    struct gas_layout layout = {0};
    gas_lay_out(&layout);
    error_free(make_store(&store, &layout));
    const double bytes = (double)cell_blocks_bytes(&store);
    cell_blocks_destroy(&store);
    return bytes + layout.written * (double)sizeof(double);
}

/* Cells lie in the domain alone. */
static void gas_count(const void *parameters, const struct simulation_case *input,
                      struct counted *counted)
{
    (void)parameters;
    counted->box = domain_bounds(input);
    if (input->levels > 1) {
        const struct place place = place_whole(input);
        counted->part = gas_part_of_cells(&place);
    }
}

static double gas_step(const void *parameters, const struct simulation_case *input,
                       const struct material *material, const struct point *point, double diameter)
{
    const struct gas_parameters *of = parameters;
    struct point at = *point;
    (void)input;
    return courant_of(of) * diameter / any_material_evaluate(material, &at).sound_long;
}

static void gas_judge(const void *parameters, const struct simulation *simulation,
                      struct judgement *judgement)
{
    const struct gas_parameters *of = parameters;
    gas_refuse(simulation, of, &judgement->findings);
    if (!simulation->problem->place.is_part)
        gas_judge_bodies(&judgement->findings, simulation->problem->place.resolution);
    judgement->instead =
        of->method.index == GAS_LAX_WENDROFF
            ? "this method is here for comparison: leave `method` out for the default, "
              "muscl-hancock, which holds where it stops"
            : "with a pressure below zero the gas is colder than its equation of state reaches; "
              "else a smaller step may hold: halve `courant`";
}

static const struct field_row *const field_tables[] = {field_rows, NULL};

const struct solver_class gas_class = {
    .members = "cells",
    .boundaries = BOUNDARIES_CLOSED | BOUNDARY_PARTS | 1u << BOUNDARY_TRANSMITTING |
                  1u << BOUNDARY_INFLOW | 1u << BOUNDARY_PERIODIC | 1u << BOUNDARY_RIGID_BODY,
    .size = sizeof(struct gas),
    .create = gas_create,
    .fill = gas_fill,
    .start = gas_start,
    .prepare = gas_prepare,
    .advance = gas_advance,
    .state = gas_state,
    .destroy = gas_destroy,
    .bytes = gas_bytes,
    .count = gas_count,
    .step = gas_step,
    .judge = gas_judge,
    .fields = field_tables};
