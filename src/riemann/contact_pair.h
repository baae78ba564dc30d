/* The contact of two particles: what a pair of them exchanges where a Riemann problem is solved
 * along the pair, with velocity and traction split into the part along its axis and the part across
 * it. The kernel of second-order SPH calls contact_pair, that of first order its parts
 * (sph/contact/body.h). Both parts are linear in the differences between the two sides
 * (acoustic.h); the part along may be one of strong shocks instead; and a contact law may open the
 * contact or let it slip.
 *
 * Values may be carried to the contact first by limited slopes: the left side's by a fraction l of
 * the difference between the two, the right side's by a fraction r, so that 1 - l - r of it is left
 * to the Riemann problem. Source: Parshikov (2013), (1.20)-(1.37), and docs/sph.md for the laws and
 * the slopes. */
#ifndef BOLIDE_RIEMANN_CONTACT_PAIR_H
#define BOLIDE_RIEMANN_CONTACT_PAIR_H

#include "base/vector.h"
#include "riemann/dukowicz.h"
#include "riemann/exact_gas.h"
#include "riemann/shock.h"

/* Where stress and velocity along the axis come from. */
enum pair_star {
    STAR_ACOUSTIC,  /* acoustic.h */
    STAR_MEAN,      /* arithmetic means: no Riemann problem */
    STAR_DUKOWICZ,  /* dukowicz.h */
    STAR_EXACT_GAS, /* exact_gas.h */
    STAR_SHOCK,     /* shock.h: acoustic, by the impedances of shocks */
};

/* Fractions of the differences between the sides that slopes carry to the contact. */
struct pair_carried {
    double velocity, stress; /* along the axis */
    double sliding, shear;   /* across it */
};

/* A side: impedances rho C_l and rho C_t (0 for a fluid), density and shock_slope as the solver of
 * strong shocks takes them (STAR_SHOCK: rho times the slope, side.h otherwise), stress along the
 * axis and traction across it, at the particle. */
struct pair_side {
    double impedance, shear_impedance, density, shock_slope;
    double stress;
    struct vec3 shear;
    struct pair_carried carried;
};

/* What the right side has more than the left: velocity along the axis, and across it velocity and
 * traction. */
struct pair_difference {
    double velocity;
    struct vec3 sliding, shear;
};

/* How pairs of a kind meet: constants where this is inlined. */
struct pair_law {
    enum pair_star star;
    bool shear;   /* the sides have traction across the axis */
    bool carried; /* by slopes */
    bool cuts;    /* contact laws may act */
    bool calms;   /* jumps of stress between elastic sides may count in part, see pair_share */
};

/* What a pair of its own adds to that: not zero where it carries no traction across the axis, and
 * where it carries no tension; and of the difference of velocities, what counts in the stress: 1
 * but for fluids that slide past each other. Of how far both sides are elastic solids, 0 to 1. */
struct pair_limits {
    double slip, open, brake, elastic;
};

/* sigma* and U* less the velocity of the left side, along the axis and across it. */
struct pair_contact {
    double stress, velocity;
    struct vec3 shear, sliding;
};

/* What both parts of a contact are linear in. */
struct pair_weights {
    struct contact_weights along, across;
};

BOLIDE_INLINE struct pair_weights pair_weights_of(const struct pair_side *left,
                                                  const struct pair_side *right,
                                                  enum pair_star star)
{
    struct pair_weights weights = {riemann_mean_weights(), riemann_mean_weights()};
    if (star == STAR_SHOCK) { /* the part along is weighed by its own shocks */
        weights.across = riemann_acoustic_weights(left->shear_impedance, right->shear_impedance);
    } else if (star != STAR_MEAN) {
        const struct two_inverses inverse = inverses_of_sums(
            left->impedance, right->impedance, left->shear_impedance, right->shear_impedance);
        weights.along = contact_weights_of(left->impedance, right->impedance, inverse.first);
        weights.across =
            contact_weights_of(left->shear_impedance, right->shear_impedance, inverse.second);
    }
    return weights;
}

/* The share of a jump of stress that moves the contact, from the squares of MOVES, impedance times
 * jump of velocity, and of PULLS, jump of stress. In a wave both are equal, and all of it counts.
 * Where stress jumps more, as in the reflection at an oblique surface, the rest is an error of the
 * slopes; between elastic particles nothing is gained from it, and vibrations lose their energy to
 * it. Plastic flow needs it. */
BOLIDE_INLINE double pair_share(double elastic, double moves, double pulls)
{
    const double tiny = 1e-60;
    return 1.0 - elastic * (1.0 - minimum(1.0, moves / maximum(pulls, tiny)));
}

/* Stress and velocity along the axis, before the law. */
BOLIDE_INLINE struct contact pair_along(const struct pair_side *left, const struct pair_side *right,
                                        double velocity, struct pair_limits limits,
                                        struct pair_law law, const struct contact_weights *along)
{
    struct contact contact;
    if (law.star == STAR_DUKOWICZ || law.star == STAR_EXACT_GAS) {
        const struct side l = {left->impedance, 0.0, left->stress, left->density,
                               left->shock_slope};
        const struct side r = {right->impedance, velocity, right->stress, right->density,
                               right->shock_slope};
        return law.star == STAR_DUKOWICZ ? riemann_dukowicz(l, r) : riemann_exact_gas(l, r);
    }
    if (law.carried) {
        const double stress = right->stress - left->stress;
        const double rise = left->carried.velocity * velocity;
        const double jump = velocity - rise - right->carried.velocity * velocity;
        const double left_stress = left->stress + left->carried.stress * stress;
        const double right_stress = right->stress - right->carried.stress * stress;
        const double step = right_stress - left_stress;
        const struct contact_weights w =
            law.star == STAR_SHOCK
                ? riemann_shock_weights(left->impedance, right->impedance, left->shock_slope,
                                        right->shock_slope, jump, step)
                : *along;
        const double both = 0.5 * (left->impedance + right->impedance);
        const double share =
            law.calms ? pair_share(limits.elastic, square(both * jump), square(step)) : 1.0;
        contact.stress = contact_stress(w, left_stress, right_stress, limits.brake * jump);
        contact.velocity = rise + contact_velocity_jump(w, jump, share * step);
        return contact;
    }
    contact.stress = contact_stress(*along, left->stress, right->stress, velocity);
    contact.velocity = contact_velocity_jump(*along, velocity, right->stress - left->stress);
    return contact;
}

