/* The region of material points: where it is, and what is wrong with it. */
#include <math.h>

#include "couple/cfdmp.h"
#include "material/material.h"
#include "shape/kinds.h"

int64_t cfdmp_band_depth(int dimension) { return 2 * dimension; }

/* The faces of solids are so many cells behind an open face of the region: the gas sees none. */
static int64_t solid_depth(const struct cfdmp *cfdmp)
{
    static const int64_t least = 3;
    const int64_t band = cfdmp_band_depth(cfdmp->dimension);
    return cfdmp->parameters.overlap + (band > least ? band : least);
}

void cfdmp_blocked(const struct cfdmp *cfdmp, int axis, int64_t at[2])
{
    const int64_t depth = cfdmp->parameters.overlap + cfdmp_band_depth(cfdmp->dimension);
    at[0] = cfdmp->cut.low[axis] + (cfdmp->cut.open[axis][0] ? depth : 0);
    at[1] = cfdmp->cut.high[axis] - (cfdmp->cut.open[axis][1] ? depth : 0);
}

/* Room for the overlap behind each open face, and one band. */
static struct error *check_extent(const struct cfdmp *cfdmp, const struct simulation_case *input)
{
    const int64_t overlap = cfdmp->parameters.overlap, band = cfdmp_band_depth(cfdmp->dimension);
    bool open = false;
    for (int axis = 0; axis < cfdmp->dimension; axis++) {
        const int faces = cfdmp->cut.open[axis][0] + cfdmp->cut.open[axis][1];
        const int64_t cells = cfdmp->cut.high[axis] - cfdmp->cut.low[axis],
                      needed = faces * overlap + band;
        open |= faces > 0;
        if (faces > 0 && cells < needed)
            return input_error(input, "solver", "cfdmp",
                               "the region of the material points has %lld cells along %c: it "
                               "needs %lld, for the overlap of %lld at %s and what gas sees of it",
                               (long long)cells, "xyz"[axis], (long long)needed, (long long)overlap,
                               faces == 1 ? "its open face" : "both faces");
    }
    return open ? NULL
                : input_error(input, "solver", "cfdmp",
                              "the region of the material points fills the domain: enlarge the "
                              "domain, or use `solver: mpm`");
}

/* What is no solid becomes gas, which not every fluid is. */
static struct error *check_fluids(const struct simulation_case *input)
{
    int material = -1;
    bool several = false;
    struct error *error = NULL;
    for (int b = 0; b < input->bodies.count; b++) {
        const int of = case_body(input, b)->material_index;
        several |= !is_solid(input, b) && material >= 0 && of != material;
        material = is_solid(input, b) ? material : of;
    }
    for (int b = 0; b < input->bodies.count; b++) {
        const struct body_input *body = case_body(input, b);
        const struct eos *eos = &case_material(input, body->material_index)->material->eos;
        if (is_solid(input, b))
            continue;
        if (body->driven || body->frozen || !isnan(body->stop))
            error = error_join(error, input_error(input, "bodies", input->bodies.names[b],
                                                  "the solver cfdmp computes a material without "
                                                  "strength as gas, and gas has no prescribed "
                                                  "motion: give \"%s\" a `strength`",
                                                  body->material));
        else if (several && !eos_traits(eos).gas)
            error = error_join(error, input_error(input, "bodies", input->bodies.names[b],
                                                  "the solver cfdmp computes a material without "
                                                  "strength as gas, and of two both must be gases: "
                                                  "give \"%s\" a `strength`, so that it becomes "
                                                  "material points",
                                                  body->material));
    }
    return error;
}

