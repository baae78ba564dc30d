/* The contact of two bodies at a node. Source: Cui, dissertation (2014), (2-22)-(2-32); Ma, Zhang
 * and Huang, CMES 55 (2010) 61. */
#ifndef BOLIDE_MPM_CONTACT_H
#define BOLIDE_MPM_CONTACT_H

#include "base/vector.h"

/* A body's part of a node: mass, and the momentum that it would have at the end of the step without
 * contact. */
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

/* The impulse that body A gets in the step, and B its opposite where it is free. NORMAL points out
 * of A, of length one. */
struct contact_push {
    struct vec3 impulse;
    enum contact_state state;
};

/* What the rule leaves of the impulse that gives both the SAME velocity. */
BOLIDE_INLINE struct contact_push contact_limit(struct vec3 same, struct vec3 normal,
                                                struct contact_rule rule)
{
    struct contact_push push = {same, CONTACT_STICKS};
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

/* Both are free. */
BOLIDE_INLINE struct contact_push contact_push(struct contact_side a, struct contact_side b,
                                               struct vec3 normal, struct contact_rule rule)
{
    const double both = a.mass + b.mass;
    const struct vec3 wanted = vec3_sub(vec3_scale(a.mass, b.momentum), /* (2-29) */
                                        vec3_scale(b.mass, a.momentum));
    return contact_limit(vec3_scale(1.0 / both, wanted), normal, rule);
}

/* Body B keeps its VELOCITY whatever pushes back. */
BOLIDE_INLINE struct contact_push contact_push_prescribed(struct contact_side a,
                                                          struct vec3 velocity, struct vec3 normal,
                                                          struct contact_rule rule)
{
    return contact_limit(vec3_sub(vec3_scale(a.mass, velocity), a.momentum), normal, rule);
}

/* A transmitting surface: its normal, of length one, impedance times area along and across it. */
struct contact_outlet {
    struct vec3 normal;
    double along, across;
};

/* What body A gets in DT from one of VELOCITY u that keeps all of its state, as from material that
 * no wave has reached: the FORCE of its stresses and Z A (u - v') of the surface between, v' the
 * velocity at the end (Lysmer and Kuhlemeyer, J. Eng. Mech. Div. ASCE 95 (1969) 859). */
BOLIDE_INLINE struct vec3 contact_run_out(struct contact_side a, struct vec3 force,
                                          struct vec3 velocity, struct contact_outlet outlet,
                                          double dt)
{
    const struct vec3 normal = outlet.normal;
    const double along = outlet.along, across = outlet.across;
    const struct vec3 pushed = vec3_add(a.momentum, vec3_scale(dt, force));
    const double p = vec3_dot(pushed, normal), u = vec3_dot(velocity, normal);
    const struct vec3 p_across = vec3_sub(pushed, vec3_scale(p, normal)),
                      u_across = vec3_sub(velocity, vec3_scale(u, normal));
    const double own = a.mass / (a.mass + dt * along), own_across = a.mass / (a.mass + dt * across);
    const struct vec3 after =
        vec3_add(vec3_scale(own * (p + dt * along * u), normal),
                 vec3_scale(own_across, vec3_add(p_across, vec3_scale(dt * across, u_across))));
    return vec3_sub(after, a.momentum);
}

#endif
