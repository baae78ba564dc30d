/* The places of the parts of afdmp: the nest of the charges, the region of the solids, and the gas
 * between them. */
#include <string.h>

#include "couple/afdmp.h"
#include "couple/coarse.h"
#include "material/material.h"
#include "model/boundaries.h"
#include "model/problem.h"
#include "shape/shape.h"

static bool is_charge(const struct simulation_case *input, int body)
{
    return material_is_lit(body_material(input, body));
}

static int count_bodies(const struct simulation_case *input,
                        bool (*is)(const struct simulation_case *, int body))
{
    int count = 0;
    for (int b = 0; b < input->bodies.count; b++)
        count += is(input, b);
    return count;
}

/* A box from LOW to HIGH, in cells, cut to the DOMAIN, becomes CUT. */
static void cut_to_domain(const struct afdmp *afdmp, const struct cell_blocks *domain,
                          const double low[3], const double high[3], struct gas_cut *cut)
{
    for (int axis = 0; axis < 3; axis++) {
        cut->low[axis] = domain->low[axis];
        cut->high[axis] = domain->high[axis];
        if (axis >= afdmp->dimension)
            continue;
        cut->low[axis] = (int64_t)maximum(floor(low[axis] + 1e-6), (double)domain->low[axis]);
        cut->high[axis] = (int64_t)minimum(ceil(high[axis] - 1e-6), (double)domain->high[axis]);
        cut->open[axis][0] = cut->low[axis] > domain->low[axis];
        cut->open[axis][1] = cut->high[axis] < domain->high[axis];
    }
}

/* The bounds of all bodies that ARE, in cells, MARGIN wider. */
static void find_bounds(const struct afdmp *afdmp, const struct simulation_case *input,
                        bool (*are)(const struct simulation_case *, int body), double margin,
                        double low[3], double high[3])
{
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = INFINITY;
        high[axis] = -INFINITY;
        for (int b = 0; b < input->bodies.count; b++) {
            if (!are(input, b))
                continue;
            const struct bounds bounds = shape_bounds(&case_body(input, b)->shape);
            low[axis] = minimum(low[axis], vec3_at(bounds.low, axis) / afdmp->edge - margin);
            high[axis] = maximum(high[axis], vec3_at(bounds.high, axis) / afdmp->edge + margin);
        }
    }
}

/* Whether BODY moves at the start, in its middle. */
static bool moves(const struct simulation *simulation, int body)
{
    const struct body_input *of = case_body(simulation->problem->input, body);
    const struct bounds bounds = shape_bounds(&of->shape);
    const struct vec3 middle = vec3_scale(0.5, vec3_add(bounds.low, bounds.high));
    double velocity[3] = {0.0};
    struct point point;
    const char *key = "";
    body_start_at(of, &simulation->problem->material[of->material_index], middle, &point, velocity,
                  &key);
    return velocity[0] != 0.0 || velocity[1] != 0.0 || velocity[2] != 0.0;
}

/* The region of the solids. */
static struct error *find_region(struct afdmp *afdmp, const struct simulation *simulation,
                                 const struct cell_blocks *domain)
{
    static const double margin = 10.0;
    const struct simulation_case *input = simulation->problem->input;
    const struct couple_region *given = &afdmp->parameters.region;
    double low[3], high[3];
    TRY(region_check(given, "afdmp.region", input, domain));
    find_bounds(afdmp, input, is_solid, margin, low, high);
    for (int axis = 0; axis < afdmp->dimension && given->low.count > 0; axis++) {
        low[axis] = given->low.at[axis] / afdmp->edge;
        high[axis] = given->high.at[axis] / afdmp->edge;
    }
    cut_to_domain(afdmp, domain, low, high, &afdmp->region);
    struct error *error = NULL;
    for (int b = 0; b < input->bodies.count; b++) {
        const struct body_input *body = case_body(input, b);
        const struct bounds bounds = shape_bounds(&body->shape);
        bool outside = false;
        for (int axis = 0; axis < afdmp->dimension; axis++)
            outside |=
                vec3_at(bounds.low, axis) / afdmp->edge < (double)afdmp->region.low[axis] - 1e-6 ||
                vec3_at(bounds.high, axis) / afdmp->edge > (double)afdmp->region.high[axis] + 1e-6;
        if (is_solid(input, b) && outside)
            error = error_join(error, input_error(input, "bodies", input->bodies.names[b],
                                                  "this solid reaches beyond the region of the "
                                                  "solids: enlarge the region, or leave it out"));
        if (is_solid(input, b) && moves(simulation, b))
            error = error_join(
                error, input_error(input, "bodies", input->bodies.names[b],
                                   "the solver afdmp computes solids from when on a wave of the "
                                   "gas comes to them: this one must be at rest before; the "
                                   "solvers cfdmp and mpm move it from the start"));
    }
    return error;
}

