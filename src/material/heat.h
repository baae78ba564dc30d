/* The thermal part of a material: temperature from density and energy, and back. Temperature is counted from a
 * curve e_r(rho) of the equation of state whose temperature T_r(rho) is known:
 *
 *   T = T_r + (e - e_r)/C_V
 *
 *   ideal gas                     e_r = 0, T_r = 0
 *   stiffened gas                 the isentrope of the state at rest, T_r = T_0 (rho/rho_0)^(gamma - 1)
 *   barotropic, rubber            the cold curve, T_r = T_0
 *   Mie-Grueneisen, rho <= rho_0  the cold curve (1.68), T_r = T_0                             (3.3)
 *   Mie-Grueneisen, rho > rho_0   the shock adiabat (1.66), T_r = T_H after Walsh and Christian
 *
 * Source: Parshikov (2013), (3.1)-(3.3); Walsh and Christian, Phys. Rev. 97 (1955) 1544. */
#ifndef BOLIDE_HEAT_H
#define BOLIDE_HEAT_H

#include "material/eos.h"

/* NAN where a case says nothing. */
struct heat {
    double capacity;     /* C_V, J/(kg K) */
    double conductivity; /* lambda, W/(m K) */
    double
        temperature; /* T_0, K, of the state of no pressure and no energy; an ideal gas has none */
};

/* A point of the curve that temperatures are counted from. */
struct heat_curve {
    double temperature, energy;
};

/* T_H where the adiabat U_s = C_a + S_a U_p has compressed to eta = 1 - rho_0/rho. Walsh and Christian's
 * C_V (dT_H/dv + gamma T_H/v) = [(v_0 - v) dp_H/dv + p_H]/2 becomes for a constant gamma
 *
 *   T_H = (1 - eta)^-gamma [T_0 + (C_a^2 S_a/C_V) int_0^eta (1 - y)^gamma y^2/(1 - S_a y)^3 dy]
 *
 * and with e^u = 1/(1 - S_a y) the integral that of (1 - y)^gamma (e^u - 1)^2/S_a^3 over u: as smooth near the
 * largest compression as anywhere, so that six Gauss-Legendre points serve. */
BOLIDE_INLINE double heat_adiabat(const struct heat *heat, const struct eos_mie_grueneisen *solid,
                                  double eta)
{
    const double node[3] = {0.23861918608319690863, 0.66120938646626451366, 0.93246951420315202781};
    const double weight[3] = {0.46791393457269104739, 0.36076157304813860757,
                              0.17132449237917034504};
    /* The adiabat is held beyond its largest compression, as the equation of state holds it. */
    double end = -log(maximum(1.0 - solid->slope * eta, 1e-3)), integral = 0.0;
    for (int k = 0; k < 6; k++) {
        double grown = exp(0.5 * end * (k < 3 ? 1.0 - node[k] : 1.0 + node[k - 3]));
        double over = grown - 1.0, left = 1.0 - over / (grown * solid->slope); /* 1 - y */
        integral += weight[k % 3] * exp(solid->gamma * log(left)) * square(over);
    }
    integral *= 0.5 * end / (solid->slope * square(solid->slope));
    double work =
        solid->slope > 0.0 ? square(solid->sound) * solid->slope / heat->capacity * integral : 0.0;
    return (heat->temperature + work) / pow(1.0 - eta, solid->gamma);
}

BOLIDE_INLINE struct heat_curve heat_curve_of_mie_grueneisen(const struct heat *heat,
                                                             const struct eos_mie_grueneisen *solid,
                                                             double density)
{
    struct heat_curve curve;
    double eta = 1.0 - solid->density / density;
    if (eta <= 0.0) {
        curve.temperature = heat->temperature;
        curve.energy = 0.5 * solid->bulk_modulus * square(eta) / solid->density;
        return curve;
    }
    double reach = maximum(1.0 - solid->slope * eta, 1e-3);
    curve.temperature = heat_adiabat(heat, solid, eta);
    curve.energy = 0.5 * square(solid->sound * eta / reach);
    return curve;
}

BOLIDE_INLINE struct heat_curve heat_curve_of_stiffened_gas(const struct heat *heat,
                                                            const struct eos_stiffened_gas *gas,
                                                            double density)
{
    struct heat_curve curve;
    double ratio = density / gas->density, g = gas->gamma, c2 = square(gas->sound);
    double rise = pow(ratio, g - 1.0);
    curve.temperature = heat->temperature * rise;
    curve.energy = c2 * ((rise / g - 1.0) / (g - 1.0) + 1.0 / (g * ratio));
    return curve;
}

/* NAN for an equation of state that gives no temperature. */
BOLIDE_INLINE struct heat_curve heat_curve(const struct heat *heat, const struct eos *eos,
                                           double density)
{
    struct heat_curve curve = {heat->temperature, 0.0};
    double ratio = eos->of.reference_density / density;
    switch (eos->kind) {
    case EOS_ideal_gas:
        curve.temperature = 0.0;
        return curve;
    case EOS_stiffened_gas:
        return heat_curve_of_stiffened_gas(heat, &eos->of.stiffened_gas, density);
    case EOS_mie_grueneisen:
        return heat_curve_of_mie_grueneisen(heat, &eos->of.mie_grueneisen, density);
    case EOS_barotropic:
        curve.energy =
            0.5 * eos->of.barotropic.bulk_modulus * square(1.0 - ratio) / eos->of.reference_density;
        return curve;
    case EOS_rubber:
        curve.energy = square(eos->of.rubber.sound) * (ratio - 1.0 - log(ratio));
        return curve;
    default:
        curve.temperature = NAN;
        return curve;
    }
}

/* Temperature (K) at DENSITY and ENERGY (J/kg). */
BOLIDE_INLINE double heat_temperature(const struct heat *heat, const struct eos *eos,
                                      double density, double energy)
{
    struct heat_curve curve = heat_curve(heat, eos, density);
    return curve.temperature + (energy - curve.energy) / heat->capacity;
}

/* The energy (J/kg) at which DENSITY has TEMPERATURE. */
BOLIDE_INLINE double heat_energy(const struct heat *heat, const struct eos *eos, double density,
                                 double temperature)
{
    struct heat_curve curve = heat_curve(heat, eos, density);
    return curve.energy + heat->capacity * (temperature - curve.temperature);
}

/* Why a material has no temperature; NULL when it has one. */
BOLIDE_INLINE const char *heat_wrong(const struct heat *heat, const struct eos *eos)
{
    const struct heat some = {1.0, 1.0, 1.0};
    if (isnan(heat_curve(&some, eos, eos->of.reference_density).temperature))
        return "its equation of state gives no temperature";
    return heat->capacity > 0.0 ? NULL : "it has no `heat: {capacity: ...}`";
}

#endif
