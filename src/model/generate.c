/* From bodies to particles. A lattice is walked site by site and never held in memory: once to count
 * what stays and to find mistakes, once more to make it.
 * Particle mass and diameter: Parshikov (2013), (1.69). */
#include "model/generate.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "case/internal.h"
#include "material/any.h"
#include "material/material.h"
#include "model/overlap.h"

/* An id keeps the index of a site in 48 bits. */
static const double sites_limit = 281474976710656.0;

/* More than a rank can hold particles, and as many as it looks through in a minute. */
static const int64_t sites_a_rank = INT64_C(1) << 32;

/* A walk over the sites of one body that become particles. */
struct walk {
    const struct simulation_case *input;
    int body;
    struct lattice lattice;
    struct range kept;      /* about an axis, the y between the mirrors that cut the body */
    int64_t site, end;      /* the next one to look at */
    struct lattice_row row; /* of the site; empty before the first */
    struct rival *rivals;   /* bodies whose bounds meet this one's, */
    int rival_count;
    int *near; /* and those among them that meet the row */
    int near_count;
    int conflict; /* a body that overlaps by mistake, -1: none found yet */
    struct vec3 conflict_place;
};

/* Where mirrors cut a body about an axis: the y that stays, infinite where none cuts it. A body wholly
 * behind a mirror is not cut: that is a mistake. */
static struct range kept_by_mirrors(const struct simulation_case *input, const struct bounds *shape)
{
    struct range kept = {-INFINITY, INFINITY};
    for (int i = 0; i < input->walls.count && input->geometry == GEOMETRY_AXISYMMETRIC; i++) {
        const struct wall_input *wall = case_wall(input, i);
        if (wall->axis != 1 || !(wall->at > shape->low.y && wall->at < shape->high.y))
            continue;
        if (wall->side == WALL_LOW)
            kept.low = maximum(kept.low, wall->at);
        else
            kept.high = minimum(kept.high, wall->at);
    }
    return kept;
}

struct bounds body_bounds(const struct simulation_case *input, int body)
{
    struct bounds bounds = shape_bounds(&case_body(input, body)->shape);
    if (input->geometry == GEOMETRY_AXISYMMETRIC && bounds.high.x > 0.0)
        bounds.low.x = maximum(bounds.low.x, 0.0);
    const struct range kept = kept_by_mirrors(input, &bounds);
    bounds.low.y = maximum(bounds.low.y, kept.low);
    bounds.high.y = minimum(bounds.high.y, kept.high);
    return bounds;
}

struct lattice body_lattice(const struct simulation_case *input, int body)
{
    const struct body_input *of = case_body(input, body);
    const double resolution = isnan(of->resolution) ? input->resolution : of->resolution;
    return lattice_make(&of->lattice, &of->shape, body_bounds(input, body), resolution,
                        (int)input->dimension);
}

double largest_diameter(const struct simulation_case *input)
{
    double largest = 0.0;
    for (int body = 0; body < input->bodies.count; body++) {
        const double volume = body_lattice(input, body).volume;
        largest = maximum(largest, diameter_of_volume(volume, input->dimension));
    }
    return largest;
}

/* Far from the origin doubles lie too far apart for the distances of neighbours, whose error is up to
 * half a step of them: FINEST of the spacing at most. */
static struct error *check_place(const struct simulation_case *input, int body,
                                 const struct lattice *lattice)
{
    static const double FINEST = 1e-3;
    const struct bounds bounds = body_bounds(input, body);
    const double low[3] = {bounds.low.x, bounds.low.y, bounds.low.z};
    const double high[3] = {bounds.high.x, bounds.high.y, bounds.high.z};
    const double spacing[3] = {lattice->spacing.x, lattice->spacing.y, lattice->spacing.z};
    assert(input->dimension <= 3);
    for (int axis = 0; axis < input->dimension; axis++) {
        const double far = maximum(fabs(low[axis]), fabs(high[axis]));
        const double apart = nextafter(far, INFINITY) - far;
        const double wanted = lattice->kind == LATTICE_RINGS ? lattice->arc : spacing[axis];
        if (apart > FINEST * wanted)
            return input_error(input, "bodies", input->bodies.names[body],
                               "it lies at %c = %.3g m, where numbers are %.2g m apart, too far "
                               "for particles %.3g m apart: move the case to within %.2g m of the "
                               "origin",
                               "xyz"[axis],
                               fabs(low[axis]) > fabs(high[axis]) ? low[axis] : high[axis], apart,
                               wanted, FINEST * wanted / 0x1p-52);
    }
    return NULL;
}

