/* An explosive on its shock adiabat and its products as a JWL, whose pressures add by the mass
 * fraction F of the products, as the burn model has it:
 *
 *   p = (1 - F) p_s(rho, e) + F p_g(rho, e),   p_g: jwl.h
 *   p_s: that of mie_grueneisen.h, or after Murnaghan, without energy,
 *   p_s = rho_0 C^2/n [(rho/rho_0)^n - 1],  n = 4 S - 1, which has the same sound and slope at rest
 *
 * where p_s counts only in compression once F > 0, as products between grains carry no tension.
 * Both parts have the density and energy of the whole: no more than an interpolation between an
 * explosive that has not burnt and one that has. Source: Parshikov (2013), (1.63)-(1.68), (5.17),
 * (5.18), whose isentrope is that of a JWL; with Murnaghan the JWL++ of Souers, Anderson, Mercer,
 * McGuire and Vitello, Propellants Explos. Pyrotech. 25 (2000) 54. */
#ifndef BOLIDE_EOS_BLENDED_JWL_H
#define BOLIDE_EOS_BLENDED_JWL_H

#include "material/eos/jwl.h"
#include "material/eos/mie_grueneisen.h"

enum blended_explosive { EXPLOSIVE_SHOCK, EXPLOSIVE_MURNAGHAN };

struct eos_blended_jwl {
    double density; /* rho_0 of the explosive, kg/m^3 */
    double sound, slope, gamma, bulk_modulus;
    int explosive; /* enum blended_explosive */
    double products_a, products_b, products_r1, products_r2, products_omega;
    double energy; /* Q, J/m^3 of the explosive */
};

#define EOS_blended_jwl_NAME "blended-jwl"
#define EOS_blended_jwl_HELP                                                                 \
    "explosive on its shock adiabat and products as JWL, pressures added by mass fraction, " \
    "for `burn: cj-threshold` and `burn: pressure-power`"
#define EOS_blended_jwl_SAMPLE                                                                    \
    {                                                                                             \
        1770.0, 2830.0, 1.91, 2.64, 6e9, EXPLOSIVE_SHOCK, 617e9, 16.926e9, 4.4, 1.2, 0.25, 10.1e9 \
    } /* PETN */
#define EOS_blended_jwl_PARAMETERS(T)                                                             \
    NUMBER(T, density, "kg/m^3", REQUIRED, POSITIVE, "density of the explosive")                  \
    NUMBER(T, sound, "m/s", REQUIRED, POSITIVE, "C of U_s = C + S U_p of the explosive")          \
    NUMBER(T, slope, "", REQUIRED, POSITIVE, "S of U_s = C + S U_p of the explosive")             \
    NUMBER(T, gamma, "", REQUIRED, NOT_NEGATIVE, "Grueneisen coefficient of the explosive")       \
    NUMBER(T, bulk_modulus, "Pa", REQUIRED, POSITIVE, "bulk modulus of the explosive in tension") \
    CHOICE(T, explosive, "shock",                                                                 \
           "shock: Mie-Grueneisen relative to the shock adiabat; murnaghan: with the "            \
           "exponent 4 S - 1 and without energy, as in JWL++",                                    \
           "shock", "murnaghan")                                                                  \
    NUMBER(T, products_a, "Pa", REQUIRED, ANY, "A of the products")                               \
    NUMBER(T, products_b, "Pa", REQUIRED, ANY, "B of the products")                               \
    NUMBER(T, products_r1, "", REQUIRED, POSITIVE, "R_1 of the products")                         \
    NUMBER(T, products_r2, "", REQUIRED, POSITIVE, "R_2 of the products")                         \
    NUMBER(T, products_omega, "", REQUIRED, POSITIVE, "Grueneisen coefficient of the products")   \
    NUMBER(T, energy, "J/m^3", REQUIRED, POSITIVE, "Q: heat of the reaction")

/* The explosive alone. Energy far below that at rest, which errors leave, pulls no further: with
 * ever less the square of the sound speed at rest would fall below a half of what it is, and then
 * below zero. */
BOLIDE_INLINE struct eos_value blended_explosive(const struct eos_blended_jwl *blend,
                                                 double density, double energy)
{
    const double none[POINT_HISTORY] = {0.0};
    if (blend->explosive == EXPLOSIVE_MURNAGHAN) {
        const double n = 4.0 * blend->slope - 1.0, c2 = square(blend->sound);
        const double rise = power(density / blend->density, n);
        const struct eos_value value = {blend->density * c2 / n * (rise - 1.0),
                                        c2 * rise * blend->density / density, 0.0, 0};
        return value;
    }
    const struct eos_mie_grueneisen solid = {blend->density, blend->sound,        blend->slope,
                                             blend->gamma,   blend->bulk_modulus, EOS_EXTENDED};
    const double wave = minimum(square(blend->sound), blend->bulk_modulus / blend->density),
                 least = -0.5 * wave / (blend->gamma * (1.0 + blend->gamma)),
                 heat = blend->gamma > 0.0 ? maximum(energy, least) : energy;
    struct eos_value value = eos_mie_grueneisen(&solid, density, heat, none);
    if (value.status & POINT_BEYOND)
        value = eos_mie_grueneisen_beyond(&solid, density, heat);
    if (energy < heat)
        value.dp_de = 0.0;
    return value;
}

BOLIDE_INLINE struct eos_value eos_blended_jwl(const struct eos_blended_jwl *blend, double density,
                                               double energy, const double *history)
{
    const double burnt = history[HISTORY_burnt], left = 1.0 - burnt;
    const struct eos_jwl jwl = {blend->density,     blend->products_a,  blend->products_b,
                                blend->products_r1, blend->products_r2, blend->products_omega,
                                blend->energy,      EOS_SOURCE};
    struct eos_value value = {0.0, 0.0, 0.0, 0};
    if (left > 0.0) {
        value = blended_explosive(blend, density, energy);
        if (burnt > 0.0 && value.pressure < 0.0) /* products between its grains carry no tension */
            value.pressure = value.dp_drho = value.dp_de = 0.0;
        value.pressure *= left;
        value.dp_drho *= left;
        value.dp_de *= left;
    }
    if (burnt > 0.0) {
        const struct eos_value products = eos_jwl(&jwl, density, energy, history);
        value.pressure += burnt * products.pressure;
        value.dp_drho += burnt * products.dp_drho;
        value.dp_de += burnt * products.dp_de;
        value.status |= products.status;
    }
    return value;
}

BOLIDE_INLINE struct eos_traits eos_blended_jwl_traits(const struct eos_blended_jwl *blend)
{
    struct eos_traits traits = eos_default_traits();
    traits.shock_slope = blend->slope;
    traits.reaction_energy = blend->energy;
    traits.history = HISTORY_BIT(burnt);
    return traits;
}

BOLIDE_INLINE struct heat_curve eos_blended_jwl_curve(const struct eos_blended_jwl *blend,
                                                      const struct heat *heat, double density)
{
    const struct heat_curve none = {NAN, 0.0};
    (void)blend;
    (void)heat;
    (void)density;
    return none;
}

#endif
