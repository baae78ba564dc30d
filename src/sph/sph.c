/* The SPH solver as the run loop sees it. What a step does is the scheme's; around it are neighbour
 * lists, conduction and bodies with prescribed motion. Source: Parshikov (2013), sections 1.2 to
 * 1.5. */
#include "sph/sph.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/memory.h"
#include "material/any.h"
#include "model/boundaries.h"
#include "model/generate.h"
#include "model/particles/fill.h"
#include "riemann/shock_slope.h"
#include "sph/conduction/kernel.h"
#include "sph/scheme.h"

/* Cells are this much wider than the support at the start, so that a little growth of the particles
 * does not put them on the next level of cells, twice as wide. */
static const double growth_room = 1.08;

static bool has_walls(const struct simulation *simulation)
{
    for (int axis = 0; axis < 3; axis++)
        if (!images_repeat(&simulation->problem->images, axis) &&
            (!isnan(simulation->problem->images.low[axis]) ||
             !isnan(simulation->problem->images.high[axis])))
            return true;
    return false;
}

bool sph_has_laws(const struct simulation *simulation)
{
    for (int a = 0; a < CONTACT_GROUPS; a++)
        for (int b = 0; b < CONTACT_GROUPS; b++)
            if (simulation->problem->law[a][b])
                return true;
    return false;
}

struct error *sph_option_error(const struct sph *sph, const struct simulation_case *input,
                               const char *key, const char *format, ...)
{
    char path[128], text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    snprintf(path, sizeof path, "sph.method.%s.%s", sph->scheme->name, key);
    return input_error(input, "solver", path, "%s", text);
}

struct error *sph_find_slopes(const struct simulation *simulation, double *slope)
{
    struct error *error = NULL;
    for (int m = 0; m < simulation->problem->materials; m++) {
        slope[m] = riemann_shock_slope(&simulation->problem->material[m]);
        if (isnan(slope[m]))
            error = error_join(
                error, input_error(simulation->problem->input, "materials",
                                   simulation->problem->input->materials.names[m],
                                   "its shock adiabat has no slope, since its equation of state "
                                   "has no sound at its reference density without energy"));
    }
    return error;
}

/* PARAMETERS with the defaults of their scheme. */
static struct sph_parameters settled(const struct sph_parameters *parameters, int dimension)
{
    const struct sph_scheme *scheme = parameters->method.choice->thing;
    struct sph_parameters all = *parameters;
    if (isnan(all.smoothing))
        all.smoothing = scheme->smoothing[dimension - 1];
    if (isnan(all.courant))
        all.courant = scheme->courant;
    return all;
}

/* What follows from the case and the options of its scheme. */
static unsigned traits_of(const struct sph *sph, const struct simulation *simulation)
{
    unsigned traits =
        sph->scheme->traits(sph->parameters.method.value, simulation->problem->dimension);
    struct field_declaration history[POINT_HISTORY];
    bool strong = false, fails = false, spreads = false;
    for (int m = 0; m < simulation->problem->materials; m++) {
        strong |= material_has_strength(&simulation->problem->material[m]);
        fails |= material_breaks(&simulation->problem->material[m]);
        spreads |= strength_spreads(&simulation->problem->material[m].strength);
    }
    traits |= has_walls(simulation) ? SPH_WALLS : 0u;
    traits |= images_periodic(&simulation->problem->images) ? SPH_PERIODIC : 0u;
    traits |= sph_axisymmetric(simulation) ? SPH_AXISYMMETRIC : 0u;
    traits |= simulation->problem->geometry == GEOMETRY_PLANE_STRESS ? SPH_THIN : 0u;
    traits |= simulation->problem->dimension > 1 ? SPH_PLANE : 0u;
    traits |= strong && simulation->problem->dimension > 1 ? SPH_SHEAR : 0u;
    traits |= spreads ? SPH_SPREADS : 0u;
    traits |= fails && sph->scheme->breaks ? SPH_BREAKS : 0u;
    traits |= simulation->problem->input->bodies.count > 1 ? SPH_BODIES : 0u;
    traits |= problem_history(simulation->problem, history) > 0 ? SPH_HISTORY : 0u;
    return traits | (conduction_on(&sph->parameters) ? SPH_CONDUCTION : 0u);
}

