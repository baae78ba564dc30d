/* What of a case the gas solver cannot do, told where it stands in the case. */
#include <stdio.h>

#include "gas/gas_internal.h"
#include "gas/gas_phases.h"
#include "material/material.h"
#include "model/boundaries.h"
#include "shape/shape.h"

static void refuse_map(struct findings *findings, const char *section, const struct named_map *map,
                       const char *text)
{
    if (map->count > 0)
        finding_add(findings, FINDING_WRONG, section, map->names[0], "%s", text);
}

static void refuse_body(const struct place *place, int index, struct findings *findings)
{
    const struct simulation_case *input = place->input;
    const struct body_input *body = case_body(input, index);
    const char *name = input->bodies.names[index];
    if (!place_has(place, index))
        return;
    if (body->driven || body->frozen || !isnan(body->stop))
        finding_add(findings, FINDING_WRONG, "bodies", name,
                    "the solver gas cannot hold a body: gas flows through its cells; an "
                    "obstacle is rigid, and a boundary of kind inflow has a velocity");
    if (!isnan(body->resolution) && !place->is_part)
        finding_add(findings, FINDING_WRONG, "bodies", name,
                    "the solver gas has cells of one size: leave the "
                    "body's resolution out");
}

void gas_find_materials(const struct simulation *simulation, int material[2])
{
    const struct simulation_case *input = simulation->problem->input;
    const struct place *place = &simulation->problem->place;
    int first = 0;
    while (first + 1 < input->bodies.count && !place_has(place, first))
        first++;
    material[0] = material[1] = case_body(input, first)->material_index;
    if (input->start.input && input->start.material_index >= 0)
        material[1] = input->start.material_index;
    for (int b = 1; b < input->bodies.count && material[1] == material[0]; b++)
        if (place_has(place, b) && case_body(input, b)->material_index != material[0])
            material[1] = case_body(input, b)->material_index;
    const struct material *of = simulation->problem->material;
    const double density[2] = {eos_reference_density(&of[material[0]].eos),
                               eos_reference_density(&of[material[1]].eos)};
    if (density[1] < density[0] || (density[1] == density[0] && material[1] < material[0])) {
        const int denser = material[0];
        material[0] = material[1];
        material[1] = denser;
    }
}

/* Whether pressures grow in proportion to the energy at each density. */
static bool is_linear(const struct eos *eos)
{
    static const double part[] = {0.001, 0.1, 0.7, 1.0, 1.2}, energy[] = {0.0, 1e4, 2e6};
    const double none[POINT_HISTORY] = {0.0};
    for (int k = 0; k < (int)COUNT_OF(part); k++) {
        const double density = part[k] * eos_reference_density(eos);
        struct eos_value value[COUNT_OF(energy)];
        for (int n = 0; n < (int)COUNT_OF(energy); n++)
            value[n] = eos_evaluate(eos, density, energy[n], none);
        for (int n = 0; n < (int)COUNT_OF(energy); n++) {
            const double pressure = value[0].pressure + value[0].dp_de * energy[n];
            if (!(value[0].dp_de > 0.0) ||
                fabs(value[n].pressure - pressure) > 1e-9 * value[0].dp_de * energy[2])
                return false;
        }
    }
    return true;
}

/* Whether it is a liquid whose pressure has a floor, so that the history of its failure is not
 * needed. */
static bool cavitates(const struct material *material)
{
    return failure_traits(&material->failure).of_fluids && eos_traits(&material->eos).stiffened &&
           !material_burns(material);
}

double gas_floor_of(const struct material *material, bool another)
{
    const struct eos_traits traits = eos_traits(&material->eos);
    const double least = failure_traits(&material->failure).least;
    return traits.gas || material_burns(material) ? -(double)INFINITY
           : another                              ? maximum(least, 0.0)
                                                  : least;
}

/* A fluid whose pressure follows from its density and energy alone. */
static const char *refuse_material(const struct material *material)
{
    if (material_has_strength(material))
        return "the solver gas computes fluids: leave the strength out";
    if (material_burns(material) && !burn_traits(&material->burn).by_time)
        return "the solver gas burns explosives as programmed: choose `burn: programmed`, or leave "
               "`burn` out and begin with products";
    if (material_burns(material) && !is_linear(&material->eos))
        return "the solver gas burns explosives whose products have a pressure that grows in "
               "proportion to the energy: choose `eos: jwl`";
    if (material_history(material) && !material_is_lit(material) && !cavitates(material))
        return "the solver gas keeps no history of a material: choose another equation of state";
    return NULL;
}

/* Couplings know no floors. */
bool gas_computes(const struct material *material)
{
    return !refuse_material(material) && !material_fails(material);
}