static void walk_end(struct walk *walk)
{
    free(walk->rivals);
    free(walk->near);
}

/* Begins a walk over the part of BODY's lattice that falls to this rank; walk_end in any case. */
static struct error *walk_begin(struct walk *walk, const struct overlaps *overlaps, int body,
                                const struct ranks *ranks)
{
    const struct simulation_case *input = overlaps->input;
    *walk = (struct walk){
        .input = input, .body = body, .lattice = body_lattice(input, body), .conflict = -1};
    if (isinf(walk->lattice.sites))
        return input_error(input, "bodies", input->bodies.names[body],
                           "the lattice has more sites than ids can tell apart: choose a coarser "
                           "resolution");
    if (walk->lattice.sites >= sites_limit)
        return input_error(input, "bodies", input->bodies.names[body],
                           "the lattice has %.3g sites, more than the %.3g that ids can tell "
                           "apart: choose a coarser resolution",
                           walk->lattice.sites, sites_limit);
    TRY(check_place(input, body, &walk->lattice));
    const struct bounds bounds = shape_bounds(&case_body(input, body)->shape);
    walk->kept = kept_by_mirrors(input, &bounds);
    const struct slice slice = ranks_slice(ranks, (int64_t)walk->lattice.sites);
    if (slice.end - slice.begin > sites_a_rank)
        return input_error(input, "bodies", input->bodies.names[body],
                           "the lattice has %.3g sites, too many to look at: choose a coarser "
                           "resolution",
                           walk->lattice.sites);
    walk->site = slice.begin;
    walk->end = slice.end;

    TRY(overlaps_rivals(overlaps, body, &walk->rivals, &walk->rival_count));
    walk->near = memory_allocate(((size_t)walk->rival_count + 1) * sizeof *walk->near);
    return walk->near ? NULL : error_new(ERROR_SYSTEM, "out of memory");
}

/* A matrix may hold thousands of grains: a row of sites tests only those that it meets. */
static void walk_to_row(struct walk *walk, int64_t site)
{
    const struct lattice_row *row = &walk->row;
    walk->row = row->sites > 0 && site == row->first + row->sites
                    ? lattice_row_after(&walk->lattice, row)
                    : lattice_row_of(&walk->lattice, site);
    walk->near_count = 0;
    for (int i = 0; i < walk->rival_count; i++)
        if (bounds_meet(&walk->rivals[i].bounds, &walk->row.bounds))
            walk->near[walk->near_count++] = i;
}

static bool site_dropped(struct walk *walk, struct vec3 place)
{
    for (int i = 0; i < walk->near_count; i++) {
        const struct rival *rival = &walk->rivals[walk->near[i]];
        if (place.x < rival->bounds.low.x || place.x > rival->bounds.high.x ||
            !shape_inside(&case_body(walk->input, rival->body)->shape, place))
            continue;
        if (rival->overlap == OVERLAP_DROP)
            return true;
        if (walk->conflict < 0) {
            walk->conflict = rival->body;
            walk->conflict_place = place;
        }
    }
    return false;
}

/* Beyond the axis of symmetry or a mirror across it, or on one of them, but for rounding: there is
 * nothing of a body. */
static bool site_beyond_axis(const struct walk *walk, struct vec3 place)
{
    const double margin = 1e-9 * walk->input->resolution;
    return walk->input->geometry == GEOMETRY_AXISYMMETRIC &&
           (place.x <= margin || place.y <= walk->kept.low + margin ||
            place.y >= walk->kept.high - margin);
}