/* What slopes leave of the difference of velocities across the axis. */
BOLIDE_INLINE double pair_open(const struct pair_side *left, const struct pair_side *right)
{
    return 1.0 - left->carried.sliding - right->carried.sliding;
}

/* Traction across the axis, of the two sides' own and of what they slide past each other. */
BOLIDE_INLINE struct vec3 pair_shear(struct contact_weights across, struct vec3 left,
                                     struct vec3 right, struct vec3 sliding)
{
    return vec3_add(vec3_add(vec3_scale(across.left, right), vec3_scale(across.right, left)),
                    vec3_scale(across.impedance, sliding));
}

/* Velocity across the axis less that of the left side; SHEAR is the difference of the tractions. */
BOLIDE_INLINE struct vec3 pair_sliding(struct contact_weights across, struct vec3 sliding,
                                       struct vec3 shear)
{
    return vec3_add(vec3_scale(across.right, sliding), vec3_scale(across.compliance, shear));
}

/* Velocity along the axis less that of the left side, STRESS its own: where the contact is OPEN the
 * left side unloads to a free surface, elsewhere that of the bound contact. */
BOLIDE_INLINE double pair_free_velocity(bool open, double impedance, double stress, double bound)
{
    return open ? -stress / impedance : bound;
}

/* The same across it, where the contact carries no traction there. */
BOLIDE_INLINE struct vec3 pair_free_sliding(bool free, double shear_impedance, struct vec3 shear,
                                            struct vec3 bound)
{
    const double still = shear_impedance > 0.0 ? -1.0 / shear_impedance : 0.0;
    return vec3_make(free ? still * shear.x : bound.x, free ? still * shear.y : bound.y,
                     free ? still * shear.z : bound.z);
}

/* The part along the axis, and the weights of that across it. */
struct pair_solved {
    struct contact along;
    struct contact_weights across;
};

/* Adds the law, and what is across the axis. */
BOLIDE_INLINE struct pair_contact pair_across(const struct pair_side *left,
                                              const struct pair_side *right,
                                              const struct pair_difference *difference,
                                              struct pair_limits limits, struct pair_law law,
                                              const struct pair_solved *solved)
{
    const struct vec3 none = {0.0, 0.0, 0.0};
    const struct contact along = solved->along;
    const struct contact_weights *across = &solved->across;
    struct pair_contact c = {along.stress, along.velocity, none, none};
    double opened = 0.0;
    if (law.cuts) {
        opened = along.stress > 0.0 ? limits.open : 0.0;
        c.velocity =
            pair_free_velocity(opened > 0.0, left->impedance, left->stress, along.velocity);
        c.stress = opened > 0.0 ? 0.0 : along.stress;
    }
    if (!law.shear) {
        const double fraction =
            law.carried ? left->carried.sliding + 0.5 * pair_open(left, right) : 0.5;
        c.sliding = vec3_scale(fraction, difference->sliding);
        return c;
    }
    if (law.carried) {
        /* of the difference of tractions, what reaches the contact: the right side's by the left's
         * weight, and back */
        const double l = left->carried.shear, r = right->carried.shear;
        const double fraction = across->left * (1.0 - r) + across->right * l;
        const double open = pair_open(left, right);
        c.shear = vec3_add(vec3_add(left->shear, vec3_scale(fraction, difference->shear)),
                           vec3_scale(across->impedance * open, difference->sliding));
        const double both = 0.5 * (left->shear_impedance + right->shear_impedance) * open;
        const double step = 1.0 - l - r;
        const double share =
            law.calms
                ? pair_share(limits.elastic,
                             square(both) * vec3_dot(difference->sliding, difference->sliding),
                             square(step) * vec3_dot(difference->shear, difference->shear))
                : 1.0;
        c.sliding =
            vec3_add(vec3_scale(left->carried.sliding + across->right * open, difference->sliding),
                     vec3_scale(across->compliance * share * step, difference->shear));
    } else {
        c.shear = pair_shear(*across, left->shear, right->shear, difference->sliding);
        c.sliding = pair_sliding(*across, difference->sliding, difference->shear);
    }
    if (law.cuts) {
        const bool free = maximum(opened, limits.slip) > 0.0;
        c.shear = vec3_scale(free ? 0.0 : 1.0, c.shear);
        c.sliding = pair_free_sliding(free, left->shear_impedance, left->shear, c.sliding);
    }
    return c;
}

/* The contact of LEFT and RIGHT under LAW, as the left side sees it. */
BOLIDE_INLINE struct pair_contact contact_pair(const struct pair_side *left,
                                               const struct pair_side *right,
                                               const struct pair_difference *difference,
                                               struct pair_limits limits, struct pair_law law)
{
    const struct pair_weights weights = pair_weights_of(left, right, law.star);
    struct pair_solved solved;
    solved.along = pair_along(left, right, difference->velocity, limits, law, &weights.along);
    solved.across = weights.across;
    return pair_across(left, right, difference, limits, law, &solved);
}

#endif
