/* The state of a run: its populations, and the time that its phases take. */
#include "model/simulation.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/memory.h"
#include "model/columns.h"
#include "model/maps.h"

struct error *simulation_create(const struct simulation_case *input, const struct ranks *ranks,
                                int threads, struct simulation *simulation)
{
    const struct place whole = place_whole(input);
    return simulation_create_at(&whole, ranks, threads, simulation);
}

struct error *simulation_create_at(const struct place *place, const struct ranks *ranks,
                                   int threads, struct simulation *simulation)
{
    const size_t loads = (size_t)place->input->loads.count;
    struct problem *problem = memory_allocate(sizeof *problem);
    *simulation = (struct simulation){
        .problem = problem, .ranks = ranks, .partition = {.ranks = ranks}, .threads = threads};
    simulation->loads = place->input->loads.count;
    simulation->load = memory_allocate(loads * sizeof *simulation->load);
    simulation->trace = memory_allocate(loads * sizeof *simulation->trace);
    struct error *error = problem && simulation->load && simulation->trace
                              ? problem_create(place, problem)
                              : out_of_memory();
    if (error)
        simulation_destroy(simulation);
    else
        maps_take(simulation);
    return error;
}

void simulation_add_population(struct simulation *simulation, const char *name,
                               const struct population_class *type, void *store)
{
    assert(simulation->populations < POPULATIONS_MAX);
    struct population_source *source = &simulation->population[simulation->populations++];
    *source = (struct population_source){.name = name, .type = type, .store = store};
    struct field_declaration maps[2 * MAPS_MAX];
    struct population population =
        simulation_population_at(simulation, simulation->populations - 1);
    source->columns = population.columns = columns_make(&population, source->column);
    const int count = population.count ? 0 : maps_declare(simulation, &population, maps);
    if (count) {
        type->add(store, maps, count);
        population = simulation_population_at(simulation, simulation->populations - 1);
        source->columns = columns_make(&population, source->column);
    }
}

struct population simulation_population_at(const struct simulation *simulation, int index)
{
    assert(index < simulation->populations);
    const struct population_source *source = &simulation->population[index];
    struct population population = source->type->members(source->store);
    population.source = source;
    population.name = source->name;
    population.problem = simulation->problem;
    population.columns = source->columns;
    population.column = source->column;
    return population;
}

struct population simulation_population(const struct simulation *simulation)
{
    return simulation_population_at(simulation, 0);
}

void simulation_see(struct simulation *simulation)
{
    for (int k = 0; k < simulation->populations; k++)
        simulation->seen[k] = simulation_population_at(simulation, k);
}

void simulation_add_event(struct simulation *simulation, const char *name)
{
    assert(simulation->events < EVENTS_MAX);
    simulation->event[simulation->events++] = (struct event){name, NAN};
}

void simulation_event(struct simulation *simulation, const char *name, double time)
{
    for (int k = 0; k < simulation->events; k++)
        if (!strcmp(simulation->event[k].name, name))
            simulation->event[k].time = time;
}

/* The number of the population OF, -1 for none and for bodies. */
static int find_population(const struct simulation *simulation, const char *of)
{
    const bool body = case_find_body(simulation->problem->input, of) >= 0;
    for (int k = 0; k < simulation->populations && of && !body; k++)
        if (strcmp(simulation->population[k].name, of) == 0)
            return k;
    return -1;
}

const struct population *simulation_seen(const struct simulation *simulation, const char *of,
                                         const struct population *first)
{
    const int found = find_population(simulation, of);
    return found > 0 ? &simulation->seen[found] : first;
}

int simulation_shown(const struct simulation *simulation, const struct population *population,
                     const struct population *shown[POPULATIONS_MAX])
{
    int count = 0;
    shown[count++] = population;
    for (int k = 1; k < simulation->populations; k++)
        if (population->name == simulation->population[0].name)
            shown[count++] = &simulation->seen[k];
    return count;
}

struct error *simulation_check_of(const struct simulation *simulation, const char *section,
                                  const char *name, const char *of)
{
    const struct simulation_case *input = simulation->problem->input;
    if (!of || case_find_body(input, of) >= 0 || find_population(simulation, of) >= 0)
        return NULL;
    char key[160];
    snprintf(key, sizeof key, "%.120s.of", name);
    return input_error(input, section, key, "this case has no %s: its solver computes %s", of,
                       simulation->population[0].name);
}

void simulation_remove_population(struct simulation *simulation, const void *store)
{
    int kept = 0;
    for (int k = 0; k < simulation->populations; k++)
        if (simulation->population[k].store != store)
            simulation->population[kept++] = simulation->population[k];
    simulation->populations = kept;
}

bool simulation_changed(const struct simulation *simulation)
{
    bool changed = false;
    for (int k = 0; k < simulation->populations; k++)
        changed |= simulation->population[k].type->changed(simulation->population[k].store);
    return changed;
}

struct error *simulation_commit(struct simulation *simulation)
{
    struct error *error = NULL;
    for (int k = 0; k < simulation->populations; k++)
        error = error_join(error,
                           simulation->population[k].type->commit(simulation->population[k].store));
    return error;
}

struct error *simulation_distribute(struct simulation *simulation)
{
    for (int k = 0; k < simulation->populations; k++)
        TRY(simulation->population[k].type->distribute(simulation->population[k].store));
    return NULL;
}

uint64_t simulation_hash(const struct simulation *simulation)
{
    const struct population_source *first = simulation->population;
    uint64_t hash = first->type->hash(first->store);
    for (int k = 1; k < simulation->populations; k++)
        hash = hash * 0x9e3779b97f4a7c15u +
               simulation->population[k].type->hash(simulation->population[k].store);
    return hash;
}

