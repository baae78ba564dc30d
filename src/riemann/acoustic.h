/* The Riemann problem between two states in the acoustic approximation: waves carry jumps of
 * velocity and stress in the ratio of the impedance Z = rho c.
 *
 *   U* = (Z_l U_l + Z_r U_r + sigma_r - sigma_l) / (Z_l + Z_r)               (1.20), (1.32), (1.36)
 *  sigma* = (Z_l sigma_r + Z_r sigma_l + Z_l Z_r (U_r - U_l)) / (Z_l + Z_r)  (1.21), (1.33), (1.37)
 *
 * for the component along the axis with longitudinal impedances, for those across it with shear
 * impedances. Stress is positive in tension. Source: Parshikov (2013), sections 1.2 and 1.3. */
#ifndef BOLIDE_RIEMANN_ACOUSTIC_H
#define BOLIDE_RIEMANN_ACOUSTIC_H

#include "riemann/side.h"

/* What a Riemann problem is linear in:
 *   U* = U_l + right (U_r - U_l) + compliance (sigma_r - sigma_l)
 *   sigma* = left sigma_r + right sigma_l + impedance (U_r - U_l) */
struct contact_weights {
    double left, right, compliance, impedance;
};

/* Two states without impedance (fluids in shear) carry no stress and meet at their mean velocity.
 * INVERSE is that of the sum where that is not zero. */
BOLIDE_INLINE struct contact_weights contact_weights_of(double left, double right, double inverse)
{
    struct contact_weights w;
    double sum = left + right;
    w.left = sum > 0.0 ? left * inverse : 0.5;
    w.right = sum > 0.0 ? right * inverse : 0.5;
    w.compliance = sum > 0.0 ? inverse : 0.0;
    w.impedance = left * w.right;
    return w;
}

BOLIDE_INLINE struct contact_weights riemann_acoustic_weights(double left, double right)
{
    const double tiny = 1e-100;
    return contact_weights_of(left, right, 1.0 / maximum(left + right, tiny));
}

/* The inverses that contact_weights_of wants for the sums of two pairs of impedances, with one
 * division. A sum of zero becomes a tiny one: were it chosen by a condition, compilers would divide
 * once a branch. */
struct two_inverses {
    double first, second;
};
BOLIDE_INLINE struct two_inverses inverses_of_sums(double left, double right, double left_across,
                                                   double right_across)
{
    const double tiny = 1e-100;
    double sum = maximum(left + right, tiny),
           sum_across = maximum(left_across + right_across, tiny);
    double inverse = 1.0 / (sum * sum_across);
    struct two_inverses both = {inverse * sum_across, inverse * sum};
    return both;
}

/* The arithmetic means of the two states, which turn the contact form of the SPH equations into the
 * standard one: (1.15)-(1.17) follow from (1.24)-(1.26) by (1.22), (1.23). */
BOLIDE_INLINE struct contact_weights riemann_mean_weights(void)
{
    struct contact_weights w = {0.5, 0.5, 0.0, 0.0};
    return w;
}

/* U* - U_l of a component: VELOCITY = U_r - U_l, STRESS = sigma_r - sigma_l. */
BOLIDE_INLINE double contact_velocity_jump(struct contact_weights w, double velocity, double stress)
{
    return w.right * velocity + w.compliance * stress;
}

/* sigma* of a component. */
BOLIDE_INLINE double contact_stress(struct contact_weights w, double left, double right,
                                    double velocity)
{
    return w.left * right + w.right * left + w.impedance * velocity;
}

BOLIDE_INLINE struct contact riemann_acoustic(struct side left, struct side right)
{
    struct contact_weights w = riemann_acoustic_weights(left.impedance, right.impedance);
    double jump = right.velocity - left.velocity;
    struct contact contact;
    contact.velocity = left.velocity + contact_velocity_jump(w, jump, right.stress - left.stress);
    contact.stress = contact_stress(w, left.stress, right.stress, jump);
    return contact;
}

#endif
