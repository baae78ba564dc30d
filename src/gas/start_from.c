/* A blast that another case has computed as the start of this one: opens and runs that case, on
 * every rank alike, and takes what its cells hold. start_fill.c hands it to ours. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "gas/start_blast.h"
#include "material/material.h"

struct error *gas_wrong_start(const struct simulation *simulation, const char *key,
                              const char *text)
{
    return input_error(simulation->problem->input, "start", key, "%s", text);
}

/* What the other case must be. */
struct error *gas_check_start(const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input, *other = input->start.input;
    if (!other)
        return NULL;
    const bool ball = input->dimension == 3 || input->geometry == GEOMETRY_AXISYMMETRIC,
               rings = other->dimension == 2 && other->geometry == GEOMETRY_AXISYMMETRIC;
    if (other->solver.choice->thing != &gas_class || (other->dimension != 1 && !rings))
        return gas_wrong_start(simulation, "from",
                               "that case must be one of one dimension, or an axisymmetric one, "
                               "with the solver gas");
    if (other->levels > 1)
        return gas_wrong_start(simulation, "from",
                               "that case has cells of several levels: leave its `levels` out");
    if (input->dimension == 1)
        return gas_wrong_start(simulation, "from",
                               "this case has one dimension itself: resume that run");
    if (rings && input->dimension != 3)
        return gas_wrong_start(simulation, "from",
                               "an axisymmetric case can start one in 3-D only");
    if (!rings && other->geometry != (ball ? GEOMETRY_SPHERICAL : GEOMETRY_CYLINDRICAL))
        return gas_wrong_start(
            simulation, "from",
            ball ? "a start in 3-D or axisymmetry needs `geometry: spherical` in that case"
                 : "a start in a plane needs `geometry: cylindrical` in that case");
    if (!rings && input->start.axis >= 0)
        return gas_wrong_start(simulation, "axis",
                               "the blast of a case of one dimension has no axis");
    if (input->geometry == GEOMETRY_AXISYMMETRIC && input->start.center.count &&
        input->start.center.at[0] != 0.0)
        return gas_wrong_start(simulation, "center",
                               "in axisymmetry the centre lies on the axis, x = 0");
    return NULL;
}

/* Runs the other case. */
static struct error *compute(const struct simulation *simulation, struct blast *blast)
{
    const struct start_input *start = &simulation->problem->input->start;
    const double until = isnan(start->at) ? blast->input->run.until : start->at;
    struct simulation *other = &blast->simulation;
    TRY(gas_class.fill(&blast->gas, other));
    TRY(gas_class.start(&blast->gas, other));
    maps_update(other, 0.0);
    while (other->time < until) {
        struct limit limit = limit_of_nothing();
        TRY(gas_class.prepare(&blast->gas, other, &limit));
        const double left = until - other->time, dt = limit.dt < left ? limit.dt : left;
        TRY(gas_class.advance(&blast->gas, other, dt));
        other->time = dt < left ? other->time + dt : until;
        other->step++;
        maps_update(other, dt);
    }
    return NULL;
}

/* Makes the solver of the other case, whose mistakes name it. It keeps the maps of this one. */
static struct error *open_blast(struct blast *blast, const struct simulation *simulation)
{
    const struct start_input *start = &simulation->problem->input->start;
    blast->input = start->input;
    blast->ranks = ranks_alone();
    const void *parameters = start->input->solver.value;
    struct error *error =
        simulation_create(start->input, &blast->ranks, simulation->threads, &blast->simulation);
    if (!error) {
        struct judgement judgement = judge_with(&gas_class, parameters, &blast->simulation);
        error = findings_refusal(&judgement.findings);
        findings_free(&judgement.findings);
    }
    if (!error) {
        blast->simulation.maps = simulation->maps;
        memcpy(blast->simulation.map, simulation->map, sizeof simulation->map);
        error = gas_class.create(&blast->gas, &blast->simulation, parameters);
    }
    return error_context(error, "start.from: %s", start->from);
}

