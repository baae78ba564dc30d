/* From bodies to particles. A lattice is walked twice (walk.h): once to count what stays and to
 * find mistakes, as here, once more to make it (particles/fill.c). Particle mass and diameter:
 * Parshikov (2013), (1.69). */
#include "model/generate.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "material/any.h"
#include "material/material.h"
#include "model/walk.h"

/* A place as the case writes it, in as many numbers as it has dimensions. */
enum { PLACE_TEXT = 80 };
static const char *place_text(const struct simulation_case *input, struct vec3 place, char *buffer)
{
    static const char *const formats[3] = {"[%.6g m]", "[%.6g m, %.6g m]",
                                           "[%.6g m, %.6g m, %.6g m]"};
    snprintf(buffer, PLACE_TEXT, formats[input->dimension - 1], place.x, place.y, place.z);
    return buffer;
}

/* The face that AT lies outside; NULL: none. A particle on a wall would meet its own image. */
static const struct face *face_before(const struct place *place, struct vec3 at)
{
    const double x[3] = {at.x, at.y, at.z}, margin = 1e-9 * place->input->resolution;
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++) {
            const struct face *face = &place->face[axis][side];
            const double beyond = side ? x[axis] - face->at : face->at - x[axis];
            if (face->boundary >= 0 && (face_closes(face)     ? beyond >= 0.0
                                        : face_lets_out(face) ? beyond > margin
                                                              : false))
                return face;
        }
    return NULL;
}

/* What one walk over a body found. */
struct finding {
    struct body_summary summary; /* without the diameter */
    double volume;               /* of all particles, m^dimension */
    double energy;               /* of them, internal and kinetic */
    double sound;                /* in summary.fastest */
    const struct face *wall;     /* that a particle lies behind, as face_before says */
    struct vec3 wall_place;
    int conflict;
    struct vec3 conflict_place;
    const char *start_wrong; /* of the first particle without a state; NULL: none */
    const char *start_key;   /* that it is about */
    struct vec3 start_place;
};

static void extend(struct extremes *range, double value)
{
    range->low = fmin(range->low, value);
    range->high = fmax(range->high, value);
}

static void note_state(const struct material *material, struct point point, struct finding *finding)
{
    struct body_summary *summary = &finding->summary;
    extend(&summary->density, point.density);
    extend(&summary->pressure, point.pressure);
    if (!heat_wrong(&material->heat, &material->eos))
        extend(&summary->temperature,
               heat_temperature(&material->heat, &material->eos, point.density, point.energy));
    struct response response = any_material_evaluate(material, &point);
    if (summary->particles == 1 || response.sound_long > finding->sound) {
        summary->fastest = point;
        finding->sound = response.sound_long;
    }
}

static void explore_start(const struct simulation_case *input, int body, struct vec3 place,
                          double volume, struct finding *finding)
{
    struct body_summary *summary = &finding->summary;
    struct point point;
    double velocity[3] = {0.0};
    const char *key, *wrong = walk_start(input, body, place, &point, velocity, &key);
    if (wrong) {
        if (!finding->start_wrong) {
            finding->start_wrong = wrong;
            finding->start_key = key;
            finding->start_place = place;
        }
        return;
    }
    const struct body_input *of = case_body(input, body);
    const double speed = sqrt(square(velocity[0]) + square(velocity[1]) + square(velocity[2]));
    summary->mass += point.density * volume;
    finding->energy += point.density * volume * (point.energy + 0.5 * square(speed));
    extend(&summary->speed, speed);
    if (of->varies || summary->particles == 1)
        note_state(case_material(input, of->material_index)->material, point, finding);
}

static bool is_in(const struct bounds *box, struct vec3 place, int64_t dimension)
{
    return place.x >= box->low.x && place.x <= box->high.x &&
           (dimension < 2 || (place.y >= box->low.y && place.y <= box->high.y)) &&
           (dimension < 3 || (place.z >= box->low.z && place.z <= box->high.z));
}

static double site_at(const struct lattice *lattice, int axis, int64_t site)
{
    const double origin[3] = {lattice->origin.x, lattice->origin.y, lattice->origin.z},
                 spacing[3] = {lattice->spacing.x, lattice->spacing.y, lattice->spacing.z};
    return origin[axis] + ((double)site + 0.5) * spacing[axis];
}

