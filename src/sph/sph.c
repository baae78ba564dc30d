/* The SPH solver as the run loop sees it: its parameters, its fields, and the order of a step.
 *
 * prepare: rows (when they no longer hold), records, pair sums, step limit; advance: all particles to the next
 * level. Source: Parshikov (2013), sections 1.2 to 1.5; the step of section 1.5. */
#include "sph/sph.h"

#include <stdlib.h>

#include "base/clock.h"
#include "base/memory.h"
#include "model/generate.h"
#include "sph/heat_kernel.h"
#include "sph/lanes.h"
#include "sph/prune.h"
#include "sph/sph_internal.h"

/* A field without unit is not shown: it belongs to the middle of a step. */
static const struct field_declaration sph_field_table[] = {
    {"diameter", "m", "particle diameter (m/rho)^(1/dimension)", NUMBER_DOUBLE, 1, FIELD_DERIVED},
    {"sound_long", "m/s", "longitudinal sound speed", NUMBER_DOUBLE, 1, FIELD_DERIVED},
    {"sound_shear", "m/s", "shear wave speed", NUMBER_DOUBLE, 1, FIELD_DERIVED},
    {"acceleration", NULL, "acceleration", NUMBER_DOUBLE, 3, FIELD_PASSING},
    {"power", NULL, "specific power of the contact forces", NUMBER_DOUBLE, 1, FIELD_PASSING},
    {"strain_rate", NULL, "symmetric velocity gradient", NUMBER_DOUBLE, 6, FIELD_PASSING},
    {"spin", NULL, "half the curl of velocity", NUMBER_DOUBLE, 3, FIELD_PASSING},
};
enum { DIAMETER_FIELD = 0, SPIN_FIELD = COUNT_OF(sph_field_table) - 1 };
static const struct field_declaration wall_field = {
    "wall_acceleration", NULL, "acceleration by walls", NUMBER_DOUBLE, 3, FIELD_PASSING};
static const struct field_declaration drift_field = {
    "drift", NULL, "mean contact velocity less own velocity", NUMBER_DOUBLE, 3, FIELD_PASSING};
static const struct field_declaration hoop_fields[] = {
    {"hoop_pull", NULL, "acceleration by hoop stress", NUMBER_DOUBLE, 1, FIELD_PASSING},
    {"hoop_strain", NULL, "part of u/r that is strain rate", NUMBER_DOUBLE, 1, FIELD_PASSING}};
static const struct field_declaration thickness_field = {
    "thickness", "", "thickness relative to the start", NUMBER_DOUBLE, 1, FIELD_STATE};
static const struct field_declaration correction_field = {
    "correction", NULL, "inverse second moment of the kernel", NUMBER_DOUBLE, 0, FIELD_STATE};
static const struct field_declaration velocity_gradient_field = {
    "velocity_gradient", NULL, "gradient of velocity", NUMBER_DOUBLE, 0, FIELD_STATE};
static const struct field_declaration stress_gradient_field = {
    "stress_gradient", NULL, "gradient of stress", NUMBER_DOUBLE, 0, FIELD_STATE};
static const struct field_declaration force_field = {
    "expected_force", "N/m^3", "force of the next step", NUMBER_DOUBLE, 3, FIELD_STATE};
static const struct field_declaration plane_fields[] = {
    {"packing", NULL, "how volumes fill space, and lack neighbours", NUMBER_DOUBLE, 4, FIELD_STATE},
    {"support", "m", "diameter that the kernel goes with", NUMBER_DOUBLE, 1, FIELD_STATE}};
static const struct field_declaration heat_field = {
    "heat_rate", NULL, "specific power of conduction", NUMBER_DOUBLE, 1, FIELD_PASSING};
static const struct field_declaration level_history_field = {
    "level_history", NULL, "history of level n", NUMBER_DOUBLE, POINT_HISTORY, FIELD_DERIVED};
static const struct field_declaration viscosity_field = {
    "viscosity", "Pa", "artificial viscous pressure", NUMBER_DOUBLE, 1, FIELD_DERIVED};