void gas_free_blast(struct blast *blast)
{
    if (!blast)
        return;
    gas_class.destroy(&blast->gas);
    simulation_destroy(&blast->simulation);
    for (int n = 0; n < SHELLS; n++) {
        free(blast->number[n]);
        free(blast->factor[n]);
    }
    free(blast->speed[0]);
    free(blast->speed[1]);
    free(blast->reached);
    free(blast->fraction);
    free(blast->cell);
    free(blast);
}

static bool differs(double a, double b) { return fabs(a - b) > 1e-9 * maximum(fabs(a), fabs(b)); }

static struct error *make_room(struct blast *blast)
{
    const size_t count = (size_t)blast->cells, bytes = count * sizeof(double);
    bool room = true;
    for (int n = 0; n < SHELLS; n++)
        room &= (blast->number[n] = memory_allocate(bytes)) != NULL;
    for (int n = 0; n < 2; n++)
        room &= (blast->speed[n] = memory_allocate(bytes)) != NULL;
    blast->fraction = memory_allocate(bytes);
    blast->cell = memory_allocate(count * sizeof *blast->cell);
    blast->reached = memory_allocate(count * sizeof *blast->reached);
    return room && blast->fraction && blast->cell && blast->reached ? NULL
                                                                    : out_of_memory_for("a start");
}

/* Which cells the blast has reached: those that move, or differ from the last one, which is the
 * farthest. All shells up to the last of them count. */
static void find_reached(struct blast *blast)
{
    const struct gas *gas = &blast->gas;
    const int far = blast->cells - 1;
    for (int along = 0; along < 2; along++) {
        blast->from[along] = blast->rings ? blast->count[along] : 0;
        blast->last[along] = blast->rings ? 0 : along;
    }
    for (int k = 0; k <= far; k++) {
        const int at[2] = {k % blast->count[0], k / blast->count[0]};
        const bool open = !gas->open || gas->open[blast->cell[k]] != 0.0;
        blast->reached[k] =
            open && (fabs(blast->speed[0][k]) >= 1e-6 || fabs(blast->speed[1][k]) >= 1e-6 ||
                     differs(blast->number[SHELL_FIRST][k], blast->number[SHELL_FIRST][far]) ||
                     differs(blast->number[SHELL_ENERGY][k], blast->number[SHELL_ENERGY][far]));
        for (int along = 0; along < 2 && blast->reached[k]; along++) {
            blast->from[along] = at[along] < blast->from[along] ? at[along] : blast->from[along];
            blast->last[along] =
                at[along] >= blast->last[along] ? at[along] + 1 : blast->last[along];
        }
    }
    for (int k = 0; k < blast->last[0] && !blast->rings; k++)
        blast->reached[k] = true;
}

/* What the cells of the other case hold, in the order of their radius and then of their height. */
static struct error *take(struct blast *blast)
{
    const struct gas *gas = &blast->gas;
    const struct cell_blocks *cells = gas->cells;
    blast->rings = cells->dimension == 2;
    blast->edge = cells->edge;
    blast->cells = cells->count;
    for (int along = 0; along < 2; along++) {
        const bool has = along < cells->dimension;
        blast->low[along] = has ? (double)cells->low[along] * cells->edge : 0.0;
        blast->count[along] = has ? (int)(cells->high[along] - cells->low[along]) : 1;
    }
    TRY(make_room(blast));
    for (int32_t i = 0; i < cells->count; i++) {
        int k = 0;
        for (int along = cells->dimension - 1; along >= 0; along--)
            k = k * blast->count[along] +
                (int)((cells->position[i][along] - blast->low[along]) / blast->edge);
        const double density = gas->u[GAS_DENSITY][i],
                     second = gas->layout.two ? gas->u[GAS_SECOND][i] : 0.0;
        blast->cell[k] = i;
        blast->number[SHELL_FIRST][k] = density - second;
        blast->number[SHELL_SECOND][k] = second;
        blast->number[SHELL_ENERGY][k] = gas->u[GAS_ENERGY][i];
        blast->number[SHELL_AFTERBURNT][k] =
            gas->layout.afterburns ? gas->u[GAS_AFTERBURNT][i] : 0.0;
        blast->fraction[k] = gas->layout.two ? gas->u[GAS_FRACTION][i] : 0.0;
        for (int along = 0; along < 2; along++)
            blast->speed[along][k] =
                density > 0.0 ? gas->u[GAS_MOMENTUM + along][i] / density : 0.0;
    }
    find_reached(blast);
    return NULL;
}

