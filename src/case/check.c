/* What the tables cannot say of a case: names that must exist, numbers of components, states at the
 * start, limits of checks; and what follows from them. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "case/checking.h"
#include "exact/exact.h"
#include "material/material.h"
#include "material/whole.h"
#include "shape/lattice.h"

void case_check_axis(struct checking *checking, const char *key, int axis)
{
    if (case_dimension_known(checking) && axis >= checking->input->dimension)
        case_wrong(checking, key, "the case has %d dimension%s", (int)checking->input->dimension,
                   checking->input->dimension == 1 ? "" : "s");
}

/* The material as plain data: the index of a choice is the enum of its model. A heat capacity of
 * the strength is that of the material which has no other. */
struct error *case_fill_material(struct material_input *material)
{
    struct material *plain = memory_allocate(sizeof *plain);
    if (!plain)
        return out_of_memory();
    material->material = plain;
    plain->heat = material->heat;
    plain->afterburn = material->afterburn;
    plain->composition = material->composition;
    double *const none[] = {&plain->afterburn.energy,      &plain->afterburn.rate,
                            &plain->afterburn.slow_energy, &plain->afterburn.slow_rate,
                            &plain->afterburn.mixing,      &plain->afterburn.load,
                            &plain->composition.formation};
    for (size_t k = 0; k < COUNT_OF(none); k++)
        if (isnan(*none[k]))
            *none[k] = 0.0;
    if (material->eos.value) {
        plain->eos.kind = (enum eos_kind)material->eos.index;
        memcpy(&plain->eos.of, material->eos.value, material->eos.choice->size);
    }
    plain->strength.kind = STRENGTH_NONE;
    if (material->strength.value) {
        plain->strength.kind = (enum strength_kind)material->strength.index;
        memcpy(&plain->strength.of, material->strength.value, material->strength.choice->size);
    }
    if (isnan(plain->heat.capacity))
        plain->heat.capacity = strength_traits(&plain->strength).capacity;
    material->heat.capacity = plain->heat.capacity;
    plain->failure.kind = FAILURE_NONE;
    if (material->failure.value) {
        plain->failure.kind = (enum failure_kind)material->failure.index;
        memcpy(&plain->failure.of, material->failure.value, material->failure.choice->size);
    }
    if (material->burn.value) {
        plain->burn.kind = (enum burn_kind)material->burn.index;
        memcpy(&plain->burn.of, material->burn.value, material->burn.choice->size);
    }
    if (material->eos.value)
        material_complete(plain);
    return NULL;
}

static void check_material(struct checking *checking, int index)
{
    const struct material_input *material = case_material(checking->input, index);
    char path[PATH_TEXT];
    const char *key, *text;
    if (!material->eos.value)
        return;
    if ((text = eos_wrong(&material->material->eos, &key))) {
        snprintf(path, sizeof path, "eos.%s.%s", material->eos.choice->name, key);
        case_wrong(checking, path, "%s", text);
    }
    if ((text = strength_wrong(&material->material->strength, &key))) {
        snprintf(path, sizeof path, "strength.%s.%s", material->strength.choice->name, key);
        case_wrong(checking, path, "%s", text);
    }
    if ((text = failure_wrong(&material->material->failure, &key))) {
        snprintf(path, sizeof path, "failure.%s.%s", material->failure.choice->name, key);
        case_wrong(checking, path, "%s", text);
    }
    if ((text = material_failure_wrong(material->material)))
        case_wrong(checking, "failure", "%s", text);
    const struct afterburn *afterburn = &material->material->afterburn;
    if (afterburn->rate > 0.0 && isnan(material->afterburn.energy))
        case_wrong(checking, "afterburn", "without `energy` it heats nothing: give it");
    if (afterburn->energy > 0.0 && afterburn->rate == 0.0)
        case_wrong(checking, "afterburn", "without `rate` nothing burns: give it");
    if (afterburn->slow_energy > 0.0 && afterburn->slow_rate == 0.0)
        case_wrong(checking, "afterburn", "without `slow_rate` nothing burns slowly: give it");
    if (afterburn->slow_rate > 0.0 && afterburn->slow_energy == 0.0)
        case_wrong(checking, "afterburn", "without `slow_energy` nothing burns slowly: give it");
    if (afterburn->energy == 0.0 &&
        (afterburn->slow_energy > 0.0 || afterburn->air > 0.0 || afterburn->mixing > 0.0))
        case_wrong(checking, "afterburn", "the second stage follows the first: give `energy`");
    const struct composition *of = &material->material->composition;
    if (afterburn->mixing > 0.0 && afterburn->slow_energy > 0.0)
        case_wrong(checking, "afterburn",
                   "`mixing` is in place of a second stage: leave out it or `slow_energy` and "
                   "`slow_rate`");
    if (afterburn->mixing > 0.0 && !composition_is_known(of))
        case_wrong(checking, "afterburn",
                   "`mixing` needs the `composition` of the material, which it does not have");
    if (afterburn->load > 0.0 && afterburn->mixing == 0.0)
        case_wrong(checking, "afterburn", "without `mixing` the load has no effect: leave it out");
    if ((text = material_burn_wrong(material->material)))
        case_wrong(checking, "burn", "%s", text);
}

