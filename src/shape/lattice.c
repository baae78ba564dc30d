/* Square, cubic and hexagonal lattices, and concentric rings. Rings: Parshikov (2013), section 2.6,
 * sectors of equal area; and for any number of sites a ring the same as near as whole numbers
 * allow. */
#include "shape/lattice.h"

#include "shape/kinds.h"

static const struct parameter rings_table[] = {
    PARAMETER(VECTOR, struct lattice_rings, center, OPTIONAL,
              "the center of the rings; default: that of the shape, whose inner and outer radius "
              "the rings then fill",
              .unit = "m"),
    PARAMETER(INTEGER, struct lattice_rings, count, "0",
              "number of particles in every ring, all of equal mass; 0: as the resolution "
              "requires, more in wider rings",
              .below = 1e6, .closed = true),
    PARAMETER(NUMBER, struct lattice_rings, start, "0 deg",
              "the direction from x about which the rings are mirror images", .unit = ""),
    PARAMETER_END,
};

const struct choice lattice_choices[] = {
    [LATTICE_SQUARE] = {"square",
                        "A square lattice, cubic in 3-D, that fills the bounds of the shape.", NULL,
                        0, NULL},
    [LATTICE_HEXAGONAL] = {"hexagonal",
                           "Rows along x, alternately shifted: six neighbours each; 2-D only.",
                           NULL, 0, NULL},
    [LATTICE_RINGS] = {"rings", "Concentric rings of particles of equal area; 2-D only.",
                       rings_table, sizeof(struct lattice_rings), NULL},
};

/* More rings than this would have more sites than ids. */
static const double rings_limit = 0x1p24, count_limit = 0x1p48;

const char *lattice_wrong(const struct one_of *lattice, const struct one_of *shape, int dimension)
{
    struct radii radii;
    if (lattice->index == LATTICE_HEXAGONAL && dimension != 2)
        return "a hexagonal lattice needs two dimensions";
    if (lattice->index != LATTICE_RINGS)
        return NULL;
    const struct lattice_rings *rings = lattice->value;
    if (dimension != 2)
        return "rings need two dimensions";
    if (rings->center.count != 0 && rings->center.count != 2)
        return "rings need two numbers in `center`";
    if (rings->center.count == 0 && !shape_radii(shape, &radii))
        return "the shape has no center: rings need a ball or shell, cut or not, or their `center`";
    return NULL;
}

/* How many steps fit into EXTENT. */
static double whole_number(double extent, double step)
{
    return maximum(round(extent / step), 1.0);
}

static void make_lines(struct lattice *lattice, struct bounds bounds, double resolution,
                       int dimension)
{
    const double low[3] = {bounds.low.x, bounds.low.y, bounds.low.z};
    const double high[3] = {bounds.high.x, bounds.high.y, bounds.high.z};
    const double between_rows = lattice->kind == LATTICE_HEXAGONAL ? sqrt(0.75) : 1.0;
    /* An axis that the case has not: one site at zero, of unit width. */
    double origin[3] = {-0.5, -0.5, -0.5}, spacing[3] = {1.0, 1.0, 1.0};
    assert(dimension <= 3);
    lattice->sites = 1.0;
    for (int axis = 0; axis < 3; axis++)
        lattice->count[axis] = 1;
    for (int axis = 0; axis < dimension; axis++) {
        const double extent = high[axis] - low[axis];
        const double count =
            whole_number(extent, axis == 1 ? between_rows * resolution : resolution);
        lattice->count[axis] = (int64_t)minimum(count, count_limit);
        lattice->sites *= count;
        spacing[axis] = extent / count;
        origin[axis] = low[axis];
    }
    lattice->origin = vec3_make(origin[0], origin[1], origin[2]);
    lattice->spacing = vec3_make(spacing[0], spacing[1], spacing[2]);
    lattice->volume = spacing[0] * spacing[1] * spacing[2];
}

/* Whole rings WIDTH wide about a given middle, as far as the farthest corner of BOUNDS. */
static struct radii radii_over(struct bounds bounds, struct vec3 center, double width)
{
    const double x = maximum(fabs(bounds.low.x - center.x), fabs(bounds.high.x - center.x));
    const double y = maximum(fabs(bounds.low.y - center.y), fabs(bounds.high.y - center.y));
    return (struct radii){center, 0.0, width * ceil(hypot(x, y) / width)};
}

/* The inner edge of ring INDEX, which is the outer one of the ring before. */
static double ring_edge(const struct lattice *lattice, int64_t index)
{
    const double inner = lattice->radii.inner, outer = lattice->radii.outer;
    const double part = (double)index / (double)lattice->rings;
    if (lattice->ring_sites)
        return sqrt(square(inner) + part * (square(outer) - square(inner)));
    return inner + part * (outer - inner);
}

/* Ring INDEX, whose first site is FIRST. Every other ring is turned by half a step, and all are
 * mirror images of themselves about the direction in which they start. */
