/* Mie-Grüneisen about a polynomial shock adiabat, mu = rho/rho_0 - 1:
 *
 *   p = p_H (1 - gamma mu/2) + gamma rho e                                    (2-65)
 *   p_H = rho_0 C_0^2 [mu + (2s - 1) mu^2 + (s - 1)(3s - 1) mu^3]   mu > 0
 *   p_H = rho_0 C_0^2 mu                                            mu <= 0   (2-66)
 *
 * The adiabat is U_s = C_0 + s U_p up to third order in mu. Source: Cui, dissertation (2014). */
#ifndef BOLIDE_EOS_GRUENEISEN_POLYNOMIAL_H
#define BOLIDE_EOS_GRUENEISEN_POLYNOMIAL_H

#include "material/eos/grueneisen.h"

struct eos_grueneisen_polynomial {
    double density; /* rho_0, kg/m^3 */
    double sound;   /* C_0, m/s */
    double slope;   /* s of U_s = C_0 + s U_p */
    double gamma;   /* Grüneisen coefficient, constant */
    int form;       /* enum eos_form */
};

#define EOS_grueneisen_polynomial_NAME "grueneisen-polynomial"
#define EOS_grueneisen_polynomial_HELP \
    "Mie-Grueneisen relative to the shock adiabat, a cubic of mu = rho/rho_0 - 1"
#define EOS_grueneisen_polynomial_SAMPLE         \
    {                                            \
        7890.0, 4569.0, 1.49, 2.17, EOS_EXTENDED \
    } /* steel */
#define EOS_grueneisen_polynomial_PARAMETERS(T)                                             \
    NUMBER(T, density, "kg/m^3", REQUIRED, POSITIVE, "density at zero pressure and energy") \
    NUMBER(T, sound, "m/s", REQUIRED, POSITIVE,                                             \
           "C_0 of U_s = C_0 + s U_p, the speed of a weak shock")                           \
    NUMBER(T, slope, "", REQUIRED, NOT_NEGATIVE,                                            \
           "slope of the shock adiabat, s of U_s = C_0 + s U_p")                            \
    NUMBER(T, gamma, "", REQUIRED, NOT_NEGATIVE, "Grueneisen coefficient")                  \
    EOS_FORM_PARAMETER(T)

BOLIDE_INLINE struct eos_value eos_grueneisen_polynomial(
    const struct eos_grueneisen_polynomial *solid, double density, double energy,
    const double *history)
{
    (void)history;
    struct eos_value value;
    double mu = density / solid->density - 1.0, s = solid->slope;
    double second = mu > 0.0 ? 2.0 * s - 1.0 : 0.0;
    double third = mu > 0.0 ? (s - 1.0) * (3.0 * s - 1.0) : 0.0;
    double modulus = solid->density * square(solid->sound);
    double curve = modulus * mu * (1.0 + mu * (second + mu * third));
    double slope = modulus * (1.0 + mu * (2.0 * second + 3.0 * mu * third)); /* dp_H/dmu */
    double share = 1.0 - 0.5 * solid->gamma * mu;
    value.pressure = curve * share + solid->gamma * density * energy;
    value.dp_drho =
        (slope * share - 0.5 * solid->gamma * curve) / solid->density + solid->gamma * energy;
    value.dp_de = solid->gamma * density;
    const bool within = (mu >= grueneisen_tension() - 1.0) &
                        (solid->gamma * mu <= 2.0 * (1.0 - grueneisen_gamma_weight())) &
                        grueneisen_is_warm(solid->sound, energy);
    value.status = within | (solid->form == EOS_SOURCE) ? 0 : POINT_BEYOND;
    return value;
}

/* The largest density of the source's form, p_H in compression and h, see grueneisen.h. */
BOLIDE_INLINE double grueneisen_polynomial_end(const struct eos_grueneisen_polynomial *solid)
{
    return solid->density * (1.0 + 2.0 * (1.0 - grueneisen_gamma_weight()) / solid->gamma);
}

BOLIDE_INLINE struct eos_curve_point grueneisen_polynomial_adiabat(
    const struct eos_grueneisen_polynomial *solid, double density)
{
    const double mu = density / solid->density - 1.0, s = solid->slope, c2 = square(solid->sound);
    const double second = 2.0 * s - 1.0, third = (s - 1.0) * (3.0 * s - 1.0);
    const struct eos_curve_point p = {solid->density * c2 * mu * (1.0 + mu * (second + mu * third)),
                                      c2 * (1.0 + mu * (2.0 * second + 3.0 * mu * third))};
    return p;
}

BOLIDE_INLINE struct eos_curve_point grueneisen_polynomial_weight(
    const struct eos_grueneisen_polynomial *solid, double density)
{
    const struct eos_curve_point h = {1.0 - 0.5 * solid->gamma * (density / solid->density - 1.0),
                                      -0.5 * solid->gamma / solid->density};
    return grueneisen_weight(h, grueneisen_gamma_weight());
}

BOLIDE_INLINE struct eos_traits eos_grueneisen_polynomial_traits(
    const struct eos_grueneisen_polynomial *solid)
{
    struct eos_traits traits = eos_default_traits();
    traits.shock_slope = solid->slope;
    return traits;
}

/* The curve p = p_H, e_r = p_H (v_0 - v)/2, with n = rho/rho_0 = 1 + mu and p_H = rho_0 C_0^2 (mu +
 * a mu^2 + b mu^3):
 *
 *   T_r = n^gamma (T_0 + C_0^2/(2 C_V) int_0^ln(n) k^(-gamma - 1) f d ln k)
 *   f = (1 + a) m^2 + 2 (a + b) m^3 + 3 b m^4
 *
 * with m = k - 1, from Walsh and Christian's C_V (dT/dv + gamma T/v) = [(v_0 - v) dp/dv + p]/2,
 * Phys. Rev. 97 (1955) 1544. */
BOLIDE_INLINE struct heat_curve grueneisen_polynomial_curve(
    const struct eos_grueneisen_polynomial *solid, const struct heat *heat, double density)
{
    double mu = density / solid->density - 1.0, s = solid->slope, c2 = square(solid->sound);
    double a = mu > 0.0 ? 2.0 * s - 1.0 : 0.0, b = mu > 0.0 ? (s - 1.0) * (3.0 * s - 1.0) : 0.0;
    double end = logarithm(1.0 + mu), work = 0.0;
    for (int k = 0; k < QUADRATURE; k++) {
        const struct quadrature q = quadrature_point(k);
        double ln = 0.5 * end * (1.0 + q.at), m = exponential(ln) - 1.0;
        work += 0.5 * end * q.weight * exponential(-(solid->gamma + 1.0) * ln) * square(m) *
                (1.0 + a + m * (2.0 * (a + b) + 3.0 * b * m));
    }
    struct heat_curve curve = {exponential(solid->gamma * end) *
                                   (heat->temperature + 0.5 * c2 / heat->capacity * work),
                               0.5 * c2 * mu * (1.0 + mu * (a + mu * b)) * mu / (1.0 + mu)};
    return curve;
}

GRUENEISEN_CONTINUED(grueneisen_polynomial, eos->gamma)

#endif