/* The next site that becomes a particle, and where; false behind the last. */
static bool walk_next(struct walk *walk, int64_t *site, struct vec3 *place)
{
    const struct one_of *shape = &case_body(walk->input, walk->body)->shape;
    while (walk->site < walk->end) {
        *site = walk->site++;
        if (*site >= walk->row.first + walk->row.sites)
            walk_to_row(walk, *site);
        *place = lattice_place(&walk->lattice, &walk->row, *site);
        if (!site_beyond_axis(walk, *place) && shape_inside(shape, *place) &&
            !site_dropped(walk, *place))
            return true;
    }
    return false;
}

/* A place as the case writes it, in as many numbers as it has dimensions. */
enum { PLACE_TEXT = 80 };
static const char *place_text(const struct simulation_case *input, struct vec3 place, char *buffer)
{
    static const char *const formats[3] = {"[%.6g m]", "[%.6g m, %.6g m]",
                                           "[%.6g m, %.6g m, %.6g m]"};
    snprintf(buffer, PLACE_TEXT, formats[input->dimension - 1], place.x, place.y, place.z);
    return buffer;
}

/* What a square metre of the plane stands for at PLACE: a metre of depth, or the radius, for a radian. */
static double depth_at(const struct simulation_case *input, struct vec3 place)
{
    return input->geometry == GEOMETRY_AXISYMMETRIC ? place.x : 1.0;
}

/* The wall that PLACE lies behind, -1 for none, and from the number of walls on the outflow that it lies
 * beyond. A particle on a wall would meet its own image. */
static int wall_before(const struct simulation_case *input, struct vec3 place)
{
    const double at[3] = {place.x, place.y, place.z};
    const int walls = input->walls.count;
    for (int i = 0; i < walls; i++) {
        const struct wall_input *wall = case_wall(input, i);
        if (wall->side == WALL_LOW ? at[wall->axis] <= wall->at : at[wall->axis] >= wall->at)
            return i;
    }
    for (int i = 0; i < input->outflows.count; i++) {
        const struct outflow_input *face = case_outflow(input, i);
        const double beyond = at[face->axis] - face->at;
        if ((face->side == WALL_LOW ? -beyond : beyond) > 1e-9 * input->resolution)
            return walls + i;
    }
    return -1;
}

/* What one walk over a body found. */
struct finding {
    struct body_summary summary; /* without the diameter */
    double volume;               /* of all particles, m^dimension */
    double energy;               /* of them, internal and kinetic */
    double sound;                /* in summary.fastest */
    int wall;                    /* that a particle lies behind, as wall_before says */
    struct vec3 wall_place;
    int conflict;
    struct vec3 conflict_place;
    const char *start_wrong; /* of the first particle without a state; NULL: none */
    const char *start_key;   /* that it is about */
    struct vec3 start_place;
};

/* What a particle of BODY starts with: NULL, or what is wrong. */
static const char *start_at(const struct simulation_case *input, int body, struct vec3 place,
                            struct point *point, double velocity[3], const char **key)
{
    const struct body_input *of = case_body(input, body);
    const struct material *material = case_material(input, of->material_index)->material;
    return body_start_at(of, material, place, point, velocity, key);
}

static void extend(struct range *range, double value)
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
    const char *key, *wrong = start_at(input, body, place, &point, velocity, &key);
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