/* Cells are this much wider than the support at the start, so that a little growth of the particles does not
 * put them on the next level of cells, twice as wide. */
static const double growth_room = 1.08;

static bool has_walls(const struct simulation *simulation)
{
    for (int axis = 0; axis < 3; axis++)
        if (!isnan(simulation->mirrors.low[axis]) || !isnan(simulation->mirrors.high[axis]))
            return true;
    return false;
}

static bool has_laws(const struct simulation *simulation)
{
    for (int a = 0; a < CONTACT_GROUPS; a++)
        for (int b = 0; b < CONTACT_GROUPS; b++)
            if (simulation->law[a][b])
                return true;
    return false;
}

static bool is_standard(const struct sph *sph) { return sph->parameters.method == SPH_STANDARD; }

static bool is_thin(const struct simulation *simulation)
{
    return simulation->geometry == GEOMETRY_PLANE_STRESS;
}

struct sph_fields sph_fields_of(const struct sph *sph, const struct simulation *simulation)
{
    const struct particles *p = &simulation->particles;
    struct sph_fields f = {
        .diameter = particles_field(p, "diameter"),
        .sound_long = particles_field(p, "sound_long"),
        .sound_shear = particles_field(p, "sound_shear"),
        .viscosity = is_standard(sph) ? particles_field(p, "viscosity") : NULL,
        .heat_rate = conduction_on(sph) ? particles_field(p, "heat_rate") : NULL,
        .thickness = is_thin(simulation) ? particles_field(p, "thickness") : NULL,
        .rates = {.acceleration = particles_field(p, "acceleration"),
                  .power = particles_field(p, "power"),
                  .strain_rate = particles_field(p, "strain_rate"),
                  .spin = particles_field(p, "spin"),
                  .wall = has_walls(simulation) ? particles_field(p, "wall_acceleration") : NULL,
                  .drift = sph->kind.drift ? particles_field(p, "drift") : NULL}};
    if (sph_second_order(sph)) {
        f.correction = particles_field(p, "correction");
        f.velocity_gradient = particles_field(p, "velocity_gradient");
        f.stress_gradient = particles_field(p, "stress_gradient");
        f.force = particles_field(p, "expected_force");
        f.packing = simulation->dimension > 1 ? particles_field(p, "packing") : NULL;
        f.support = simulation->dimension > 1 ? particles_field(p, "support") : NULL;
    }
    if (sph_axisymmetric(simulation)) {
        f.rates.hoop_pull = particles_field(p, "hoop_pull");
        f.rates.hoop_strain = particles_field(p, "hoop_strain");
    }
    return f;
}

/* Spins correct what shear stress would brake, in the acoustic contact problem. */
static struct error *choose_turn(struct sph *sph, const struct simulation *simulation)
{
    const char *wrong = NULL;
    sph->kind.turn = sph->parameters.rotation == SPH_ROTATION_CORRECTED;
    if (sph->kind.turn && sph->kind.star != STAR_ACOUSTIC)
        wrong = "corrected goes with `method: contact` and `contact: acoustic`";
    else if (sph->kind.turn && !sph->kind.shear)
        wrong = simulation->dimension == 1 ? "nothing turns in one dimension"
                                           : "corrected wants a material with strength: a fluid's "
                                             "rotation is not braked";
    return wrong ? input_error(simulation->input, "solver", "sph.rotation", "%s", wrong) : NULL;
}