static struct lattice_row make_ring(const struct lattice *lattice, int64_t index, int64_t first)
{
    const double inner = ring_edge(lattice, index), outer = ring_edge(lattice, index + 1);
    const struct vec3 center = lattice->radii.center;
    double radius = 0.5 * (inner + outer);
    int64_t sites = lattice->ring_sites;
    if (sites == 0)
        sites = (int64_t)maximum(round(2.0 * M_PI * radius / lattice->arc), 1.0);
    if (sites == 1 && inner == 0.0)
        radius = 0.0;
    const struct vec3 reach = vec3_make(radius, radius, 0.0);
    return (struct lattice_row){
        .index = index,
        .first = first,
        .sites = sites,
        .volume = M_PI * (outer - inner) * (outer + inner) / (double)sites,
        .bounds = {vec3_sub(center, reach), vec3_add(center, reach)},
        .shift = index % 2 ? 0.0 : 0.5,
        .radius = radius,
    };
}

static void make_rings(struct lattice *lattice, const struct lattice_rings *rings,
                       const struct one_of *shape, struct bounds bounds, double resolution)
{
    if (rings->center.count > 0)
        lattice->radii = radii_over(bounds, vec3_of(&rings->center), resolution);
    else
        shape_radii(shape, &lattice->radii);
    const double inner = lattice->radii.inner, outer = lattice->radii.outer;
    lattice->arc = resolution;
    lattice->start = rings->start;
    lattice->ring_sites = rings->count;
    lattice->volume = square(resolution);
    lattice->sites = M_PI * (outer - inner) * (outer + inner) / lattice->volume;
    const double count = rings->count ? whole_number(lattice->sites, (double)rings->count)
                                      : whole_number(outer - inner, resolution);
    if (count > rings_limit) {
        lattice->sites = INFINITY;
        return;
    }
    lattice->rings = (int64_t)count;
    lattice->sites = 0.0;
    for (int64_t i = 0; i < lattice->rings; i++) {
        const struct lattice_row ring = make_ring(lattice, i, 0);
        lattice->sites += (double)ring.sites;
        lattice->volume = i ? maximum(lattice->volume, ring.volume) : ring.volume;
    }
}

struct lattice lattice_make(const struct one_of *lattice, const struct one_of *shape,
                            struct bounds bounds, double resolution, int dimension)
{
    struct lattice made = {.kind = (enum lattice_kind)lattice->index};
    if (made.kind == LATTICE_RINGS)
        make_rings(&made, lattice->value, shape, bounds, resolution);
    else
        make_lines(&made, bounds, resolution, dimension);
    return made;
}

/* A line along x: of a hexagonal lattice they are shifted in turn, by a quarter of a step either
 * way. */
static struct lattice_row make_line(const struct lattice *lattice, int64_t index)
{
    const int64_t across = index % lattice->count[1], up = index / lattice->count[1];
    const double y = lattice->origin.y + ((double)across + 0.5) * lattice->spacing.y;
    const double z = lattice->origin.z + ((double)up + 0.5) * lattice->spacing.z;
    const double width = (double)lattice->count[0] * lattice->spacing.x;
    return (struct lattice_row){
        .index = index,
        .first = index * lattice->count[0],
        .sites = lattice->count[0],
        .volume = lattice->volume,
        .bounds = {vec3_make(lattice->origin.x, y, z), vec3_make(lattice->origin.x + width, y, z)},
        .shift = lattice->kind == LATTICE_SQUARE ? 0.5
                 : index % 2                     ? 0.75
                                                 : 0.25,
    };
}

struct lattice_row lattice_row_of(const struct lattice *lattice, int64_t site)
{
    if (lattice->kind != LATTICE_RINGS)
        return make_line(lattice, site / lattice->count[0]);
    struct lattice_row ring = make_ring(lattice, 0, 0);
    while (site >= ring.first + ring.sites)
        ring = make_ring(lattice, ring.index + 1, ring.first + ring.sites);
    return ring;
}

struct lattice_row lattice_row_after(const struct lattice *lattice, const struct lattice_row *row)
{
    return lattice->kind == LATTICE_RINGS
               ? make_ring(lattice, row->index + 1, row->first + row->sites)
               : make_line(lattice, row->index + 1);
}

struct vec3 lattice_place(const struct lattice *lattice, const struct lattice_row *row,
                          int64_t site)
{
    const double steps = (double)(site - row->first) + row->shift;
    if (lattice->kind != LATTICE_RINGS)
        return vec3_make(lattice->origin.x + steps * lattice->spacing.x, row->bounds.low.y,
                         row->bounds.low.z);
    const double angle = lattice->start + 2.0 * M_PI * steps / (double)row->sites;
    const struct vec3 center = lattice->radii.center;
    return vec3_make(center.x + row->radius * cos(angle), center.y + row->radius * sin(angle), 0.0);
}