/* How long the surfaces of the charges burn: from when the detonation comes to the first place of
 * them until the last of them has burnt, s. Places where the domain ends are no surface. */
struct burning_time {
    double first, last;
};

static void look_at_charge(const struct afdmp *afdmp, const struct simulation_case *input, int body,
                           const struct cell_blocks *domain, struct burning_time *time)
{
    enum { ACROSS = 32 };
    const struct body_input *of = case_body(input, body);
    const struct bounds bounds = shape_bounds(&of->shape);
    int count[3] = {1, 1, 1};
    double from[3] = {0.0}, step[3] = {0.0};
    for (int axis = 0; axis < afdmp->dimension; axis++) {
        const double low = maximum(vec3_at(bounds.low, axis),
                                   (double)domain->low[axis] * afdmp->edge),
                     high = minimum(vec3_at(bounds.high, axis),
                                    (double)domain->high[axis] * afdmp->edge);
        count[axis] = ACROSS;
        step[axis] = (high - low) / ACROSS;
        from[axis] = low + 0.5 * step[axis];
    }
    for (int c = 0; c < count[2]; c++)
        for (int b = 0; b < count[1]; b++)
            for (int a = 0; a < count[0]; a++) {
                const double at[3] = {from[0] + a * step[0], from[1] + b * step[1],
                                      from[2] + c * step[2]};
                const struct vec3 place = vec3_make(at[0], at[1], at[2]);
                if (!shape_inside(&of->shape, place))
                    continue;
                const double arrival = detonation_arrival(input, body, place);
                time->last = maximum(time->last, arrival);
                for (int face = 0; face < 2 * afdmp->dimension; face++) {
                    double next[3] = {at[0], at[1], at[2]};
                    const int axis = face / 2;
                    next[axis] += face % 2 ? step[axis] : -step[axis];
                    const double cell = next[axis] / afdmp->edge;
                    if (cell > (double)domain->low[axis] && cell < (double)domain->high[axis] &&
                        !shape_inside(&of->shape, vec3_make(next[0], next[1], next[2])))
                        time->first = minimum(time->first, arrival);
                }
            }
}

/* The nest: the charges and as much room as their products need until all have burnt. */
static struct error *find_nest(struct afdmp *afdmp, const struct simulation_case *input,
                               const struct cell_blocks *domain)
{
    static const double cells = 8.0, faster = 1.3; /* than the detonation */
    struct burning_time time = {INFINITY, 0.0};
    double low[3], high[3], speed = 0.0;
    for (int b = 0; b < input->bodies.count; b++)
        if (is_charge(input, b)) {
            look_at_charge(afdmp, input, b, domain, &time);
            speed = maximum(speed, material_detonation_speed(body_material(input, b)));
        }
    const double margin =
        cells + faster * speed * maximum(time.last - time.first, 0.0) / afdmp->edge;
    find_bounds(afdmp, input, is_charge, margin, low, high);
    cut_to_domain(afdmp, domain, low, high, &afdmp->nest_cut);
    bool meets = count_bodies(input, is_solid) > 0;
    for (int axis = 0; axis < afdmp->dimension && meets; axis++)
        meets = afdmp->nest_cut.low[axis] < afdmp->region.high[axis] &&
                afdmp->nest_cut.high[axis] > afdmp->region.low[axis];
    if (meets)
        return input_error(input, "solver", "afdmp",
                           "while the charge burns its products need %.4g m of gas around it, and "
                           "the region of the solids is nearer: use the solver cfdmp or mpm, or "
                           "give a smaller `region`",
                           margin * afdmp->edge);
    return NULL;
}