/* Which pair loop the case needs, and what its contact problems take from the materials. */
static struct error *choose_kind(struct sph *sph, const struct simulation *simulation)
{
    static const enum pair_star stars[] = {[SPH_CONTACT_ACOUSTIC] = STAR_ACOUSTIC,
                                           [SPH_CONTACT_DUKOWICZ] = STAR_DUKOWICZ,
                                           [SPH_CONTACT_EXACT_GAS] = STAR_EXACT_GAS};
    struct sph_parameters *parameters = &sph->parameters;
    struct pair_kind *kind = &sph->kind;
    if (sph_corrected(sph))
        return hllc_choose(sph, simulation, has_laws(simulation));
    kind->dimension = simulation->dimension;
    if (sph_second_order(sph))
        TRY(muscl_check(sph, simulation));
    if (parameters->contact < 0)
        parameters->contact = SPH_CONTACT_ACOUSTIC;
    /* On a line density and spacing must not drift apart; in more dimensions a mean of contacts would smear jets. */
    if (parameters->motion < 0)
        parameters->motion = sph_second_order(sph) && kind->dimension == 1 ? SPH_MOTION_CONTACT
                                                                           : SPH_MOTION_PARTICLE;
    kind->star = is_standard(sph) ? STAR_MEAN : stars[parameters->contact];
    kind->drift = parameters->motion == SPH_MOTION_CONTACT;
    kind->depth = sph_axisymmetric(simulation) || is_thin(simulation);
    for (int m = 0; m < simulation->materials; m++) {
        const struct material *material = &simulation->material[m];
        const char *name = simulation->input->materials.names[m];
        kind->shear |= material_has_strength(material) && simulation->dimension > 1;
        TRY(sph_choose_bend(sph, simulation, m));
        if (is_thin(simulation) && !material_has_strength(material))
            return input_error(
                simulation->input, "materials", name,
                "plane stress is for plates that have strength, and this is a fluid");
    }
    return choose_turn(sph, simulation);
}

/* An image of an image along one axis does not exist, so it must lie beyond reach: it is as far from a particle as
 * the gap of the two walls and, on a lattice, a diameter. */
static struct error *check_walls(const struct simulation *simulation, double reach)
{
    for (int axis = 0; axis < simulation->dimension; axis++) {
        double gap = simulation->mirrors.high[axis] - simulation->mirrors.low[axis];
        if (gap < reach)
            return input_error(simulation->input, "walls", NULL,
                               "the two walls across %c are %.4g m apart; with this smoothing and "
                               "resolution they must be %.4g m apart at least",
                               "xyz"[axis], gap, reach);
    }
    return NULL;
}

static struct error *sph_create(void *solver, struct simulation *simulation, const void *parameters)
{
    struct sph *sph = solver;
    sph->parameters = sph_settled(parameters);
    sph->neighbours.skin = sph->parameters.skin;
    sph->neighbours.near_skin = sph_near_skin(&sph->parameters, simulation->dimension);
    TRY(choose_kind(sph, simulation));
    TRY(sph_refuse(simulation));
    sph->groups = (struct contact_groups){simulation->group_of_body, &simulation->law[0][0],
                                          has_laws(simulation) ? CONTACT_GROUPS : 1};
    struct field_declaration fields[COUNT_OF(sph_field_table) + 12 + HLLC_FIELDS + POINT_HISTORY];
    int count = simulation_history(simulation, fields);
    const bool history = count > 0;
    struct field_declaration *own = fields + count;
    for (size_t k = 0; k < COUNT_OF(sph_field_table); k++)
        fields[count++] = sph_field_table[k];
    if (sph->kind.turn) /* the spins of the step before enter the next */
        own[SPIN_FIELD].kind = FIELD_STATE;
    if (sph_second_order(sph)) {
        const struct muscl_kind kind = muscl_kind_of(sph);
        fields[count] = correction_field;
        fields[count++].components = tensor_components(kind.dimension);
        fields[count] = velocity_gradient_field;
        fields[count++].components = kind.dimension * kind.dimension;
        fields[count] = stress_gradient_field;
        fields[count++].components = kind.dimension * muscl_stresses(kind);
        fields[count++] = force_field;
        for (size_t k = 0; k < COUNT_OF(plane_fields) && kind.dimension > 1; k++)
            fields[count++] = plane_fields[k];
    }
    if (sph_corrected(sph)) { /* supports are those of the start */
        own[DIAMETER_FIELD].kind = FIELD_STATE;
        count += hllc_declare(&sph->parameters, fields + count);
        if (history)
            fields[count++] = level_history_field;
    }
    if (has_walls(simulation))
        fields[count++] = wall_field;
    for (size_t k = 0; k < COUNT_OF(hoop_fields) && sph_axisymmetric(simulation); k++)
        fields[count++] = hoop_fields[k];
    if (is_thin(simulation))
        fields[count++] = thickness_field;
    if (is_standard(sph))
        fields[count++] = viscosity_field;
    if (sph->kind.drift)
        fields[count++] = drift_field;
    TRY(conduction_create(sph, simulation));
    if (conduction_on(sph))
        fields[count++] = heat_field;
    double diameter = largest_diameter(simulation->input);
    double support = 2.0 * sph->parameters.smoothing * diameter;
    TRY(check_walls(simulation, support - (1.0 + 1e-9) * diameter));
    double cell = growth_room * support * (1.0 + sph->parameters.skin);
    TRY(particles_create(simulation->dimension, cell, fields, count, &simulation->particles));
    simulation->particles.ranks = simulation->ranks;
    simulation->particles.threads = simulation->threads;
    return NULL;
}