/* An image of an image along one axis does not exist, so it must lie beyond reach: it is as far
 * from a particle as the gap of the two walls and, on a lattice, a diameter. */
static struct error *check_walls(const struct simulation *simulation, double reach)
{
    for (int axis = 0; axis < simulation->problem->dimension; axis++) {
        double gap = simulation->problem->images.high[axis] - simulation->problem->images.low[axis];
        if (gap < reach && !images_repeat(&simulation->problem->images, axis))
            return input_error(simulation->problem->input, "boundaries", NULL,
                               "the two walls across %c are %.4g m apart; with this smoothing and "
                               "resolution they must be %.4g m apart at least",
                               "xyz"[axis], gap, reach);
    }
    return NULL;
}

static struct error *create_store(struct sph *sph, struct simulation *simulation)
{
    struct field_declaration fields[POINT_HISTORY + SPH_FIELDS_MAX];
    const struct sph_parameters *parameters = &sph->parameters;
    int count = problem_history(simulation->problem, fields);
    count += sph_declare_fields(sph->scheme, sph->traits, simulation->problem->dimension,
                                fields + count);
    double diameter = largest_diameter(simulation->problem->input);
    double support = 2.0 * parameters->smoothing * diameter;
    TRY(check_walls(simulation, support - (1.0 + 1e-9) * diameter));
    TRY(sph_check_periods(simulation, support));
    double cell = growth_room * support * (1.0 + parameters->skin);
    return particles_add(simulation, cell, fields, count, &sph->particles);
}

static struct error *sph_create(void *solver, struct simulation *simulation, const void *parameters)
{
    struct sph *sph = solver;
    sph->parameters = settled(parameters, simulation->problem->dimension);
    sph->scheme = sph->parameters.method.choice->thing;
    sph->traits = traits_of(sph, simulation);
    sph->neighbours.skin = sph->parameters.skin;
    sph->neighbours.near_skin = sph_near_skin(&sph->parameters, sph->traits);
    sph->groups =
        (struct contact_groups){simulation->problem->group_of_body, &simulation->problem->law[0][0],
                                sph_has_laws(simulation) ? CONTACT_GROUPS : 1, NULL};
    sph->bodies = simulation->problem->input->bodies.count;
    if (sph->scheme->touches && sph_has(sph, SPH_BODIES)) {
        sph->cluster = memory_allocate((size_t)sph->bodies * sizeof *sph->cluster);
        if (!sph->cluster)
            return out_of_memory();
    }
    sph->state = calloc(1, sph->scheme->state_size);
    if (!sph->state)
        return out_of_memory();
    TRY(sph->scheme->create(sph, simulation));
    TRY(conduction_create(sph, simulation));
    spread_create(sph, simulation);
    TRY(sph_create_loads(sph, simulation));
    return create_store(sph, simulation);
}

static struct error *sph_fill(void *solver, struct simulation *simulation)
{
    const struct sph *sph = solver;
    return generate_particles(simulation, sph->particles);
}

static struct error *sph_start(void *solver, struct simulation *simulation)
{
    const struct sph *sph = solver;
    if (sph_has(sph, SPH_PERIODIC))
        sph_wrap(simulation, sph->particles);
    sph->scheme->start(sph, simulation);
    return NULL;
}