/* The materials of both cases, which must be alike. */
static struct error *check_materials(const struct simulation *simulation, const struct gas *gas,
                                     const struct blast *blast)
{
    const bool alone = simulation->problem->input->start.window && !gas->layout.two;
    const int materials = blast->gas.layout.two && !alone ? 2 : 1;
    if (materials == 2 && !gas->layout.two)
        return gas_wrong_start(simulation, "material",
                               "that case has two materials: give the one here that "
                               "its denser one is");
    for (int k = 0; k < materials; k++)
        if (memcmp(&gas->eos[k], &blast->gas.eos[k], sizeof gas->eos[k]) != 0)
            return gas_wrong_start(
                simulation, "from",
                k ? "the equations of state of the denser materials differ"
                  : "the equations of state differ: that case needs the materials of this");
    return NULL;
}

/* Whether the centre lies in the domain, whose planes of symmetry belong to it. Along the axis of
 * rings it need not. */
static struct error *check_center(const struct gas *gas, const struct simulation *simulation)
{
    const struct start_input *start = &simulation->problem->input->start;
    const struct vector_value *center = &start->center;
    const int along = start->input->dimension == 1 ? -1 : start->axis < 0 ? 1 : start->axis;
    const struct cell_blocks *cells = gas->cells;
    for (int axis = 0; axis < cells->dimension && !start->window; axis++) {
        const double at = axis < center->count ? center->at[axis] : 0.0,
                     low = (double)cells->low[axis] * cells->edge,
                     high = (double)cells->high[axis] * cells->edge;
        if (axis != along && (at < low - 1e-6 * cells->edge || at > high + 1e-6 * cells->edge))
            return input_error(simulation->problem->input, "start", "center",
                               "the centre of the blast, %c = %.6g m, is outside the domain, which "
                               "goes from %.6g to %.6g m",
                               "xyz"[axis], at, low, high);
    }
    return NULL;
}

struct error *gas_check_source(const struct gas *gas, const struct simulation *simulation)
{
    const struct start_input *start = &simulation->problem->input->start;
    if (!start->input)
        return NULL;
    TRY(check_center(gas, simulation));
    struct blast *blast = memory_allocate(sizeof *blast);
    if (!blast)
        return out_of_memory_for("a start");
    struct error *error = open_blast(blast, simulation);
    if (!error)
        error = check_materials(simulation, gas, blast);
    gas_free_blast(blast);
    return error;
}

/* Where the blast lies, whose cells are to be fine. */
static void find_reach(struct gas *gas, const struct start_input *start, const struct blast *blast)
{
    const double height = blast->low[1] + blast->last[1] * blast->edge,
                 depth = blast->low[1] + blast->from[1] * blast->edge;
    gas->start_center = start->center;
    gas->start_reach = blast->low[0] + blast->last[0] * blast->edge;
    if (blast->rings)
        gas->start_reach = hypot(gas->start_reach, maximum(fabs(height), fabs(depth)));
}

struct error *gas_compute_start(struct gas *gas, struct simulation *simulation, struct blast **out)
{
    const struct start_input *start = &simulation->problem->input->start;
    *out = NULL;
    if (!start->input)
        return NULL;
    struct blast *blast = *out = memory_allocate(sizeof *blast);
    if (!blast)
        return out_of_memory_for("a start");
    struct error *error = open_blast(blast, simulation);
    if (!error)
        error = error_context(compute(simulation, blast), "start.from: %s", start->from);
    if (!error)
        error = take(blast);
    if (!error && blast->gas.unburnt)
        error = gas_wrong_start(simulation, "from",
                                "the explosive has not burnt by then: compute that case further");
    if (!error)
        find_reach(gas, start, blast);
    return ranks_agree(simulation->ranks, error);
}
