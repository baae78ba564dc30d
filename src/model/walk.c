/* Iteration over the sites of a body's lattice, which is never stored; see walk.h. */
#include "model/walk.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "model/generate.h"

/* An id keeps the index of a site in 48 bits. */
static const double sites_limit = 281474976710656.0;

/* More than a rank can store, and as many as it can iterate over in a minute. */
static const int64_t sites_a_rank = INT64_C(1) << 32;

/* Lengths of less than this are rounding. */
static double margin_of(const struct simulation_case *input) { return 1e-9 * input->resolution; }

/* What the box of PLACE and its walls leave of BODY, whose shape is in the bounds SHAPE. One
 * entirely outside a wall is not cut but reported as an error. */
static struct bounds kept_in(const struct place *place, int body, const struct bounds *shape)
{
    const double margin = margin_of(place->input);
    double end[2][3] = {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}};
    if (place_has(place, body)) {
        memcpy(end[0], &place->box.low, sizeof end[0]);
        memcpy(end[1], &place->box.high, sizeof end[1]);
    }
    for (int axis = 0; axis < place->input->dimension; axis++)
        for (int side = 0; side < 2; side++) {
            const struct face *face = &place->face[axis][side];
            if (face->cuts && face_closes(face) && face->at > vec3_at(shape->low, axis) + margin &&
                face->at < vec3_at(shape->high, axis) - margin)
                end[side][axis] =
                    side ? minimum(end[1][axis], face->at) : maximum(end[0][axis], face->at);
        }
    return (struct bounds){vector_at(end[0]), vector_at(end[1])};
}

struct bounds place_bounds(const struct place *place, int body)
{
    struct bounds bounds = shape_bounds(&case_body(place->input, body)->shape);
    if (geometry_power(place->input->geometry) > 0 && bounds.high.x > 0.0)
        bounds.low.x = maximum(bounds.low.x, 0.0);
    return bounds_common(bounds, kept_in(place, body, &bounds));
}

struct lattice place_lattice(const struct place *place, int body)
{
    const struct body_input *of = case_body(place->input, body);
    const double resolution = isnan(of->resolution) ? place->input->resolution : of->resolution;
    return lattice_make(&of->lattice, &of->shape, place_bounds(place, body), resolution,
                        (int)place->input->dimension);
}

struct bounds body_bounds(const struct simulation_case *input, int body)
{
    const struct place whole = place_whole(input);
    return place_bounds(&whole, body);
}

struct vec3 body_middle(const struct simulation_case *input, int body)
{
    const struct bounds bounds = body_bounds(input, body);
    return vec3_scale(0.5, vec3_add(bounds.low, bounds.high));
}

struct vec3 body_velocity(const struct simulation_case *input, int body)
{
    const struct field_list *given = &case_body(input, body)->velocity;
    const struct vec3 middle = body_middle(input, body);
    double velocity[3] = {0.0, 0.0, 0.0};
    for (int axis = 0; axis < given->count && axis < 3; axis++)
        velocity[axis] = field_at(&given->at[axis], middle, 0.0);
    return vec3_make(velocity[0], velocity[1], velocity[2]);
}

