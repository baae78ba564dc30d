/* The cases of both parts of a coupled run, the region and its faces. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "couple/cfdmp.h"
#include "material/material.h"
#include "model/domain.h"
#include "shape/kinds.h"

static struct error *out_of_memory(void)
{
    return error_new(ERROR_SYSTEM, "out of memory for the parts of the coupling");
}

/* Memory that is freed with the solver; NULL when there is none. */
static void *own(struct cfdmp *cfdmp, size_t size)
{
    void *memory = memory_allocate(size + 1);
    if (!memory || !memory_reserve((void **)&cfdmp->owned, &cfdmp->owned_capacity,
                                   cfdmp->owned_count + 1, cfdmp->owned_count, sizeof(void *))) {
        free(memory);
        return NULL;
    }
    cfdmp->owned[cfdmp->owned_count++] = memory;
    memset(memory, 0, size + 1);
    return memory;
}

/* The depth of the band behind the overlap: sweeps along each axis look two cells ahead. */
static int64_t band_depth(int dimension) { return 2 * dimension; }

static struct one_of shape_of(const char *name, void *value)
{
    struct one_of shape = {.index = -1};
    for (int k = 0; k < shape_choice_count; k++)
        if (strcmp(shape_choices[k].name, name) == 0)
            shape = (struct one_of){k, &shape_choices[k], value};
    return shape;
}

static double in(const struct vec3 *v, int axis)
{
    return axis == 0 ? v->x : axis == 1 ? v->y : v->z;
}

/* The bodies of the case, a copy that is freed with the part. */
static struct error *copy_bodies(struct cfdmp *cfdmp, const struct simulation_case *input,
                                 struct part *part)
{
    const size_t size = (size_t)input->bodies.count * sizeof(struct body_input);
    part->input.bodies.items = own(cfdmp, size);
    if (!part->input.bodies.items)
        return out_of_memory();
    memcpy(part->input.bodies.items, input->bodies.items, size);
    return NULL;
}

/* What is wrong with the region as the case gives it. */
static struct error *check_region(const struct cfdmp *cfdmp, const struct simulation *simulation,
                                  const struct cell_blocks *cells)
{
    const struct simulation_case *input = simulation->problem->input;
    const struct cfdmp_region *region = &cfdmp->parameters.region;
    static const char key[] = "cfdmp.region";
    if (region->low.count == 0 && region->high.count == 0)
        return NULL;
    if (region->low.count != cfdmp->dimension || region->high.count != cfdmp->dimension)
        return input_error(input, "solver", key,
                           "expected `low` and `high` with %d component%s each, one per dimension",
                           cfdmp->dimension, cfdmp->dimension == 1 ? "" : "s");
    for (int axis = 0; axis < cfdmp->dimension; axis++) {
        const double low = region->low.at[axis], high = region->high.at[axis],
                     domain[2] = {(double)cells->low[axis] * cfdmp->edge,
                                  (double)cells->high[axis] * cfdmp->edge},
                     slack = 1e-6 * cfdmp->edge;
        if (!(low < high))
            return input_error(input, "solver", key, "`low` is not below `high` along %c",
                               "xyz"[axis]);
        if (low < domain[0] - slack || high > domain[1] + slack)
            return input_error(
                input, "solver", key,
                "it reaches from %.6g m to %.6g m along %c, beyond the domain, which "
                "reaches from %.6g m to %.6g m",
                low, high, "xyz"[axis], domain[0], domain[1]);
    }
    return NULL;
}

/* The region in cells of the domain of CELLS. */
static struct error *find_region(struct cfdmp *cfdmp, const struct simulation *simulation,
                                 const struct cell_blocks *cells)
{
    const struct simulation_case *input = simulation->problem->input;
    const struct cfdmp_region *region = &cfdmp->parameters.region;
    TRY(check_region(cfdmp, simulation, cells));
    const int64_t margin = cfdmp->parameters.overlap + band_depth(cfdmp->dimension) + 3;
    for (int axis = 0; axis < 3; axis++) {
        double low = INFINITY, high = -INFINITY;
        cfdmp->cut.low[axis] = cells->low[axis];
        cfdmp->cut.high[axis] = cells->high[axis];
        if (axis >= cfdmp->dimension)
            continue;
        for (int b = 0; b < input->bodies.count; b++) {
            const struct body_input *body = case_body(input, b);
            if (gas_computes(&simulation->problem->material[body->material_index]))
                continue;
            const struct bounds bounds = shape_bounds(&body->shape);
            low = minimum(low, in(&bounds.low, axis) / cfdmp->edge - (double)margin);
            high = maximum(high, in(&bounds.high, axis) / cfdmp->edge + (double)margin);
        }
        if (region->low.count > axis) {
            low = region->low.at[axis] / cfdmp->edge;
            high = region->high.at[axis] / cfdmp->edge;
        }
        if (!(low < high))
            return input_error(input, "solver", "cfdmp",
                               "no body is solid: give the `region` of the material points");
        low = maximum(floor(low + 1e-6), (double)cells->low[axis]);
        high = minimum(ceil(high - 1e-6), (double)cells->high[axis]);
        cfdmp->cut.low[axis] = (int64_t)low;
        cfdmp->cut.high[axis] = (int64_t)high;
        for (int side = 0; side < 2; side++)
            cfdmp->cut.open[axis][side] =
                side ? cfdmp->cut.high[axis] < cells->high[axis] : low > (double)cells->low[axis];
        if (high - low < (double)(cfdmp->parameters.overlap + band_depth(cfdmp->dimension)))
            return input_error(input, "solver", "cfdmp",
                               "the region of the material points has %.0f cells along %c: it "
                               "needs %d for the overlap and what gas sees of it",
                               high - low, "xyz"[axis],
                               (int)(cfdmp->parameters.overlap + band_depth(cfdmp->dimension)));
    }
    return NULL;
}

