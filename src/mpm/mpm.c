/* The material point method as the run loop sees it: its fields, its parts from create to
 * destroy, and the forecast of `bolide check`. The step itself is in step.c. */
#include "mpm/mpm.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "material/any.h"
#include "material/material.h"
#include "model/particles/fill.h"
#include "model/particles/population.h"
#include "mpm/mpm_internal.h"

/* Conditions of the fields. */
enum {
    MPM_AFFINE = 1,
    MPM_CONSERVES = 2,
    MPM_FILTERS = 4,
    MPM_MIXES = 8,
    MPM_GAUGED = 16,
    MPM_SPREADS = 32
};

static const struct field_row field_rows[] = {
    {.field = {"sound_long", "m/s", "longitudinal sound speed", NUMBER_DOUBLE, 1, FIELD_DERIVED},
     .offset = offsetof(struct mpm_fields, sound_long)},
    {.field = {"viscosity", "Pa", "artificial viscous pressure", NUMBER_DOUBLE, 1, FIELD_STATE},
     .offset = offsetof(struct mpm_fields, viscosity)},
    {.field = {"velocity_gradient", NULL, "gradient of velocity", NUMBER_DOUBLE, 9, FIELD_STATE},
     .when = MPM_AFFINE,
     .where = "transfer: apic or tpic",
     .offset = offsetof(struct mpm_fields, velocity_gradient)},
    {.field = {"state_energy", "J/kg", "energy at the time of the pressure, half a step ahead",
               NUMBER_DOUBLE, 1, FIELD_STATE},
     .when = MPM_CONSERVES,
     .where = "transfer: flip",
     .offset = offsetof(struct mpm_fields, at_state)},
    {.field = {"shock", NULL, "how much of a shock it is in, 0 to 1", NUMBER_DOUBLE, 1,
               FIELD_STATE | FIELD_FRACTION},
     .when = MPM_MIXES,
     .where = "shock_mixing",
     .offset = offsetof(struct mpm_fields, shock)},
    {.field = {"divergence", "1/s", "divergence of the velocity, before the filter", NUMBER_DOUBLE,
               1, FIELD_STATE},
     .when = MPM_FILTERS,
     .where = "viscosity_unresolved",
     .offset = offsetof(struct mpm_fields, divergence)},
    {.field = {"ambient_work", "J/kg", "work of the ambient pressure in the last step",
               NUMBER_DOUBLE, 1, FIELD_DERIVED},
     .when = MPM_GAUGED,
     .where = "gauge_pressure",
     .offset = offsetof(struct mpm_fields, ambient)},
    {.field = {"damage_gradient", NULL, "gradient of damage that spreads", NUMBER_DOUBLE, 1,
               FIELD_PASSING},
     .when = MPM_SPREADS,
     .offset = offsetof(struct mpm_fields, damage_gradient)},
    FIELD_ROWS_END,
};
enum { MPM_FIELDS = COUNT_OF(field_rows) - 1 };

static struct field_needs needs_of(const struct mpm_parameters *parameters, bool spreads)
{
    unsigned conditions = spreads ? MPM_SPREADS : 0;
    if (parameters->transfer != MPM_FLIP)
        conditions |= MPM_AFFINE;
    if (mpm_conserves(parameters))
        conditions |= MPM_CONSERVES;
    if (parameters->viscosity_unresolved > 0.0)
        conditions |= MPM_FILTERS;
    if (parameters->shock_mixing > 0.0)
        conditions |= MPM_MIXES;
    if (mpm_conserves(parameters) && parameters->gauge_pressure != 0.0)
        conditions |= MPM_GAUGED;
    return (struct field_needs){.conditions = conditions};
}

struct mpm_fields mpm_fields_of(const struct mpm *mpm)
{
    const struct field_needs needs = needs_of(&mpm->parameters, mpm->spreads);
    struct mpm_fields fields;
    field_rows_bind(field_rows, &needs, mpm->particles, &fields);
    return fields;
}

