/* The solver afdmp as the run loop sees it: each stage is a step of one part; at the end of a step
 * the next stage may begin. */
#include "couple/afdmp.h"

#include "material/material.h"

const char afdmp_nest_name[] = "detonation";

/* Of the events by which stages begin. */
static const char *const stage_names[] = {
    [AFDMP_PROPAGATION] = "propagation", [AFDMP_INTERACTION] = "interaction"};

static const char *const map_names[] = {"conservative", "consistent", "text", NULL};

const struct parameter afdmp_table[] = {
    PARAMETER(TABLE, struct afdmp_parameters, region, OPTIONAL,
              "the box of the solids, which is at rest until a wave comes; default: 10 cells "
              "around all of them",
              .table = region_table),
    PARAMETER(CHOICE, struct afdmp_parameters, map, "conservative",
              "what cells get of the particles of the detonation; consistent: mass, momentum and "
              "internal energy of each material through the nodes, so that kinetic energy is lost; "
              "conservative: cells get that as heat; text: as printed in the source, internal "
              "energy of the particles within each cell",
              .names = map_names),
    PARAMETER(NUMBER, struct afdmp_parameters, wake, "1.1",
              "the last stage begins when the pressure of the gas beside the region has changed by "
              "this factor",
              .above = 1.0, .below = INFINITY),
    PART_ROWS(struct afdmp_parameters),
    PARAMETER_END,
};

static struct error *afdmp_create(void *solver, struct simulation *simulation,
                                  const void *parameters)
{
    struct afdmp *afdmp = solver;
    afdmp->parameters = *(const struct afdmp_parameters *)parameters;
    TRY(afdmp_make_parts(afdmp, simulation));
    afdmp->stage = afdmp->nest_mpm ? AFDMP_DETONATION : AFDMP_PROPAGATION;
    if (afdmp->nest_mpm)
        simulation_add_event(simulation, stage_names[AFDMP_PROPAGATION]);
    if (afdmp->last_mpm) {
        simulation_add_event(simulation, stage_names[AFDMP_INTERACTION]);
        part_show(simulation, &afdmp->last);
    }
    part_show(simulation, &afdmp->gas_part);
    if (afdmp->nest_mpm) {
        const struct population_source *own = &afdmp->nest.simulation.population[0];
        simulation_add_population(simulation, afdmp_nest_name, own->type, own->store);
    }
    return NULL;
}

/* Calls FUNCTION for both parts of material points, where they are. */
static struct error *each_mpm(struct afdmp *afdmp,
                              struct error *(*function)(void *, struct simulation *))
{
    if (afdmp->last_mpm)
        TRY(function(afdmp->last_mpm, &afdmp->last.simulation));
    return afdmp->nest_mpm ? function(afdmp->nest_mpm, &afdmp->nest.simulation) : NULL;
}

static struct error *afdmp_fill(void *solver, struct simulation *simulation)
{
    struct afdmp *afdmp = solver;
    (void)simulation;
    TRY(gas_class.fill(afdmp->gas, &afdmp->gas_part.simulation));
    return each_mpm(afdmp, mpm_class.fill);
}

static void share_time(struct afdmp *afdmp, const struct simulation *simulation)
{
    part_share_time(&afdmp->gas_part, simulation);
    part_share_time(&afdmp->nest, simulation);
    part_share_time(&afdmp->last, simulation);
}

static struct error *afdmp_start(void *solver, struct simulation *simulation)
{
    struct afdmp *afdmp = solver;
    share_time(afdmp, simulation);
    TRY(gas_class.start(afdmp->gas, &afdmp->gas_part.simulation));
    if (afdmp->stage != (double)AFDMP_DETONATION)
        afdmp_burn_all(afdmp);
    TRY(each_mpm(afdmp, mpm_class.start));
    if (simulation->step == 0 && afdmp->last_mpm)
        afdmp_note_rest(afdmp, &afdmp->region, &afdmp->round_region);
    if (afdmp->stage == (double)AFDMP_DETONATION)
        afdmp_note_rest(afdmp, &afdmp->nest_cut, &afdmp->round_nest);
    afdmp_hide_cells(afdmp);
    return NULL;
}

/* What computes the stage: its part, of the class TYPE. */
static struct coupled_part *part_now(struct afdmp *afdmp, const struct solver_class **type)
{
    *type = afdmp->stage == (double)AFDMP_PROPAGATION ? &gas_class : &mpm_class;
    return afdmp->stage == (double)AFDMP_DETONATION    ? &afdmp->nest
           : afdmp->stage == (double)AFDMP_PROPAGATION ? &afdmp->gas_part
                                                       : &afdmp->last;
}