static struct error *sph_start(void *solver, struct simulation *simulation)
{
    if (sph_corrected(solver)) {
        hllc_start(solver, simulation);
        return NULL;
    }
    struct sph_fields fields = sph_fields_of(solver, simulation);
    for (int32_t i = 0; fields.thickness && i < simulation->particles.count; i++)
        if (fields.thickness[i] == 0.0) /* fresh */
            fields.thickness[i] = 1.0;
    if (sph_second_order(solver))
        muscl_start(solver, simulation);
    sph_evaluate(solver, simulation);
    return NULL;
}

/* Pair sums of all particles from the records. */
static void sum_pairs(struct sph *sph, struct simulation *simulation,
                      const struct sph_fields *fields)
{
    const struct particles *p = &simulation->particles;
    struct pair_loop loop = {.kind = sph->kind,
                             .record = sph->record,
                             .empty = p->count + sph->neighbours.ghosts.count,
                             .smoothing = sph->parameters.smoothing,
                             .neighbours = &sph->neighbours,
                             .groups = &sph->groups,
                             .body = p->body,
                             .density = p->density,
                             .rates = fields->rates};
    const struct prune_loop prune = {loop.record, record_stride(loop.kind), p->dimension,
                                     NULL,        loop.smoothing,           &sph->neighbours};
    for (int rest = 0; rest < 2; rest++) {
        if (rest)
            sph_pack_rest(sph, simulation);
#pragma omp parallel for schedule(dynamic) num_threads(simulation->threads)
        for (int32_t b = 0; b < p->blocks; b++) {
            const int32_t first = p->block[b].first, end = first + p->block[b].count;
            if (neighbours_inner(&sph->neighbours, b) == rest)
                continue;
            prune_loop_run(&prune, p->block, b);
            pair_loop_run(&loop, first, end);
        }
    }
    sph->neighbours.prune = false;
    if (sph_axisymmetric(simulation))
        sph_add_hoop(sph, simulation, fields);
}

/* The same of second order, from records half of STEP ahead. */
static void sum_pairs_ahead(struct sph *sph, struct simulation *simulation,
                            const struct sph_fields *fields, double step)
{
    const struct particles *p = &simulation->particles;
    sph->half_step = 0.5 * step;
    double begin = clock_seconds();
    muscl_pack(sph, simulation);
    simulation_spend(simulation, "records", clock_seconds() - begin);
    begin = clock_seconds();
    struct muscl_loop loop = {.kind = muscl_kind_of(sph),
                              .record = sph->record,
                              .empty = p->count + sph->neighbours.ghosts.count,
                              .place = sph->place,
                              .smoothing = sph->parameters.smoothing,
                              .neighbours = &sph->neighbours,
                              .groups = &sph->groups,
                              .body = p->body,
                              .density = p->density,
                              .velocity = (const double(*)[3])p->velocity,
                              .rates = {fields->rates, fields->correction,
                                        fields->velocity_gradient, fields->stress_gradient,
                                        fields->force, fields->packing}};
    const struct prune_loop prune = {loop.record, muscl_stride(loop.kind), p->dimension,
                                     loop.place,  loop.smoothing,          &sph->neighbours};
    for (int rest = 0; rest < 2; rest++) {
        if (rest)
            muscl_pack_rest(sph, simulation);
#pragma omp parallel for schedule(dynamic) num_threads(simulation->threads)
        for (int32_t b = 0; b < p->blocks; b++) {
            const int32_t first = p->block[b].first, end = first + p->block[b].count;
            if (neighbours_inner(&sph->neighbours, b) == rest)
                continue;
            prune_loop_run(&prune, p->block, b);
            muscl_loop_run(&loop, first, end);
        }
    }
    sph->neighbours.prune = false;
    frozen_push(sph, simulation, fields);
    if (sph_axisymmetric(simulation))
        sph_add_hoop(sph, simulation, fields);
    simulation_spend(simulation, "pairs", clock_seconds() - begin);
}

