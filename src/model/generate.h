/* From bodies to particles: a lattice fills each shape. What can be said of them before there are
 * any. */
#ifndef BOLIDE_GENERATE_H
#define BOLIDE_GENERATE_H

#include "model/findings.h"
#include "model/simulation.h"
#include "shape/lattice.h"

struct extremes {
    double low, high;
};

/* What a body will be, for `bolide check`. */
struct body_summary {
    int64_t particles;
    int64_t counted; /* of these, in the box that was asked for */
    double mass;     /* kg, kg/m or kg/m^2 in 3-D, 2-D, 1-D */
    double diameter; /* of a particle, of the mean where they differ, m */
    struct extremes density, pressure, temperature,
        speed;            /* at the start; temperature NAN: it has none */
    struct point fastest; /* the state at the start, of particles that differ the one with the
                             fastest sound */
};

/* Whether walls or periodic faces keep bodies from both sides of AXIS: they stand for infinite
 * ones. */
bool walls_on_both_sides(const struct simulation_case *input, int axis);

/* The bounds of BODY's shape between the walls that cut it; about an axis those of its part at
 * x > 0, if it has one. */
struct bounds body_bounds(const struct simulation_case *input, int body);
struct bounds place_bounds(const struct place *place, int body);

/* The middle of these bounds, and how fast BODY moves there at the start. */
struct vec3 body_middle(const struct simulation_case *input, int body);
struct vec3 body_velocity(const struct simulation_case *input, int body);

struct lattice body_lattice(const struct simulation_case *input, int body);
struct lattice place_lattice(const struct place *place, int body);

/* Largest initial particle diameter of a case, m: the store's cell follows from it. */
double largest_diameter(const struct simulation_case *input);

/* Collective: counts the PARTICLES that this rank will make. ERROR_INPUT (located) when two bodies
 * overlap and neither replaces the other, when a body has no particle, or when a particle lies
 * behind a wall. */
struct error *generate_count(const struct place *place, const struct ranks *ranks,
                             int64_t *particles);

/* Finds what is possible but perhaps not what is meant: a body so thin that others get
 * through it, or that it becomes one particles thickness; a start below 0 K; a body that an axis or
 * mirror cuts, unless in half; one whose particles have another volume than its shape. */
void generate_judge(struct findings *findings);

/* About how many simple shapes a rank has to ask to count the particles of INPUT, where a site
 * counts as a few. More than GENERATE_LONG take a minute, which should be announced; more than
 * GENERATE_MOST are refused. */
double generate_work(const struct simulation_case *input, const struct ranks *ranks);
#define GENERATE_LONG 0x1p31
#define GENERATE_MOST 0x1p36

/* Counts without making: SUMMARY has an entry for each body. Only particles in BOX, NULL:
 * everywhere, are counted apart, and must not lie behind walls. */
struct error *generate_summary(const struct simulation_case *input, const struct bounds *box,
                               struct body_summary *summary);

#endif
