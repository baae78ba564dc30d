/* Views of the particle store: its fields as they lie there, and a few quantities computed from them
 * when they are read. */
#include "model/views.h"

#include <stdio.h>
#include <string.h>

#include "material/material.h"
#include "model/start_place.h"
#include "particle/particles.h"

/* Particles that are computed at once when one component of them is wanted. */
enum { CHUNK = 256, COMPONENTS_MAX = 6 };

static void compute_stress(const void *context, int64_t begin, int64_t end, double *out)
{
    const struct population p = simulation_population(context);
    for (int64_t i = begin; i < end; i++, out += 6)
        for (int k = 0; k < 6; k++)
            out[k] = (p.deviator ? p.deviator[i][k] : 0.0) - (k < 3 ? p.pressure[i] : 0.0);
}

static void compute_equivalent_stress(const void *context, int64_t begin, int64_t end, double *out)
{
    const struct population p = simulation_population(context);
    static const double none[6] = {0.0};
    for (int64_t i = begin; i < end; i++) {
        const double *s = p.deviator ? p.deviator[i] : none;
        const struct sym3 deviator = {s[0], s[1], s[2], s[3], s[4], s[5]};
        *out++ = sym3_mises(deviator);
    }
}

static void compute_speed(const void *context, int64_t begin, int64_t end, double *out)
{
    const struct population p = simulation_population(context);
    for (int64_t i = begin; i < end; i++) {
        const double *u = p.velocity[i];
        *out++ = sqrt(square(u[0]) + square(u[1]) + square(u[2]));
    }
}

static void compute_displacement(const void *context, int64_t begin, int64_t end, double *out)
{
    const struct simulation *simulation = context;
    const struct population p = simulation_population(simulation);
    double(*moved)[3] = (double(*)[3])out;
    start_places(simulation, begin, end, moved);
    for (int64_t i = begin; i < end; i++)
        for (int k = 0; k < 3; k++)
            moved[i - begin][k] = p.position[i][k] - moved[i - begin][k];
}

/* (m/rho)^(1/dimension), of axisymmetry that of the section. */
static void compute_diameter(const void *context, int64_t begin, int64_t end, double *out)
{
    const struct simulation *simulation = context;
    const struct population population = simulation_population(simulation), *p = &population;
    const bool round = simulation->problem->geometry == GEOMETRY_AXISYMMETRIC;
    for (int64_t i = begin; i < end; i++) {
        const double depth = round ? p->position[i][0] : 1.0;
        *out++ = diameter_of_volume(p->mass[i] / (p->density[i] * depth), p->dimension);
    }
}

static void compute_temperature(const void *context, int64_t begin, int64_t end, double *out)
{
    const struct simulation *simulation = context;
    const struct population p = simulation_population(simulation);
    for (int64_t i = begin; i < end; i++) {
        const struct material *material = &simulation->problem->material[p.material[i]];
        *out++ = heat_temperature(&material->heat, &material->eos, p.density[i], p.energy[i]);
    }
}

static bool has_temperature(const struct simulation *simulation)
{
    bool all = simulation->problem->materials > 0;
    for (int m = 0; m < simulation->problem->materials; m++)
        all &= !heat_wrong(&simulation->problem->material[m].heat,
                           &simulation->problem->material[m].eos);
    return all;
}

static const struct view temperature_view = {
    .name = "temperature",
    .unit = "K",
    .help = "temperature, where all materials have a heat capacity",
    .components = 1,
    .compute = compute_temperature};

/* Where a solver does not keep it. */
static const struct view diameter_view = {.name = "diameter",
                                          .unit = "m",
                                          .help = "particle diameter (m/rho)^(1/dimension)",
                                          .components = 1,
                                          .compute = compute_diameter};

static const struct view displacement_view = {.name = "displacement",
                                              .unit = "m",
                                              .help = "displacement from the position at the start",
                                              .components = 3,
                                              .compute = compute_displacement};

static const struct view computed_views[] = {
    {.name = "stress",
     .unit = "Pa",
     .help = "stress, positive in tension",
     .components = 6,
     .compute = compute_stress},
    {.name = "equivalent_stress",
     .unit = "Pa",
     .help = "equivalent (von Mises) stress",
     .components = 1,
     .compute = compute_equivalent_stress},
    {.name = "speed",
     .unit = "m/s",
     .help = "magnitude of the velocity",
     .components = 1,
     .compute = compute_speed},
};

void views_add(struct views *views, struct view view)
{
    assert(views->count < VIEWS_MAX);
    views->view[views->count++] = view;
}