/* The first site along AXIS at or above PLACE, or above it alone. */
static int64_t first_site(const struct lattice *lattice, int axis, double place, bool above)
{
    int64_t low = 0, high = lattice->count[axis];
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        const double at = site_at(lattice, axis, middle);
        if (above ? at > place : at >= place)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

static struct vec3 place_at(const struct lattice *lattice, const int64_t site[3])
{
    return vec3_make(site_at(lattice, 0, site[0]), site_at(lattice, 1, site[1]),
                     site_at(lattice, 2, site[2]));
}

/* Looks for a wall among the sites from LOW up to HIGH, a box of them: walls are planes across an
 * axis. */
static void explore_walls(const struct place *place, const struct lattice *lattice,
                          const int64_t low[3], const int64_t high[3], struct finding *finding)
{
    for (int axis = -1; axis < (int)place->input->dimension && !finding->wall; axis++) {
        int64_t site[3] = {low[0], low[1], low[2]};
        if (axis >= 0)
            site[axis] = high[axis] - 1;
        if (!face_before(place, place_at(lattice, site)))
            continue;
        for (int64_t before = axis < 0 ? site[0] : low[axis];
             axis >= 0 && site[axis] - before > 1;) {
            int64_t middle[3] = {site[0], site[1], site[2]};
            middle[axis] = before + (site[axis] - before) / 2;
            if (!face_before(place, place_at(lattice, middle)))
                before = middle[axis];
            else
                site[axis] = middle[axis];
        }
        finding->wall_place = place_at(lattice, site);
        finding->wall = face_before(place, finding->wall_place);
    }
}

/* As explore_body for a body all of whose sites become particles in one state. */
static void explore_plain(const struct walk *walk, const struct place *place,
                          const struct bounds *box, struct finding *finding)
{
    const struct simulation_case *input = walk->input;
    const struct lattice *lattice = &walk->lattice;
    struct body_summary *summary = &finding->summary;
    const int64_t count = walk->end - walk->site;
    int64_t low[3] = {0, 0, 0}, high[3], counted = 1;
    for (int axis = 0; axis < 3; axis++)
        high[axis] = lattice->count[axis];
    for (int axis = 0; axis < (int)input->dimension && box; axis++) {
        low[axis] = first_site(lattice, axis, vec3_at(box->low, axis), false);
        high[axis] = first_site(lattice, axis, vec3_at(box->high, axis), true);
    }
    for (int axis = 0; axis < 3; axis++)
        counted *= high[axis] > low[axis] ? high[axis] - low[axis] : 0;
    const struct bounds sites = walk_sites(walk);
    const double middle = 0.5 * (sites.low.x + sites.high.x), sum = (double)lattice->count[0];
    const int power = geometry_power(input->geometry);
    const double depth =
        power == 0   ? 1.0 /* the mean over the sites of 1, x or x^2 */
        : power == 1 ? middle
                     : square(middle) + square(lattice->spacing.x) * (square(sum) - 1.0) / 12.0;
    if (count == 0)
        return;
    summary->particles = 1; /* for the state of the first */
    explore_start(input, walk->body, sites.low, lattice->volume, finding);
    summary->mass *= depth * (double)count;
    finding->energy *= depth * (double)count;
    finding->volume = lattice->volume * (double)count;
    summary->particles = count;
    summary->counted = box ? counted : count;
    if (counted > 0)
        explore_walls(place, lattice, low, high, finding);
}

/* Of particles out of BOX, NULL: none are, less is asked. */
static struct error *explore_body(const struct overlaps *overlaps, int body,
                                  const struct bounds *box, const struct ranks *ranks,
                                  struct finding *finding)
{
    const struct simulation_case *input = overlaps->place->input;
    const struct extremes none = {NAN, NAN};
    *finding = (struct finding){.conflict = -1};
    struct body_summary *summary = &finding->summary;
    summary->density = summary->pressure = summary->temperature = summary->speed = none;
    struct walk walk;
    struct error *error = walk_begin(&walk, overlaps, body, ranks);
    int64_t site;
    struct vec3 place;
    if (!error && walk.plain) {
        explore_plain(&walk, overlaps->place, box, finding);
        walk_end(&walk);
        return NULL;
    }
    while (!error && summary->particles <= INT32_MAX && walk_next(&walk, &site, &place)) {
        summary->particles++;
        finding->volume += walk.volume;
        explore_start(input, body, place, walk.volume * walk_depth(input, place), finding);
        if (box && !is_in(box, place, input->dimension))
            continue;
        summary->counted++;
        if (!finding->wall) {
            finding->wall = face_before(overlaps->place, place);
            finding->wall_place = place;
        }
    }
    finding->conflict = walk.conflict;
    finding->conflict_place = walk.conflict_place;
    walk_end(&walk);
    return error;
}

/* Why BODY has no particle. */
static const char *no_particle(const struct simulation_case *input, int body)
{
    if (geometry_power(input->geometry) > 0 && body_bounds(input, body).high.x <= 0.0)
        return "no particle: x is the radius, and the whole body is at x < 0; move it to x > 0, or "
               "mirror "
               "it there";
    return "no particle: the shape is smaller than the resolution, or replaced everywhere";
}

/* The mistakes that a walk over BODY has shown. Each pair of bodies is named once, by its first. */
static struct error *judge_body(const struct place *whole, int body, const struct ranks *ranks,
                                const struct finding *findings)
{
    const struct simulation_case *input = whole->input;
    const struct finding *finding = &findings[body];
    const char *name = input->bodies.names[body];
    const int other = finding->conflict;
    char place[PLACE_TEXT];
    struct error *error = NULL;
    if (finding->wall)
        error = input_error(input, "bodies", name, "the particle at %s lies behind %s \"%s\"",
                            place_text(input, finding->wall_place, place),
                            face_closes(finding->wall) ? "wall" : "outflow",
                            input->boundaries.names[finding->wall->boundary]);
    if (other >= 0 && !(other < body && findings[other].conflict == body))
        error = error_join(
            error, input_error(input, "bodies", name,
                               "overlaps \"%s\" at %s: let one of the two, and only one, name the "
                               "other in `replaces`",
                               input->bodies.names[other],
                               place_text(input, finding->conflict_place, place)));
    if (finding->start_wrong) {
        char key[128];
        snprintf(key, sizeof key, "%.80s%s%s", name, finding->start_key[0] ? "." : "",
                 finding->start_key);
        error =
            error_join(error, input_error(input, "bodies", key, "%s (at %s)", finding->start_wrong,
                                          place_text(input, finding->start_place, place)));
    }
    if (!isfinite(finding->summary.mass) || !isfinite(finding->energy))
        error = error_join(error, input_error(input, "bodies", name,
                                              "its mass and energy are not finite: %g and %g",
                                              finding->summary.mass, finding->energy));
    if (ranks_sum(ranks, finding->summary.particles) == 0 && !whole->is_part)
        error =
            error_join(error, input_error(input, "bodies", name, "%s", no_particle(input, body)));
    return error;
}

/* Collective: walks over all bodies; FINDINGS has an entry for each. */
static struct error *explore(const struct place *place, const struct bounds *box,
                             const struct ranks *ranks, struct finding *findings)
{
    const struct simulation_case *input = place->input;
    struct overlaps overlaps;
    TRY(walk_check_work(place, ranks)); /* the same on all ranks */
    struct error *error = overlaps_make(place, &overlaps);
    const bool ready = !error;
    int64_t total = 0;
    for (int body = 0; ready && body < input->bodies.count; body++)
        if (place_has(place, body))
            error = error_join(error, explore_body(&overlaps, body, box, ranks, &findings[body]));
    overlaps_free(&overlaps);
    TRY(ranks_agree(ranks, error));
    for (int body = 0; body < input->bodies.count; body++) {
        if (!place_has(place, body))
            continue;
        error = error_join(error, judge_body(place, body, ranks, findings));
        total += findings[body].summary.particles;
    }
    if (total > INT32_MAX && input->levels < 2) /* of several levels there are far fewer cells */
        error =
            error_join(error, input_error(input, "resolution", NULL,
                                          "%.3g particles are more than the %.3g that a rank "
                                          "computes: choose a coarser resolution, or more ranks",
                                          (double)total, (double)INT32_MAX));
    return ranks_agree(ranks, error);
}

struct error *generate_count(const struct place *place, const struct ranks *ranks,
                             int64_t *particles)
{
    const struct simulation_case *input = place->input;
    struct finding *findings = memory_allocate((size_t)input->bodies.count * sizeof *findings);
    TRY(ranks_agree(ranks, findings ? NULL : out_of_memory()));
    assert(findings);
    struct error *error = explore(place, NULL, ranks, findings);
    *particles = 0;
    for (int body = 0; !error && body < input->bodies.count; body++)
        *particles += findings[body].summary.particles;
    free(findings);
    return error;
}

struct error *generate_summary(const struct simulation_case *input, const struct bounds *box,
                               struct body_summary *summary)
{
    const struct ranks alone = ranks_alone();
    const struct place whole = place_whole(input);
    struct finding *findings = memory_allocate((size_t)input->bodies.count * sizeof *findings);
    if (!findings)
        return out_of_memory();
    struct error *error = explore(&whole, box, &alone, findings);
    for (int body = 0; body < input->bodies.count; body++) {
        const struct finding *finding = &findings[body];
        summary[body] = finding->summary;
        summary[body].diameter = diameter_of_volume(
            finding->volume / (double)finding->summary.particles, input->dimension);
    }
    free(findings);
    return error;
}
