/* The contact of two bodies at a node. Source: Cui, dissertation (2014), (2-22)-(2-32); Ma, Zhang and Huang, CMES 55 (2010)
 * 61. */
#ifndef BOLIDE_MPM_CONTACT_H
#define BOLIDE_MPM_CONTACT_H

#include "base/vector.h"

/* A body's part of a node: mass, and the momentum that it would have at the end of the step without contact. */
struct contact_side {
    double mass;
    struct vec3 momentum;
};

/* What keeps two bodies together: friction mu, INFINITY sticks; whether they may part. */
struct contact_rule {
    double friction;
    bool opens;
};

enum contact_state { CONTACT_NONE, CONTACT_SLIPS, CONTACT_STICKS };

/* The impulse that body A gets in the step, and B its opposite. NORMAL points out of A, of length one. */
struct contact_push {
    struct vec3 impulse;
    enum contact_state state;
};

BOLIDE_INLINE struct contact_push contact_push(struct contact_side a, struct contact_side b,
                                               struct vec3 normal, struct contact_rule rule)
{
    const double both = a.mass + b.mass;
    /* that which gives both the same velocity (2-29) */
    struct contact_push push = {vec3_scale(1.0 / both, vec3_sub(vec3_scale(a.mass, b.momentum),
                                                                vec3_scale(b.mass, a.momentum))),
                                CONTACT_STICKS};
    const double along = vec3_dot(push.impulse, normal);
    if (rule.opens && !(along < 0.0)) { /* they part (2-22) */
        push.impulse = vec3_make(0.0, 0.0, 0.0);
        push.state = CONTACT_NONE;
        return push;
    }
    const struct vec3 across = vec3_scale(along, normal), shear = vec3_sub(push.impulse, across);
    const double wanted = sqrt(vec3_dot(shear, shear)), limit = rule.friction * fabs(along);
    if (!isinf(rule.friction) && wanted > limit) { /* (2-32) */
        push.impulse = vec3_add(across, vec3_scale(limit / wanted, shear));
        push.state = CONTACT_SLIPS;
    }
    return push;
}

#endif
