/* Bodies of a case as MPM uses them: layers, prescribed motion, and gravity and the hoop stress in
 * the ledger. */
#include <string.h>

#include "base/memory.h"
#include "material/any.h"
#include "material/material.h"
#include "model/generate.h"
#include "model/particles/held.h"
#include "mpm/mpm_internal.h"

/* The layer of a contact group for bodies with prescribed motion or without, or that of one frozen
 * body; created if it does not exist yet. BIN_GROUPS when there are too many. */
static int layer_for(struct mpm *mpm, const struct simulation *simulation, int body,
                     bool prescribed)
{
    const bool frozen = body_is_frozen(simulation, body);
    const int group = simulation->problem->group_of_body[body];
    int g = 0;
    while (g < mpm->layers && (frozen || mpm->layer[g].frozen || mpm->layer[g].group != group ||
                               mpm->layer[g].prescribed != prescribed))
        g++;
    if (g == mpm->layers && g < BIN_GROUPS)
        mpm->layer[mpm->layers++] =
            (struct layer){.group = group, .prescribed = prescribed, .frozen = frozen};
    return g;
}

/* The wave speed in a frozen body at the start. */
static void note_sound(struct layer *layer, const struct simulation *simulation, int body)
{
    const struct body_input *input = case_body(simulation->problem->input, body);
    const struct material *material = &simulation->problem->material[input->material_index];
    struct point point = input->start;
    if (input->varies)
        point = (struct point){.density = material_density(material)};
    const struct response response = any_material_evaluate(material, &point);
    layer->sound_long = response.sound_long;
    layer->sound_shear = response.sound_shear;
}

struct error *mpm_share_layers(struct mpm *mpm, const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    static_assert((int)CONTACT_GROUPS == (int)BIN_GROUPS, "a layer for each contact group");
    mpm->layer_of_body = memory_allocate((size_t)input->bodies.count);
    mpm->layer_at_rest = memory_allocate((size_t)input->bodies.count);
    if (!mpm->layer_of_body || !mpm->layer_at_rest)
        return out_of_memory();
    for (int b = 0; b < input->bodies.count; b++) {
        const struct body_input *body = case_body(input, b);
        const bool prescribed = body->driven || body->frozen || body->stop <= 0.0;
        const int own = layer_for(mpm, simulation, b, prescribed),
                  rest = isnan(body->stop) ? own : layer_for(mpm, simulation, b, true);
        if (own == BIN_GROUPS || rest == BIN_GROUPS)
            return input_error(input, "bodies", input->bodies.names[b],
                               "the solver mpm tells %d kinds of bodies apart, by contacts and by "
                               "how they are prescribed, and this is one more",
                               (int)BIN_GROUPS);
        mpm->layer_of_body[b] = (uint8_t)own;
        mpm->layer_at_rest[b] = (uint8_t)rest;
        if (body->frozen)
            note_sound(&mpm->layer[own], simulation, b);
    }
    return NULL;
}

void mpm_stop_bodies(struct mpm *mpm, struct simulation *simulation)
{
    stop_bodies(simulation, mpm->particles);
    for (int b = 0; b < simulation->problem->input->bodies.count; b++)
        if (body_stands(simulation, b))
            mpm->layer_of_body[b] = mpm->layer_at_rest[b];
}

void mpm_move_prescribed(const struct mpm *mpm, const struct simulation *simulation, double dt)
{
    const struct particles *p = mpm->particles;
    if (!any_body(simulation, body_is_prescribed))
        return;
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
    for (int32_t i = 0; i < p->count; i++) {
        if (!body_is_prescribed(simulation, p->body[i]))
            continue;
        for (int k = 0; k < simulation->problem->dimension; k++)
            p->position[i][k] += dt * p->velocity[i][k];
        mpm_keep_before_walls(simulation, p->position[i]);
    }
}

/* The density below which the mass of a node is too small for its velocity to be used. */
static double least_density(const struct simulation *simulation)
{
    double least = INFINITY;
    for (int b = 0; b < simulation->problem->input->bodies.count; b++) {
        const struct body_input *body = case_body(simulation->problem->input, b);
        least = minimum(least,
                        body->varies
                            ? material_density(&simulation->problem->material[body->material_index])
                            : body->start.density);
    }
    return least;
}

