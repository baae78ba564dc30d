/* Mie-Grüneisen about the shock adiabat in compression and about a linear elastic curve in tension.
 *
 *   p - p_r = gamma rho (e - e_r)                                              (1.63)
 *   rho > rho_0:   p_r = C_a^2 (v_0 - v) / [v_0 - S_a (v_0 - v)]^2,            (1.65)
 *                  e_r = p_r (v_0 - v)/2                                       (1.66)
 *   rho <= rho_0:  p_r = K (v_0 - v)/v_0,   e_r = p_r (v_0 - v)/2              (1.67), (1.68)
 *
 * with v = 1/rho. Source: Parshikov (2013), section 1.4; temperatures (3.1)-(3.3) and Walsh and
 * Christian, Phys. Rev. 97 (1955) 1544. */
#ifndef BOLIDE_EOS_MIE_GRUENEISEN_H
#define BOLIDE_EOS_MIE_GRUENEISEN_H

#include "material/eos/grueneisen.h"

struct eos_mie_grueneisen {
    double density;      /* rho_0, kg/m^3 */
    double sound;        /* C_a, m/s */
    double slope;        /* S_a of U_s = C_a + S_a U_p */
    double gamma;        /* Grüneisen coefficient, constant */
    double bulk_modulus; /* K, Pa, in tension */
    int form;            /* enum eos_form */
};

#define EOS_mie_grueneisen_NAME "mie-grueneisen"
#define EOS_mie_grueneisen_HELP                                                                \
    "Mie-Grueneisen relative to the shock adiabat U_s = sound + slope U_p, linear elastic in " \
    "tension"
#define EOS_mie_grueneisen_SAMPLE                      \
    {                                                  \
        2700.0, 5350.0, 1.35, 2.17, 73e9, EOS_EXTENDED \
    } /* aluminium */
#define EOS_mie_grueneisen_PARAMETERS(T)                                                    \
    NUMBER(T, density, "kg/m^3", REQUIRED, POSITIVE, "density at zero pressure and energy") \
    NUMBER(T, sound, "m/s", REQUIRED, POSITIVE,                                             \
           "C_a of U_s = C_a + S_a U_p, the speed of a weak shock")                         \
    NUMBER(T, slope, "", REQUIRED, NOT_NEGATIVE,                                            \
           "slope of the shock adiabat, S_a of U_s = C_a + S_a U_p")                        \
    NUMBER(T, gamma, "", REQUIRED, NOT_NEGATIVE, "Grueneisen coefficient")                  \
    NUMBER(T, bulk_modulus, "Pa", REQUIRED, POSITIVE, "bulk modulus in tension")            \
    EOS_FORM_PARAMETER(T)

BOLIDE_INLINE struct eos_value eos_mie_grueneisen(const struct eos_mie_grueneisen *solid,
                                                  double density, double energy,
                                                  const double *history)
{
    (void)history;
    struct eos_value value;
    double v0 = 1.0 / solid->density, v = 1.0 / density, dv = v0 - v;
    double curve, slope; /* p_r and dp_r/d(v0 - v) */
    /* Beyond the largest compression of the adiabat the curve is held at its guard value. */
    double reach = v0 - solid->slope * dv;
    double guard = 1e-3 * v0;
    const bool within = (density >= grueneisen_tension() * solid->density) &
                        (solid->gamma * (density - solid->density) <=
                         2.0 * (1.0 - grueneisen_gamma_weight()) * solid->density) &
                        grueneisen_on_adiabat(solid->slope, dv, v0) &
                        grueneisen_is_warm(solid->sound, energy);
    value.status = within | (solid->form == EOS_SOURCE) ? 0 : POINT_BEYOND;
    if (dv <= 0.0) {
        slope = solid->bulk_modulus * solid->density;
        curve = slope * dv;
    } else {
        if (reach < guard) {
            reach = guard;
            value.status |= POINT_OUT_OF_RANGE;
        }
        double c2 = square(solid->sound);
        curve = c2 * dv / square(reach);
        slope = c2 * (1.0 / square(reach) + 2.0 * solid->slope * dv / (reach * square(reach)));
    }
    double reference = 0.5 * curve * dv;
    double reference_slope = 0.5 * (slope * dv + curve);
    double excess = energy - reference;
    value.pressure = curve + solid->gamma * density * excess;
    /* d(v0 - v)/drho = v^2 */
    value.dp_drho =
        square(v) * (slope - solid->gamma * density * reference_slope) + solid->gamma * excess;
    value.dp_de = solid->gamma * density;
    return value;
}