/* Two materials at most. */
static void refuse_materials(const struct simulation *simulation,
                             const struct gas_parameters *parameters, struct findings *findings)
{
    const struct simulation_case *input = simulation->problem->input;
    const struct material *of = simulation->problem->material;
    int material[2];
    gas_find_materials(simulation, material);
    const bool two = material[0] != material[1];
    for (int b = 0; b < input->bodies.count; b++) {
        const int m = case_body(input, b)->material_index;
        if (m != material[0] && m != material[1] && place_has(&simulation->problem->place, b)) {
            finding_add(findings, FINDING_WRONG, "bodies", input->bodies.names[b],
                        "the solver gas computes two materials at most, and this is another "
                        "one: \"%s\", beside \"%s\" and \"%s\"",
                        case_body(input, b)->material, input->materials.names[material[0]],
                        input->materials.names[material[1]]);
            return;
        }
    }
    for (int k = 0; k <= two; k++) {
        const char *text = refuse_material(&of[material[k]]);
        const struct eos *eos = &of[material[k]].eos;
        if (!text && two && !((eos_traits(eos).gas || eos_traits(eos).stiffened) && is_linear(eos)))
            text = "beside a second material the solver gas computes gases that never pull, and "
                   "liquids, "
                   "whose pressure grows in proportion to the energy: ideal-gas, noble-abel, "
                   "stiffened-gas and jwl of products";
        if (!text && two && !eos_traits(eos).gas && !material_burns(&of[material[k]]) &&
            parameters->method.index == GAS_LAX_WENDROFF)
            text = "lax-wendroff divides two gases: leave the method out beside a liquid";
        if (text)
            finding_add(findings, FINDING_WRONG, "materials", input->materials.names[material[k]],
                        "%s", text);
    }
    const bool lit[2] = {material_is_lit(&of[material[0]]), material_is_lit(&of[material[1]])};
    if (two && lit[0])
        finding_add(findings, FINDING_WRONG, "materials", input->materials.names[material[0]],
                    "the solver gas burns one explosive, the denser of "
                    "two materials: leave `burn` out");
    if (two && of[material[0]].afterburn.energy > 0.0)
        finding_add(findings, FINDING_WRONG, "materials", input->materials.names[material[0]],
                    "the denser of two materials burns in the other: "
                    "leave `afterburn` out");
    if (two && of[material[1]].afterburn.mixing > 0.0 &&
        isnan(eos_ratio_of_heats(&of[material[0]].eos)))
        finding_add(findings, FINDING_WRONG, "materials", input->materials.names[material[0]],
                    "products mix with an ideal gas: choose `eos: ideal-gas`, or leave "
                    "`afterburn.mixing` of \"%s\" out",
                    input->materials.names[material[1]]);
    if (!two && of[material[0]].afterburn.energy > 0.0)
        finding_add(findings, FINDING_WRONG, "materials", input->materials.names[material[0]],
                    "products burn in a second material, the air: leave "
                    "`afterburn` out, or fill the space around them");
    if (two && of[material[1]].afterburn.energy > 0.0 && !eos_traits(&of[material[0]].eos).gas)
        finding_add(findings, FINDING_WRONG, "materials", input->materials.names[material[1]],
                    "products burn in air, not in a liquid: leave `afterburn` out");
    const bool marked = parameters->method.index == GAS_LAX_WENDROFF;
    if ((lit[0] || lit[1]) && marked && !parameters->burnt)
        finding_add(findings, FINDING_WRONG, "solver", NULL,
                    "lax-wendroff does not burn explosives: leave the "
                    "method out");
    if (two && marked && of[material[1]].afterburn.energy > 0.0)
        finding_add(findings, FINDING_WRONG, "solver", NULL,
                    "lax-wendroff does not burn products in the air: "
                    "leave the method or `afterburn` out");
    if (two && marked && input->start.input)
        finding_add(findings, FINDING_WRONG, "start", NULL,
                    "lax-wendroff with two materials begins with bodies: "
                    "leave the method or `start` out");
    if (two && marked && simulation->ranks->size > 1)
        finding_add(findings, FINDING_WRONG, "solver", NULL,
                    "lax-wendroff with two materials runs on one rank");
    for (int b = 0; two && b < input->boundaries.count; b++)
        if (case_boundary(input, b)->kind == BOUNDARY_PERIODIC && marked)
            finding_add(findings, FINDING_WRONG, "boundaries", input->boundaries.names[b],
                        "no periodic faces with lax-wendroff and two materials: "
                        "leave the method out");
        else if (case_boundary(input, b)->kind == BOUNDARY_INFLOW)
            finding_add(findings, FINDING_WRONG, "boundaries", input->boundaries.names[b],
                        "no inflow beside a second material: leave one of the two "
                        "materials out, or let gas flow in from a body");
}

/* What there is not yet for cells of several levels. */
static void refuse_levels(const struct simulation *simulation,
                          const struct gas_parameters *parameters, struct findings *findings)
{
    const struct simulation_case *input = simulation->problem->input;
    const struct material *of = simulation->problem->material;
    int material[2];
    gas_find_materials(simulation, material);
    const char *text = NULL;
    if (parameters->method.index == GAS_LAX_WENDROFF)
        text = "several levels of cells need the method muscl-hancock";
    else if (!eos_traits(&of[material[0]].eos).gas || !eos_traits(&of[material[1]].eos).gas)
        text = "several levels of cells hold gases, no liquids";
    else if (input->output.maps.count > 0 || !isnan(parameters->ambient))
        text = "with several levels of cells there are no `maps`: leave them and `ambient` out";
    if (text)
        finding_add(findings, FINDING_WRONG, "levels", NULL, "%s", text);
    if (parameters->center.count && parameters->center.count != input->dimension)
        finding_add(findings, FINDING_WRONG, "solver", "gas.center",
                    "expected %d component%s, one per dimension", (int)input->dimension,
                    input->dimension == 1 ? "" : "s");
}

