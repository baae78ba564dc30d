/* What is odd about the bodies of a case before anything moves; see generate_judge. */
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "material/material.h"
#include "model/solver.h"
#include "model/walk.h"

/* Particles across a plate below which others get through it, and with which it hardly bends. */
enum { THIN = 3 };

bool walls_on_both_sides(const struct simulation_case *input, int axis)
{
    const struct place whole = place_whole(input);
    const struct face *face = whole.face[axis];
    const bool radius = axis == 0 && geometry_power(input->geometry) > 0;
    return (!radius && face_closes(&face[0]) && face_closes(&face[1])) ||
           face[0].kind == BOUNDARY_PERIODIC;
}

static bool is_thin(const struct simulation_case *input, int body, int axis)
{
    const struct lattice lattice = body_lattice(input, body);
    return lattice.kind != LATTICE_RINGS && lattice.count[axis] < THIN;
}

/* A sheet of which all bodies are a part is no plate. */
static bool all_are_thin(const struct simulation_case *input, int axis)
{
    for (int body = 0; body < input->bodies.count; body++)
        if (!is_thin(input, body, axis))
            return false;
    return true;
}

static void warn_of_thin(struct findings *findings, int body)
{
    const struct simulation_case *input = findings->input;
    assert(input->dimension <= 3);
    for (int axis = 0; axis < input->dimension && input->dimension > 1; axis++)
        if (is_thin(input, body, axis) && !walls_on_both_sides(input, axis) &&
            !all_are_thin(input, axis)) {
            const int64_t count = body_lattice(input, body).count[axis];
            {
                finding_add(findings, FINDING_DOUBTFUL, "bodies", input->bodies.names[body],
                            "%lld particle%s thick along %c: other bodies can get through "
                            "fewer than %d, and it hardly bends; refine it",
                            (long long)count, count == 1 ? "" : "s", "xyz"[axis], THIN);
                return;
            }
        }
}

/* A state that no material has, such as a porous one that is given by its density alone. One that
 * varies is seen at the first row of the history. */
static void warn_of_cold(struct findings *findings, int body)
{
    const struct simulation_case *input = findings->input;
    const struct body_input *of = case_body(input, body);
    const struct material *material = case_material(input, of->material_index)->material;
    if (of->varies || heat_wrong(&material->heat, &material->eos))
        return;
    const double temperature =
        heat_temperature(&material->heat, &material->eos, of->start.density, of->start.energy);
    if (!(temperature < 0.0))
        return;
    finding_add(findings, FINDING_DOUBTFUL, "bodies", input->bodies.names[body],
                "it starts at %.4g K: density %g kg/m^3 and energy %g J/kg are no state of "
                "its material, whose density at rest is %g kg/m^3. Make pores as holes of "
                "the shape, or give the temperature",
                temperature, of->start.density, of->start.energy, material_density(material));
}

/* A body across the axis of symmetry, or a mirror across it, loses what is outside. That is meant
 * where it is the half of a symmetric body; a mesostructure may end at two walls. */
static void warn_of_cut(struct findings *findings, int body)
{
    const struct simulation_case *input = findings->input;
    const struct bounds shape = shape_bounds(&case_body(input, body)->shape);
    const struct bounds kept = body_bounds(input, body);
    const struct vec3 spacing = body_lattice(input, body).spacing;
    const bool round = geometry_power(input->geometry) > 0;
    assert(input->dimension <= 3);
    for (int axis = 0; axis < input->dimension; axis++) {
        const double from = vec3_at(shape.low, axis), to = vec3_at(shape.high, axis);
        const double low = vec3_at(kept.low, axis), high = vec3_at(kept.high, axis);
        const double below = low - from, above = to - high, cut = below + above, left = high - low;
        const double margin = vec3_at(spacing, axis);
        if (!isfinite(cut) || cut <= margin || (below > 0.0 && above > 0.0) ||
            fabs(cut - left) <= margin)
            continue;
        {
            finding_add(findings, FINDING_DOUBTFUL, "bodies", input->bodies.names[body],
                        "%.0f %% of its extent along %c is left out: it is from %.6g m to %.6g "
                        "m and ends at %s, %c = %.6g m",
                        100.0 * cut / (cut + left), "xyz"[axis], from, to,
                        round && axis == 0 && below > 0.0 ? "the axis" : "the wall", "xyz"[axis],
                        below > 0.0 ? low : high);
            return;
        }
    }
}

/* The volume of the sites of BODY that become particles, about an axis times their radius; NAN
 * where its lattice is refused, which has its own message. */