static void start_layers(struct mpm *mpm, const struct simulation *simulation)
{
    for (int g = 0; g < mpm->layers; g++) {
        grid_start(&mpm->layer[g].grid, simulation->problem->dimension,
                   mpm_window(mpm, simulation));
        mpm->layer[g].main.stride = NODE_STRIDE;
        mpm->layer[g].back.stride = BACK_STRIDE;
        mpm->layer[g].normal.stride = BACK_STRIDE;
        mpm->layer[g].stress.stride = FACE_STRIDE * simulation->problem->dimension;
        mpm->layer[g].fill.stride = FILL_STRIDE;
    }
}

static struct error *mpm_create(void *solver, struct simulation *simulation, const void *parameters)
{
    struct mpm *mpm = solver;
    mpm->parameters = mpm_settled(parameters, simulation);
    mpm->spreads = mpm_any_spreads(simulation);
    mpm->edge = mpm->parameters.cell;
    TRY(error_join(mpm_note_bodies(mpm, parameters, simulation), mpm_find_planes(mpm, simulation)));
    TRY(mpm_share_layers(mpm, simulation));
    start_layers(mpm, simulation);
    mpm_note_mixtures(mpm, simulation);
    mpm_note_surfaces(mpm);
    struct field_declaration fields[POINT_HISTORY + MPM_FIELDS];
    const struct field_needs needs = needs_of(&mpm->parameters, mpm->spreads);
    int count = problem_history(simulation->problem, fields);
    count += field_rows_declare(field_rows, &needs, fields + count);
    TRY(particles_add(simulation, mpm->edge, fields, count, &mpm->particles));
    if (mpm_window(mpm, simulation).centred)
        mpm->particles->shift = 0.5 * mpm->edge;
    return loads_create(simulation, &mpm->loads);
}

static struct error *mpm_fill(void *solver, struct simulation *simulation)
{
    const struct mpm *mpm = solver;
    return generate_particles(simulation, mpm->particles);
}

static struct error *mpm_start(void *solver, struct simulation *simulation)
{
    struct mpm *mpm = solver;
    mpm->threads = simulation->threads;
    mpm->rate = memory_allocate((size_t)mpm->threads * sizeof *mpm->rate);
    if (!mpm->rate)
        return out_of_memory();
    if (!mpm->particles->blocks) /* as they are when loaded */
        TRY(particles_sort(mpm->particles));
    if (mpm_is_affine(mpm) && simulation->step == 0)
        mpm_start_gradients(mpm, simulation);
    const struct mpm_fields fields = mpm_fields_of(mpm);
    if (fields.at_state && simulation->step == 0)
        memcpy(fields.at_state, mpm->particles->energy,
               (size_t)mpm->particles->count * sizeof *fields.at_state);
    mpm_evaluate(mpm, simulation);
    return NULL;
}

static struct error *mpm_state(void *solver, struct visitor *visitor)
{
    struct mpm *mpm = solver;
    return visitor->visit(visitor, "mpm/limit", NUMBER_DOUBLE, &mpm->limit_before, 1, 1);
}

static void mpm_carry(void *solver, const void *before, const int *body)
{
    (void)body;
    ((struct mpm *)solver)->limit_before = ((const struct mpm *)before)->limit_before;
}

static void mpm_destroy(void *solver)
{
    struct mpm *mpm = solver;
    for (int t = 0; t < mpm->threads && mpm->rate; t++)
        free(mpm->rate[t]);
    free(mpm->rate);
    particles_drop(mpm->particles);
    free(mpm->half_size);
    free(mpm->gauge);
    free(mpm->reaction);
    free(mpm->courant);
    free(mpm->balances_of);
    free(mpm->given);
    free(mpm->layer_of_body);
    free(mpm->layer_at_rest);
    free(mpm->block);
    free(mpm->leaving);
    bins_free(&mpm->bins);
    mpm_free_halo(mpm);
    loads_free(&mpm->loads);
    for (int g = 0; g < mpm->layers; g++) {
        struct layer *layer = &mpm->layer[g];
        free(layer->wall);
        free(layer->meets);
        free(layer->shocked);
        for (int cause = 0; cause < SURFACE_CAUSES; cause++)
            free(layer->pushed[cause]);
        mpm_free_order(layer);
        grid_free(&layer->grid);
        grid_field_free(&layer->main);
        grid_field_free(&layer->back);
        grid_field_free(&layer->normal);
        grid_field_free(&layer->stress);
        grid_field_free(&layer->fill);
    }
}

