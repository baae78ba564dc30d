/* The surface of a body as small plane elements. It is sampled from the shape of the body on a grid
 * finer than the particles; each element is attached to the nearest particle and follows the
 * deformation gradient that the particles around it have now. So the area and the normal of a
 * surface stay right where a body flies, rotates and bends, however thin it is. Surfaces that
 * appear by fracture are not part of it. */
#ifndef BOLIDE_SURFACE_H
#define BOLIDE_SURFACE_H

#include "case/case.h"
#include "model/place.h"
#include "model/population.h"
#include "parallel/ranks.h"

/* What is on the outer side of an element at the start: nothing; a wall, the axis, an outflow or a
 * periodic face; another body. */
enum surface_cover { SURFACE_FREE, SURFACE_AT_WALL, SURFACE_COVERED, SURFACE_COVERS };

/* The area vector points outward: m^2, m per metre of depth in 2-D, 1 in 1-D. About an axis the
 * state now has it per radian, m^2. */
struct surface_state {
    struct vec3 place, area, normal;
};

struct surface_element {
    int32_t site; /* of its particle */
    enum surface_cover cover;
    struct surface_state start;
};

struct body_surface {
    int body, dimension;
    bool round;     /* about an axis */
    double spacing; /* of the particles, the largest of the axes */
    int32_t elements;
    struct surface_element *element; /* sorted by site */
    struct surface_state *now;
    /* Particles with elements and those around them, by increasing id. */
    int32_t sites;
    uint64_t *id;
    struct vec3 *start;
    struct vec3 *place;    /* now; -INFINITY: the particle is gone */
    int32_t *member;       /* index on this rank; -1: it has none */
    int32_t *first, *near; /* near[first[k]] to near[first[k + 1] - 1]: the sites around site k */
};

/* Samples the surface of BODY; free it in any case. ERROR_SYSTEM: out of memory. ERROR_INPUT: its
 * lattice has too many sites. */
struct error *surface_create(const struct place *place, int body, struct body_surface *surface);
void surface_free(struct body_surface *surface);

/* Collective: finds the members of POPULATION and brings `now` up to date. An element whose
 * particle is gone has no area. */
void surface_follow(struct body_surface *surface, const struct population *population,
                    const struct ranks *ranks);

#endif