int64_t simulation_members(const struct simulation *simulation)
{
    int64_t own = 0;
    for (int k = 0; k < simulation->populations; k++)
        own += simulation->population[k].type->members(simulation->population[k].store).count;
    return ranks_sum(simulation->ranks, own);
}

struct totals simulation_totals(const struct simulation *simulation)
{
    struct totals totals =
        population_totals(simulation_population(simulation), simulation->ranks, -1);
    for (int k = 1; k < simulation->populations; k++) {
        const struct totals more =
            population_totals(simulation_population_at(simulation, k), simulation->ranks, -1);
        for (int entry = 0; entry < LEDGER_ENTRIES; entry++)
            totals.entry[entry] += more.entry[entry];
        totals.kinetic += more.kinetic;
        totals.internal += more.internal;
        totals.momentum_scale += more.momentum_scale;
    }
    return totals;
}

void simulation_destroy(struct simulation *simulation)
{
    simulation->populations = 0;
    partition_free(&simulation->partition);
    struct problem *problem = (struct problem *)simulation->problem; /* ours, but for all others */
    if (problem)
        problem_destroy(problem);
    free(problem);
    for (int i = 0; i < simulation->loads && simulation->trace; i++)
        load_trace_free(&simulation->trace[i]);
    free(simulation->trace);
    free(simulation->load);
    simulation->problem = NULL;
    simulation->load = NULL;
    simulation->trace = NULL;
}

void simulation_start_phase(struct simulation *simulation)
{
    simulation->phase_end = clock_seconds();
}

void simulation_end_phase(struct simulation *simulation, enum phase_kind kind, const char *name)
{
    const double now = clock_seconds();
    const double seconds = simulation->phase_end > 0.0 ? now - simulation->phase_end : 0.0;
    int i = 0;
    simulation->phase_end = now;
    while (i < simulation->phases && strcmp(simulation->phase[i].name, name) != 0)
        i++;
    assert(i < PHASES_MAX);
    if (i == simulation->phases)
        simulation->phase[simulation->phases++] = (struct phase){name, 0.0};
    simulation->phase[i].seconds += seconds;
    if (kind == PHASE_BLOCKS)
        simulation->partition.work += seconds;
}

void simulation_take_phases(struct simulation *simulation, struct simulation *part)
{
    simulation_start_phase(simulation);
    for (int k = 0; k < part->phases; k++) {
        simulation_end_phase(simulation, PHASE_SHARED, part->phase[k].name);
        for (int i = 0; i < simulation->phases; i++)
            if (strcmp(simulation->phase[i].name, part->phase[k].name) == 0)
                simulation->phase[i].seconds += part->phase[k].seconds;
    }
    part->phases = 0;
}

void simulation_end_waiting(struct simulation *simulation)
{
    if (simulation->ranks->size > 1)
        simulation_end_phase(simulation, PHASE_WAITING, "waiting");
}

struct error *simulation_impossible(const struct simulation *simulation, int32_t i)
{
    const struct population population = simulation_population(simulation), *p = &population;
    const bool cell = p->kind == POPULATION_OF_CELLS;
    return error_new(
        ERROR_STATE,
        "step %lld, t = %.6g s: the state of %s %llu (body %s, site %llu) at "
        "(%.6g, %.6g, %.6g) m became impossible: density %.6g kg/m^3, energy %.6g J/kg, "
        "pressure %.6g Pa, velocity (%.6g, %.6g, %.6g) m/s",
        (long long)simulation->step + 1, simulation->time, cell ? "cell" : "particle",
        (unsigned long long)p->id[i], simulation->problem->input->bodies.names[p->body[i]],
        (unsigned long long)(p->id[i] & PARTICLE_SITE), p->position[i][0], p->position[i][1],
        p->position[i][2], p->density[i], p->energy[i], p->pressure[i], p->velocity[i][0],
        p->velocity[i][1], p->velocity[i][2]);
}

struct error *simulation_value_at(const struct simulation *simulation, double time,
                                  const struct field_value *field, const char *name,
                                  const char *key, double *value)
{
    *value = field_at(field, vec3_make(0.0, 0.0, 0.0), time);
    if (isfinite(*value))
        return NULL;
    return error_new(ERROR_STATE, "step %lld: %s of %s, \"%s\", is not finite at t = %.6g s",
                     (long long)simulation->step + 1, key, name,
                     varying_expression_text(field->varying), time);
}

struct error *simulation_visit(struct simulation *simulation, struct visitor *visitor)
{
    TRY(visitor->visit(visitor, "time", NUMBER_DOUBLE, &simulation->time, 1, 1));
    TRY(visitor->visit(visitor, "step", NUMBER_INT64, &simulation->step, 1, 1));
    TRY(ledger_visit(&simulation->ledger, simulation->ranks, visitor));
    TRY(load_records_visit(simulation->load, simulation->loads, simulation->ranks, visitor));
    double times[EVENTS_MAX];
    for (int k = 0; k < simulation->events; k++)
        times[k] = simulation->event[k].time;
    if (simulation->events > 0)
        TRY(visitor->visit(visitor, "events", NUMBER_DOUBLE, times, simulation->events, 1));
    for (int k = 0; k < simulation->events; k++)
        simulation->event[k].time = times[k];
    for (int k = 0; k < simulation->populations; k++)
        TRY(simulation->population[k].type->visit(simulation->population[k].store, visitor));
    return NULL;
}

bool interval_is_due(double time, double interval, int64_t *due)
{
    if (isnan(interval) || time < (double)*due * interval)
        return false;
    *due = (int64_t)floor(time / interval) + 1;
    if (time >= (double)*due * interval) /* the quotient was rounded down */
        ++*due;
    return true;
}
