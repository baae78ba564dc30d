/* The angular velocity of a body of particles. */
#ifndef BOLIDE_SPIN_H
#define BOLIDE_SPIN_H

#include "base/vector.h"

/* w of J w = L by Cramer's rule, with J the moment of inertia and L the angular momentum about the
 * centre of mass; in a plane it has one component. Not a number for a body that has no moment of
 * inertia about some axis. */
BOLIDE_INLINE struct vec3 spin_of(struct sym3 j, struct vec3 l, int dimension)
{
    if (dimension < 3)
        return vec3_make(0.0, 0.0, l.z / j.zz);
    struct sym3 minors = {j.yy * j.zz - j.yz * j.yz, j.xx * j.zz - j.zx * j.zx,
                          j.xx * j.yy - j.xy * j.xy, j.yz * j.zx - j.xy * j.zz,
                          j.xy * j.zx - j.xx * j.yz, j.xy * j.yz - j.yy * j.zx};
    double determinant = j.xx * minors.xx + j.xy * minors.xy + j.zx * minors.zx;
    return vec3_scale(1.0 / determinant, sym3_dot(minors, l));
}

/* The first axis about which a body turns in DIMENSION dimensions, and how many there are. */
BOLIDE_INLINE int spin_first(int dimension) { return dimension == 2 ? 2 : 0; }
BOLIDE_INLINE int spin_count(int dimension) { return dimension == 3 ? 3 : dimension == 2 ? 1 : 0; }

#endif