static struct error *explore_body(const struct overlaps *overlaps, int body,
                                  const struct ranks *ranks, struct finding *finding)
{
    const struct simulation_case *input = overlaps->input;
    const struct range none = {NAN, NAN};
    *finding = (struct finding){.wall = -1, .conflict = -1};
    struct body_summary *summary = &finding->summary;
    summary->density = summary->pressure = summary->temperature = summary->speed = none;
    struct walk walk;
    struct error *error = walk_begin(&walk, overlaps, body, ranks);
    int64_t site;
    struct vec3 place;
    while (!error && summary->particles <= INT32_MAX && walk_next(&walk, &site, &place)) {
        summary->particles++;
        finding->volume += walk.row.volume;
        explore_start(input, body, place, walk.row.volume * depth_at(input, place), finding);
        if (finding->wall < 0) {
            finding->wall = wall_before(input, place);
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
    if (input->geometry == GEOMETRY_AXISYMMETRIC && body_bounds(input, body).high.x <= 0.0)
        return "no particle: x is the radius, and the whole body is at x < 0; move it to x > 0, or "
               "mirror "
               "it there";
    return "no particle: the shape is smaller than the resolution, or replaced everywhere";
}

/* The mistakes that a walk over BODY has shown. Each pair of bodies is told once, by its first. */
static struct error *judge_body(const struct simulation_case *input, int body,
                                const struct ranks *ranks, const struct finding *findings)
{
    const struct finding *finding = &findings[body];
    const char *name = input->bodies.names[body];
    const int other = finding->conflict, walls = input->walls.count;
    char place[PLACE_TEXT];
    struct error *error = NULL;
    if (finding->wall >= 0)
        error = input_error(input, "bodies", name, "the particle at %s lies behind %s \"%s\"",
                            place_text(input, finding->wall_place, place),
                            finding->wall < walls ? "wall" : "outflow",
                            finding->wall < walls ? input->walls.names[finding->wall]
                                                  : input->outflows.names[finding->wall - walls]);
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
    if (ranks_sum(ranks, finding->summary.particles) == 0)
        error =
            error_join(error, input_error(input, "bodies", name, "%s", no_particle(input, body)));
    return error;
}

/* A site itself takes as long as a few simple shapes. What walk_begin refuses counts as nothing. */
static double work_of_body(const struct simulation_case *input, int body, const struct ranks *ranks)
{
    static const double work_a_site = 4.0;
    const double sites = body_lattice(input, body).sites;
    if (!(sites < sites_limit))
        return 0.0;
    return ceil(sites / ranks->size) * (work_a_site + shape_work(&case_body(input, body)->shape));
}

double generate_work(const struct simulation_case *input, const struct ranks *ranks)
{
    double work = 0.0;
    for (int body = 0; body < input->bodies.count; body++)
        work += work_of_body(input, body, ranks);
    return work;
}

/* ERROR_INPUT for the body with the most of it when there is more work than a rank does in some
 * minutes. */
static struct error *check_work(const struct simulation_case *input, const struct ranks *ranks)
{
    const double all = generate_work(input, ranks);
    double most = 0.0;
    int worst = 0;
    if (all <= GENERATE_MOST)
        return NULL;
    for (int body = 0; body < input->bodies.count; body++) {
        const double work = work_of_body(input, body, ranks);
        worst = work > most ? body : worst;
        most = maximum(work, most);
    }
    return input_error(input, "bodies", input->bodies.names[worst],
                       "its %.2g sites, at each of which up to %.2g shapes are asked, take too "
                       "long to count: choose a coarser resolution, fewer copies that overlap, or "
                       "bodies in place of the shapes of a union",
                       body_lattice(input, worst).sites,
                       shape_work(&case_body(input, worst)->shape));
}

/* Collective: walks over all bodies; FINDINGS has an entry for each. */
static struct error *explore(const struct simulation_case *input, const struct ranks *ranks,
                             struct finding *findings)
{
    struct overlaps overlaps;
    TRY(check_work(input, ranks)); /* the same on all ranks */
    struct error *error = overlaps_make(input, &overlaps);
    const bool ready = !error;
    int64_t total = 0;
    for (int body = 0; ready && body < input->bodies.count; body++)
        error = error_join(error, explore_body(&overlaps, body, ranks, &findings[body]));
    overlaps_free(&overlaps);
    TRY(ranks_agree(ranks, error));
    for (int body = 0; body < input->bodies.count; body++) {
        error = error_join(error, judge_body(input, body, ranks, findings));
        total += findings[body].summary.particles;
    }
    if (total > INT32_MAX)
        error = error_join(error, input_error(input, "resolution", NULL,
                                              "more than %d particles on one rank", INT32_MAX));
    return ranks_agree(ranks, error);
}

/* Makes the particles of BODY from index *next on, and moves it behind the last. */
static struct error *fill_body(struct simulation *simulation, const struct overlaps *overlaps,
                               int body, int32_t *next)
{
    const struct simulation_case *input = simulation->input;
    const struct body_input *of = case_body(input, body);
    struct particles *particles = particles_of(simulation);
    struct walk walk;
    struct error *error = walk_begin(&walk, overlaps, body, simulation->ranks);
    int64_t site;
    struct vec3 place;
    while (!error && walk_next(&walk, &site, &place)) {
        const int32_t i = (*next)++;
        struct point start;
        const char *key;
        start_at(input, body, place, &start, particles->velocity[i], &key);
        particles->id[i] = particle_id(body, site);
        particles->body[i] = (uint16_t)body;
        particles->material[i] = (uint16_t)of->material_index;
        particles->mass[i] = start.density * walk.row.volume * depth_at(input, place);
        particles->density[i] = start.density;
        particles->energy[i] = start.energy;
        particles->pressure[i] = start.pressure;
        memcpy(particles->deviator[i], &start.deviator, sizeof start.deviator);
        if (particles->history[HISTORY_lighting_time])
            particles->history[HISTORY_lighting_time][i] = detonation_arrival(input, body, place);
        particles->position[i][0] = place.x;
        particles->position[i][1] = place.y;
        particles->position[i][2] = place.z;
    }
    walk_end(&walk);
    return error;
}

struct error *generate_particles(struct simulation *simulation)
{
    const struct simulation_case *input = simulation->input;
    struct finding *findings = memory_allocate((size_t)input->bodies.count * sizeof *findings);
    struct error *error =
        ranks_agree(simulation->ranks, findings ? NULL : error_new(ERROR_SYSTEM, "out of memory"));
    assert(error || findings);
    if (!error)
        error = explore(input, simulation->ranks, findings);
    int64_t total = 0;
    for (int body = 0; !error && body < input->bodies.count; body++)
        total += findings[body].summary.particles;
    free(findings);
    int32_t next = 0;
    if (!error)
        error = particles_append(particles_of(simulation), (int32_t)total, &next);
    struct overlaps overlaps = {0};
    if (!error)
        error = overlaps_make(input, &overlaps);
    for (int body = 0; !error && body < input->bodies.count; body++)
        error = fill_body(simulation, &overlaps, body, &next);
    overlaps_free(&overlaps);
    if (!error)
        error = particles_commit(particles_of(simulation));
    return ranks_agree(simulation->ranks, error);
}

struct error *particles_fill(void *solver, struct simulation *simulation)
{
    (void)solver;
    return generate_particles(simulation);
}

struct error *generate_warnings(const struct simulation_case *input)
{
    struct error *warnings = NULL;
    for (int body = 0; body < input->bodies.count; body++) {
        const struct body_input *of = case_body(input, body);
        const double wanted = isnan(of->resolution) ? input->resolution : of->resolution;
        const struct lattice lattice = body_lattice(input, body);
        const double spacing[3] = {lattice.spacing.x, lattice.spacing.y, lattice.spacing.z};
        assert(input->dimension <= 3);
        for (int axis = 0; axis < input->dimension; axis++)
            if (lattice.count[axis] == 1 && spacing[axis] < (1.0 - 1e-9) * wanted) {
                warnings = error_join(
                    warnings,
                    input_error(input, "bodies", input->bodies.names[body],
                                "smaller than the resolution along %c (%.3g m of %.3g m): "
                                "one particle stands for it",
                                "xyz"[axis], spacing[axis], wanted));
                break;
            }
    }
    return warnings;
}

struct error *generate_summary(const struct simulation_case *input, struct body_summary *summary)
{
    const struct ranks alone = ranks_alone();
    struct finding *findings = memory_allocate((size_t)input->bodies.count * sizeof *findings);
    if (!findings)
        return error_new(ERROR_SYSTEM, "out of memory");
    struct error *error = explore(input, &alone, findings);
    for (int body = 0; body < input->bodies.count; body++) {
        const struct finding *finding = &findings[body];
        summary[body] = finding->summary;
        summary[body].diameter = diameter_of_volume(
            finding->volume / (double)finding->summary.particles, input->dimension);
    }
    free(findings);
    return error;
}