/* Solids lie in the region, behind what gas sees of it. */
static struct error *check_solids(const struct cfdmp *cfdmp, const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    const double depth = (double)(cfdmp->parameters.overlap + band_depth(cfdmp->dimension));
    struct error *error = NULL;
    for (int b = 0; b < input->bodies.count; b++) {
        const struct body_input *body = case_body(input, b);
        if (gas_computes(&simulation->problem->material[body->material_index]))
            continue;
        const struct bounds bounds = shape_bounds(&body->shape);
        for (int axis = 0; axis < cfdmp->dimension; axis++)
            for (int side = 0; side < 2; side++) {
                const double at = in(side ? &bounds.high : &bounds.low, axis) / cfdmp->edge,
                             face = (double)(side ? cfdmp->cut.high : cfdmp->cut.low)[axis];
                const double room = side ? face - at : at - face,
                             wanted = cfdmp->cut.open[axis][side] ? depth : 0.0;
                if (room < wanted - 1e-6)
                    error = error_join(
                        error,
                        input_error(input, "bodies", input->bodies.names[b],
                                    "this solid is %.6g m from the face %c = %.6g m of the region "
                                    "of material points: it must be %.6g m inside, behind the "
                                    "overlap; enlarge the region, or leave it out",
                                    room * cfdmp->edge, "xyz"[axis], face * cfdmp -> edge,
                                    wanted * cfdmp -> edge));
            }
    }
    return error;
}

/* The domain in cells of EDGE, before the gas solver has found it: its faces, rounded. */
static struct cell_blocks domain_of(const struct simulation_case *input, double edge)
{
    struct cell_blocks cells = {.dimension = (int)input->dimension, .edge = edge};
    for (int axis = 0; axis < 3; axis++) {
        cells.high[axis] = 1;
        if (axis >= cells.dimension)
            continue;
        cells.low[axis] = (int64_t)floor(domain_face(input, axis, 0).at / edge + 0.5);
        cells.high[axis] = (int64_t)floor(domain_face(input, axis, 1).at / edge + 0.5);
    }
    return cells;
}

/* Blocks the cells behind the band. */
static struct error *block_inside(struct cfdmp *cfdmp)
{
    struct part *part = &cfdmp->gas_part;
    const int64_t depth = cfdmp->parameters.overlap + band_depth(cfdmp->dimension);
    const int old = part->input.obstacles.count;
    struct obstacle_input *items = own(cfdmp, ((size_t)old + 1) * sizeof *items);
    char **names = own(cfdmp, ((size_t)old + 1) * sizeof *names);
    struct shape_box *box = own(cfdmp, sizeof *box);
    if (!items || !names || !box)
        return out_of_memory();
    bool any = true;
    box->from.count = box->to.count = cfdmp->dimension;
    for (int axis = 0; axis < cfdmp->dimension; axis++) {
        const int64_t low = cfdmp->cut.low[axis] + (cfdmp->cut.open[axis][0] ? depth : 0),
                      high = cfdmp->cut.high[axis] - (cfdmp->cut.open[axis][1] ? depth : 0);
        box->from.at[axis] = (double)low * cfdmp->edge;
        box->to.at[axis] = (double)high * cfdmp->edge;
        any &= low < high;
    }
    for (int k = 0; k < old; k++) {
        items[k] = *case_obstacle(&part->input, k);
        names[k] = part->input.obstacles.names[k];
    }
    items[old] = (struct obstacle_input){.shape = shape_of("box", box)};
    names[old] = "region";
    part->input.obstacles = (struct named_map){.count = old + any, .names = names, .items = items};
    return NULL;
}

