/* Columns: the fields of a store as they are there, and a few quantities computed from them when
 * they are read; see columns.h. */
#include "model/columns.h"

#include <stdio.h>
#include <string.h>

#include "material/material.h"
#include "model/ledger.h"
#include "model/problem.h"
#include "model/start_place.h"

/* Members that are computed at once when one component of them is wanted. */
enum { CHUNK = 256, COMPONENTS_MAX = 6 };

static void compute_stress(const struct population *p, int64_t begin, int64_t end, double *out)
{
    for (int64_t i = begin; i < end; i++, out += 6)
        for (int k = 0; k < 6; k++)
            out[k] = (p->deviator ? p->deviator[i][k] : 0.0) - (k < 3 ? p->pressure[i] : 0.0);
}

static void compute_equivalent_stress(const struct population *p, int64_t begin, int64_t end,
                                      double *out)
{
    static const double none[6] = {0.0};
    for (int64_t i = begin; i < end; i++) {
        const double *s = p->deviator ? p->deviator[i] : none;
        const struct sym3 deviator = {s[0], s[1], s[2], s[3], s[4], s[5]};
        *out++ = sym3_mises(deviator);
    }
}

static void compute_speed(const struct population *p, int64_t begin, int64_t end, double *out)
{
    for (int64_t i = begin; i < end; i++) {
        const double *u = p->velocity[i];
        *out++ = sqrt(square(u[0]) + square(u[1]) + square(u[2]));
    }
}

static void compute_displacement(const struct population *p, int64_t begin, int64_t end,
                                 double *out)
{
    double(*moved)[3] = (double(*)[3])out;
    start_places(p, begin, end, moved);
    for (int64_t i = begin; i < end; i++)
        for (int k = 0; k < 3; k++)
            moved[i - begin][k] = p->position[i][k] - moved[i - begin][k];
}

/* (m/rho)^(1/dimension), where x is a radius that of the section. */
static void compute_diameter(const struct population *p, int64_t begin, int64_t end, double *out)
{
    const int power = geometry_power(p->problem->geometry);
    for (int64_t i = begin; i < end; i++) {
        const double x = p->position[i][0], depth = power == 0 ? 1.0 : power == 1 ? x : square(x);
        *out++ = diameter_of_volume(p->mass[i] / (p->density[i] * depth), p->dimension);
    }
}

static void compute_temperature(const struct population *p, int64_t begin, int64_t end, double *out)
{
    for (int64_t i = begin; i < end; i++) {
        const struct material *material = &p->problem->material[p->material[i]];
        *out++ =
            population_is_mixed(p, (int32_t)i)
                ? (double)NAN
                : heat_temperature(&material->heat, &material->eos, p->density[i], p->energy[i]);
    }
}

static bool has_temperature(const struct problem *problem)
{
    bool all = problem->materials > 0;
    for (int m = 0; m < problem->materials; m++)
        all &= !heat_wrong(&problem->material[m].heat, &problem->material[m].eos);
    return all;
}

static const struct column computed[] = {
    {"stress", "Pa", "stress, positive in tension", 6, -1, compute_stress},
    {"equivalent_stress", "Pa", "equivalent (von Mises) stress", 1, -1, compute_equivalent_stress},
    {"speed", "m/s", "magnitude of the velocity", 1, -1, compute_speed},
};
static const struct column temperature = {
    "temperature",      "K", "temperature, where all materials have a heat capacity", 1, -1,
    compute_temperature};
/* Where a solver does not keep it. */
static const struct column diameter = {"diameter", "m", "particle diameter (m/rho)^(1/dimension)",
                                       1,          -1,  compute_diameter};
static const struct column displacement = {
    "displacement",      "m", "displacement from the position at the start", 3, -1,
    compute_displacement};

static bool is_there(const struct column *columns, int count, const char *name)
{
    for (int i = 0; i < count; i++)
        if (!strcmp(columns[i].name, name))
            return true;
    return false;
}

int columns_make(const struct population *population, struct column *columns)
{
    const struct problem *problem = population->problem;
    const bool moving = problem->input && population->kind == POPULATION_OF_PARTICLES;
    int count = 0;
    for (int i = 0; i < population->fields; i++) {
        const struct field_declaration *field = &population->field[i].declaration;
        if (field->number != NUMBER_DOUBLE || !field->unit)
            continue;
        const char *unit = field->unit;
        if (!strcmp(field->name, "mass")) /* in the unit of the totals */
            unit = ledger_unit(LEDGER_MASS, population->dimension, problem->geometry);
        assert(count + (int)COUNT_OF(computed) + 3 < COLUMNS_MAX);
        columns[count++] =
            (struct column){field->name, unit, field->help, field->components, i, NULL};
    }
    for (size_t i = 0; i < COUNT_OF(computed); i++)
        columns[count++] = computed[i];
    if (moving && !is_there(columns, count, diameter.name))
        columns[count++] = diameter;
    if (has_temperature(problem))
        columns[count++] = temperature;
    if (moving)
        columns[count++] = displacement;
    return count;
}