void views_of_population(struct views *views, const struct simulation *simulation)
{
    const struct population population = simulation_population(simulation),
                            *particles = &population;
    views->dimension = particles->dimension;
    for (int i = 0; i < particles->fields; i++) {
        const struct field_declaration *declaration = &particles->field[i].declaration;
        if (declaration->number != NUMBER_DOUBLE || !declaration->unit)
            continue;
        const char *unit = declaration->unit;
        if (!strcmp(declaration->name, "mass")) /* in the unit of the totals */
            unit = ledger_unit(LEDGER_MASS, particles->dimension, simulation->problem->geometry);
        views_add(views, (struct view){.name = declaration->name,
                                       .unit = unit,
                                       .help = declaration->help,
                                       .components = declaration->components,
                                       .data = particles->field[i].data});
    }
    for (size_t i = 0; i < COUNT_OF(computed_views); i++) {
        struct view view = computed_views[i];
        view.context = simulation;
        views_add(views, view);
    }
    int component;
    const bool moving = simulation->problem->input && particles->kind == POPULATION_OF_PARTICLES;
    if (moving && !views_find(views, "diameter", &component)) {
        struct view view = diameter_view;
        view.context = simulation;
        views_add(views, view);
    }
    if (has_temperature(simulation)) {
        struct view view = temperature_view;
        view.context = simulation;
        views_add(views, view);
    }
    if (moving) {
        struct view view = displacement_view;
        view.context = simulation;
        views_add(views, view);
    }
}

static const char *const *component_names(int components)
{
    static const char *const vector_names[3] = {"x", "y", "z"};
    static const char *const tensor_names[6] = {"xx", "yy", "zz", "xy", "yz", "zx"};
    assert(components <= 3 || components == 6);
    return components == 6 ? tensor_names : vector_names;
}

const char *view_component_name(int components, int component)
{
    return components == 1 ? "" : component_names(components)[component];
}

bool view_component_shown(int components, int component, int dimension)
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

const struct view *views_find(const struct views *views, const char *name, int *component)
{
    const char *dot = strrchr(name, '.');
    const size_t length = dot ? (size_t)(dot - name) : strlen(name);
    for (int i = 0; i < views->count; i++) {
        const struct view *view = &views->view[i];
        if (strlen(view->name) != length || strncmp(view->name, name, length) != 0)
            continue;
        *component = dot ? component_index(view->components, dot + 1) : -1;
        return dot && *component < 0 ? NULL : view;
    }
    return NULL;
}

static struct error *choose_component(const struct view *view, int dimension)
{
    char text[256] = "";
    size_t used = 0;
    int shown = 0;
    for (int i = 0; i < view->components && used < sizeof text; i++)
        if (view_component_shown(view->components, i, dimension))
            used +=
                (size_t)snprintf(text + used, sizeof text - used, "%s%s.%s", shown++ ? ", " : "",
                                 view->name, component_names(view->components)[i]);
    return error_new(ERROR_INPUT, "\"%s\" is a %s, choose %s: %s", view->name,
                     view->components == 3 ? "vector" : "tensor",
                     shown == 1 ? "its component" : "one of its components", text);
}

static struct error *no_such_field(const struct views *views, const char *field,
                                   const char *const *more, int count)
{
    enum { MORE = 8 };
    const char *names[VIEWS_MAX + MORE];
    int known = 0;
    for (; known < views->count; known++)
        names[known] = views->view[known].name;
    for (int i = 0; i < count && i < MORE; i++)
        names[known++] = more[i];
    char word[64];
    snprintf(word, sizeof word, "%.*s", (int)strcspn(field, "."), field);
    if (!strcmp(word, temperature_view.name))
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

struct error *views_choose(const struct views *views, const char *field, const char *const *more,
                           int count, const struct view **view, int *component)
{
    char whole[64];
    snprintf(whole, sizeof whole, "%.*s", (int)strcspn(field, "."), field);
    *view = views_find(views, field, component);
    const struct view *around = *view ? *view : views_find(views, whole, component);
    if (!around)
        return no_such_field(views, field, more, count);
    if (around->components > 1 && (!*view || *component < 0))
        return choose_component(around, views->dimension);
    if (!*view)
        return error_new(ERROR_INPUT, "\"%s\": %s has no components", field, whole);
    if (*component < 0)
        *component = 0;
    return NULL;
}

void view_read(const struct view *view, int64_t begin, int64_t end, double *out)
{
    if (view->compute)
        view->compute(view->context, begin, end, out);
    else if (end > begin)
        memcpy(out, view->data + begin * view->components,
               (size_t)(end - begin) * (size_t)view->components * sizeof *out);
}

void view_read_component(const struct view *view, int component, int64_t begin, int64_t end,
                         double *out)
{
    assert(component < view->components && (component >= 0 || view->components == 1));
    if (view->components == 1) {
        view_read(view, begin, end, out);
        return;
    }
    double chunk[CHUNK * COMPONENTS_MAX];
    for (int64_t from = begin; from < end; from += CHUNK) {
        const int64_t to = from + CHUNK < end ? from + CHUNK : end;
        view_read(view, from, to, chunk);
        for (int64_t i = from; i < to; i++)
            out[i - begin] = chunk[(i - from) * view->components + component];
    }
}