static struct error *make_gas_part(struct cfdmp *cfdmp, const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    struct part *part = &cfdmp->gas_part;
    part->input = *input;
    part->input.resolution = cfdmp->edge;
    part->input.outflows = part->input.contacts = part->input.loads = (struct named_map){0};
    TRY(copy_bodies(cfdmp, input, part));
    for (int b = 0; b < input->bodies.count; b++) {
        struct body_input *body = case_body(&part->input, b);
        body->elsewhere = !gas_computes(&simulation->problem->material[body->material_index]);
    }
    const struct cell_blocks domain = domain_of(input, cfdmp->edge);
    TRY(find_region(cfdmp, simulation, &domain));
    TRY(check_solids(cfdmp, simulation));
    TRY(block_inside(cfdmp));
    TRY(simulation_create(&part->input, simulation->ranks, simulation->threads, &part->simulation));
    part->solver = own(cfdmp, gas_class.size);
    if (!part->solver)
        return out_of_memory();
    cfdmp->gas = part->solver;
    return gas_class.create(part->solver, &part->simulation, &cfdmp->parameters.gas);
}

/* Bodies reach to the faces of the region. */
static struct error *cut_bodies(struct cfdmp *cfdmp, struct part *part)
{
    const int count = part->input.bodies.count;
    for (int b = 0; b < count; b++) {
        struct body_input *body = case_body(&part->input, b);
        const struct bounds bounds = shape_bounds(&body->shape);
        bool within = true;
        for (int axis = 0; axis < cfdmp->dimension; axis++) {
            const double low = (double)cfdmp->cut.low[axis] * cfdmp->edge,
                         high = (double)cfdmp->cut.high[axis] * cfdmp->edge;
            body->elsewhere |= !(in(&bounds.low, axis) < high && in(&bounds.high, axis) > low);
            within &= in(&bounds.low, axis) >= low && in(&bounds.high, axis) <= high;
        }
        if (within || body->elsewhere)
            continue;
        struct shape_intersection *both = own(cfdmp, sizeof *both);
        struct shape_box *box = own(cfdmp, sizeof *box);
        struct one_of *items = own(cfdmp, 2 * sizeof *items);
        if (!both || !box || !items)
            return out_of_memory();
        box->from.count = box->to.count = cfdmp->dimension;
        for (int axis = 0; axis < cfdmp->dimension; axis++) {
            box->from.at[axis] = (double)cfdmp->cut.low[axis] * cfdmp->edge;
            box->to.at[axis] = (double)cfdmp->cut.high[axis] * cfdmp->edge;
        }
        items[0] = body->shape;
        items[1] = shape_of("box", box);
        *both = (struct shape_intersection){{2, items}};
        body->shape = shape_of("intersection", both);
        body->cut = true;
    }
    return NULL;
}

/* Faces of the region that are faces of the domain: walls, where gas has them, or outflows. */
static struct error *close_faces(struct cfdmp *cfdmp, struct part *part)
{
    enum { FACES = 6 };
    static const char *const faces[FACES] = {"the face low in x", "the face high in x",
                                             "the face low in y", "the face high in y",
                                             "the face low in z", "the face high in z"};
    const struct mirrors *mirrors = &cfdmp->gas_part.simulation.problem->mirrors;
    char **names = own(cfdmp, FACES * sizeof *names);
    struct wall_input *wall = own(cfdmp, FACES * sizeof *wall);
    struct outflow_input *outflow = own(cfdmp, FACES * sizeof *outflow);
    part->input.walls = (struct named_map){.names = names, .items = wall};
    part->input.outflows = (struct named_map){.names = names, .items = outflow};
    if (!names || !wall || !outflow)
        return out_of_memory();
    for (int k = 0; k < FACES; k++) {
        names[k] = own(cfdmp, strlen(faces[k]) + 1);
        if (!names[k])
            return out_of_memory();
        memcpy(names[k], faces[k], strlen(faces[k]));
    }
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int side = 0; side < 2; side++) {
            const double at = (double)(side ? cfdmp->cut.high : cfdmp->cut.low)[axis] * cfdmp->edge;
            const double mirror = side ? mirrors->high[axis] : mirrors->low[axis];
            if (cfdmp->cut.open[axis][side])
                continue;
            if (!isnan(mirror))
                wall[part->input.walls.count++] = (struct wall_input){axis, side, mirror};
            else
                outflow[part->input.outflows.count++] =
                    (struct outflow_input){.axis = axis, .side = side, .at = at, .pressure = NAN};
        }
    return NULL;
}

