/* Maps of the members over the time; see maps.h. A member's memory is zero until it has been looked
 * at: of a peak it is one then, of an arrival the time, of an impulse the integral until now. */
#include "model/maps.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"
#include "model/columns.h"

/* Members whose quantity is read at once. */
enum { CHUNK = 256 };

void maps_take(struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    for (int i = 0; input && i < input->output.maps.count && i < MAPS_MOST; i++) {
        const struct map_input *of = case_map(input, i);
        const struct map_over *over = of->arrival.field ? &of->arrival : &of->impulse;
        struct map map = {.name = input->output.maps.names[i],
                          .kind = of->peak            ? MAP_PEAK
                                  : of->arrival.field ? MAP_ARRIVAL
                                                      : MAP_IMPULSE,
                          .field = of->peak ? of->peak : over->field,
                          .above = of->peak ? 0.0 : over->above.value};
        maps_add(simulation, &map);
    }
}

void maps_add(struct simulation *simulation, const struct map *map)
{
    for (int k = 0; k < simulation->maps; k++)
        if (!strcmp(simulation->map[k].name, map->name))
            return;
    assert(simulation->maps < MAPS_MAX);
    struct map *own = &simulation->map[simulation->maps++];
    *own = *map;
    snprintf(own->memory, sizeof own->memory, "%s_memory", map->name);
}

/* One number a member; NULL: POPULATION has no such quantity, or it has several. */
static const struct column *quantity_of(const struct map *map, const struct population *population,
                                        int *component)
{
    const struct column *column = column_find(population, map->field, component);
    if (!column || (column->components > 1 && *component < 0))
        return NULL;
    *component = *component < 0 ? 0 : *component;
    return column;
}

bool maps_find(const struct map *map, const struct population *population,
               struct map_fields *fields)
{
    fields->value = fields_find(population->field, population->fields, map->name);
    fields->memory = fields_find(population->field, population->fields, map->memory);
    return fields->value && fields->memory;
}

bool maps_has(const struct map *map, const struct population *population)
{
    for (int k = 0; k < population->fields; k++)
        if (!strcmp(population->field[k].declaration.name, map->memory))
            return true;
    return false;
}

static void find_unit(struct map *map, const struct column *column)
{
    if (map->kind == MAP_ARRIVAL)
        snprintf(map->unit, sizeof map->unit, "s");
    else
        snprintf(map->unit, sizeof map->unit, "%s%s", column->unit,
                 map->kind == MAP_IMPULSE ? "*s" : "");
}

int maps_declare(struct simulation *simulation, const struct population *population,
                 struct field_declaration *fields)
{
    static const char *const helps[] = {[MAP_PEAK] = "largest value until now",
                                        [MAP_ARRIVAL] = "time of arrival; not a number: none yet",
                                        [MAP_IMPULSE] = "largest impulse until now"};
    int count = 0, component;
    for (int k = 0; k < simulation->maps; k++) {
        struct map *map = &simulation->map[k];
        const struct column *column = quantity_of(map, population, &component), *other;
        other = column_find(population, map->name, &component);
        if (!column || other || (map->of_cells && population->kind != POPULATION_OF_CELLS))
            continue;
        find_unit(map, column);
        fields[count++] = (struct field_declaration){
            map->name,     map->unit, helps[map->kind],
            NUMBER_DOUBLE, 1,         map->kind == MAP_ARRIVAL ? FIELD_DERIVED : FIELD_STATE};
        fields[count++] = (struct field_declaration){map->memory,   NULL, "of a map",
                                                     NUMBER_DOUBLE, 1,    FIELD_STATE};
    }
    return count;
}

/* What a member has at TIME, after DT with VALUE. */
static void keep(const struct map *map, double value, double time, double dt, double *kept,
                 double *memory)
{
    const double over = value - map->above;
    switch (map->kind) {
    case MAP_PEAK:
        if (isfinite(over) && !(*memory != 0.0 && *kept >= over)) {
            *kept = over;
            *memory = 1.0;
        }
        break;
    case MAP_ARRIVAL:
        if (*memory == 0.0 && over >= 0.0)
            *memory = time != 0.0 ? time : DBL_MIN;
        *kept = *memory != 0.0 ? *memory : (double)NAN;
        break;
    case MAP_IMPULSE:
        if (isfinite(over))
            *memory += over * dt;
        *kept = maximum(*kept, *memory);
        break;
    }
}

static void update(const struct map *map, const struct population *population, double time,
                   double dt)
{
    int component;
    struct map_fields fields;
    const struct column *column = quantity_of(map, population, &component);
    if (!column || !maps_find(map, population, &fields))
        return;
#pragma omp parallel for schedule(static) num_threads(population->threads)
    for (int32_t begin = 0; begin < population->count; begin += CHUNK) {
        double value[CHUNK];
        const int32_t end = begin + CHUNK < population->count ? begin + CHUNK : population->count;
        column_read_component(population, column, component, begin, end, value);
        for (int32_t i = begin; i < end; i++)
            if (population_has(population, i))
                keep(map, value[i - begin], time, dt, &fields.value[i], &fields.memory[i]);
    }
}

void maps_update(const struct simulation *simulation, double dt)
{
    for (int p = 0; p < simulation->populations && simulation->maps; p++) {
        const struct population population = simulation_population_at(simulation, p);
        for (int k = 0; k < simulation->maps; k++)
            update(&simulation->map[k], &population, simulation->time, dt);
    }
}

/* Whether any population keeps the map; the mistake of the first one otherwise. */
static struct error *check_map(const struct simulation *simulation, const struct map *map,
                               const struct column **column)
{
    int component;
    const struct population first = simulation_population(simulation);
    for (int p = 0; p < simulation->populations; p++) {
        const struct population population = simulation_population_at(simulation, p);
        *column = quantity_of(map, &population, &component);
        if (*column && maps_has(map, &population))
            return NULL;
    }
    TRY(column_choose(&first, map->field, NULL, 0, column, &component));
    return error_new(ERROR_INPUT, "there is a field \"%s\" already: give the map another name",
                     map->name);
}

static struct error *check_above(const struct quantity *above, const struct column *column)
{
    struct unit unit;
    char is[DIMENSION_TEXT], must[DIMENSION_TEXT];
    TRY(unit_parse(column->unit, &unit));
    if (dimension_equal(above->dimension, unit.dimension))
        return NULL;
    dimension_text(above->dimension, is);
    dimension_text(unit.dimension, must);
    return error_new(ERROR_INPUT, "`above` is in %s, but %s is in %s", is[0] ? is : "plain numbers",
                     column->name, must[0] ? must : "plain numbers");
}

struct error *maps_check(const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    struct error *all = NULL;
    for (int i = 0; i < input->output.maps.count && i < simulation->maps; i++) {
        const struct map_input *of = case_map(input, i);
        const struct column *column;
        char key[64];
        snprintf(key, sizeof key, "maps.%s", input->output.maps.names[i]);
        struct error *error = check_map(simulation, &simulation->map[i], &column);
        if (!error && !of->peak)
            error =
                check_above(of->arrival.field ? &of->arrival.above : &of->impulse.above, column);
        if (error)
            all = error_join(all, input_error(input, "output", key, "%s", error_message(error, 0)));
        error_free(error);
    }
    return all;
}
