/* Verney's shell: a thick cylinder of an incompressible, rigid, perfectly plastic solid in plane
 * strain that runs inward with free surfaces until plastic work has stopped it. Verney (1968);
 * Howell and Ball (2002); the form of Wang, Chen and Huang (2024). Its sample takes the distance
 * from the axis, and its velocity is that away from it; it has no contact and no star states. */
#ifndef BOLIDE_EXACT_VERNEY_H
#define BOLIDE_EXACT_VERNEY_H

#include "base/parameter.h"
#include "exact/exact.h"

struct exact_verney {
    double inner_radius, outer_radius; /* at the start */
    double density, yield;
    double speed; /* of the inner surface at the start, inward */
};

extern const struct parameter exact_verney_table[];
extern const struct exact_class exact_verney_class;

#endif