static struct error *make_gas_part(struct afdmp *afdmp, const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    struct coupled_part *part = &afdmp->gas_part;
    TRY(part_begin(&afdmp->maker, part, input));
    part->place.resolution = afdmp->edge;
    for (int b = 0; b < input->bodies.count; b++)
        part->elsewhere[b] = is_solid(input, b);
    if (count_bodies(input, is_solid) > 0) {
        part_block(&afdmp->maker, part, afdmp->region.low, afdmp->region.high);
        part_pin(&afdmp->maker, &part->place, 0, afdmp->region.low, afdmp->region.high);
    }
    if (count_bodies(input, is_charge) > 0 && !input->start.input)
        part_pin(&afdmp->maker, &part->place, 1, afdmp->nest_cut.low, afdmp->nest_cut.high);
    afdmp->parameters.gas.burnt = true;
    TRY(part_create(&afdmp->maker, part, simulation, &gas_class, &afdmp->parameters.gas));
    afdmp->gas = part->solver;
    return NULL;
}

/* A part of material points, whose bodies reach to the faces of BOX, and which ends where the
 * domain does. Solids are in it or not. */
static struct error *make_mpm_part(struct afdmp *afdmp, const struct simulation *simulation,
                                   struct coupled_part *part, const struct gas_cut *box,
                                   const struct gas_cut *ends, bool solids)
{
    const struct simulation_case *input = simulation->problem->input;
    TRY(part_begin(&afdmp->maker, part, input));
    for (int b = 0; b < input->bodies.count; b++)
        part->elsewhere[b] = is_solid(input, b) && !solids;
    part_cut_bodies(&afdmp->maker, part, box->low, box->high);
    part_close_faces(&afdmp->maker, part, ends, &simulation->problem->place);
    return part_create(&afdmp->maker, part, simulation, &mpm_class, &afdmp->parameters.mpm);
}

void afdmp_judge(const void *parameters, const struct simulation *simulation,
                 struct judgement *judgement)
{
    const struct afdmp_parameters *of = parameters;
    const struct simulation_case *input = simulation->problem->input;
    struct findings *findings = &judgement->findings;
    boundaries_refuse(findings, afdmp_class.boundaries);
    for (int b = 0; b < input->bodies.count && count_bodies(input, is_charge) > 0; b++)
        if (!is_solid(input, b) && moves(simulation, b))
            finding_add(findings, FINDING_WRONG, "bodies", input->bodies.names[b],
                        "the solver afdmp keeps the gas around a charge at rest while the charge "
                        "burns: this body must not move at the start; the solvers cfdmp and mpm "
                        "move it");
    if (input->loads.count > 0)
        finding_add(findings, FINDING_WRONG, "loads", input->loads.names[0],
                    "the solver afdmp computes solids from when on a wave of the gas comes to "
                    "them: use the solver mpm or cfdmp");
    coarse_cells(findings, part_edge(&of->mpm, input));
    judgement->energy_lost = mpm_energy_lost;
}

static bool count_beside(void *context, int64_t number, const int64_t at[3])
{
    int64_t *count = context;
    (void)at;
    *count = number + 1;
    return true;
}