static const char *const *component_names(int components)
{
    static const char *const vector_names[3] = {"x", "y", "z"};
    static const char *const tensor_names[6] = {"xx", "yy", "zz", "xy", "yz", "zx"};
    assert(components <= 3 || components == 6);
    return components == 6 ? tensor_names : vector_names;
}

const char *column_component_name(int components, int component)
{
    return components == 1 ? "" : component_names(components)[component];
}

bool column_component_shown(int components, int component, int dimension)
{
    if (components == 3)
        return component < dimension;
    return component < 3 || dimension == 3 || (dimension == 2 && component == 3);
}

/* The index of component NAME of a vector or tensor, -1 when there is none. */
static int component_index(int components, const char *name)
{
    const char *const *names = component_names(components);
    for (int i = 0; i < components && components > 1; i++)
        if (strcmp(names[i], name) == 0)
            return i;
    return -1;
}

const struct column *column_find(const struct population *population, const char *name,
                                 int *component)
{
    const char *dot = strrchr(name, '.');
    const size_t length = dot ? (size_t)(dot - name) : strlen(name);
    for (int i = 0; i < population->columns; i++) {
        const struct column *column = &population->column[i];
        if (strlen(column->name) != length || strncmp(column->name, name, length) != 0)
            continue;
        *component = dot ? component_index(column->components, dot + 1) : -1;
        return dot && *component < 0 ? NULL : column;
    }
    return NULL;
}

static struct error *choose_component(const struct column *column, int dimension)
{
    char text[256] = "";
    size_t used = 0;
    int shown = 0;
    for (int i = 0; i < column->components && used < sizeof text; i++)
        if (column_component_shown(column->components, i, dimension))
            used +=
                (size_t)snprintf(text + used, sizeof text - used, "%s%s.%s", shown++ ? ", " : "",
                                 column->name, component_names(column->components)[i]);
    return error_new(ERROR_INPUT, "\"%s\" is a %s, choose %s: %s", column->name,
                     column->components == 3 ? "vector" : "tensor",
                     shown == 1 ? "its component" : "one of its components", text);
}

static struct error *no_such_field(const struct population *population, const char *field,
                                   const char *const *more, int count)
{
    enum { MORE = 8 };
    const char *names[COLUMNS_MAX + MORE];
    int known = 0;
    for (; known < population->columns; known++)
        names[known] = population->column[known].name;
    for (int i = 0; i < count && i < MORE; i++)
        names[known++] = more[i];
    char word[64];
    snprintf(word, sizeof word, "%.*s", (int)strcspn(field, "."), field);
    if (!strcmp(word, temperature.name))
        return error_new(ERROR_INPUT, "there is no temperature: not every material has a `heat: "
                                      "{capacity: ...}` and an equation of state that gives one");
    const char *nearest = nearest_name(word, names, known);
    if (nearest)
        return error_new(ERROR_INPUT, "the particles have no field \"%s\" (did you mean \"%s\"?)",
                         field, nearest);
    char text[1024] = "";
    size_t used = 0;
    for (int i = 0; i < known && used < sizeof text; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%s", i ? ", " : "", names[i]);
    return error_new(ERROR_INPUT, "the particles have no field \"%s\" (known: %s)", field, text);
}

struct error *column_choose(const struct population *population, const char *field,
                            const char *const *more, int count, const struct column **column,
                            int *component)
{
    char whole[64];
    snprintf(whole, sizeof whole, "%.*s", (int)strcspn(field, "."), field);
    *column = column_find(population, field, component);
    const struct column *around = *column ? *column : column_find(population, whole, component);
    if (!around)
        return no_such_field(population, field, more, count);
    if (around->components > 1 && (!*column || *component < 0))
        return choose_component(around, population->dimension);
    if (!*column)
        return error_new(ERROR_INPUT, "\"%s\": %s has no components", field, whole);
    if (*component < 0)
        *component = 0;
    return NULL;
}

void column_read(const struct population *population, const struct column *column, int64_t begin,
                 int64_t end, double *out)
{
    if (column->field < 0) {
        column->compute(population, begin, end, out);
        return;
    }
    const double *data = population->field[column->field].data;
    if (end > begin)
        memcpy(out, data + begin * column->components,
               (size_t)(end - begin) * (size_t)column->components * sizeof *out);
}

void column_read_component(const struct population *population, const struct column *column,
                           int component, int64_t begin, int64_t end, double *out)
{
    assert(component < column->components && (component >= 0 || column->components == 1));
    if (column->components == 1) {
        column_read(population, column, begin, end, out);
        return;
    }
    double chunk[CHUNK * COMPONENTS_MAX];
    for (int64_t from = begin; from < end; from += CHUNK) {
        const int64_t to = from + CHUNK < end ? from + CHUNK : end;
        column_read(population, column, from, to, chunk);
        for (int64_t i = from; i < to; i++)
            out[i - begin] = chunk[(i - from) * column->components + component];
    }
}
