/* Mie-Grüneisen about the shock adiabat in compression and about a linear elastic curve in tension.
 *
 *   p - p_r = gamma rho (e - e_r)                                              (1.63)
 *   rho > rho_0:   p_r = C_a^2 (v_0 - v) / [v_0 - S_a (v_0 - v)]^2,            (1.65)
 *                  e_r = p_r (v_0 - v)/2                                       (1.66)
 *   rho <= rho_0:  p_r = K (v_0 - v)/v_0,   e_r = p_r (v_0 - v)/2              (1.67), (1.68)
 *
 * with v = 1/rho. Source: Parshikov (2013), section 1.4. */
#ifndef BOLIDE_EOS_MIE_GRUENEISEN_H
#define BOLIDE_EOS_MIE_GRUENEISEN_H

#include "material/eos/common.h"

struct eos_mie_grueneisen {
    double density;      /* rho_0, kg/m^3 */
    double sound;        /* C_a, m/s */
    double slope;        /* S_a of U_s = C_a + S_a U_p */
    double gamma;        /* Grüneisen coefficient, constant */
    double bulk_modulus; /* K, Pa, in tension */
};

#define EOS_mie_grueneisen_NAME "mie-grueneisen"
#define EOS_mie_grueneisen_HELP \
    "Mie-Grueneisen about the shock adiabat U_s = sound + slope U_p, linear elastic in tension"
#define EOS_mie_grueneisen_PARAMETERS(T)                                                    \
    NUMBER(T, density, "kg/m^3", REQUIRED, POSITIVE, "density at zero pressure and energy") \
    NUMBER(T, sound, "m/s", REQUIRED, POSITIVE,                                             \
           "shock speed of a vanishing shock, C_a of U_s = C_a + S_a U_p")                  \
    NUMBER(T, slope, "", REQUIRED, NOT_NEGATIVE,                                            \
           "slope of the shock adiabat, S_a of U_s = C_a + S_a U_p")                        \
    NUMBER(T, gamma, "", REQUIRED, NOT_NEGATIVE, "Grueneisen coefficient")                  \
    NUMBER(T, bulk_modulus, "Pa", REQUIRED, POSITIVE, "bulk modulus in tension")

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
    value.status = 0;
    if (dv <= 0.0) {
        slope = solid->bulk_modulus * solid->density;
        curve = slope * dv;
    } else {
        if (reach < guard) {
            reach = guard;
            value.status = POINT_OUT_OF_RANGE;
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

BOLIDE_INLINE struct eos_traits eos_mie_grueneisen_traits(const struct eos_mie_grueneisen *solid)
{
    struct eos_traits traits = eos_default_traits();
    traits.shock_slope = solid->slope;
    return traits;
}

#endif