static struct error *sph_prepare(void *solver, struct simulation *simulation, struct limit *limit)
{
    struct sph *sph = solver;
    bool rebuilt;
    stop_bodies(simulation, sph->particles);
    TRY(sph_refresh_lists(sph, simulation, &rebuilt));
    if (simulation->step == 0 && sph->cluster)
        TRY(sph_find_clusters(sph, simulation));
    if (rebuilt) {
        struct error *error = sph_has(sph, SPH_CONDUCTION) ? conduction_reserve(sph) : NULL;
        if (!error && sph_has(sph, SPH_SPREADS))
            error = spread_reserve(sph);
        if (!error && sph->scheme->rebuilt)
            error = sph->scheme->rebuilt(sph, simulation);
        TRY(ranks_agree(simulation->ranks, error));
    }
    *limit = limit_of_nothing();
    if (!sph_has(sph, SPH_STILL))
        sph->scheme->prepare(sph, simulation, limit);
    if (sph_has(sph, SPH_CONDUCTION)) {
        const struct sph_fields fields = sph_fields_of(sph, simulation);
        conduction_prepare(sph, simulation, &fields, limit);
    }
    if (sph_has(sph, SPH_SPREADS)) {
        const struct sph_fields fields = sph_fields_of(sph, simulation);
        spread_prepare(sph, simulation, &fields);
    }
    limit->event = next_event(simulation);
    return NULL;
}

static struct error *sph_advance(void *solver, struct simulation *simulation, double dt)
{
    struct sph *sph = solver;
    sph->steps_since_build++;
    struct error *error = sph->scheme->advance(sph, simulation, dt);
    error = error_join(error, drive_bodies(simulation, sph->particles, dt));
    if (sph_has(sph, SPH_PERIODIC))
        sph_wrap(simulation, sph->particles);
    return error;
}

static struct error *sph_state(void *solver, struct visitor *visitor)
{
    struct sph *sph = solver;
    return sph->cluster
               ? visitor->visit(visitor, "sph/cluster", NUMBER_UINT16, sph->cluster, sph->bodies, 1)
               : NULL;
}

/* A cluster is known by its first body. Bodies that BEFORE has not are each one by itself. */
static void sph_carry(void *solver, const void *before, const int *body)
{
    struct sph *sph = solver;
    const struct sph *from = before;
    for (int b = 0; b < sph->bodies && sph->cluster; b++)
        sph->cluster[b] = (uint16_t)b;
    for (int b = 0; b < from->bodies && sph->cluster && from->cluster; b++)
        for (int other = 0; other < b && body[b] >= 0; other++)
            if (body[other] >= 0 && from->cluster[other] == from->cluster[b]) {
                sph->cluster[body[b]] = sph->cluster[body[other]];
                break;
            }
}

static void sph_destroy(void *solver)
{
    struct sph *sph = solver;
    neighbours_free(&sph->neighbours);
    conduction_destroy(sph);
    spread_destroy(sph);
    sph_free_loads(sph);
    if (sph->state && sph->scheme->destroy)
        sph->scheme->destroy(sph);
    free(sph->state);
    free(sph->place);
    free(sph->cluster);
    particles_drop(sph->particles);
}

/* Of a solid without walls. */
static double sph_bytes(const void *parameters, int dimension)
{
    const struct sph_parameters all = settled(parameters, dimension);
    const struct sph_scheme *scheme = all.method.choice->thing;
    const unsigned traits = scheme->traits(all.method.value, dimension) |
                            (dimension > 1 ? SPH_PLANE | SPH_SHEAR : 0u) |
                            (conduction_on(&all) ? SPH_CONDUCTION : 0u);
    struct field_declaration fields[SPH_FIELDS_MAX];
    const int count = sph_declare_fields(scheme, traits, dimension, fields);
    struct particles store;
    error_free(particles_create(dimension, 1.0, fields, count, &store));
    double bytes = (double)particles_bytes(&store);
    particles_destroy(&store);
    /* Neighbours on a regular lattice: the volume of the support, skin included. */
    double reach = 2.0 * all.smoothing * (1.0 + all.skin);
    double neighbours = dimension == 1   ? 2.0 * reach
                        : dimension == 2 ? 3.14159 * square(reach)
                                         : 4.18879 * reach * square(reach);
    double lists = sizeof(struct row) + 1.25 * neighbours * sizeof(uint32_t);
    const double near_skin = sph_near_skin(&all, traits);
    if (near_skin > 0.0)
        lists +=
            4 * sizeof(double) + sizeof(struct near_row) +
            neighbours * pow((1.0 + near_skin) / (1.0 + all.skin), dimension) * sizeof(uint32_t);
    const size_t numbers =
        scheme->stride(all.method.value, dimension) + 4 + (conduction_on(&all) ? HEAT_STRIDE : 0);
    return bytes + (double)(numbers * sizeof(double)) + lists;
}

