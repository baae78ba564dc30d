/* Where the faces of the domain lie that a case names or implies. */
#ifndef BOLIDE_DOMAIN_H
#define BOLIDE_DOMAIN_H

#include "case/case.h"
#include "parallel/ghosts.h"

/* A face and where it stands in the case, for messages. */
struct face_place {
    double at; /* m */
    const char *section, *name;
};

/* The low or high face across AXIS: of `domain`, else of a wall, else of the bodies. */
struct face_place domain_face(const struct simulation_case *input, int axis, int side);

/* Makes axes of MIRRORS periodic or closes them where boundaries say so, which the solver
 * judges. */
void domain_set_faces(const struct simulation_case *input, struct mirrors *mirrors);

#endif
