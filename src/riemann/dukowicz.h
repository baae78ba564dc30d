/* The Riemann problem of two shocks, each with a shock speed linear in the jump of velocity, U_s =
 * c + A |u* - u|, solved without iteration. With u_0 = u -+ c/(2A) and P_0 = P - rho c^2/(4A) the
 * two curves are parabolas,
 *
 *   right: P* = P_0r + a |u - u_0r| (u - u_0r),   left: P* = P_0l - b |u - u_0l| (u - u_0l)
 *   a, b = rho A,
 *
 * whose one meeting point is u*. Source: Dukowicz, J. Comput. Phys. 61 (1985) 119, in the form of
 * Parshikov (2013), section 2.3. For a gas A = (gamma + 1)/2, the limit of strong shocks; for
 * condensed material the slope of the shock adiabat. */
#ifndef BOLIDE_RIEMANN_DUKOWICZ_H
#define BOLIDE_RIEMANN_DUKOWICZ_H

#include "riemann/side.h"

BOLIDE_INLINE struct contact riemann_dukowicz(struct side left, struct side right)
{
    double cl = left.impedance / left.density, cr = right.impedance / right.density;
    double a = right.density * right.shock_slope, b = left.density * left.shock_slope;
    double lowest = right.velocity - 0.5 * cr / right.shock_slope;
    double highest = left.velocity + 0.5 * cl / left.shock_slope;
    double right0 = -right.stress - 0.25 * right.impedance * cr / right.shock_slope;
    double left0 = -left.stress - 0.25 * left.impedance * cl / left.shock_slope;
    /* With x = u - lowest: a |x| x + b |x - d| (x - d) = rise, increasing in x. Which side of each
     * parabola the root is on follows from the signs at x = 0 and x = d. */
    double d = highest - lowest, rise = left0 - right0;
    double sa = -b * fabs(d) * d <= rise ? a : -a;
    double sb = a * fabs(d) * d >= rise ? -b : b;
    /* (sa + sb) x^2 - 2 sb d x + sb d^2 - rise = 0; at the root half the slope is the positive
     * square root. */
    double qa = sa + sb, qb = -sb * d, qc = sb * d * d - rise;
    double root = sqrt(maximum(qb * qb - qa * qc, 0.0));
    double sum = qb + root, difference = root - qb;
    double x = qb > 0.0 ? -qc / sum : difference / (qa == 0.0 ? 1.0 : qa);
    struct contact contact;
    contact.velocity = lowest + x;
    contact.stress = -(right0 + a * fabs(x) * x);
    return contact;
}

#endif