static void check_replaces(struct checking *checking, const struct body_input *body, int index)
{
    for (int i = 0; i < body->replaces.count; i++) {
        int other = case_find_name(checking, &checking->input->bodies, "body",
                                   body->replaces.names[i], "replaces");
        if (other == index)
            case_wrong(checking, "replaces", "a body cannot replace itself");
    }
}

/* Of two bodies one gives way. */
static void check_mutual(struct checking *checking)
{
    const struct named_map *bodies = &checking->input->bodies;
    struct replacements pairs;
    struct error *error = case_replacements(checking->input, &pairs);
    for (int i = 0; i < pairs.count && !error; i++) {
        const struct replacement *pair = &pairs.at[i];
        const bool again = i > 0 && pair[-1].by == pair->by && pair[-1].of == pair->of;
        if (again || pair->by <= pair->of || !replaces(&pairs, pair->of, pair->by))
            continue;
        checking->name = bodies->names[pair->by];
        case_wrong(checking, "replaces", "\"%s\" replaces this body: only one of the two can",
                   bodies->names[pair->of]);
    }
    checking->name = NULL;
    free(pairs.at);
    checking->error = error_join(checking->error, error);
}

/* A coordinate that the case has not would be zero everywhere, and is a mistake. */
static void check_position(struct checking *checking, const char *key,
                           const struct field_value *field)
{
    const struct simulation_case *input = checking->input;
    if (!field->varying || !case_dimension_known(checking))
        return;
    for (int axis = (int)input->dimension; axis < 3; axis++)
        if (varying_expression_uses(field->varying, axis))
            case_wrong(checking, key, "the case has %d dimension%s, and no position %c",
                       (int)input->dimension, input->dimension == 1 ? "" : "s", "xyz"[axis]);
}

static void check_positions(struct checking *checking, const char *key,
                            const struct field_list *list)
{
    char item[PATH_TEXT];
    for (int i = 0; i < list->count; i++) {
        snprintf(item, sizeof item, "%s.%d", key, i + 1);
        check_position(checking, item, &list->at[i]);
    }
}

/* As many components as a stress has in the dimension of the case; a thin plate bears none
 * across. */
static void check_stress(struct checking *checking, const struct body_input *body)
{
    static const char *const forms[] = {"[xx, yy, zz]", "[xx, yy, zz, xy]",
                                        "[xx, yy, zz, xy, yz, zx]"};
    static const int counts[] = {3, 4, 6};
    const int64_t dimension = checking->input->dimension;
    const struct field_value *across = &body->stress.at[2];
    if (body->stress.count == 0 || !case_dimension_known(checking))
        return;
    if (body->stress.count != counts[dimension - 1])
        case_wrong(checking, "stress", "give %s in %d dimension%s", forms[dimension - 1],
                   (int)dimension, dimension == 1 ? "" : "s");
    else if (checking->input->geometry == GEOMETRY_PLANE_STRESS &&
             (across->varying || across->constant != 0.0))
        case_wrong(checking, "stress.3", "in plane stress the stress zz is zero");
}

static void check_start_keys(struct checking *checking, const struct body_input *body)
{
    check_position(checking, "density", &body->density);
    check_position(checking, "pressure", &body->pressure);
    check_position(checking, "energy", &body->energy);
    check_position(checking, "temperature", &body->temperature);
    check_positions(checking, "velocity", &body->velocity);
    case_check_driven(checking, body);
    check_positions(checking, "stress", &body->stress);
    check_stress(checking, body);
}

