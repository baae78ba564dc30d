/* What a run knows before it has members: materials, faces and the contact laws between groups of
 * bodies, checked against the case. */
#include "model/problem.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "material/material.h"
#include "model/boundaries.h"
#include "model/solver.h"

struct error *input_error(const struct simulation_case *input, const char *section,
                          const char *name, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char *text = text_vformat(format, arguments);
    va_end(arguments);
    char *path = name ? text_format("%s.%s", section, name) : text_copy(section);
    struct error *error;
    if (!text || !path)
        error = out_of_memory();
    else if (input->document)
        error = document_error(input->document, path, "%s", text);
    else
        error = error_new(ERROR_INPUT, "%s: %s", path, text);
    free(text);
    free(path);
    return error;
}

/* The laws of the bodies that contacts name, by a number of their own from 1 on; 0 stands for all
 * other bodies. An entry is 0 for a pair that no contact names, else 1 + its law. */
struct law_table {
    int count;      /* of numbers, 0 included */
    int *number;    /* of each body */
    uint8_t *entry; /* count x count */
};

static uint8_t *law_entry(const struct law_table *table, int first, int second)
{
    return &table->entry[(size_t)first * (size_t)table->count + (size_t)second];
}

static int law_of(const struct law_table *table, int first, int second)
{
    const int entry = *law_entry(table, first, second);
    return entry ? entry - 1 : 0;
}

/* The number of the surface with these values, which becomes one if there is none yet;
 * CONTACT_SURFACES when there are too many. */
static int surface_of(struct problem *problem, struct contact_surface surface)
{
    int k = 0;
    problem->surfaces = problem->surfaces ? problem->surfaces : 1;
    while (k < problem->surfaces && (problem->surface[k].friction != surface.friction ||
                                     problem->surface[k].normal != surface.normal ||
                                     problem->surface[k].touch != surface.touch))
        k++;
    if (k == problem->surfaces && k < CONTACT_SURFACES)
        problem->surface[problem->surfaces++] = surface;
    return k;
}

/* The laws of a contact, of its first body towards the second and the other way; false when there
 * are too many. */
static bool laws_of(struct problem *problem, const struct contact_input *contact, int law[2])
{
    static const int turned[] = {[NORMAL_MEAN] = NORMAL_MEAN,
                                 [NORMAL_FIRST] = NORMAL_SECOND,
                                 [NORMAL_SECOND] = NORMAL_FIRST};
    const int bits = (contact->shear == SHEAR_SLIP ? LAW_SLIP : 0) |
                     (contact->tension == TENSION_NONE ? LAW_NO_TENSION : 0);
    const int touch = contact->touch >= 0                ? contact->touch
                      : contact->tension == TENSION_NONE ? TOUCH_SURFACES
                                                         : TOUCH_NODES;
    bool room = true;
    for (int side = 0; side < 2; side++) {
        const int normal = side ? turned[contact->normal] : contact->normal;
        const int surface = surface_of(
            problem, (struct contact_surface){contact->friction, bits ? normal : NORMAL_MEAN,
                                              bits ? touch : TOUCH_NODES});
        law[side] = bits | LAW_SURFACE * surface;
        room &= surface < CONTACT_SURFACES;
    }
    return room;
}

static struct error *law_table_make(struct problem *problem, struct law_table *table)
{
    const struct simulation_case *input = problem->input;
    table->number = memory_allocate((size_t)input->bodies.count * sizeof *table->number);
    if (!table->number)
        return out_of_memory();
    table->count = 1;
    for (int i = 0; i < input->contacts.count; i++)
        for (int side = 0; side < 2; side++) {
            int *number = &table->number[case_contact(input, i)->body[side]];
            if (*number == 0)
                *number = table->count++;
        }
    table->entry = memory_allocate((size_t)table->count * (size_t)table->count);
    if (!table->entry)
        return out_of_memory();
    struct error *error = NULL;
    for (int i = 0; i < input->contacts.count; i++) {
        const struct contact_input *contact = case_contact(input, i);
        const char *name = input->contacts.names[i];
        const int first = table->number[contact->body[0]], second = table->number[contact->body[1]];
        int law[2];
        struct error *mistake = NULL;
        if (first == second)
            mistake = input_error(input, "contacts", name, "`between` needs two different bodies");
        else if (*law_entry(table, first, second))
            mistake =
                input_error(input, "contacts", name, "another contact names the same two bodies");
        if (!laws_of(problem, contact, law))
            mistake = error_join(mistake,
                                 input_error(input, "contacts", name,
                                             "more than %d different surfaces", CONTACT_SURFACES));
        error = error_join(error, mistake);
        *law_entry(table, first, second) = (uint8_t)(1 + law[0]);
        *law_entry(table, second, first) = (uint8_t)(1 + law[1]);
    }
    return error;
}

/* Two bodies may share a group when nothing tells them apart: full contact with each other, and the
 * same law towards each third body. */
static bool same_laws(const struct law_table *table, int first, int second)
{
    bool same = law_of(table, first, second) == 0;
    for (int third = 0; third < table->count && same; third++)
        if (third != first && third != second)
            same = law_of(table, first, third) == law_of(table, second, third);
    return same;
}