void afdmp_each_beside(const struct afdmp *afdmp, const struct gas_cut *box,
                       bool (*act)(void *context, int64_t number, const int64_t at[3]),
                       void *context)
{
    int64_t number = 0;
    for (int axis = 0; axis < afdmp->dimension; axis++)
        for (int side = 0; side < 2; side++) {
            const int one = axis == 0 ? 1 : 0, other = axis == 2 ? 1 : 2;
            int64_t at[3];
            if (!box->open[axis][side])
                continue;
            at[axis] = side ? box->high[axis] : box->low[axis] - 1;
            for (at[other] = box->low[other]; at[other] < box->high[other]; at[other]++)
                for (at[one] = box->low[one]; at[one] < box->high[one]; at[one]++)
                    if (!act(context, number++, at))
                        return;
        }
}

/* The number of the cell beside the open face of BOX that is nearest to the node AT. */
static int64_t number_beside(const struct afdmp *afdmp, const struct gas_cut *box,
                             const int64_t at[3])
{
    int64_t first = 0, number = 0, least = INT64_MAX;
    for (int axis = 0; axis < afdmp->dimension; axis++)
        for (int side = 0; side < 2; side++) {
            const int one = axis == 0 ? 1 : 0, other = axis == 2 ? 1 : 2;
            const int64_t plane = side ? box->high[axis] : box->low[axis],
                          way = at[axis] > plane ? at[axis] - plane : plane - at[axis];
            if (!box->open[axis][side])
                continue;
            int64_t place[2], count[2];
            for (int k = 0; k < 2; k++) {
                const int along = k ? other : one;
                count[k] = box->high[along] - box->low[along];
                place[k] = at[along] - box->low[along];
                place[k] = place[k] < 0 ? 0 : place[k] >= count[k] ? count[k] - 1 : place[k];
            }
            if (way < least) {
                least = way;
                number = first + place[0] + count[0] * place[1];
            }
            first += count[0] * count[1];
        }
    return number;
}

struct noting {
    const struct cell_blocks *cells;
    double *rest;
};

static bool note(void *context, int64_t number, const int64_t at[3])
{
    const struct noting *noting = context;
    int32_t block;
    const int32_t i = part_cell(noting->cells, at, &block);
    noting->rest[number] = i < 0 ? 0.0 : noting->cells->pressure[i];
    return true;
}

void afdmp_note_rest(const struct afdmp *afdmp, const struct gas_cut *box, struct afdmp_rim *rim)
{
    struct noting noting = {gas_view(afdmp->gas).cells, rim->rest};
    afdmp_each_beside(afdmp, box, note, &noting);
    part_unite(afdmp->ranks, rim->bits, rim->rest, rim->cells);
}

/* The gas outside the nest is at rest: its pressure near the node AT. */
static double pressure_outside(void *of, const int64_t at[3], int component)
{
    const struct afdmp *afdmp = of;
    const int64_t number = number_beside(afdmp, &afdmp->nest_cut, at);
    (void)component;
    return afdmp->round_nest.rest[number] -
           mpm_gauge(afdmp->nest_mpm, gas_view(afdmp->gas).material[0]);
}

static void take_push(void *of, const struct mpm_push *push)
{
    struct afdmp *afdmp = of;
    const double *impulse = push->impulse, h = afdmp->edge;
    ledger_book(
        &afdmp->nest.simulation.ledger, LEDGER_EXCHANGE, 0.0,
        vec3_make(impulse[0], impulse[1], impulse[2]),
        vec3_make((double)push->at[0] * h, (double)push->at[1] * h, (double)push->at[2] * h),
        mpm_push_work(push));
}

static struct error *make_rim(struct afdmp *afdmp, const struct gas_cut *box, struct afdmp_rim *rim)
{
    afdmp_each_beside(afdmp, box, count_beside, &rim->cells);
    rim->rest = owned_new(&afdmp->owned, (size_t)rim->cells * sizeof *rim->rest);
    rim->bits = owned_new(&afdmp->owned, (size_t)rim->cells * sizeof *rim->bits);
    return rim->rest && rim->bits ? NULL : out_of_memory_for("the coupling");
}

