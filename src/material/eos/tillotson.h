/* Tillotson's equation of state for metals and rocks from rest to vaporisation, eta = rho/rho_0, mu
 * = eta - 1, w = 1 + e/(e_0 eta^2):
 *
 *   condensed (rho >= rho_0 or e <= e_iv):  p_c = (a + b/w) rho e + A mu + B mu^2
 *   vapour (rho < rho_0 and e >= e_cv):     p_v = a rho e + [b rho e/w + A mu exp(-beta (1/eta - 1))]
 *                                                          exp(-alpha (1/eta - 1)^2)
 *   between:                                p = [(e - e_iv) p_v + (e_cv - e) p_c] / (e_cv - e_iv)
 *
 * and the pressure is not below -tension, where that is given: the material keeps this tension as
 * it expands further, and has pressure again once it is compressed to the same density.
 *
 * By default an energy below zero, which nothing cold has at any density, counts as e/(1 - e/e_1)
 * with e_1 = e_0/5, and w is 1 there: else what is under tension and compressed would cool without
 * bound. c^2 is held at a hundredth of A/rho_0 times eta in tension beyond its maximum, A^2/(4 B)
 * at no energy. Where p > 0 the form has a sound speed everywhere.
 *
 * Source: Tillotson, General Atomic report GA-3216 (1962); in this form Melosh, Impact Cratering
 * (1989), II.4. */
#ifndef BOLIDE_EOS_TILLOTSON_H
#define BOLIDE_EOS_TILLOTSON_H

#include "material/eos/grueneisen.h"

struct eos_tillotson {
    double density;          /* rho_0, kg/m^3 */
    double a, b;             /* dimensionless */
    double bulk_modulus;     /* A, Pa */
    double second_modulus;   /* B, Pa */
    double energy;           /* e_0, J/kg */
    double alpha, beta;      /* decay of the condensed terms in the vapour */
    double incipient_energy; /* e_iv, J/kg: vaporisation begins */
    double complete_energy;  /* e_cv, J/kg: vaporisation is complete */
    double tension;          /* the largest that it bears, Pa; NAN: any */
    int form;                /* enum eos_form */
};

#define EOS_tillotson_NAME "tillotson"
#define EOS_tillotson_HELP "Tillotson: metals and rocks from rest to vaporisation"
#define EOS_tillotson_SAMPLE                                                           \
    {                                                                                  \
        2700.0, 0.5, 1.63, 75.2e9, 65e9, 5e6, 5.0, 5.0, 3e6, 13.9e6, NAN, EOS_EXTENDED \
    } /* aluminium */
#define EOS_tillotson_PARAMETERS(T)                                                                \
    NUMBER(T, density, "kg/m^3", REQUIRED, POSITIVE, "density of the cold solid at zero pressure") \
    NUMBER(T, a, "", REQUIRED, NOT_NEGATIVE, "thermal coefficient at high energy")                 \
    NUMBER(T, b, "", REQUIRED, NOT_NEGATIVE, "thermal coefficient added at low energy")            \
    NUMBER(T, bulk_modulus, "Pa", REQUIRED, POSITIVE, "A: bulk modulus at zero pressure")          \
    NUMBER(T, second_modulus, "Pa", REQUIRED, NOT_NEGATIVE, "B: coefficient of mu^2")              \
    NUMBER(T, energy, "J/kg", REQUIRED, POSITIVE, "e_0: energy scale of the thermal term")         \
    NUMBER(T, alpha, "", REQUIRED, NOT_NEGATIVE,                                                   \
           "decay of the condensed terms in the vapour, of (1/eta - 1)^2")                         \
    NUMBER(T, beta, "", REQUIRED, NOT_NEGATIVE,                                                    \
           "decay of the elastic term in the vapour, of 1/eta - 1")                                \
    NUMBER(T, incipient_energy, "J/kg", REQUIRED, POSITIVE,                                        \
           "e_iv: energy at which vaporisation begins")                                            \
    NUMBER(T, complete_energy, "J/kg", REQUIRED, POSITIVE,                                         \
           "e_cv: energy at which vaporisation is complete")                                       \
    NUMBER(T, tension, "Pa", OPTIONAL, NOT_NEGATIVE,                                               \
           "largest tension, held constant on further expansion; default: that of the cold curve") \
    EOS_FORM_PARAMETER(T)