static double volume_of_body(const struct overlaps *overlaps, int body)
{
    const struct ranks alone = ranks_alone();
    struct walk walk;
    struct error *error = walk_begin(&walk, overlaps, body, &alone);
    int64_t site;
    struct vec3 place;
    double volume = error ? (double)NAN : 0.0;
    while (!error && walk_next(&walk, &site, &place))
        volume += walk.volume * walk_depth(overlaps->place->input, place);
    walk_end(&walk);
    error_free(error);
    return volume;
}

/* Gives BODY of FINE, a copy of INPUT, a lattice so many times finer that a share of WORK
 * (generate_work) counts it; false where that is not finer. */
static bool refine(const struct simulation_case *input, struct simulation_case *fine, int body)
{
    static const double WORK = 0x1p24, LEAST = 2.0, MOST = 16.0;
    struct body_input *of = case_body(fine, body);
    of->weights = 0;
    const double sites = body_lattice(input, body).sites;
    const double work = sites * (4.0 + shape_work(&of->shape)) * input->bodies.count;
    const double times = minimum(floor(pow(WORK / work, 1.0 / (double)input->dimension)), MOST);
    if (!(times >= LEAST))
        return false;
    of->resolution = (isnan(of->resolution) ? input->resolution : of->resolution) / times;
    of->lattice = (struct one_of){LATTICE_SQUARE, NULL, NULL};
    return true;
}

/* The particles of a shape that is few of them wide have more or less volume than it has. */
static void compare_volumes(const struct overlaps *own, const struct overlaps *fine, int body,
                            struct findings *findings)
{
    static const double WRONG = 0.02;
    const struct simulation_case *input = own->place->input;
    const double excess = volume_of_body(own, body) / volume_of_body(fine, body) - 1.0;
    if (!(isfinite(excess) && fabs(excess) > WRONG))
        return;
    finding_add(findings, FINDING_DOUBTFUL, "bodies", input->bodies.names[body],
                "its particles have %.3g %% %s volume, and mass, than its shape: refine it, "
                "or scale its density",
                100.0 * fabs(excess), excess > 0.0 ? "more" : "less");
}

/* Compares the particles of each body with a lattice as fine as a short time allows. With too many
 * for that, they are accurate. */
static void warn_of_volumes(struct findings *findings)
{
    const struct simulation_case *input = findings->input;
    const struct solver_class *class = input->solver.choice->thing;
    const size_t bytes = (size_t)input->bodies.count * sizeof(struct body_input);
    if (class->count || input->dimension == 1)
        return;
    struct simulation_case fine = *input;
    struct overlaps of_own, of_fine;
    fine.bodies.items = memory_allocate(bytes);
    if (!fine.bodies.items)
        return;
    memcpy(fine.bodies.items, input->bodies.items, bytes);
    const struct place whole = place_whole(input), finer = place_whole(&fine);
    struct error *error =
        error_join(overlaps_make(&whole, &of_own), overlaps_make(&finer, &of_fine));
    const bool made = !error;
    for (int body = 0; made && body < input->bodies.count; body++)
        if (refine(input, &fine, body))
            compare_volumes(&of_own, &of_fine, body, findings);
    overlaps_free(&of_own);
    overlaps_free(&of_fine);
    free(fine.bodies.items);
    error_free(error); /* told where bodies are filled */
}

void generate_judge(struct findings *findings)
{
    const struct simulation_case *input = findings->input;
    for (int body = 0; body < input->bodies.count; body++) {
        warn_of_thin(findings, body);
        warn_of_cold(findings, body);
        warn_of_cut(findings, body);
    }
    for (int body = 0; body < input->bodies.count; body++) {
        const struct body_input *of = case_body(input, body);
        const double wanted = isnan(of->resolution) ? input->resolution : of->resolution;
        const struct lattice lattice = body_lattice(input, body);
        const double spacing[3] = {lattice.spacing.x, lattice.spacing.y, lattice.spacing.z};
        assert(input->dimension <= 3);
        for (int axis = 0; axis < input->dimension; axis++)
            if (lattice.count[axis] == 1 && spacing[axis] < (1.0 - 1e-9) * wanted) {
                finding_add(findings, FINDING_DOUBTFUL, "bodies", input->bodies.names[body],
                            "smaller than the resolution along %c (%.3g m of %.3g m): "
                            "it becomes one particle",
                            "xyz"[axis], spacing[axis], wanted);
                break;
            }
    }
    warn_of_volumes(findings);
}