static void surround_nest(struct afdmp *afdmp)
{
    afdmp->outside =
        (struct mpm_outside){.of = afdmp, .pressure = pressure_outside, .pushed = take_push};
    part_surround(afdmp->nest_mpm, &afdmp->outside, &afdmp->nest_cut);
}

void afdmp_count(const void *parameters, const struct simulation_case *input,
                 struct counted *counted)
{
    struct afdmp afdmp = {.parameters = *(const struct afdmp_parameters *)parameters,
                          .dimension = (int)input->dimension};
    afdmp.edge = part_edge(&afdmp.parameters.mpm, input);
    const struct cell_blocks domain = part_domain(input, afdmp.edge);
    double low[3] = {0.0, 0.0, 0.0}, high[3] = {0.0, 0.0, 0.0};
    const bool solids = count_bodies(input, is_solid) > 0;
    *counted = (struct counted){.cells = 1.0,
                                .bytes = gas_class.bytes(&afdmp.parameters.gas, afdmp.dimension)};
    error_free(find_nest(&afdmp, input, &domain));
    for (int axis = 0; axis < afdmp.dimension; axis++) {
        low[axis] = afdmp.edge * (double)(solids ? domain.low : afdmp.nest_cut.low)[axis];
        high[axis] = afdmp.edge * (double)(solids ? domain.high : afdmp.nest_cut.high)[axis];
        counted->cells *= (double)(domain.high[axis] - domain.low[axis]);
    }
    counted->box = (struct bounds){vector_at(low), vector_at(high)};
}

struct error *afdmp_make_parts(struct afdmp *afdmp, struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    afdmp->ranks = simulation->ranks;
    afdmp->dimension = simulation->problem->dimension;
    afdmp->round = geometry_power(simulation->problem->geometry) > 0;
    afdmp->edge = part_edge(&afdmp->parameters.mpm, input);
    afdmp->maker = (struct part_maker){&afdmp->owned, afdmp->edge, afdmp->dimension};
    const struct cell_blocks domain = part_domain(input, afdmp->edge);
    struct gas_cut all = {.open = {{false}}};
    memcpy(all.low, domain.low, sizeof all.low);
    memcpy(all.high, domain.high, sizeof all.high);
    const bool solids = count_bodies(input, is_solid) > 0,
               charges = count_bodies(input, is_charge) > 0 && !input->start.input;
    if (!solids && !charges)
        return input_error(input, "solver", "afdmp",
                           "no body is an explosive that is lit, and none is solid: use the solver "
                           "gas");
    if (solids)
        TRY(find_region(afdmp, simulation, &domain));
    if (charges)
        TRY(find_nest(afdmp, input, &domain));
    TRY(make_gas_part(afdmp, simulation));
    if (solids) {
        TRY(make_mpm_part(afdmp, simulation, &afdmp->last, &afdmp->region, &all, true));
        afdmp->last_mpm = afdmp->last.solver;
        mpm_limit_by_nodes(afdmp->last_mpm);
        TRY(make_rim(afdmp, &afdmp->region, &afdmp->round_region));
    }
    if (charges) {
        TRY(make_mpm_part(afdmp, simulation, &afdmp->nest, &afdmp->nest_cut, &afdmp->nest_cut,
                          false));
        afdmp->nest_mpm = afdmp->nest.solver;
        mpm_limit_by_nodes(afdmp->nest_mpm);
        mpm_particles(afdmp->nest_mpm)->name = afdmp_nest_name;
        TRY(make_rim(afdmp, &afdmp->nest_cut, &afdmp->round_nest));
        surround_nest(afdmp);
    }
    return NULL;
}

void afdmp_free_parts(struct afdmp *afdmp)
{
    part_free(&afdmp->gas_part, &gas_class);
    part_free(&afdmp->nest, &mpm_class);
    part_free(&afdmp->last, &mpm_class);
    owned_free(&afdmp->owned);
}