static double sph_step(const void *parameters, const struct simulation_case *input,
                       const struct material *material, const struct point *point, double diameter)
{
    const int dimension = (int)input->dimension;
    const struct sph_parameters all = settled(parameters, dimension);
    const struct sph_scheme *scheme = all.method.choice->thing;
    struct point at = *point;
    const double heat = conduction_step(&all, dimension, &material->heat, point->density, diameter);
    if (scheme->traits(all.method.value, dimension) & SPH_STILL)
        return heat;
    if (scheme->wide_step)
        diameter *= all.smoothing;
    return minimum(heat, all.courant * diameter / any_material_evaluate(material, &at).sound_long);
}

/* What no scheme can do, or the one of the case cannot. */
static void refuse(const struct sph *sph, const struct simulation *simulation,
                   struct findings *findings)
{
    const struct simulation_case *input = findings->input;
    const struct sph_scheme *scheme = sph->scheme;
    sph_refuse(simulation, findings);
    if (sph->parameters.courant > scheme->courant_limit)
        finding_add(findings, FINDING_WRONG, "solver", "sph.courant",
                    "%s is stable up to %g: give less, or another method", scheme->name,
                    scheme->courant_limit);
    if (conduction_on(&sph->parameters) && !scheme->conducts)
        finding_add(findings, FINDING_WRONG, "solver", "sph.conduction",
                    "%s does not conduct heat: use another method", scheme->name);
    if (sph_has(sph, SPH_STILL) && !sph_has(sph, SPH_CONDUCTION))
        findings_take(findings, FINDING_WRONG,
                      sph_option_error(sph, input, "motion",
                                       "nothing happens without motion unless heat is conducted: "
                                       "give `conduction` as well"));
    if (!scheme->breaks)
        refuse_broken_contacts(simulation->problem, findings);
    if (!scheme->stands)
        refuse_standing_spall(simulation->problem, findings);
    for (int m = 0; sph_has(sph, SPH_THIN) && m < simulation->problem->materials; m++)
        if (!material_has_strength(&simulation->problem->material[m]))
            finding_add(findings, FINDING_WRONG, "materials", input->materials.names[m],
                        "plane stress is for plates that have strength, and this is a fluid");
}

static bool loses_always(const struct material *material)
{
    (void)material;
    return true;
}

static void sph_judge(const void *parameters, const struct simulation *simulation,
                      struct judgement *judgement)
{
    struct sph sph = {.parameters = settled(parameters, simulation->problem->dimension)};
    const void *options = sph.parameters.method.value;
    const struct sph_scheme *scheme = sph.scheme = sph.parameters.method.choice->thing;
    boundaries_refuse_of_particles(&judgement->findings, sph_class.boundaries);
    sph.traits = traits_of(&sph, simulation);
    refuse(&sph, simulation, &judgement->findings);
    sph_judge_masses(parameters, &judgement->findings);
    if (scheme->largest_jump)
        judgement->largest_jump = scheme->largest_jump(options);
    judgement->energy_lost = scheme->energy_lost ? scheme->energy_lost(options) : NULL;
    if (strcmp(scheme->name, "muscl") != 0)
        judgement->instead =
            "this method is here for comparison and stops in strong shocks and in large "
            "expansions: leave `method` out for the default, muscl, which holds there";
    judgement->loses_tension = scheme->loses_tension ? scheme->loses_tension : loses_always;
}

const struct solver_class sph_class = {.size = sizeof(struct sph),
                                       .removes = true,
                                       .boundaries = BOUNDARIES_CLOSED | 1u << BOUNDARY_PERIODIC,
                                       .create = sph_create,
                                       .fill = sph_fill,
                                       .start = sph_start,
                                       .prepare = sph_prepare,
                                       .advance = sph_advance,
                                       .state = sph_state,
                                       .carry = sph_carry,
                                       .destroy = sph_destroy,
                                       .bytes = sph_bytes,
                                       .step = sph_step,
                                       .judge = sph_judge,
                                       .fields = sph_field_tables};
