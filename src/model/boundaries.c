/* Faces as particles see them, and boundaries that a solver does not have; see boundaries.h. */
#include "model/boundaries.h"

#include <stdio.h>
#include <string.h>

#include "model/generate.h"
#include "parallel/periodic.h"
#include "shape/shape.h"

struct mirrors boundaries_images(const struct face face[3][2])
{
    struct mirrors images = {0};
    for (int axis = 0; axis < 3; axis++) {
        const struct face *low = &face[axis][0], *high = &face[axis][1];
        images.low[axis] = face_closes(low) ? low->at : (double)NAN;
        images.high[axis] = face_closes(high) ? high->at : (double)NAN;
        if (low->kind == BOUNDARY_PERIODIC && low->at < high->at && isfinite(high->at - low->at))
            images_make_periodic(&images, axis, low->at, high->at);
    }
    return images;
}

/* Writes the names of the kinds in SUPPORTED as `a, b, c`. */
static void kinds_text(unsigned supported, char *text, size_t size)
{
    const char *names[BOUNDARY_KINDS];
    int count = 0;
    for (int kind = 0; kind < BOUNDARY_KINDS; kind++)
        if (supported & 1u << kind)
            names[count++] = boundary_kind_name(kind);
    list_text(names, count, text, size);
}

/* Writes the names of the solvers of the catalogue that have KIND. */
static void solvers_text(const struct simulation_case *input, int kind, char *text, size_t size)
{
    enum { MOST = 16 };
    const struct choice_list *list = catalogue_list(input->catalogue, "solver");
    const char *names[MOST];
    int count = 0;
    for (int k = 0; k < list->count && count < MOST; k++)
        if (((const struct solver_class *)list->choices[k].thing)->boundaries & 1u << kind)
            names[count++] = list->choices[k].name;
    list_text(names, count, text, size);
}

/* What a solver of particles offers in its place. */
static const char *const instead[BOUNDARY_KINDS] = {
    [BOUNDARY_TRANSMITTING] =
        "; or end the material with a few particles of a `frozen` body, which waves leave through",
    [BOUNDARY_RIGID_BODY] = "; or make it a body that is `driven` or `frozen`"};

static void refuse_kind(struct findings *findings, int b, unsigned supported)
{
    const struct simulation_case *input = findings->input;
    const struct boundary_input *boundary = case_boundary(input, b);
    char path[160], has[160], others[160];
    snprintf(path, sizeof path, "%.100s.part", input->boundaries.names[b]);
    kinds_text(supported, has, sizeof has);
    solvers_text(input, boundary->kind, others, sizeof others);
    const char *other = supported & BOUNDARY_PARTS ? NULL : instead[boundary->kind];
    if (boundary->part.choice && boundary->kind != BOUNDARY_RIGID_BODY &&
        !(supported & BOUNDARY_PARTS))
        finding_add(findings, FINDING_WRONG, "boundaries", path,
                    "only the solver gas has faces of several parts: remove this key, or close "
                    "the part with a `frozen` body");
    else if (!(supported & 1u << boundary->kind))
        finding_add(findings, FINDING_WRONG, "boundaries", input->boundaries.names[b],
                    "the solver %s has no %s boundaries (it has: %s); these have: %s%s",
                    input->solver.choice->name, boundary_kind_name(boundary->kind), has, others,
                    other ? other : "");
}

void boundaries_refuse(struct findings *findings, unsigned supported)
{
    const struct simulation_case *input = findings->input;
    for (int b = 0; b < input->boundaries.count; b++)
        refuse_kind(findings, b, supported);
}

/* Rows of a hexagonal lattice are shifted in turn: an odd number of them does not repeat. */
static void check_rows(struct findings *findings, int body, int axis)
{
    const struct simulation_case *input = findings->input;
    const struct lattice lattice = body_lattice(input, body);
    if (lattice.kind != LATTICE_HEXAGONAL || axis != 1 || lattice.count[1] % 2 == 0)
        return;

    finding_add(findings, FINDING_WRONG, "bodies", input->bodies.names[body],
                "its hexagonal lattice has %lld rows between periodic faces, and only an even "
                "number repeats: change the resolution a little",
                (long long)lattice.count[1]);
}

/* Bodies lie in the domain, and those that fill it fit together across the faces. */
static void check_bodies(struct findings *findings, int axis, const struct face_place face[2])
{
    const struct simulation_case *input = findings->input;
    const double margin = 1e-6 * input->resolution;
    for (int b = 0; b < input->bodies.count; b++) {
        const struct bounds bounds = body_bounds(input, b);
        const double low = vec3_at(bounds.low, axis), high = vec3_at(bounds.high, axis);
        if (low < face[0].at - margin || high > face[1].at + margin)
            finding_add(findings, FINDING_WRONG, "bodies", input->bodies.names[b],
                        "it lies between %.6g m and %.6g m along %c, outside the domain, "
                        "which is from %.6g m to %.6g m",
                        low, high, "xyz"[axis], face[0].at, face[1].at);
        else if (low < face[0].at + margin && high > face[1].at - margin)
            check_rows(findings, b, axis);
    }
}

static void check_face(struct findings *findings, int b)
{
    const struct simulation_case *input = findings->input;
    const struct boundary_input *boundary = case_boundary(input, b);
    const int axis = boundary->axis;
    const struct face_place face[2] = {domain_face(input, axis, 0), domain_face(input, axis, 1)};
    if (!isnan(boundary->at) && boundary->kind != BOUNDARY_PERIODIC)
        return; /* bodies are cut there */
    if (!(face[0].at < face[1].at)) {
        finding_add(findings, FINDING_WRONG, face[1].section, face[1].name,
                    "the domain has no room along %c", "xyz"[axis]);
        return;
    }
    check_bodies(findings, axis, face);
}

void boundaries_refuse_of_particles(struct findings *findings, unsigned supported)
{
    const struct simulation_case *input = findings->input;
    boundaries_refuse(findings, supported);
    bool bounded = false;
    for (int b = 0; b < input->boundaries.count; b++)
        bounded |= case_boundary(input, b)->kind != BOUNDARY_RIGID_BODY;
    if (!bounded && (input->domain.low.count || input->domain.high.count))
        finding_add(findings, FINDING_WRONG, "domain", NULL,
                    "the solver %s computes wherever particles are: name in "
                    "`boundaries` which faces of the domain are closed",
                    input->solver.choice->name);
    for (int b = 0; b < input->boundaries.count; b++)
        if (supported & 1u << case_boundary(input, b)->kind &&
            !case_boundary(input, b)->part.choice)
            check_face(findings, b);
}
