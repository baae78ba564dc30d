/* Mie-Grüneisen with constant gamma rho, as one formula of eta = rho/rho_0 in compression and
 * tension:
 *
 *   p = rho_0 C_0^2 f(eta) + rho_0 gamma_0 e
 *   f = (eta - 1) [eta - gamma_0 (eta - 1)/2] / [eta - s (eta - 1)]^2
 *
 * In compression its shock adiabat from rest is U_s = C_0 + s U_p. Source: Wang, Chen and Huang
 * (2024), (19). */
#ifndef BOLIDE_EOS_GRUENEISEN_ETA_H
#define BOLIDE_EOS_GRUENEISEN_ETA_H

#include "material/eos/grueneisen.h"

struct eos_grueneisen_eta {
    double density; /* rho_0, kg/m^3 */
    double sound;   /* C_0 (a_0 of the source), m/s */
    double slope;   /* s of U_s = C_0 + s U_p */
    double gamma;   /* Grüneisen coefficient at rho_0 */
    int form;       /* enum eos_form */
};

#define EOS_grueneisen_eta_NAME "grueneisen-eta"
#define EOS_grueneisen_eta_HELP \
    "Mie-Grueneisen with gamma*density constant, one formula in compression and tension"
#define EOS_grueneisen_eta_SAMPLE                \
    {                                            \
        2785.0, 5328.0, 1.338, 2.0, EOS_EXTENDED \
    } /* aluminium */
#define EOS_grueneisen_eta_PARAMETERS(T)                                                    \
    NUMBER(T, density, "kg/m^3", REQUIRED, POSITIVE, "density at zero pressure and energy") \
    NUMBER(T, sound, "m/s", REQUIRED, POSITIVE,                                             \
           "C_0 of U_s = C_0 + s U_p, the speed of a weak shock")                           \
    NUMBER(T, slope, "", REQUIRED, NOT_NEGATIVE,                                            \
           "slope of the shock adiabat, s of U_s = C_0 + s U_p")                            \
    NUMBER(T, gamma, "", REQUIRED, NOT_NEGATIVE, "Grueneisen coefficient at zero pressure") \
    EOS_FORM_PARAMETER(T)

BOLIDE_INLINE struct eos_value eos_grueneisen_eta(const struct eos_grueneisen_eta *solid,
                                                  double density, double energy,
                                                  const double *history)
{
    (void)history;
    struct eos_value value;
    double eta = density / solid->density, k = eta - 1.0;
    double thermal = solid->density * solid->gamma;
    double over = eta - solid->slope * k;
    /* Beyond the largest compression of the adiabat the denominator is held at its guard value. */
    double guard = 1e-3;
    const bool within = (eta >= grueneisen_tension()) &
                        (solid->gamma * k <= 2.0 * (1.0 - grueneisen_product_weight()) * eta) &
                        grueneisen_on_adiabat(solid->slope, k, eta) &
                        grueneisen_is_warm(solid->sound, energy);
    value.status = within | (solid->form == EOS_SOURCE) ? 0 : POINT_BEYOND;
    if (over < guard) {
        over = guard;
        value.status |= POINT_OUT_OF_RANGE;
    }
    double under = k * (eta - 0.5 * solid->gamma * k);
    double f = under / square(over);
    double f_slope = (2.0 * eta - 1.0 - solid->gamma * k) / square(over) -
                     2.0 * under * (1.0 - solid->slope) / (over * square(over));
    double c2 = square(solid->sound);
    value.pressure = solid->density * c2 * f + thermal * energy;
    value.dp_drho = c2 * f_slope;
    value.dp_de = thermal;
    return value;
}

/* The largest density of the source's form, p_H and h, see grueneisen.h. */
BOLIDE_INLINE double grueneisen_eta_end(const struct eos_grueneisen_eta *solid)
{
    const double weight = 2.0 * (1.0 - grueneisen_product_weight()) / solid->gamma;
    return solid->density / (1.0 - minimum(weight, grueneisen_largest_strain(solid->slope)));
}

BOLIDE_INLINE struct eos_curve_point grueneisen_eta_adiabat(const struct eos_grueneisen_eta *solid,
                                                            double density)
{
    return grueneisen_linear_adiabat(solid->density, solid->sound, solid->slope, density);
}

BOLIDE_INLINE struct eos_curve_point grueneisen_eta_weight(const struct eos_grueneisen_eta *solid,
                                                           double density)
{
    const struct eos_curve_point h = {1.0 - 0.5 * solid->gamma * (1.0 - solid->density / density),
                                      -0.5 * solid->gamma * solid->density / square(density)};
    return grueneisen_weight(h, grueneisen_product_weight());
}

BOLIDE_INLINE struct eos_traits eos_grueneisen_eta_traits(const struct eos_grueneisen_eta *solid)
{
    struct eos_traits traits = eos_default_traits();
    traits.shock_slope = solid->slope;
    return traits;
}

/* The shock adiabat from rest, continued into tension, with x = 1 - rho_0/rho:
 *
 *   e_r = (C_0 x/(1 - s x))^2/2
 *   T_r = exp(gamma_0 x) [T_0 + (C_0^2 s/C_V) int_0^x exp(-gamma_0 y) y^2/(1 - s y)^3 dy]
 *
 * from Walsh and Christian's C_V (dT/dv + gamma_0 T/v_0) = [(v_0 - v) dp/dv + p]/2, Phys. Rev. 97
 * (1955) 1544. With e^u = 1/(1 - s y) the integral is that of exp(-gamma_0 y) (e^u - 1)^2/s^3 over
 * u. */
BOLIDE_INLINE struct heat_curve grueneisen_eta_curve(const struct eos_grueneisen_eta *solid,
                                                     const struct heat *heat, double density)
{
    double x = 1.0 - solid->density / density, s = solid->slope, work = 0.0;
    /* held beyond the largest compression, as the pressure is */
    double reach = maximum(1.0 - s * x, 1e-3), end = -logarithm(reach);
    if (s > 0.0) {
        for (int k = 0; k < QUADRATURE; k++) {
            const struct quadrature q = quadrature_point(k);
            double grown = exponential(0.5 * end * (1.0 + q.at)), y = (1.0 - 1.0 / grown) / s;
            work += 0.5 * end * q.weight * exponential(-solid->gamma * y) * square(grown - 1.0);
        }
        work *= square(solid->sound / s) / heat->capacity;
    }
    struct heat_curve curve = {exponential(solid->gamma * x) * (heat->temperature + work),
                               0.5 * square(solid->sound * x / reach)};
    return curve;
}

GRUENEISEN_CONTINUED(grueneisen_eta, 0.0)

#endif
