/* What of a case the gas solver cannot do, told where it stands in the case. */
#include "gas/gas_internal.h"
#include "material/material.h"

static struct error *refuse_map(const struct simulation_case *input, const char *section,
                                const struct named_map *map, const char *text)
{
    return map->count == 0 ? NULL : input_error(input, section, map->names[0], "%s", text);
}

static struct error *refuse_body(const struct simulation_case *input, int index)
{
    const struct body_input *body = case_body(input, index);
    const char *name = input->bodies.names[index];
    struct error *error = NULL;
    if (body->driven || body->frozen || !isnan(body->stop))
        error = input_error(input, "bodies", name,
                            "the solver gas cannot hold a body: gas flows through its cells; an "
                            "obstacle is rigid, and a boundary of kind inflow has a velocity");
    if (!isnan(body->resolution))
        error = error_join(error, input_error(input, "bodies", name,
                                              "the solver gas has cells of one size: leave the "
                                              "body's resolution out"));
    return error;
}

/* One material, a fluid whose pressure follows from its density and energy alone. */
static struct error *refuse_materials(const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    const int first = case_body(input, 0)->material_index;
    const struct material *material = &simulation->problem->material[first];
    const char *name = input->materials.names[first], *text = NULL;
    for (int b = 1; b < input->bodies.count; b++)
        if (case_body(input, b)->material_index != first)
            return input_error(input, "bodies", input->bodies.names[b],
                               "the solver gas computes one material, and this is the second: "
                               "\"%s\", beside \"%s\"",
                               case_body(input, b)->material, name);
    if (material_has_strength(material))
        text = "the solver gas computes fluids: leave the strength out";
    else if (material_burns(material))
        text = "the solver gas does not burn explosives: leave `burn` out and begin with products";
    else if (material_history(material))
        text = "the solver gas keeps no history of a material: choose another equation of state";
    return text ? input_error(input, "materials", name, "%s", text) : NULL;
}

struct error *gas_refuse(const struct simulation *simulation)
{
    const struct simulation_case *input = simulation->problem->input;
    struct error *error = NULL;
    if (simulation->problem->geometry == GEOMETRY_PLANE_STRESS)
        error = input_error(input, "geometry", NULL, "the solver gas has no plane stress");
    error = error_join(error, refuse_map(input, "contacts", &input->contacts,
                                         "bodies of gas have no surfaces in the solver gas"));
    error = error_join(error, refuse_map(input, "loads", &input->loads,
                                         "bodies of gas have no surfaces in the solver gas; a "
                                         "boundary of kind inflow pushes"));
    error = error_join(error, refuse_map(input, "outflows", &input->outflows,
                                         "outflows are for particles: use a boundary of kind "
                                         "transmitting"));
    error = error_join(error, refuse_map(input, "detonations", &input->detonations,
                                         "the solver gas does not burn explosives"));
    for (int b = 0; b < input->bodies.count; b++)
        error = error_join(error, refuse_body(input, b));
    return error_join(error, refuse_materials(simulation));
}