BOLIDE_INLINE struct eos_value eos_tillotson_condensed(const struct eos_tillotson *t,
                                                       double density, double energy)
{
    struct eos_value value;
    double eta = density / t->density, mu = eta - 1.0;
    const double below = t->form == EOS_SOURCE ? 0.0 : minimum(energy, 0.0);
    const double share = 1.0 / (1.0 - below / (0.2 * t->energy)), warm = energy * share;
    double ratio = (energy - below) / (t->energy * square(eta)), w = 1.0 + ratio;
    value.pressure =
        (t->a + t->b / w) * density * warm + (t->bulk_modulus + t->second_modulus * mu) * mu;
    /* dw/drho = -2 ratio/rho, dw/de = ratio/e */
    value.dp_drho = (t->a + t->b / w + 2.0 * t->b * ratio / square(w)) * warm +
                    (t->bulk_modulus + 2.0 * t->second_modulus * mu) / t->density;
    value.dp_de = (t->a + t->b / square(w)) * density * square(share);
    value.status = 0;
    return value;
}

BOLIDE_INLINE struct eos_value eos_tillotson_vapour(const struct eos_tillotson *t, double density,
                                                    double energy)
{
    struct eos_value value;
    double eta = density / t->density, mu = eta - 1.0, thin = 1.0 / eta - 1.0;
    double ratio = energy / (t->energy * square(eta)), w = 1.0 + ratio;
    double fade = exponential(-t->alpha * square(thin)), cold = exponential(-t->beta * thin);
    double thermal = t->b * density * energy / w, elastic = t->bulk_modulus * mu * cold;
    value.pressure = t->a * density * energy + (thermal + elastic) * fade;
    /* dthin/drho = -1/(eta rho) */
    double thermal_slope = t->b * energy * (1.0 / w + 2.0 * ratio / square(w));
    double elastic_slope =
        t->bulk_modulus * cold * (1.0 / t->density + mu * t->beta / (eta * density));
    double fade_slope = 2.0 * t->alpha * thin / (eta * density);
    value.dp_drho = t->a * energy + (thermal_slope + elastic_slope) * fade +
                    (thermal + elastic) * fade * fade_slope;
    value.dp_de = t->a * density + t->b * density / square(w) * fade;
    value.status = 0;
    return value;
}

BOLIDE_INLINE struct eos_value eos_tillotson_whole(const struct eos_tillotson *t, double density,
                                                   double energy)
{
    if (density >= t->density || energy <= t->incipient_energy)
        return eos_tillotson_condensed(t, density, energy);
    struct eos_value vapour = eos_tillotson_vapour(t, density, energy);
    if (energy >= t->complete_energy)
        return vapour;
    struct eos_value condensed = eos_tillotson_condensed(t, density, energy), value;
    double width = t->complete_energy - t->incipient_energy;
    double share = (energy - t->incipient_energy) / width;
    value.pressure = share * vapour.pressure + (1.0 - share) * condensed.pressure;
    value.dp_drho = share * vapour.dp_drho + (1.0 - share) * condensed.dp_drho;
    value.dp_de = share * vapour.dp_de + (1.0 - share) * condensed.dp_de +
                  (vapour.pressure - condensed.pressure) / width;
    value.status = 0;
    return value;
}

BOLIDE_INLINE struct eos_value eos_tillotson(const struct eos_tillotson *t, double density,
                                             double energy, const double *history)
{
    (void)history;
    struct eos_value value = eos_tillotson_whole(t, density, energy);
    if (value.pressure < -t->tension) { /* never where it is NAN */
        value.pressure = -t->tension;
        value.dp_drho = t->bulk_modulus / t->density; /* the sound of material at rest */
        value.dp_de = 0.0;
    }
    if (t->form == EOS_EXTENDED)
        eos_hold_sound(&value, density, 0.01 * t->bulk_modulus * density / square(t->density));
    return value;
}

BOLIDE_INLINE struct eos_traits eos_tillotson_traits(const struct eos_tillotson *t)
{
    struct eos_traits traits = eos_default_traits();
    traits.limits_tension = !isnan(t->tension);
    /* dc/drho at constant entropy, from e = A mu^2/(2 rho_0) and p = A mu + B mu^2 + (a + b) rho_0
     * e */
    traits.shock_slope = 0.5 * (1.0 + t->second_modulus / t->bulk_modulus + 0.5 * (t->a + t->b));
    return traits;
}

EOS_ISENTROPE(tillotson_isentrope, tillotson)

/* The isentrope of the state at rest, along which stretching takes nearly e_cv. Below a twentieth
 * of rho_0, where little of its tension is left, it is held. */
BOLIDE_INLINE struct heat_curve eos_tillotson_curve(const struct eos_tillotson *t,
                                                    const struct heat *heat, double density)
{
    return tillotson_isentrope(t, heat, maximum(density, 0.05 * t->density));
}

#endif