/* A state that varies is judged where the particles are. */
static void check_start(struct checking *checking, struct body_input *body)
{
    const char *key;
    char path[PATH_TEXT];
    struct simulation_case *input = checking->input;
    const struct material_input *material = case_material(input, body->material_index);
    snprintf(path, sizeof path, "materials.%s", input->materials.names[body->material_index]);
    if (case_is_wrong(checking, "") || document_is_wrong(input->document, path))
        return;
    const struct material *plain = material->material;
    const char *text = heat_wrong(&plain->heat, &plain->eos);
    if (text && field_is_given(&body->temperature)) {
        case_wrong(checking, "temperature", "the material \"%s\" has no temperature: %s",
                   body->material, text);
        return;
    }
    text = body_start_wrong(body, plain, &key);
    if (!text && !body->varies)
        text = body_state_at(body, plain, (struct vec3){0}, &body->start, &key);
    if (text)
        case_wrong(checking, key, "%s", text);
}

static void check_shape(struct checking *checking, const struct body_input *body)
{
    const struct choice *shape = body->shape.choice;
    if (!shape || !case_dimension_known(checking) || case_is_wrong(checking, shape->name))
        return;
    const int dimension = (int)checking->input->dimension;
    const char *text = shape_wrong(&body->shape, dimension);
    if (text) {
        case_wrong(checking, shape->name, "%s", text);
        return;
    }
    const struct bounds bounds = shape_bounds(&body->shape);
    if (!bounds_finite(&bounds)) {
        case_wrong(checking, shape->name,
                   "this shape is infinite: intersect it with a bounded one");
        return;
    }
    if (!body->lattice.choice || case_is_wrong(checking, "lattice"))
        return;
    text = lattice_wrong(&body->lattice, &body->shape, dimension);
    if (text)
        case_wrong(checking, "lattice", "%s", text);
}

/* Particles of SPH interact by their distances and sizes, and cells are filled by points anyway. */
static void check_weights(struct checking *checking, const struct body_input *body)
{
    const struct choice *solver = checking->input->solver.choice;
    if (body->weights == 0)
        return;
    if (solver && (!strcmp(solver->name, "sph") || !strcmp(solver->name, "gas")))
        case_wrong(checking, "weights",
                   "only material points have weights: leave this out with the "
                   "solver %s",
                   solver->name);
    else if (body->lattice.choice && strcmp(body->lattice.choice->name, "square") != 0)
        case_wrong(checking, "weights", "this needs the lattice `square`");
}

static void check_body(struct checking *checking, int index)
{
    struct simulation_case *input = checking->input;
    struct body_input *body = case_body(input, index);
    body->material_index = -1;
    if (body->material)
        body->material_index =
            case_find_name(checking, &input->materials, "material", body->material, "material");
    body->varies = body_varies(body);
    check_start_keys(checking, body);
    if (body->material_index >= 0)
        check_start(checking, body);
    check_shape(checking, body);
    check_weights(checking, body);
    if (body->velocity.count == 0)
        body->velocity.count = case_dimension_known(checking) ? (int)input->dimension : 0;
    else
        case_check_components(checking, "velocity", body->velocity.count);
    if (body->frozen && (body->driven || !isnan(body->stop)))
        case_wrong(checking, "frozen", "a frozen body keeps its velocity: leave `%s` out",
                   body->driven ? "driven" : "stop");
    if (body->damping > 0.0 && (body->driven || body->frozen))
        case_wrong(checking, "damping", "a %s body keeps its velocity: leave `%s` out",
                   body->driven ? "driven" : "frozen", body->driven ? "driven" : "frozen");
    check_replaces(checking, body, index);
}

static void check_detonation(struct checking *checking, int index)
{
    const struct simulation_case *input = checking->input;
    struct detonation_input *detonation = case_detonation(input, index);
    const struct vector_value *ends[] = {&detonation->at, &detonation->to};
    const char *const keys[] = {"at", "to"};
    static const double farthest = 1e9; /* m; farther away, distances lose all their digits */
    bool same = detonation->to.count == detonation->at.count;
    for (int end = 0; end < 2; end++)
        for (int k = 0; k < ends[end]->count; k++)
            if (!(fabs(ends[end]->at[k]) <= farthest))
                case_wrong(checking, keys[end], "expected a place within %g m", farthest);
    for (int end = 0; end < 2; end++)
        if (ends[end]->count)
            case_check_components(checking, keys[end], ends[end]->count);
    for (int k = 0; k < detonation->at.count; k++)
        same = same && detonation->to.at[k] == detonation->at.at[k];
    if (same && !case_is_wrong(checking, ""))
        case_wrong(checking, "to", "both ends are the same point: leave this out");
    detonation->body = -1;
    if (!detonation->of)
        return;
    detonation->body = case_find_name(checking, &input->bodies, "body", detonation->of, "of");
    if (detonation->body >= 0 && !case_is_wrong(checking, "of") &&
        case_body(input, detonation->body)->material_index >= 0 &&
        !detonation_lights(input, index, detonation->body))
        case_wrong(checking, "of",
                   "the material of this body has no `burn` that needs an ignition");
}