double mpm_bytes(const void *parameters, int dimension)
{
    const struct mpm_parameters *of = parameters;
    struct mpm_parameters most = *of; /* what is left to the method may need its fields */
    most.shock_mixing = isnan(of->shock_mixing) ? 1.0 : of->shock_mixing;
    most.viscosity_unresolved = isnan(of->viscosity_unresolved) ? 1.0 : of->viscosity_unresolved;
    const struct field_needs needs = needs_of(&most, false);
    struct field_declaration declared[MPM_FIELDS];
    struct particles store;
    error_free(particles_create(dimension, 1.0, declared,
                                field_rows_declare(field_rows, &needs, declared), &store));
    const double fields = (double)particles_bytes(&store);
    particles_destroy(&store);
    /* Blocks full of cells of two particles an axis. */
    struct grid grid;
    grid_start(&grid, dimension, shape_window_of((enum grid_shape)of->shape, false));
    const bool faces = of->quadrature == MPM_FACES && mpm_conserves(of) && of->shape != SHAPE_GIMP;
    const int stride = NODE_STRIDE + BACK_STRIDE + (of->order > 1 ? 2 * NODE_STRIDE : 0) +
                       (faces ? FILL_STRIDE : 0);
    const double numbers = stride * (double)(BLOCK_CELLS + grid.patch) +
                           (faces ? FACE_STRIDE * dimension * (double)grid.patch : 0.0);
    const double particles = BLOCK_CELLS * pow(2.0, dimension);
    return fields + (double)particles_sort_bytes() + sizeof(int32_t) + 2.0 +
           numbers * sizeof(double) / particles;
}

static double step_of(const struct mpm_parameters *of, double courant,
                      const struct material *material, const struct point *point, double diameter)
{
    struct point at = *point;
    const double edge = isnan(of->cell) ? 2.0 * diameter : of->cell;
    return courant * edge / any_material_evaluate(material, &at).sound_long;
}

/* One fluid among the materials sets the Courant number of all, as in mpm_settled. */
static double mpm_step(const void *parameters, const struct simulation_case *input,
                       const struct material *material, const struct point *point, double diameter)
{
    bool fluid = false;
    for (int m = 0; m < input->materials.count; m++)
        fluid |= !material_has_strength(case_material(input, m)->material);
    return step_of(parameters, mpm_courant(parameters, fluid), material, point, diameter);
}

double mpm_step_beside_gas(const void *parameters, const struct simulation_case *input,
                           const struct material *material, const struct point *point,
                           double diameter)
{
    const bool fluid = !material_has_strength(material);
    (void)input;
    return step_of(parameters, mpm_courant_beside_gas(parameters, fluid), material, point,
                   diameter);
}

void mpm_coarsen(void *parameters, double factor)
{
    struct mpm_parameters *of = parameters;
    of->cell *= factor;
}

static const struct field_row *const field_tables[] = {field_rows, NULL};

const struct solver_class mpm_class = {.size = sizeof(struct mpm),
                                       .removes = true,
                                       .boundaries = BOUNDARIES_CLOSED | 1u << BOUNDARY_OUTFLOW,
                                       .create = mpm_create,
                                       .fill = mpm_fill,
                                       .start = mpm_start,
                                       .prepare = mpm_prepare,
                                       .advance = mpm_advance,
                                       .state = mpm_state,
                                       .carry = mpm_carry,
                                       .destroy = mpm_destroy,
                                       .bytes = mpm_bytes,
                                       .step = mpm_step,
                                       .coarsen = mpm_coarsen,
                                       .judge = mpm_judge,
                                       .fields = field_tables};