struct error *cfdmp_find_region(struct cfdmp *cfdmp, const struct simulation_case *input,
                                const struct cell_blocks *cells)
{
    const struct couple_region *region = &cfdmp->parameters.region;
    const double margin =
        (double)(cfdmp->parameters.overlap + cfdmp_band_depth(cfdmp->dimension) + 3);
    TRY(check_fluids(input));
    TRY(region_check(region, "cfdmp.region", input, cells));
    for (int axis = 0; axis < 3; axis++) {
        double low = INFINITY, high = -INFINITY;
        cfdmp->cut.low[axis] = cells->low[axis];
        cfdmp->cut.high[axis] = cells->high[axis];
        if (axis >= cfdmp->dimension)
            continue;
        for (int b = 0; b < input->bodies.count; b++) {
            if (!is_solid(input, b))
                continue;
            const struct bounds bounds = shape_bounds(&case_body(input, b)->shape);
            low = minimum(low, vec3_at(bounds.low, axis) / cfdmp->edge - margin);
            high = maximum(high, vec3_at(bounds.high, axis) / cfdmp->edge + margin);
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
        cfdmp->cut.open[axis][0] = cfdmp->cut.low[axis] > cells->low[axis];
        cfdmp->cut.open[axis][1] = cfdmp->cut.high[axis] < cells->high[axis];
    }
    return check_extent(cfdmp, input);
}

/* Bounds of SHAPE from places inside, APART from each other: a shape that others cut may have wide
 * bounds of its own. */
static struct bounds sampled_bounds(const struct one_of *shape, int dimension, double apart)
{
    const struct bounds wide = shape_bounds(shape);
    struct bounds found = {vec3_make(INFINITY, INFINITY, INFINITY),
                           vec3_make(-INFINITY, -INFINITY, -INFINITY)};
    int64_t count[3] = {1, 1, 1}, k[3];
    for (int axis = 0; axis < dimension; axis++)
        count[axis] = 1 + (int64_t)((vec3_at(wide.high, axis) - vec3_at(wide.low, axis)) / apart);
    for (k[2] = 0; k[2] < count[2]; k[2]++)
        for (k[1] = 0; k[1] < count[1]; k[1]++)
            for (k[0] = 0; k[0] < count[0]; k[0]++) {
                double at[3] = {0.0, 0.0, 0.0};
                for (int axis = 0; axis < dimension; axis++)
                    at[axis] = vec3_at(wide.low, axis) + ((double)k[axis] + 0.5) * apart;
                const struct vec3 place = vector_at(at);
                if (shape_inside(shape, place))
                    found = bounds_around(found, (struct bounds){place, place});
            }
    const struct vec3 half = vec3_make(0.5 * apart, 0.5 * apart, 0.5 * apart);
    return (struct bounds){vec3_sub(found.low, half), vec3_add(found.high, half)};
}

/* How far a solid within BOUNDS is from the face of the region across AXIS on SIDE, in cells, less
 * what it must be; where the face is closed, all of it must not be beyond. */
static double room_to_spare(const struct cfdmp *cfdmp, const struct bounds *bounds, int axis,
                            int side, double *room)
{
    const double low = vec3_at(bounds->low, axis) / cfdmp->edge,
                 high = vec3_at(bounds->high, axis) / cfdmp->edge,
                 face = (double)(side ? cfdmp->cut.high : cfdmp->cut.low)[axis];
    const bool open = cfdmp->cut.open[axis][side];
    *room = side ? face - (open ? high : low) : (open ? low : high) - face;
    return *room - (open ? (double)solid_depth(cfdmp) : 0.0) + 1e-6;
}

static bool has_room(const struct cfdmp *cfdmp, const struct bounds *bounds)
{
    bool has = true;
    double room;
    for (int axis = 0; axis < cfdmp->dimension; axis++)
        for (int side = 0; side < 2; side++)
            has &= room_to_spare(cfdmp, bounds, axis, side, &room) >= 0.0;
    return has;
}

/* Solids are in the region, behind what gas sees of it. */
static struct error *check_solids(const struct cfdmp *cfdmp, const struct simulation_case *input)
{
    struct error *error = NULL;
    for (int b = 0; b < input->bodies.count; b++) {
        const struct one_of *shape = &case_body(input, b)->shape;
        if (!is_solid(input, b))
            continue;
        struct bounds bounds = shape_bounds(shape);
        if (has_room(cfdmp, &bounds))
            continue;
        bounds = sampled_bounds(shape, cfdmp->dimension, 0.5 * cfdmp->edge);
        for (int axis = 0; axis < cfdmp->dimension; axis++)
            for (int side = 0; side < 2; side++) {
                double room;
                if (room_to_spare(cfdmp, &bounds, axis, side, &room) >= 0.0)
                    continue;
                error = error_join(
                    error,
                    input_error(
                        input, "bodies", input->bodies.names[b],
                        "this solid is %.6g m %s the face %c = %.6g m of the region of material "
                        "points: it must be %.6g m inside, behind the overlap; enlarge the region, "
                        "or leave it out",
                        fabs(room) * cfdmp->edge, room < 0.0 ? "beyond" : "from", "xyz"[axis],
                        (double)(side ? cfdmp->cut.high : cfdmp->cut.low)[axis] * cfdmp -> edge,
                        (double)solid_depth(cfdmp) * cfdmp -> edge));
            }
    }
    return error;
}

/* Particles go through rigid bodies, so that none may be among them. */
static struct error *check_rigid_bodies(const struct cfdmp *cfdmp,
                                        const struct simulation_case *input)
{
    const int64_t *low = cfdmp->cut.low, *high = cfdmp->cut.high;
    const double h = cfdmp->edge;
    struct error *error = NULL;
    for (int k = 0; k < input->boundaries.count; k++) {
        const struct boundary_input *body = case_boundary(input, k);
        bool found = false;
        if (body->kind != BOUNDARY_RIGID_BODY)
            continue;
        for (int64_t c = low[2]; c < high[2]; c++)
            for (int64_t b = low[1]; b < high[1]; b++)
                for (int64_t a = low[0]; a < high[0] && !found; a++) {
                    const double at[3] = {((double)a + 0.5) * h,
                                          cfdmp->dimension > 1 ? ((double)b + 0.5) * h : 0.0,
                                          cfdmp->dimension > 2 ? ((double)c + 0.5) * h : 0.0};
                    found = shape_inside(&body->part, vec3_make(at[0], at[1], at[2]));
                }
        if (found)
            error = error_join(
                error, input_error(input, "boundaries", input->boundaries.names[k],
                                   "it reaches into the region of material points, which pass "
                                   "through it: make it a body with `driven: yes`, or a smaller "
                                   "`region`"));
    }
    return error;
}

struct error *cfdmp_check_region(const struct cfdmp *cfdmp, const struct simulation_case *input)
{
    return error_join(check_solids(cfdmp, input), check_rigid_bodies(cfdmp, input));
}

/* The region of INPUT, which may be wrong: the run reports it. */
static struct cfdmp region_of(const void *parameters, const struct simulation_case *input,
                              struct cell_blocks *domain)
{
    struct cfdmp cfdmp = {.parameters = *(const struct cfdmp_parameters *)parameters,
                          .dimension = (int)input->dimension};
    cfdmp.edge = part_edge(&cfdmp.parameters.mpm, input);
    *domain = part_domain(input, cfdmp.edge);
    error_free(cfdmp_find_region(&cfdmp, input, domain));
    return cfdmp;
}

struct bounds cfdmp_room(const struct cfdmp_parameters *parameters,
                         const struct simulation_case *input)
{
    struct cell_blocks domain;
    const struct cfdmp cfdmp = region_of(parameters, input, &domain);
    const int64_t depth = solid_depth(&cfdmp);
    double end[2][3] = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
    for (int axis = 0; axis < cfdmp.dimension; axis++) {
        if (cfdmp.cut.open[axis][0])
            end[0][axis] = (double)(cfdmp.cut.low[axis] + depth) * cfdmp.edge;
        if (cfdmp.cut.open[axis][1])
            end[1][axis] = (double)(cfdmp.cut.high[axis] - depth) * cfdmp.edge;
    }
    return (struct bounds){vector_at(end[0]), vector_at(end[1])};
}

void cfdmp_count(const void *parameters, const struct simulation_case *input,
                 struct counted *counted)
{
    struct cell_blocks domain;
    const struct cfdmp cfdmp = region_of(parameters, input, &domain);
    double low[3] = {0.0, 0.0, 0.0}, high[3] = {0.0, 0.0, 0.0}, blocked = 1.0;
    *counted = (struct counted){.cells = 1.0,
                                .bytes = gas_class.bytes(&cfdmp.parameters.gas, cfdmp.dimension)};
    for (int axis = 0; axis < cfdmp.dimension; axis++) {
        int64_t inside[2];
        low[axis] = (double)cfdmp.cut.low[axis] * cfdmp.edge;
        high[axis] = (double)cfdmp.cut.high[axis] * cfdmp.edge;
        cfdmp_blocked(&cfdmp, axis, inside);
        counted->cells *= (double)(domain.high[axis] - domain.low[axis]);
        blocked *= maximum((double)(inside[1] - inside[0]), 0.0);
    }
    if (input->levels > 1) {
        const struct part_maker maker = {NULL, cfdmp.edge, cfdmp.dimension};
        struct place place = place_whole(input);
        place.resolution = cfdmp.edge;
        part_pin(&maker, &place, 0, cfdmp.cut.low, cfdmp.cut.high);
        counted->cells *= gas_part_of_cells(&place);
    }
    counted->cells -= blocked;
    counted->box = (struct bounds){vector_at(low), vector_at(high)};
}
