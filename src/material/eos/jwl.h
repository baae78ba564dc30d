/* Jones-Wilkins-Lee: the products of an explosive, or the explosive itself, without its burning.
 * With V = rho_0/rho and the energy of an initial volume E = E_0 + rho_0 e:
 *
 *   p = A [1 - w/(R_1 V)] exp(-R_1 V) + B [1 - w/(R_2 V)] exp(-R_2 V) + w E/V
 *
 * e counts from the explosive at rest, so that E_0 is the heat of the reaction for products; for an
 * unreacted explosive it makes the pressure vanish at rest; it is zero where e holds the chemical
 * energy. Source: Lee and Tarver, Phys. Fluids 23 (1980) 2362, in the form of Cui, dissertation
 * (2014), (2-60), and Parshikov (2013), (5.4)-(5.7). */
#ifndef BOLIDE_EOS_JWL_H
#define BOLIDE_EOS_JWL_H

#include "material/eos/grueneisen.h"

struct eos_jwl {
    double density; /* rho_0 of the explosive, kg/m^3 */
    double a, b;    /* Pa */
    double r1, r2;
    double omega;
    double energy; /* E_0, J/m^3 of initial volume */
    int form;      /* enum eos_form */
};

#define EOS_jwl_NAME "jwl"
#define EOS_jwl_HELP "Jones-Wilkins-Lee: explosives and their products, without burning"
#define EOS_jwl_SAMPLE                                                  \
    {                                                                   \
        1630.0, 371.2e9, 3.21e9, 4.15, 0.95, 0.3, 6.993e9, EOS_EXTENDED \
    } /* products of TNT */
#define EOS_jwl_PARAMETERS(T)                                                              \
    NUMBER(T, density, "kg/m^3", REQUIRED, POSITIVE, "density of the explosive")           \
    NUMBER(T, a, "Pa", REQUIRED, ANY, "A: factor of exp(-R_1 V), V = rho_0/rho")           \
    NUMBER(T, b, "Pa", REQUIRED, ANY, "B: factor of exp(-R_2 V)")                          \
    NUMBER(T, r1, "", REQUIRED, POSITIVE, "R_1: exponent of A")                            \
    NUMBER(T, r2, "", REQUIRED, POSITIVE, "R_2: exponent of B")                            \
    NUMBER(T, omega, "", REQUIRED, POSITIVE, "Grueneisen coefficient")                     \
    NUMBER(T, energy, "J/m^3", REQUIRED, ANY,                                              \
           "E_0: energy per initial volume at e = 0; for products the heat of detonation") \
    EOS_FORM_PARAMETER(T)

BOLIDE_INLINE struct eos_value eos_jwl(const struct eos_jwl *jwl, double density, double energy,
                                       const double *history)
{
    (void)history;
    struct eos_value value;
    double compression = density / jwl->density, volume = 1.0 / compression;
    double first = jwl->a * exponential(-jwl->r1 * volume),
           second = jwl->b * exponential(-jwl->r2 * volume);
    double share1 = 1.0 - jwl->omega * compression / jwl->r1;
    double share2 = 1.0 - jwl->omega * compression / jwl->r2;
    double heat = energy + jwl->energy / jwl->density;
    value.pressure = first * share1 + second * share2 + jwl->omega * density * heat;
    /* d/drho = (1/rho_0) d/d(rho/rho_0), and dV/d(rho/rho_0) = -V^2 */
    double slope1 = first * (jwl->r1 * square(volume) * share1 - jwl->omega / jwl->r1);
    double slope2 = second * (jwl->r2 * square(volume) * share2 - jwl->omega / jwl->r2);
    value.dp_drho = (slope1 + slope2) / jwl->density + jwl->omega * heat;
    value.dp_de = jwl->omega * density;
    const bool within = (jwl->b >= 0.0) | (compression >= grueneisen_tension());
    value.status = within | (jwl->form == EOS_SOURCE) ? 0 : POINT_BEYOND;
    return value;
}