/* Every body that burns is lit by something. */
static void check_lit(struct checking *checking, int body)
{
    const struct simulation_case *input = checking->input;
    const int material = case_body(input, body)->material_index;
    if (material < 0 || !material_is_lit(case_material(input, material)->material) ||
        document_is_wrong(input->document, "detonations"))
        return;
    for (int i = 0; i < input->detonations.count; i++)
        if (detonation_lights(input, i, body))
            return;
    case_wrong(checking, "", "nothing ignites this explosive: give a point in `detonations`");
}

/* What is said of a surface must act there. */
static void check_surface(struct checking *checking, const struct contact_input *contact)
{
    const bool opens = contact->tension == TENSION_NONE, slips = contact->shear == SHEAR_SLIP;
    if (contact->friction > 0.0 && !slips)
        case_wrong(checking, "friction", "bodies that stick have no friction: give `shear: slip`");
    if (contact->touch == TOUCH_SURFACES && !opens)
        case_wrong(checking, "touch", "this is for bodies that may separate: give `tension: none`");
    if (contact->normal != NORMAL_MEAN && !slips && !opens)
        case_wrong(
            checking, "normal",
            "this is for bodies that slip or may separate: give `shear: slip` or `tension: none`");
}

static void check_contact(struct checking *checking, int index)
{
    struct simulation_case *input = checking->input;
    struct contact_input *contact = case_contact(input, index);
    contact->body[0] = contact->body[1] = -1;
    check_surface(checking, contact);
    if (contact->between.count == 0 && case_is_wrong(checking, ""))
        return;
    if (contact->between.count != 2) {
        case_wrong(checking, "between", "expected two bodies, found %d", contact->between.count);
        return;
    }
    for (int i = 0; i < 2; i++)
        contact->body[i] =
            case_find_name(checking, &input->bodies, "body", contact->between.names[i], "between");
    if (contact->body[0] < 0 || contact->body[1] < 0)
        return;
    if (contact->body[0] == contact->body[1])
        case_wrong(checking, "between", "the two bodies must be different");
    bool told = false;
    for (int i = 0; i < index && !told; i++) {
        const struct contact_input *other = case_contact(input, i);
        told = (other->body[0] == contact->body[0] && other->body[1] == contact->body[1]) ||
               (other->body[0] == contact->body[1] && other->body[1] == contact->body[0]);
        if (told)
            case_wrong(checking, "between", "\"%s\" already names these two",
                       input->contacts.names[i]);
    }
}

void case_check_between(struct checking *checking, const struct vector_value *between)
{
    if (between->count != 0 && !(between->count == 2 && between->at[0] < between->at[1]))
        case_wrong(checking, "between", "expected two positions, the smaller first");
}

static void check_probe(struct checking *checking, int index)
{
    const struct probe_input *probe = case_probe(checking->input, index);
    case_find_members(checking, probe->of);
    case_check_between(checking, &probe->between);
    case_check_axis(checking, "axis", probe->axis);
    case_check_interval(checking, "every", probe->every);
}

static void check_profile(struct checking *checking, int index)
{
    const struct profile_input *profile = case_profile(checking->input, index);
    case_find_members(checking, profile->of);
    case_check_between(checking, &profile->between);
    case_check_axis(checking, "along", profile->along);
}

static void check_expected(struct checking *checking, int index)
{
    const struct simulation_case *input = checking->input;
    const struct expected_warning_input *expected = case_expected_warning(input, index);
    for (int i = 0; i < expected->of.count; i++)
        case_find_name(checking, &input->materials, "material", expected->of.names[i], "of");
    if (expected->reason && !expected->reason[0])
        case_wrong(checking, "reason", "a reason is required");
}

