/* How kernels read stress from their records, and sums over a row's lanes that they share: a stress
 * is sigma_xx alone for fluids and in 1-D, (xx, yy, xy) in 2-D, (xx, yy, zz, xy, yz, zx) in 3-D.
 * For the files that are compiled once an instruction set. */
#ifndef BOLIDE_SPH_RECORD_H
#define BOLIDE_SPH_RECORD_H

#include "base/vector.h"
#include "sph/lanes.h"

/* The vector that stands STEP doubles apart from V on. */
BOLIDE_INLINE struct vec3 vector_from(int dimension, const double *v, int step)
{
    return vec3_make(v[0], dimension > 1 ? v[step] : 0.0, dimension > 2 ? v[2 * step] : 0.0);
}

/* The stress that stands STEP doubles apart from S on, in the order of the record. */
BOLIDE_INLINE struct sym3 stress_from(int dimension, const double *s, int step)
{
    struct sym3 stress = {s[0], 0.0, 0.0, 0.0, 0.0, 0.0};
    if (dimension == 2) {
        stress.yy = s[step];
        stress.xy = s[2 * step];
    }
    if (dimension == 3) {
        stress.yy = s[step];
        stress.zz = s[2 * step];
        stress.xy = s[3 * step];
        stress.yz = s[4 * step];
        stress.zx = s[5 * step];
    }
    return stress;
}

BOLIDE_INLINE struct vec3 traction_of(int dimension, struct sym3 s, struct vec3 e)
{
    if (dimension == 1)
        return vec3_make(s.xx * e.x, 0.0, 0.0);
    if (dimension == 2)
        return vec3_make(s.xx * e.x + s.xy * e.y, s.xy * e.x + s.yy * e.y, 0.0);
    return sym3_dot(s, e);
}

/* What the contact laws between particles follow from. */
struct laws {
    const struct neighbours *neighbours;
    const struct contact_groups *groups;
    const uint16_t *body; /* of owned particles */
};

/* The law between the bodies of particle I and record J, as bits. */
BOLIDE_INLINE unsigned laws_between(const struct laws *laws, int32_t i, int32_t j)
{
    const struct neighbours *n = laws->neighbours;
    const struct contact_groups *groups = laws->groups;
    const uint8_t *law =
        groups->law + (size_t)groups->of_body[laws->body[i]] * (size_t)groups->groups;
    if (j >= n->count && j < n->count + n->ghosts.count)
        j = n->ghosts.source[j - n->count];
    return j < n->count ? law[groups->of_body[laws->body[j]]]
           : j < n->count + n->ghosts.remotes
               ? law[groups->of_body[n->ghosts.remote[j - n->count].body]]
               : 0;
}

/* The same of the eight neighbours of LIST: which cut shear, which tension. */
BOLIDE_INLINE void stage_laws(const struct laws *laws, int32_t i, const uint32_t *list,
                              double *slip, double *open)
{
    for (int k = 0; k < LANES; k++) {
        const unsigned bits = laws_between(laws, i, (int32_t)list[k]);
        slip[k] = bits & LAW_SLIP ? 1.0 : 0.0;
        open[k] = bits & LAW_NO_TENSION ? 1.0 : 0.0;
    }
}

#endif