/* The step is chosen by the rates of the step before, as the records are. The first step has none: its first sums are
 * there to give them. */
static void prepare_second_order(struct sph *sph, struct simulation *simulation,
                                 const struct sph_fields *fields, struct limit *limit)
{
    for (int round = simulation->step == 0 ? 0 : 1; round < 2; round++) {
        double begin = clock_seconds();
        sph_limit_step(sph, simulation, fields, limit);
        simulation_spend(simulation, "points", clock_seconds() - begin);
        sum_pairs_ahead(sph, simulation, fields, limit->dt);
    }
}

/* Pair sums of the mechanics, and the step that they allow. */
static void prepare_motion(struct sph *sph, struct simulation *simulation,
                           const struct sph_fields *fields, struct limit *limit)
{
    double begin = clock_seconds();
    if (is_standard(sph)) {
        /* Viscosity needs the divergence of the same level first. */
#pragma omp parallel for schedule(static) num_threads(simulation->threads)
        for (int32_t i = 0; i < simulation->particles.count; i++)
            fields->viscosity[i] = 0.0;
        sph_pack(sph, simulation);
        sum_pairs(sph, simulation, fields);
        sph_find_viscosity(sph, simulation, fields);
    }
    sph_pack(sph, simulation);
    simulation_spend(simulation, "records", clock_seconds() - begin);
    begin = clock_seconds();
    sum_pairs(sph, simulation, fields);
    simulation_spend(simulation, "pairs", clock_seconds() - begin);
    begin = clock_seconds();
    sph_limit_step(sph, simulation, fields, limit);
    simulation_spend(simulation, "points", clock_seconds() - begin);
}

static struct error *sph_prepare(void *solver, struct simulation *simulation, struct limit *limit)
{
    struct sph *sph = solver;
    stop_bodies(simulation);
    TRY(sph_refresh_rows(sph, simulation));
    struct sph_fields fields = sph_fields_of(sph, simulation);
    *limit = (struct limit){(double)INFINITY, "nothing", 0};
    if (sph_corrected(sph))
        hllc_prepare(sph, simulation, limit);
    else if (sph_second_order(sph) && !sph_still(sph))
        prepare_second_order(sph, simulation, &fields, limit);
    else if (!sph_still(sph))
        prepare_motion(sph, simulation, &fields, limit);
    if (conduction_on(sph)) {
        double begin = clock_seconds();
        conduction_prepare(sph, simulation, &fields, limit);
        simulation_spend(simulation, "heat", clock_seconds() - begin);
    }
    return NULL;
}

static struct error *sph_advance(void *solver, struct simulation *simulation, double dt)
{
    struct sph *sph = solver;
    sph->steps_since_build++;
    if (sph_corrected(sph)) {
        TRY(hllc_advance(sph, simulation, dt));
        return drive_bodies(simulation, dt);
    }
    double begin = clock_seconds();
    struct error *error = sph_update(sph, simulation, dt);
    simulation_spend(simulation, "points", clock_seconds() - begin);
    return error_join(error, drive_bodies(simulation, dt));
}