struct lattice body_lattice(const struct simulation_case *input, int body)
{
    const struct place whole = place_whole(input);
    return place_lattice(&whole, body);
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

/* Far from the origin, positions are rounded too coarsely for the distances of neighbours, whose
 * error is up to half a unit in the last place. At most FINEST of the spacing is allowed. */
static struct error *check_place(const struct place *place, int body, const struct lattice *lattice)
{
    static const double FINEST = 1e-3;
    const struct simulation_case *input = place->input;
    const struct bounds bounds = place_bounds(place, body);
    assert(input->dimension <= 3);
    for (int axis = 0; axis < input->dimension; axis++) {
        const double low = vec3_at(bounds.low, axis), high = vec3_at(bounds.high, axis);
        const double far = maximum(fabs(low), fabs(high));
        const double apart = nextafter(far, INFINITY) - far;
        const double between =
            lattice->kind == LATTICE_RINGS ? lattice->arc : vec3_at(lattice->spacing, axis);
        /* a body may be so thin that no number lies in it */
        const double wanted = between > 0.0 ? between : input->resolution;
        const double room = FINEST * wanted / 0x1p-52;
        if (apart > FINEST * wanted && high - low > 2.0 * room)
            return input_error(input, "bodies", input->bodies.names[body],
                               "it is %.3g m long along %c, too long for particles %.3g m apart, "
                               "since numbers at its end are %.2g m apart: choose a coarser "
                               "resolution",
                               high - low, "xyz"[axis], wanted, apart);
        if (apart > FINEST * wanted)
            return input_error(input, "bodies", input->bodies.names[body],
                               "it lies at %c = %.3g m, where numbers are %.2g m apart, too far "
                               "for particles %.3g m apart: move the case to within %.2g m of the "
                               "origin",
                               "xyz"[axis], fabs(low) > fabs(high) ? low : high, apart, wanted,
                               room);
    }
    return NULL;
}

/* The box of the sites of LATTICE, which has lines. */
static struct bounds bounds_of_sites(const struct lattice *lattice)
{
    const struct vec3 half = vec3_scale(0.5, lattice->spacing),
                      first = vec3_add(lattice->origin, half);
    const struct vec3 way = {(double)(lattice->count[0] - 1) * lattice->spacing.x,
                             (double)(lattice->count[1] - 1) * lattice->spacing.y,
                             (double)(lattice->count[2] - 1) * lattice->spacing.z};
    return (struct bounds){first, vec3_add(first, way)};
}

/* Whether every site of BODY becomes a particle, all in one state: of a box that meets no other
 * body. Then sites need not be looked at one by one. */
static bool is_plain(const struct place *place, int body, const struct lattice *lattice)
{
    enum { FEW = 2000 }; /* bodies that are compared with each other */
    const struct simulation_case *input = place->input;
    const struct body_input *of = case_body(input, body);
    bool plain = of->weights == 0 && shape_is_box(&of->shape) && lattice->kind == LATTICE_SQUARE &&
                 !of->varies && input->bodies.count <= FEW && !place->is_part;
    for (int k = 0; k < of->velocity.count; k++)
        plain &= !of->velocity.at[k].varying;
    const struct bounds sites = bounds_of_sites(lattice);
    plain &= geometry_power(input->geometry) == 0 || sites.low.x > 0.0;
    for (int other = 0; other < input->bodies.count && plain; other++) {
        const struct bounds bounds = shape_bounds(&case_body(input, other)->shape);
        plain = other == body || !bounds_meet(&sites, &bounds);
    }
    return plain;
}

struct bounds walk_sites(const struct walk *walk) { return bounds_of_sites(&walk->lattice); }

void walk_end(struct walk *walk)
{
    free(walk->rivals);
    free(walk->near);
}

struct error *walk_begin(struct walk *walk, const struct overlaps *overlaps, int body,
                         const struct ranks *ranks)
{
    const struct place *place = overlaps->place;
    const struct simulation_case *input = place->input;
    *walk = (struct walk){
        .input = input, .body = body, .lattice = place_lattice(place, body), .conflict = -1};
    if (isinf(walk->lattice.sites))
        return input_error(input, "bodies", input->bodies.names[body],
                           "the lattice has more sites than ids can tell apart: choose a coarser "
                           "resolution");
    if (walk->lattice.sites >= sites_limit)
        return input_error(input, "bodies", input->bodies.names[body],
                           "the lattice has %.3g sites, more than the %.3g that ids can tell "
                           "apart: choose a coarser resolution",
                           walk->lattice.sites, sites_limit);
    TRY(check_place(place, body, &walk->lattice));
    const struct bounds bounds = shape_bounds(&case_body(input, body)->shape);
    walk->kept = kept_in(place, body, &bounds);
    const struct slice slice = ranks_slice(ranks, (int64_t)walk->lattice.sites);
    walk->plain = is_plain(place, body, &walk->lattice);
    if (!walk->plain && slice.end - slice.begin > sites_a_rank)
        return input_error(input, "bodies", input->bodies.names[body],
                           "the lattice has %.3g sites, too many to look at: choose a coarser "
                           "resolution",
                           walk->lattice.sites);
    walk->site = slice.begin;
    walk->end = slice.end;

    TRY(overlaps_rivals(overlaps, body, &walk->rivals, &walk->rival_count));
    walk->near = memory_allocate(((size_t)walk->rival_count + 1) * sizeof *walk->near);
    return walk->near ? NULL : out_of_memory();
}

/* A matrix may contain thousands of grains, so the sites of a row are tested only against the
 * bodies whose bounds meet the row. */
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

/* Whether a site is on or outside the axis of symmetry or a mirror, but for rounding. */
static bool site_cut(const struct walk *walk, struct vec3 place)
{
    const double margin = margin_of(walk->input);
    const struct vec3 low = walk->kept.low, high = walk->kept.high;
    return (geometry_power(walk->input->geometry) > 0 && place.x <= margin) ||
           place.x <= low.x + margin || place.x >= high.x - margin || place.y <= low.y + margin ||
           place.y >= high.y - margin || place.z <= low.z + margin || place.z >= high.z - margin;
}

static bool site_counts(struct walk *walk, struct vec3 place)
{
    return !site_cut(walk, place) &&
           shape_inside(&case_body(walk->input, walk->body)->shape, place) &&
           !site_dropped(walk, place);
}

/* The part of the site around *PLACE that counts, by so many points along each axis, and moves
 * *PLACE to their mean. */
static double weigh(struct walk *walk, struct vec3 *place)
{
    const int points = (int)case_body(walk->input, walk->body)->weights;
    const int dimension = (int)walk->input->dimension;
    const double spacing[3] = {walk->lattice.spacing.x, walk->lattice.spacing.y,
                               walk->lattice.spacing.z};
    int all = 1, counted = 0;
    struct vec3 sum = {0.0, 0.0, 0.0};
    for (int axis = 0; axis < dimension; axis++)
        all *= points;
    for (int k = 0; k < all; k++) {
        double step[3] = {0.0, 0.0, 0.0};
        for (int axis = 0, rest = k; axis < dimension; axis++, rest /= points)
            step[axis] = ((rest % points + 0.5) / points - 0.5) * spacing[axis];
        if (!site_counts(walk, vec3_add(*place, vector_at(step))))
            continue;
        sum = vec3_add(sum, vector_at(step));
        counted++;
    }
    if (counted > 0)
        *place = vec3_add(*place, vec3_scale(1.0 / counted, sum));
    return (double)counted / all;
}

bool walk_next(struct walk *walk, int64_t *site, struct vec3 *place)
{
    const bool weighs = case_body(walk->input, walk->body)->weights > 0;
    while (walk->site < walk->end) {
        *site = walk->site++;
        if (*site >= walk->row.first + walk->row.sites)
            walk_to_row(walk, *site);
        *place = lattice_place(&walk->lattice, &walk->row, *site);
        const double part = weighs ? weigh(walk, place) : site_counts(walk, *place) ? 1.0 : 0.0;
        walk->volume = part * walk->row.volume;
        if (part > 0.0)
            return true;
    }
    return false;
}

/* A site costs as much as a few simple shapes. Bodies that walk_begin refuses cost nothing. */
static double work_of_body(const struct place *place, int body, const struct ranks *ranks)
{
    static const double work_a_site = 4.0;
    const struct lattice lattice = place_lattice(place, body);
    const double sites = lattice.sites;
    if (!(sites < sites_limit) || is_plain(place, body, &lattice))
        return 0.0;
    const struct body_input *of = case_body(place->input, body);
    const double points =
        of->weights > 0 ? pow((double)of->weights, (double)place->input->dimension) : 1.0;
    return ceil(sites / ranks->size) * points * (work_a_site + shape_work(&of->shape));
}

static double work_of_all(const struct place *place, const struct ranks *ranks)
{
    double work = 0.0;
    for (int body = 0; body < place->input->bodies.count; body++)
        work += work_of_body(place, body, ranks);
    return work;
}

double generate_work(const struct simulation_case *input, const struct ranks *ranks)
{
    const struct place whole = place_whole(input);
    return work_of_all(&whole, ranks);
}

struct error *walk_check_work(const struct place *place, const struct ranks *ranks)
{
    const struct simulation_case *input = place->input;
    const double all = work_of_all(place, ranks);
    double most = 0.0;
    int worst = 0;
    if (all <= GENERATE_MOST)
        return NULL;
    for (int body = 0; body < input->bodies.count; body++) {
        const double work = work_of_body(place, body, ranks);
        worst = work > most ? body : worst;
        most = maximum(work, most);
    }
    return input_error(
        input, "bodies", input->bodies.names[worst],
        "its %.2g sites, at each of which up to %.2g shapes are tested, take "
        "too long to count: choose a coarser resolution, fewer copies that overlap, or "
        "bodies in place of the shapes of a union",
        place_lattice(place, worst).sites, shape_work(&case_body(input, worst)->shape));
}

double walk_depth(const struct simulation_case *input, struct vec3 place)
{
    const int power = geometry_power(input->geometry);
    return power == 0 ? 1.0 : power == 1 ? place.x : square(place.x);
}

const char *walk_start(const struct simulation_case *input, int body, struct vec3 place,
                       struct point *point, double velocity[3], const char **key)
{
    const struct body_input *of = case_body(input, body);
    const struct material *material = case_material(input, of->material_index)->material;
    return body_start_at(of, material, place, point, velocity, key);
}