struct error *mpm_note_bodies(struct mpm *mpm, const struct mpm_parameters *given,
                              const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    mpm->half_size = memory_allocate((size_t)input->bodies.count * sizeof *mpm->half_size);
    mpm->gauge = memory_allocate((size_t)simulation->problem->materials * sizeof *mpm->gauge);
    mpm->reaction = memory_allocate((size_t)simulation->problem->materials * sizeof *mpm->reaction);
    mpm->courant = memory_allocate((size_t)simulation->problem->materials * sizeof *mpm->courant);
    mpm->balances_of =
        memory_allocate((size_t)simulation->problem->materials * sizeof *mpm->balances_of);
    if (!mpm->half_size || !mpm->gauge || !mpm->reaction || !mpm->courant || !mpm->balances_of)
        return out_of_memory();
    struct error *error = NULL;
    for (int m = 0; m < simulation->problem->materials; m++) {
        const struct material *material = &simulation->problem->material[m];
        mpm->reaction[m] = material_reaction_heat(material);
        mpm->balances_of[m] = mpm_balances(material);
        mpm->courant[m] = mpm_courant_beside_gas(given, !material_has_strength(material));
        if (!material_has_strength(material))
            mpm->gauge[m] = mpm->parameters.gauge_pressure;
    }
    for (int b = 0; b < input->bodies.count; b++) {
        const double size = diameter_of_volume(place_lattice(&simulation->problem->place, b).volume,
                                               simulation->problem->dimension);
        mpm->half_size[b] = 0.5 * size / mpm->edge;
        if (mpm->half_size[b] > 0.5 * (1.0 + 1e-6))
            error = error_join(error,
                               input_error(input, "bodies", input->bodies.names[b],
                                           "particles of %.4g m are wider than a cell of %.4g m: "
                                           "choose a larger `cell` of the solver mpm",
                                           size, mpm->edge));
        mpm->half_size[b] = minimum(mpm->half_size[b], 0.5);
    }
    mpm->least_mass =
        1e-6 * least_density(simulation) * pow(mpm->edge, simulation->problem->dimension);
    if (simulation->problem->geometry == GEOMETRY_AXISYMMETRIC) /* a cell at the axis, per radian */
        mpm->least_mass *= 0.5 * mpm->edge;
    return error;
}

/* A part of a step. */
struct weight {
    double dt;
    bool begin;
};

/* Work is computed with the mean velocity of the step, so that free fall conserves energy to
 * rounding. */
static void book_weight(const struct simulation *simulation, const struct particles *p,
                        const void *of, int32_t i, struct ledger *ledger)
{
    const struct weight *weight = of;
    const struct vec3 impulse =
        vec3_scale(weight->dt * p->mass[i], vector_at(simulation->problem->gravity));
    ledger_book(ledger, LEDGER_GRAVITY, 0.0, weight->begin ? impulse : vec3_make(0.0, 0.0, 0.0),
                vector_at(p->position[i]), 0.5 * vec3_dot(impulse, vector_at(p->velocity[i])));
}

void mpm_book_gravity(const struct mpm *mpm, struct simulation *simulation, double dt, bool begin)
{
    act_on_particles(simulation, mpm->particles, body_is_heavy, book_weight,
                     &(struct weight){dt, begin});
}

/* A step, and pressures of materials and particles. */
struct hoop {
    const double *gauge, *viscosity;
    double dt;
};

static bool is_free(const struct simulation *simulation, int body)
{
    return !body_is_prescribed(simulation, body);
}

/* Shape functions sum to one, those around the axis too. */
static void book_hoop(const struct simulation *simulation, const struct particles *p,
                      const void *of, int32_t i, struct ledger *ledger)
{
    (void)simulation;
    const struct hoop *hoop = of;
    const double stress =
        p->deviator[i][2] - p->pressure[i] - hoop->viscosity[i] + hoop->gauge[p->material[i]];
    const double force = -p->mass[i] / p->density[i] * stress / p->position[i][0];
    ledger_book(ledger, LEDGER_AXIS, 0.0, vec3_make(hoop->dt * force, 0.0, 0.0),
                vector_at(p->position[i]), 0.0);
}

static void book_ambient(const struct simulation *simulation, const struct particles *p,
                         const void *of, int32_t i, struct ledger *ledger)
{
    (void)simulation;
    const struct vec3 none = vec3_make(0.0, 0.0, 0.0);
    ledger_book(ledger, LEDGER_LOADS, 0.0, none, none, p->mass[i] * ((const double *)of)[i]);
}

void mpm_book_ambient(const struct mpm *mpm, struct simulation *simulation)
{
    const double *ambient = mpm_fields_of(mpm).ambient;
    if (ambient)
        act_on_particles(simulation, mpm->particles, is_free, book_ambient, ambient);
}

