/* The solver cfdmp as the run loop sees it: a step of the gas, then one of the particles, which the
 * gas pushes, then what passes between them. */
#include "couple/cfdmp.h"
#include "couple/coarse.h"

#include <string.h>

#include "base/memory.h"
#include "material/material.h"
#include "model/boundaries.h"

static const char *const transport_names[] = {"conservative", "printed", NULL};

const struct parameter cfdmp_table[] = {
    PARAMETER(TABLE, struct cfdmp_parameters, region, OPTIONAL,
              "the box of the material points, enlarged to whole cells; default: around all "
              "solids, with room for the overlap",
              .table = region_table),
    PARAMETER(INTEGER, struct cfdmp_parameters, overlap, "5",
              "cells that gas and material points have in common, behind each face of the region",
              .above = 0.0, .below = 65.0),
    PARAMETER(CHOICE, struct cfdmp_parameters, transport, "conservative",
              "what passes through the faces of the region; conservative: the fluxes of the gas; "
              "printed: as printed in the source, which loses and gains mass",
              .names = transport_names),
    PARAMETER(NUMBER, struct cfdmp_parameters, wake, "1.1",
              "the material points are computed from when on the pressure of the gas beside the "
              "region has changed by this factor; from the start where something moves them",
              .above = 1.0, .below = INFINITY),
    PART_ROWS(struct cfdmp_parameters),
    PARAMETER_END,
};

/* The event by which the material points begin to move. */
static const char interaction[] = "interaction";

static struct error *cfdmp_create(void *solver, struct simulation *simulation,
                                  const void *parameters)
{
    struct cfdmp *cfdmp = solver;
    cfdmp->parameters = *(const struct cfdmp_parameters *)parameters;
    TRY(cfdmp_make_parts(cfdmp, simulation));
    gas_watch(cfdmp->gas, &cfdmp->cut);
    cfdmp_surround(cfdmp);
    simulation_add_event(simulation, interaction);
    part_show(simulation, &cfdmp->mpm_part);
    part_show(simulation, &cfdmp->gas_part);
    return NULL;
}

/* Cells of the region are not the gas that counts. */
static void hide_cells(struct cfdmp *cfdmp)
{
    part_hide_cells(gas_view(cfdmp->gas).cells, cfdmp->cut.low, cfdmp->cut.high);
}

static struct error *reserve_changed(struct cfdmp *cfdmp)
{
    const int32_t blocks = gas_view(cfdmp->gas).cells->blocks;
    if (!memory_reserve((void **)&cfdmp->changed, &cfdmp->changed_capacity, blocks + 1, 0,
                        sizeof *cfdmp->changed))
        return out_of_memory_for("blocks of cells");
    memset(cfdmp->changed, 0, (size_t)blocks * sizeof *cfdmp->changed);
    return NULL;
}

/* Collective: cells that have changed get what follows from their state. */
static struct error *refresh(struct cfdmp *cfdmp)
{
    struct error *error = gas_refresh(cfdmp->gas, &cfdmp->gas_part.simulation, cfdmp->changed);
    hide_cells(cfdmp);
    return ranks_agree(cfdmp->ranks, error);
}

static struct error *cfdmp_fill(void *solver, struct simulation *simulation)
{
    struct cfdmp *cfdmp = solver;
    (void)simulation;
    TRY(gas_class.fill(cfdmp->gas, &cfdmp->gas_part.simulation));
    return mpm_class.fill(cfdmp->mpm, &cfdmp->mpm_part.simulation);
}

/* Collective: whether something other than the gas outside moves the particles. */
static bool moves_itself(const struct cfdmp *cfdmp)
{
    const struct simulation_case *input = cfdmp->mpm_part.place.input;
    const struct problem *problem = cfdmp->mpm_part.simulation.problem;
    const struct particles *p = mpm_particles(cfdmp->mpm);
    bool moves = input->loads.count > 0 || problem_has_gravity(problem);
    for (int b = 0; b < input->bodies.count; b++) {
        const struct body_input *body = case_body(input, b);
        moves |= place_has(&problem->place, b) &&
                 ((body->driven && body->velocity.count > 0) || body->varies ||
                  material_burns(&problem->material[body->material_index]));
    }
    double high = -(double)INFINITY, low = (double)INFINITY;
    for (int32_t i = 0; i < p->count; i++) {
        for (int axis = 0; axis < 3; axis++)
            moves |= p->velocity[i][axis] != 0.0;
        high = maximum(high, p->pressure[i]);
        low = minimum(low, p->pressure[i]);
    }
    high = ranks_maximum(cfdmp->ranks, high);
    low = ranks_minimum(cfdmp->ranks, low);
    return ranks_maximum(cfdmp->ranks, moves) > 0.0 || high > low;
}

static struct error *cfdmp_start(void *solver, struct simulation *simulation)
{
    struct cfdmp *cfdmp = solver;
    part_share_time(&cfdmp->mpm_part, simulation);
    part_share_time(&cfdmp->gas_part, simulation);
    TRY(gas_class.start(cfdmp->gas, &cfdmp->gas_part.simulation));
    TRY(mpm_class.start(cfdmp->mpm, &cfdmp->mpm_part.simulation));
    hide_cells(cfdmp);
    if (simulation->step == 0) {
        cfdmp_note_rest(cfdmp);
        cfdmp->awake = moves_itself(cfdmp) ? 1.0 : 0.0;
        if (cfdmp->awake > 0.0)
            simulation_event(simulation, interaction, simulation->time);
    }
    return NULL;
}