static struct error *make_mpm_part(struct cfdmp *cfdmp, const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    struct part *part = &cfdmp->mpm_part;
    part->input = *input;
    part->input.boundaries = part->input.obstacles = (struct named_map){0};
    part->input.domain = (struct domain_input){0};
    part->input.start = (struct start_input){0};
    TRY(copy_bodies(cfdmp, input, part));
    TRY(cut_bodies(cfdmp, part));
    TRY(close_faces(cfdmp, part));
    TRY(simulation_create(&part->input, simulation->ranks, simulation->threads, &part->simulation));
    part->solver = own(cfdmp, mpm_class.size);
    if (!part->solver)
        return out_of_memory();
    cfdmp->mpm = part->solver;
    return mpm_class.create(part->solver, &part->simulation, &cfdmp->parameters.mpm);
}

/* The least number of cells from AT, a place in the region, to an open face. */
static int64_t depth_of(const struct cfdmp *cfdmp, const int64_t at[3])
{
    int64_t depth = INT64_MAX;
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int side = 0; side < 2; side++) {
            const int64_t here = side ? cfdmp->count[axis] - 1 - at[axis] : at[axis];
            if (cfdmp->cut.open[axis][side] && here < depth)
                depth = here;
        }
    return depth;
}

static struct error *find_band(struct cfdmp *cfdmp)
{
    const int64_t from = cfdmp->parameters.overlap, to = from + band_depth(cfdmp->dimension);
    const int64_t *n = cfdmp->count;
    const int64_t all = n[0] * n[1] * n[2];
    cfdmp->band_of = own(cfdmp, (size_t)all * sizeof *cfdmp->band_of);
    if (!cfdmp->band_of)
        return out_of_memory();
    for (int pass = 0; pass < 2; pass++) {
        int64_t at[3], k = 0;
        cfdmp->band_cells = 0;
        for (at[2] = 0; at[2] < n[2]; at[2]++)
            for (at[1] = 0; at[1] < n[1]; at[1]++)
                for (at[0] = 0; at[0] < n[0]; at[0]++, k++) {
                    const int64_t depth = depth_of(cfdmp, at);
                    const bool in_band = depth >= from && depth < to;
                    cfdmp->band_of[k] = in_band ? (int32_t)cfdmp->band_cells : -1;
                    for (int axis = 0; axis < 3 && in_band && pass; axis++)
                        cfdmp->band[cfdmp->band_cells][axis] = cfdmp->cut.low[axis] + at[axis];
                    cfdmp->band_cells += in_band;
                }
        if (pass == 0) {
            cfdmp->band = own(cfdmp, ((size_t)cfdmp->band_cells + 1) * sizeof *cfdmp->band);
            if (!cfdmp->band)
                return out_of_memory();
        }
    }
    return NULL;
}

static struct error *make_sides(struct cfdmp *cfdmp)
{
    for (int axis = 0; axis < 3; axis++)
        for (int s = 0; s < 2; s++) {
            struct side *side = &cfdmp->side[axis][s];
            if (!cfdmp->cut.open[axis][s])
                continue;
            side->gates = 1;
            for (int other = 0; other < 3; other++)
                side->gates *= other == axis ? 1 : cfdmp->count[other];
            side->gate = own(cfdmp, (size_t)side->gates * sizeof *side->gate);
            cfdmp->cut.passed[axis][s] =
                own(cfdmp, (size_t)(side->gates * GAS_PASSED) * sizeof(double));
            if (!side->gate || !cfdmp->cut.passed[axis][s])
                return out_of_memory();
        }
    return NULL;
}

struct error *cfdmp_make_parts(struct cfdmp *cfdmp, struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    if (simulation->ranks->size > 1)
        return input_error(input, "solver", NULL, "the solver cfdmp runs on one rank");
    cfdmp->dimension = simulation->problem->dimension;
    cfdmp->round = geometry_power(simulation->problem->geometry) > 0;
    cfdmp->edge =
        isnan(cfdmp->parameters.mpm.cell) ? 2.0 * input->resolution : cfdmp->parameters.mpm.cell;
    TRY(make_gas_part(cfdmp, simulation));
    TRY(make_mpm_part(cfdmp, simulation));
    for (int axis = 0; axis < 3; axis++)
        cfdmp->count[axis] = cfdmp->cut.high[axis] - cfdmp->cut.low[axis];
    TRY(find_band(cfdmp));
    return make_sides(cfdmp);
}

static void free_part(struct part *part, const struct solver_class *class)
{
    if (part->solver)
        class->destroy(part->solver);
    if (part->simulation.problem)
        simulation_destroy(&part->simulation);
}

void cfdmp_free_parts(struct cfdmp *cfdmp)
{
    free_part(&cfdmp->gas_part, &gas_class);
    free_part(&cfdmp->mpm_part, &mpm_class);
    for (int k = 0; k < cfdmp->owned_count; k++)
        free(cfdmp->owned[k]);
    free(cfdmp->owned);
    free(cfdmp->changed);
}