static struct error *sph_state(void *solver, struct visitor *visitor)
{
    (void)solver;
    (void)visitor;
    return NULL;
}

static void sph_observe(const void *solver, const struct simulation *simulation,
                        struct views *views)
{
    (void)solver;
    views_of_particles(views, simulation);
}

static void sph_destroy(void *solver)
{
    struct sph *sph = solver;
    neighbours_free(&sph->neighbours);
    conduction_destroy(sph);
    free(sph->place);
    free(sph->end);
}

static double sph_bytes(const void *parameters, int dimension)
{
    const struct sph_parameters settled = sph_settled(parameters), *sph = &settled;
    struct particles store;
    error_free(
        particles_create(dimension, 1.0, sph_field_table, COUNT_OF(sph_field_table), &store));
    double fields = (double)particles_bytes(&store);
    particles_destroy(&store);
    /* Neighbours of a regular lattice: the volume of the support, skin included. */
    double reach = 2.0 * sph->smoothing * (1.0 + sph->skin);
    double neighbours = dimension == 1   ? 2.0 * reach
                        : dimension == 2 ? 3.14159 * square(reach)
                                         : 4.18879 * reach * square(reach);
    double heat = sph->conduction == SPH_CONDUCTION_NONE ? 0.0 : (1 + HEAT_STRIDE) * sizeof(double);
    double record = 16 * sizeof(double);
    if (sph->method == SPH_MUSCL) {
        const struct muscl_kind kind = {dimension, dimension > 1, false}; /* as of a solid */
        int slopes = tensor_components(dimension) + dimension * (dimension + muscl_stresses(kind));
        fields += (slopes + (dimension > 1 ? 8 : 3)) * sizeof(double);
        record = (muscl_stride(kind) + PLACE_STRIDE) * sizeof(double);
    }
    if (sph->method == SPH_HLLC || sph->method == SPH_MONAGHAN) {
        struct field_declaration level[HLLC_FIELDS];
        for (int k = hllc_declare(sph, level) - 1; k >= 0; k--)
            fields += level[k].components * sizeof(double);
        record = hllc_stride(hllc_kind_of(sph, dimension, false)) * sizeof(double);
    }
    double rows = sizeof(struct row) + 1.25 * neighbours * sizeof(uint32_t);
    const double near_skin = sph_near_skin(sph, dimension);
    if (near_skin > 0.0)
        rows +=
            4 * sizeof(double) + sizeof(struct near_row) +
            neighbours * pow((1.0 + near_skin) / (1.0 + sph->skin), dimension) * sizeof(uint32_t);
    return fields + heat + record + 4 * sizeof(double) + rows;
}

static double sph_step(const void *parameters, int dimension, const struct material *material,
                       const struct point *point, double diameter)
{
    const struct sph_parameters settled = sph_settled(parameters), *sph = &settled;
    struct point at = *point;
    double heat = conduction_step(sph, dimension, &material->heat, point->density, diameter);
    if (sph->motion == SPH_MOTION_NONE)
        return heat;
    if (sph->method == SPH_HLLC || sph->method == SPH_MONAGHAN)
        diameter *= sph->smoothing;
    return minimum(heat, sph->courant * diameter / material_evaluate(material, &at).sound_long);
}

static const struct field_declaration *sph_field(int index)
{
    static const struct field_declaration *const at_times[] = {&viscosity_field, &thickness_field};
    const int always = (int)COUNT_OF(sph_field_table);
    if (index < always)
        return &sph_field_table[index];
    return index < always + (int)COUNT_OF(at_times) ? at_times[index - always] : NULL;
}

const struct solver_class sph_class = {.size = sizeof(struct sph),
                                       .create = sph_create,
                                       .start = sph_start,
                                       .prepare = sph_prepare,
                                       .advance = sph_advance,
                                       .state = sph_state,
                                       .observe = sph_observe,
                                       .destroy = sph_destroy,
                                       .bytes = sph_bytes,
                                       .step = sph_step,
                                       .field = sph_field};