/* Near the axis the hoop weights may reach nodes without mass; their forces are dropped. */
static void unbook_lost(const struct mpm *mpm, const struct layer *layer, int32_t block, double dt,
                        struct ledger *ledger)
{
    int64_t corner[3], at[3];
    grid_corner(&layer->grid, block, corner);
    for (int k = 0; k < BLOCK_CELLS; k++) {
        const double *node = grid_node(&layer->main, block, k);
        if (node[NODE_MASS] > 0.0 || node[NODE_FORCE] == 0.0)
            continue;
        mpm_node_index(layer->grid.dimension, corner, k, at);
        ledger_book(ledger, LEDGER_AXIS, 0.0, vec3_make(-dt * node[NODE_FORCE], 0.0, 0.0),
                    vec3_scale(mpm->edge, vec3_make((double)at[0], (double)at[1], 0.0)), 0.0);
    }
}

/* With stresses on faces: the forces on the nodes that the particles of bin BIN reach. */
static void book_ring(const struct mpm *mpm, const struct layer *layer, int32_t bin, double dt,
                      struct ledger *ledger)
{
    const double *stress = grid_patch(&layer->grid, &layer->stress, bin),
                 *fill = grid_patch(&layer->grid, &layer->fill, bin);
    int64_t corner[3];
    block_coordinates(layer->bins.bin[bin].key, corner);
    for (int n = 0; n < layer->grid.patch; n++) {
        const double push =
            stress[n * 2 * FACE_STRIDE + FACE_HOOP] * fill[n * FILL_STRIDE + FILL_RING];
        const int64_t first = -layer->grid.reach, cells = block_cells(2),
                      x = corner[0] * cells + first + n / layer->grid.side,
                      y = corner[1] * cells + first + n % layer->grid.side;
        if (push != 0.0)
            ledger_book(ledger, LEDGER_AXIS, 0.0, vec3_make(dt * push, 0.0, 0.0),
                        vec3_scale(mpm->edge, vec3_make((double)x, (double)y, 0.0)), 0.0);
    }
}

void mpm_book_hoop(const struct mpm *mpm, struct simulation *simulation, double dt)
{
    if (simulation->problem->geometry != GEOMETRY_AXISYMMETRIC)
        return;
    const struct hoop hoop = {mpm->gauge, mpm_fields_of(mpm).viscosity, dt};
    const bool by_faces = mpm_is_by_faces(&mpm->parameters);
    if (!by_faces)
        act_on_particles(simulation, mpm->particles, is_free, book_hoop, &hoop);
    for (int g = 0; g < mpm->layers; g++) {
        const struct layer *layer = &mpm->layer[g];
#pragma omp parallel num_threads(simulation->threads)
        {
            struct ledger own = {0};
#pragma omp for schedule(static)
            for (int32_t b = 0; b < layer->bins.count; b++)
                if (by_faces && !layer->prescribed && !mpm_is_far(mpm, layer, b))
                    book_ring(mpm, layer, b, dt, &own);
#pragma omp for schedule(static)
            for (int32_t n = 0; n < layer->grid.blocks; n++)
                if (!layer->prescribed && !mpm_is_far(mpm, layer, layer->grid.touch[n][0].bin))
                    unbook_lost(mpm, layer, n, dt, &own);
#pragma omp critical(bolide_mpm_hoop)
            ledger_join(&simulation->ledger, &own);
        }
    }
}

void mpm_start_gradients(const struct mpm *mpm, const struct simulation *simulation)
{
    const struct particles *p = mpm->particles;
    double(*gradient)[9] = mpm_fields_of(mpm).velocity_gradient;
    assert(simulation->problem->dimension <= 3);
    for (int32_t i = 0; i < p->count; i++) {
        const struct field_list *velocity =
            &case_body(simulation->problem->input, p->body[i])->velocity;
        const double *x = p->position[i], away = mpm->half_size[p->body[i]] * mpm->edge;
        for (int j = 0; j < simulation->problem->dimension; j++) {
            double low[3] = {x[0], x[1], x[2]}, high[3] = {x[0], x[1], x[2]};
            low[j] -= away;
            high[j] += away;
            for (int k = 0; k < velocity->count; k++) {
                const double slope =
                    (field_at(&velocity->at[k], vec3_make(high[0], high[1], high[2]), 0.0) -
                     field_at(&velocity->at[k], vec3_make(low[0], low[1], low[2]), 0.0)) /
                    (2.0 * away);
                /* rounding may have moved the position outside the range where the expression has a
                 * value */
                gradient[i][3 * k + j] = isfinite(slope) ? slope : 0.0;
            }
        }
    }
}
