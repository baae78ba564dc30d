/* A blast in an ideal gas of gamma 1.4 with a pressure of its own (counter-pressure): energy is set
 * free at once on a plane, a line or at a point. The blast begins as Sedov's and becomes a sound
 * wave. Known are the place of its front and the jump there. */
#ifndef BOLIDE_EXACT_POINT_EXPLOSION_H
#define BOLIDE_EXACT_POINT_EXPLOSION_H

#include "base/parameter.h"
#include "exact/exact.h"

struct exact_point_explosion {
    int geometry;           /* enum radial_geometry: plane, line, point */
    struct quantity energy; /* J/m^2 on both sides of a plane, J/m of a line, J at a point */
    double density, pressure, age;
    struct vector_value center;
};

extern const struct parameter exact_point_explosion_table[];
extern const struct exact_class exact_point_explosion_class;

#endif