static void check_map(struct checking *checking, const char *key, const struct named_map *map,
                      void (*check)(struct checking *, int))
{
    checking->map = key;
    for (int i = 0; i < map->count; i++) {
        checking->name = map->names[i];
        check(checking, i);
    }
    checking->name = NULL;
}

static void check_geometry(struct checking *checking)
{
    checking->map = "geometry";
    const int geometry = checking->input->geometry,
              dimension = geometry >= GEOMETRY_CYLINDRICAL ? 1 : 2;
    if (case_dimension_known(checking) && geometry != GEOMETRY_PLANE_STRAIN &&
        checking->input->dimension != dimension)
        case_wrong(checking, "", "this is of %s: the case has %d",
                   dimension == 1 ? "one dimension" : "two dimensions",
                   (int)checking->input->dimension);
}

/* Gives the exact solution EXACT, at KEY with its dot, the materials that it names. */
static void take_material(struct checking *checking, const char *key, struct one_of *exact)
{
    const struct exact_class *class = exact->choice ? exact->choice->thing : NULL;
    for (int k = 0; class && class->material_name && exact->value && k < EXACT_MATERIALS; k++) {
        char path[PATH_TEXT];
        const char *own, *name = class->material_name(exact->value, k, &own);
        snprintf(path, sizeof path, "%s%s.%s", key, exact->choice->name, own);
        struct named_map *materials = &checking->input->materials;
        const int index = name ? case_find_name(checking, materials, "material", name, path) : -1;
        if (index >= 0)
            class->take_material(exact->value, k, case_material(checking->input, index)->material);
    }
}

static void take_check_material(struct checking *checking, int index)
{
    take_material(checking, "against.", &case_check(checking->input, index)->against);
}

struct error *case_check_meaning(struct simulation_case *input)
{
    struct checking checking = {.input = input};
    for (int i = 0; i < input->materials.count; i++)
        TRY(case_fill_material(case_material(input, i)));
    case_check_texts(&checking);
    check_geometry(&checking);
    check_map(&checking, "materials", &input->materials, check_material);
    if (input->bodies.count == 0 && !document_is_wrong(input->document, "")) {
        checking.map = "bodies";
        case_wrong(&checking, "", "at least one body is needed");
    }
    check_map(&checking, "bodies", &input->bodies, check_body);
    check_mutual(&checking);
    check_map(&checking, "contacts", &input->contacts, check_contact);
    check_map(&checking, "detonations", &input->detonations, check_detonation);
    check_map(&checking, "bodies", &input->bodies, check_lit);
    case_check_domain(&checking);
    case_check_start(&checking);
    check_map(&checking, "boundaries", &input->boundaries, case_check_boundary);
    check_map(&checking, "fine", &input->fine, case_check_fine);
    check_map(&checking, "loads", &input->loads, case_check_load);
    case_check_gravity(&checking);
    checking.map = "output";
    case_check_interval(&checking, "every", input->output.every);
    case_check_interval(&checking, "history", input->output.history);
    check_map(&checking, "output.maps", &input->output.maps, case_check_map);
    check_map(&checking, "probes", &input->probes, check_probe);
    check_map(&checking, "profiles", &input->profiles, check_profile);
    checking.map = "exact";
    checking.name = NULL;
    take_material(&checking, "", &input->exact);
    check_map(&checking, "checks", &input->checks, take_check_material);
    check_map(&checking, "checks", &input->checks, case_check_check);
    check_map(&checking, "fits", &input->fits, case_check_fit);
    case_check_repetitions(&checking);
    check_map(&checking, "expected_warnings", &input->expected, check_expected);
    case_check_study(&checking);
    check_map(&checking, "convergence.order", &input->convergence.order, case_check_order);
    case_check_calibrate(&checking);
    const bool sound = !checking.error && !document_is_wrong(input->document, "");
    for (int b = 0; b < input->boundaries.count && sound; b++) {
        struct boundary_input *boundary = case_boundary(input, b);
        boundary->place = boundary->at;
        if (boundary->axis >= 0 && isnan(boundary->at))
            boundary->place = domain_face(input, boundary->axis, boundary->side == SIDE_HIGH).at;
        if (boundary->kind == BOUNDARY_PERIODIC)
            boundary->opposite = domain_face(input, boundary->axis, SIDE_HIGH).at;
    }
    return checking.error;
}