static struct error *afdmp_prepare(void *solver, struct simulation *simulation, struct limit *limit)
{
    struct afdmp *afdmp = solver;
    const struct solver_class *type;
    struct coupled_part *part = part_now(afdmp, &type);
    share_time(afdmp, simulation);
    simulation_start_phase(&part->simulation);
    TRY(type->prepare(part->solver, &part->simulation, limit));
    part_gather(simulation, part);
    return NULL;
}

/* Whether all explosives of the nest have burnt; collective. */
static bool has_burnt(const struct afdmp *afdmp)
{
    const struct particles *p = mpm_particles(afdmp->nest_mpm);
    const struct problem *problem = afdmp->nest.simulation.problem;
    const double *burnt = p->history[HISTORY_burnt];
    bool burns = false;
    for (int32_t i = 0; i < p->count && burnt && !burns; i++)
        burns = burnt[i] < 1.0 && material_is_lit(&problem->material[p->material[i]]);
    return ranks_maximum(afdmp->ranks, burns) == 0.0;
}

/* A walk over the cells beside the region, which ends where the pressure has changed. */
struct looking {
    const struct afdmp *afdmp;
    bool stirs;
};

static bool look(void *context, int64_t number, const int64_t at[3])
{
    struct looking *looking = context;
    const struct afdmp *afdmp = looking->afdmp;
    const struct cell_blocks *cells = gas_view(afdmp->gas).cells;
    const double wake = afdmp->parameters.wake, rest = afdmp->round_region.rest[number];
    int32_t block;
    const int32_t i = part_cell(cells, at, &block);
    if (i < 0)
        return true;
    const double now = cells->pressure[i];
    looking->stirs = !(now < wake * rest && rest < wake * now);
    return !looking->stirs;
}

/* Collective. */
static bool has_come(const struct afdmp *afdmp)
{
    struct looking looking = {afdmp, false};
    if (afdmp->last_mpm)
        afdmp_each_beside(afdmp, &afdmp->region, look, &looking);
    return ranks_maximum(afdmp->ranks, looking.stirs) > 0.0;
}

static struct error *begin(struct afdmp *afdmp, struct simulation *simulation,
                           enum afdmp_stage stage, double time)
{
    afdmp->stage = (double)stage;
    simulation_event(simulation, stage_names[stage], time);
    TRY(stage == AFDMP_PROPAGATION ? afdmp_map_to_gas(afdmp, simulation)
                                   : afdmp_map_to_points(afdmp, simulation));
    afdmp_hide_cells(afdmp);
    return NULL;
}

static struct error *afdmp_advance(void *solver, struct simulation *simulation, double dt)
{
    struct afdmp *afdmp = solver;
    const struct solver_class *type;
    struct coupled_part *part = part_now(afdmp, &type);
    struct error *error = NULL;
    simulation_start_phase(&part->simulation);
    TRY(ranks_agree(simulation->ranks, type->advance(part->solver, &part->simulation, dt)));
    part_gather(simulation, part);
    if (afdmp->stage == (double)AFDMP_DETONATION && has_burnt(afdmp))
        error = begin(afdmp, simulation, AFDMP_PROPAGATION, simulation->time + dt);
    else if (afdmp->stage == (double)AFDMP_PROPAGATION && has_come(afdmp))
        error = begin(afdmp, simulation, AFDMP_INTERACTION, simulation->time + dt);
    simulation_end_phase(simulation, PHASE_SHARED, "coupling");
    return error;
}

static struct error *afdmp_state(void *solver, struct visitor *visitor)
{
    struct afdmp *afdmp = solver;
    TRY(visitor->visit(visitor, "afdmp/stage", NUMBER_DOUBLE, &afdmp->stage, 1, 1));
    if (afdmp->last_mpm)
        TRY(visitor->visit(visitor, "afdmp/rest", NUMBER_DOUBLE, afdmp->round_region.rest,
                           afdmp->round_region.cells, 1));
    const struct solver_class *type;
    const struct coupled_part *part = part_now(afdmp, &type);
    return type->state(part->solver, visitor);
}

static void afdmp_destroy(void *solver) { afdmp_free_parts(solver); }

const struct solver_class afdmp_class = {.size = sizeof(struct afdmp),
                                         .boundaries = BOUNDARIES_CLOSED | BOUNDARY_PARTS |
                                                       1u << BOUNDARY_TRANSMITTING,
                                         .create = afdmp_create,
                                         .fill = afdmp_fill,
                                         .start = afdmp_start,
                                         .prepare = afdmp_prepare,
                                         .advance = afdmp_advance,
                                         .state = afdmp_state,
                                         .destroy = afdmp_destroy,
                                         .bytes = mpm_bytes,
                                         .count = afdmp_count,
                                         .step = mpm_step_beside_gas,
                                         .coarsen = mpm_coarsen,
                                         .judge = afdmp_judge};