static struct error *cfdmp_prepare(void *solver, struct simulation *simulation, struct limit *limit)
{
    struct cfdmp *cfdmp = solver;
    struct limit of_gas;
    part_share_time(&cfdmp->mpm_part, simulation);
    part_share_time(&cfdmp->gas_part, simulation);
    *limit = limit_of_nothing();
    if (cfdmp->awake == 0.0 && cfdmp_stirs(cfdmp)) {
        cfdmp->awake = 1.0;
        simulation_event(simulation, interaction, simulation->time);
    }
    if (cfdmp->awake > 0.0) {
        simulation_start_phase(&cfdmp->mpm_part.simulation);
        TRY(mpm_class.prepare(cfdmp->mpm, &cfdmp->mpm_part.simulation, limit));
        part_gather(simulation, &cfdmp->mpm_part);
        TRY(ranks_agree(simulation->ranks, reserve_changed(cfdmp)));
        TRY(cfdmp_fill_band(cfdmp));
        TRY(refresh(cfdmp));
    }
    simulation_end_phase(simulation, PHASE_SHARED, "coupling");
    simulation_start_phase(&cfdmp->gas_part.simulation);
    TRY(gas_class.prepare(cfdmp->gas, &cfdmp->gas_part.simulation, &of_gas));
    part_gather(simulation, &cfdmp->gas_part);
    hide_cells(cfdmp); /* which may have come from other ranks */
    const double event = minimum(limit->event, of_gas.event);
    if (of_gas.dt < limit->dt)
        *limit = of_gas;
    limit->event = event;
    return NULL;
}

static struct error *cfdmp_advance(void *solver, struct simulation *simulation, double dt)
{
    struct cfdmp *cfdmp = solver;
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++)
            if (cfdmp->side[axis][side].gates)
                memset(cfdmp->cut.passed[axis][side], 0,
                       (size_t)(cfdmp->side[axis][side].gates * GAS_PASSED) * sizeof(double));
    simulation_start_phase(&cfdmp->gas_part.simulation);
    TRY(ranks_agree(simulation->ranks,
                    gas_class.advance(cfdmp->gas, &cfdmp->gas_part.simulation, dt)));
    part_gather(simulation, &cfdmp->gas_part);
    cfdmp_find_pressures(cfdmp, dt);
    simulation_end_phase(simulation, PHASE_SHARED, "coupling");
    if (cfdmp->awake > 0.0) {
        simulation_start_phase(&cfdmp->mpm_part.simulation);
        TRY(ranks_agree(simulation->ranks,
                        mpm_class.advance(cfdmp->mpm, &cfdmp->mpm_part.simulation, dt)));
        part_gather(simulation, &cfdmp->mpm_part);
    } else
        cfdmp_lean(cfdmp, simulation);
    TRY(ranks_agree(simulation->ranks, reserve_changed(cfdmp)));
    TRY(cfdmp_transport(cfdmp, simulation, dt));
    struct error *error = refresh(cfdmp);
    simulation_end_phase(simulation, PHASE_SHARED, "coupling");
    return error;
}

static struct error *cfdmp_state(void *solver, struct visitor *visitor)
{
    struct cfdmp *cfdmp = solver;
    static const char *const names[3][2] = {{"cfdmp/low x", "cfdmp/high x"},
                                            {"cfdmp/low y", "cfdmp/high y"},
                                            {"cfdmp/low z", "cfdmp/high z"}};
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int side = 0; side < 2; side++)
            if (cfdmp->side[axis][side].gates)
                TRY(visitor->visit(visitor, names[axis][side], NUMBER_DOUBLE,
                                   cfdmp->side[axis][side].gate, cfdmp->side[axis][side].gates,
                                   (int)(sizeof(struct gate) / sizeof(double))));
    TRY(visitor->visit(visitor, "cfdmp/awake", NUMBER_DOUBLE, &cfdmp->awake, 1, 1));
    TRY(gas_class.state(cfdmp->gas, visitor));
    return mpm_class.state(cfdmp->mpm, visitor);
}

static void cfdmp_destroy(void *solver) { cfdmp_free_parts(solver); }

static bool is_no_gas(const struct material *material) { return !gas_computes(material); }

static void cfdmp_judge(const void *parameters, const struct simulation *simulation,
                        struct judgement *judgement)
{
    const struct cfdmp_parameters *of = parameters;
    const double edge = part_edge(&of->mpm, simulation->problem->input);
    boundaries_refuse(&judgement->findings, cfdmp_class.boundaries);
    coarse_cells(&judgement->findings, edge);
    coarse_gases(&judgement->findings, edge);
    judgement->energy_lost = mpm_energy_lost;
    judgement->instead =
        "if a face of the region cuts a charge that burns, let the region hold the "
        "charge or leave it out";
    judgement->room = cfdmp_room(of, simulation->problem->input);
    judgement->narrow = is_no_gas;
}

const struct solver_class cfdmp_class = {
    .size = sizeof(struct cfdmp),
    .boundaries = BOUNDARIES_CLOSED | BOUNDARY_PARTS | 1u << BOUNDARY_TRANSMITTING |
                  1u << BOUNDARY_INFLOW | 1u << BOUNDARY_PERIODIC | 1u << BOUNDARY_RIGID_BODY,
    .create = cfdmp_create,
    .fill = cfdmp_fill,
    .start = cfdmp_start,
    .prepare = cfdmp_prepare,
    .advance = cfdmp_advance,
    .state = cfdmp_state,
    .destroy = cfdmp_destroy,
    .bytes = mpm_bytes,
    .count = cfdmp_count,
    .judge = cfdmp_judge,
    .step = mpm_step_beside_gas,
    .coarsen = mpm_coarsen};