/* The largest density of the source's form, p_H and h, see grueneisen.h. */
BOLIDE_INLINE double mie_grueneisen_end(const struct eos_mie_grueneisen *solid)
{
    const double weight = 2.0 * (1.0 - grueneisen_gamma_weight()) / solid->gamma;
    return solid->density *
           minimum(1.0 + weight, 1.0 / (1.0 - grueneisen_largest_strain(solid->slope)));
}

BOLIDE_INLINE struct eos_curve_point mie_grueneisen_adiabat(const struct eos_mie_grueneisen *solid,
                                                            double density)
{
    return grueneisen_linear_adiabat(solid->density, solid->sound, solid->slope, density);
}

BOLIDE_INLINE struct eos_curve_point mie_grueneisen_weight(const struct eos_mie_grueneisen *solid,
                                                           double density)
{
    const struct eos_curve_point h = {1.0 - 0.5 * solid->gamma * (density / solid->density - 1.0),
                                      -0.5 * solid->gamma / solid->density};
    return grueneisen_weight(h, grueneisen_gamma_weight());
}

BOLIDE_INLINE struct eos_traits eos_mie_grueneisen_traits(const struct eos_mie_grueneisen *solid)
{
    struct eos_traits traits = eos_default_traits();
    traits.shock_slope = solid->slope;
    traits.shock_sound = solid->sound;
    return traits;
}

/* T_H where the adiabat U_s = C_a + S_a U_p has compressed to eta = 1 - rho_0/rho. Walsh and
 * Christian's C_V (dT_H/dv + gamma T_H/v) = [(v_0 - v) dp_H/dv + p_H]/2 becomes for a constant
 * gamma
 *
 *   T_H = (1 - eta)^-gamma [T_0 + (C_a^2 S_a/C_V) int_0^eta (1 - y)^gamma y^2/(1 - S_a y)^3 dy]
 *
 * and with e^u = 1/(1 - S_a y) the integral that of (1 - y)^gamma (e^u - 1)^2/S_a^3 over u: as
 * smooth near the largest compression as anywhere, so that six Gauss-Legendre points serve. */
BOLIDE_INLINE double mie_grueneisen_adiabat_temperature(const struct heat *heat,
                                                        const struct eos_mie_grueneisen *solid,
                                                        double eta)
{
    /* The adiabat is held beyond its largest compression, as the equation of state holds it. */
    double end = -logarithm(maximum(1.0 - solid->slope * eta, 1e-3)), integral = 0.0;
    for (int k = 0; k < QUADRATURE; k++) {
        const struct quadrature q = quadrature_point(k);
        double grown = exponential(0.5 * end * (1.0 + q.at));
        double over = grown - 1.0, left = 1.0 - over / (grown * solid->slope); /* 1 - y */
        integral += q.weight * power(left, solid->gamma) * square(over);
    }
    integral *= 0.5 * end / (solid->slope * square(solid->slope));
    double work =
        solid->slope > 0.0 ? square(solid->sound) * solid->slope / heat->capacity * integral : 0.0;
    return (heat->temperature + work) / power(1.0 - eta, solid->gamma);
}

/* The cold curve in tension, (1.68) and (3.3), and the shock adiabat in compression, (1.66). */
BOLIDE_INLINE struct heat_curve mie_grueneisen_curve(const struct eos_mie_grueneisen *solid,
                                                     const struct heat *heat, double density)
{
    struct heat_curve curve;
    double eta = 1.0 - solid->density / density;
    if (eta <= 0.0) {
        curve.temperature = heat->temperature;
        curve.energy = 0.5 * solid->bulk_modulus * square(eta) / solid->density;
        return curve;
    }
    double reach = maximum(1.0 - solid->slope * eta, 1e-3);
    curve.temperature = mie_grueneisen_adiabat_temperature(heat, solid, eta);
    curve.energy = 0.5 * square(solid->sound * eta / reach);
    return curve;
}

GRUENEISEN_CONTINUED(mie_grueneisen, eos->gamma)

#endif