static struct error *group_bodies(const struct law_table *table, struct problem *problem)
{
    const struct simulation_case *input = problem->input;
    int groups = 0, speaker[CONTACT_GROUPS]; /* the number whose laws are those of the group */
    for (int body = 0; body < input->bodies.count; body++) {
        const int number = table->number[body];
        int group = 0;
        while (group < groups && speaker[group] != number &&
               !same_laws(table, speaker[group], number))
            group++;
        if (group == CONTACT_GROUPS)
            return input_error(input, "contacts", NULL,
                               "the bodies fall into more than %d groups of different contact laws",
                               CONTACT_GROUPS);
        if (group == groups)
            speaker[groups++] = number;
        problem->group_of_body[body] = (uint8_t)group;
    }
    for (int i = 0; i < groups; i++)
        for (int j = 0; j < groups; j++)
            problem->law[i][j] = (uint8_t)law_of(table, speaker[i], speaker[j]);
    return NULL;
}

static struct error *set_contacts(struct problem *problem)
{
    const struct simulation_case *input = problem->input;
    problem->group_of_body = memory_allocate((size_t)input->bodies.count);
    if (!problem->group_of_body)
        return out_of_memory();
    struct law_table table = {0};
    struct error *error = law_table_make(problem, &table);
    if (!error)
        error = group_bodies(&table, problem);
    free(table.number);
    free(table.entry);
    return error;
}

void refuse_broken_contacts(const struct problem *problem, struct findings *findings)
{
    for (int m = 0; m < problem->materials; m++)
        if (failure_traits(&problem->material[m].failure).at_contacts)
            finding_add(findings, FINDING_WRONG, "materials", problem->input->materials.names[m],
                        "`failure: threshold` is for contacts of particles that break, "
                        "which `method: contact` and `method: standard` of the solver "
                        "sph have: choose one, or `failure: spall`");
}

void refuse_standing_spall(const struct problem *problem, struct findings *findings)
{
    for (int m = 0; m < problem->materials; m++)
        if (failure_waits(&problem->material[m].failure))
            finding_add(findings, FINDING_WRONG, "materials", problem->input->materials.names[m],
                        "`onset: standing` of spall is for the solver sph and its default method");
}

/* The store keeps the number of a body in 16 bits. */
static struct error *check_counts(const struct simulation_case *input)
{
    struct error *error = NULL;
    if (input->bodies.count > UINT16_MAX)
        error = input_error(input, "bodies", NULL, "a case can have at most %d bodies", UINT16_MAX);
    if (input->materials.count > MATERIALS_MAX)
        error =
            error_join(error, input_error(input, "materials", NULL,
                                          "a case can have at most %d materials", MATERIALS_MAX));
    return error;
}

/* SPH leaves hot thin metal its strength: without it the particles of a crater's debris swell and
 * shrink so fast that steps get a hundred times shorter. */
static bool by_sph(const struct simulation_case *input)
{
    return input->solver.choice && strcmp(input->solver.choice->name, "sph") == 0;
}

struct error *problem_create(const struct place *place, struct problem *problem)
{
    const struct simulation_case *input = place->input;
    *problem = (struct problem){.input = input,
                                .place = *place,
                                .dimension = (int)input->dimension,
                                .geometry = (enum case_geometry)input->geometry,
                                .materials = input->materials.count};
    TRY(check_counts(input));
    problem->material = memory_allocate((size_t)problem->materials * sizeof *problem->material);
    if (!problem->material)
        return out_of_memory();
    memcpy(problem->gravity, input->gravity.at, sizeof problem->gravity);
    for (int i = 0; i < input->materials.count; i++) {
        problem->material[i] = *case_material(input, i)->material;
        if (by_sph(input))
            problem->material[i].melting = (struct melting){0};
    }
    problem->images = boundaries_images(place->face);
    return set_contacts(problem);
}

void problem_destroy(struct problem *problem)
{
    free(problem->group_of_body);
    free(problem->material);
    *problem = (struct problem){0};
}

int problem_history(const struct problem *problem, struct field_declaration *fields)
{
    unsigned needed = 0;
    int count = 0;
    for (int m = 0; m < problem->materials; m++)
        needed |= material_history(&problem->material[m]);
    for (int slot = 0; slot < POINT_HISTORY; slot++)
        if (needed & 1u << slot)
            fields[count++] = (struct field_declaration){history_slots[slot].name,
                                                         history_slots[slot].unit,
                                                         history_slots[slot].help,
                                                         NUMBER_DOUBLE,
                                                         1,
                                                         FIELD_STATE | history_slots[slot].range};
    return count;
}

bool problem_afterburns(const struct problem *problem)
{
    bool any = false;
    for (int m = 0; m < problem->materials; m++)
        any |= problem->material[m].afterburn.energy > 0.0;
    return any;
}

void problem_refuse_gas_keys(const struct problem *problem, struct findings *findings)
{
    const struct simulation_case *input = problem->input;
    if (geometry_power(input->geometry) > 0 && input->dimension == 1)
        finding_add(findings, FINDING_WRONG, "geometry", NULL,
                    "the solver gas alone computes cylinders and spheres in 1-D");
    const struct solver_class *method = input->solver.choice->thing;
    if (input->start.input && !problem->place.is_part && !method->removes)
        finding_add(findings, FINDING_WRONG, "start", NULL,
                    "the solvers gas, mpm and sph alone begin from another case");
    if (input->levels > 1 && !problem->place.is_part)
        finding_add(findings, FINDING_WRONG, "levels", NULL,
                    "the solvers gas, cfdmp and afdmp alone have cells of several levels");
    for (int m = 0; m < problem->materials; m++)
        if (problem->material[m].afterburn.energy > 0.0)
            finding_add(findings, FINDING_WRONG, "materials", problem->input->materials.names[m],
                        "the solver gas alone burns products in air: "
                        "leave `afterburn` out");
}