BOLIDE_INLINE struct eos_edge jwl_edge(const struct eos_jwl *jwl)
{
    const double none[POINT_HISTORY] = {0.0}, density = grueneisen_tension() * jwl->density;
    return eos_edge_of(jwl->density, density, eos_jwl(jwl, density, 0.0, none), jwl->omega);
}

/* An explosive that has not burnt, which has a negative B, below rho_1 (grueneisen.h). */
BOLIDE_INLINE struct eos_value eos_jwl_beyond(const struct eos_jwl *jwl, double density,
                                              double energy)
{
    const struct eos_edge edge = jwl_edge(jwl);
    return eos_expanded(&edge, density, energy);
}

/* See EOS_CHARGED. */
BOLIDE_INLINE double eos_jwl_take_heat(struct eos_jwl *jwl)
{
    const double heat = jwl->energy / jwl->density;
    jwl->energy = 0.0;
    return heat;
}

BOLIDE_INLINE struct eos_traits eos_jwl_traits(const struct eos_jwl *jwl)
{
    struct eos_traits traits = eos_default_traits();
    traits.gas = jwl->b >= 0.0; /* products; below zero B holds together what has not burnt */
    /* -V (d2p/dV2)/(4 dp/dV) of the isentrope p = A exp(-R_1 V) + B exp(-R_2 V) + C V^(-1-w) at
     * rest */
    const double none[POINT_HISTORY] = {0.0};
    double first = jwl->a * exponential(-jwl->r1), second = jwl->b * exponential(-jwl->r2),
           w = jwl->omega;
    double third = eos_jwl(jwl, jwl->density, 0.0, none).pressure - first - second;
    double fall = jwl->r1 * first + jwl->r2 * second + (1.0 + w) * third;
    traits.shock_slope =
        (square(jwl->r1) * first + square(jwl->r2) * second + (1.0 + w) * (2.0 + w) * third) /
        (4.0 * fall);
    return traits;
}

/* The isentrope without the last term, rho_0 e_r = A/R_1 exp(-R_1 V) + B/R_2 exp(-R_2 V) - E_0,
 * which in Lee and Tarver's p = A exp(-R_1 V) + B exp(-R_2 V) + w C_V rho T is the state of T = 0.
 * Only where E_0 makes the pressure vanish at rest, to a hundredth of its terms, it is T_r = T_s
 * V^-w with T = T_0 at rest. */
BOLIDE_INLINE struct heat_curve jwl_curve(const struct eos_jwl *jwl, const struct heat *heat,
                                          double density)
{
    const double none[POINT_HISTORY] = {0.0};
    double volume = jwl->density / density, energy[2];
    for (int k = 0; k < 2; k++) { /* at rest, then here */
        double v = k ? volume : 1.0;
        energy[k] = (jwl->a / jwl->r1 * exponential(-jwl->r1 * v) +
                     jwl->b / jwl->r2 * exponential(-jwl->r2 * v) - jwl->energy) /
                    jwl->density;
    }
    double terms = fabs(jwl->a) * exponential(-jwl->r1) + fabs(jwl->b) * exponential(-jwl->r2);
    struct heat_curve curve = {0.0, energy[1]};
    if (fabs(eos_jwl(jwl, jwl->density, 0.0, none).pressure) < 0.01 * terms)
        curve.temperature =
            (heat->temperature + energy[0] / heat->capacity) * power(volume, -jwl->omega);
    return curve;
}

BOLIDE_INLINE struct heat_curve eos_jwl_curve(const struct eos_jwl *jwl, const struct heat *heat,
                                              double density)
{
    const struct eos_edge edge = jwl_edge(jwl);
    if (jwl->form == EOS_SOURCE || jwl->b >= 0.0 || density >= edge.density)
        return jwl_curve(jwl, heat, density);
    return eos_expanded_curve(&edge, jwl_curve(jwl, heat, edge.density), density, heat->capacity);
}

#endif