void gas_refuse(const struct simulation *simulation, const struct gas_parameters *parameters,
                struct findings *findings)
{
    const struct place *place = &simulation->problem->place;
    const struct simulation_case *input = place->input;
    if (simulation->problem->geometry == GEOMETRY_PLANE_STRESS)
        finding_add(findings, FINDING_WRONG, "geometry", NULL,
                    "the solver gas has no plane stress");
    if (!place->is_part) {
        refuse_map(findings, "contacts", &input->contacts,
                   "bodies of gas have no surfaces in the solver gas");
        refuse_map(findings, "loads", &input->loads,
                   "bodies of gas have no surfaces in the solver gas; a "
                   "boundary of kind inflow pushes");
    }
    boundaries_refuse(findings, gas_class.boundaries);
    findings_take(findings, FINDING_WRONG, gas_check_start(simulation));
    for (int b = 0; b < input->bodies.count; b++)
        refuse_body(place, b, findings);
    refuse_materials(simulation, parameters, findings);
    if (input->levels > 1)
        refuse_levels(simulation, parameters, findings);
}

/* The centre of cell K of the COUNT of a box that begins at LOW; along an axis across which the box
 * is a face, -1 for none, the place of the face at PLANE. */
static struct vec3 centre_of(const int64_t low[3], const int64_t count[3], int64_t k, int face,
                             int64_t plane, double edge, int dimension)
{
    double at[3] = {0.0, 0.0, 0.0};
    for (int axis = 0; axis < dimension; axis++) {
        at[axis] = ((double)(low[axis] + k % count[axis]) + 0.5) * edge;
        if (axis == face)
            at[axis] = (double)plane * edge;
        k /= count[axis];
    }
    return vec3_make(at[0], at[1], at[2]);
}

static int64_t common_divisor(int64_t a, int64_t b)
{
    while (b) {
        const int64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* A step through ALL places that comes to each of them once, and soon to every region. */
static int64_t spread_step(int64_t all)
{
    int64_t step = (int64_t)(0.618034 * (double)all);
    while (step > 1 && common_divisor(step, all) != 1)
        step--;
    return step > 0 ? step : 1;
}

/* Whether some cell of the domain is open. */
static bool any_open(const struct place *place, const struct cell_blocks *cells)
{
    int64_t count[3], all = 1, k = 0;
    for (int axis = 0; axis < 3; axis++)
        all *= count[axis] = cells->high[axis] - cells->low[axis];
    const int64_t step = spread_step(all);
    for (int64_t tried = 0; tried < all; tried++, k = (k + step) % all)
        if (!place_blocks(place,
                          centre_of(cells->low, count, k, -1, 0, cells->edge, cells->dimension)))
            return true;
    return false;
}

/* Whether the part of BOUNDARY holds the centre of some cell's face. */
static bool part_holds_any(const struct boundary_input *boundary, const struct cell_blocks *cells)
{
    int64_t count[3], all = 1;
    for (int axis = 0; axis < 3; axis++)
        all *= count[axis] = axis == boundary->axis ? 1 : cells->high[axis] - cells->low[axis];
    const int64_t plane = (boundary->side ? cells->high : cells->low)[boundary->axis];
    for (int64_t k = 0; k < all; k++)
        if (shape_inside(&boundary->part, centre_of(cells->low, count, k, boundary->axis, plane,
                                                    cells->edge, cells->dimension)))
            return true;
    return false;
}

struct error *gas_check_shapes(const struct simulation *simulation, const struct cell_blocks *cells)
{
    const struct simulation_case *input = simulation->problem->input;
    struct error *error = NULL;
    if (has_rigid_body(input) && !any_open(&simulation->problem->place, cells))
        error = input_error(input, "boundaries", NULL,
                            "rigid bodies block all cells of the domain: leave room for the gas");
    for (int b = 0; b < input->boundaries.count; b++) {
        const struct boundary_input *boundary = case_boundary(input, b);
        char name[160];
        if (!boundary->part.choice || boundary->axis < 0 || part_holds_any(boundary, cells))
            continue;
        snprintf(name, sizeof name, "%.100s.part", input->boundaries.names[b]);
        error = error_join(
            error,
            input_error(input, "boundaries", name,
                        "no cell at the face %c = %.6g m has the centre of its outer side in "
                        "this shape: move or enlarge it",
                        "xyz"[boundary->axis],
                        (double)(boundary->side ? cells->high : cells->low)[boundary->axis] *
                            cells -> edge));
    }
    return error;
}
