/* What melting leaves of strength: material that is thinner than a melt and has the heat of one
 * carries no shear, neither stress nor waves.
 *
 * Shear modulus and yield stress have the factor 1 - hot thin, each from 0 to 1:
 *
 *   hot  = (e - e_m)/e_m      thin = (0.9 - rho/rho_0)/0.1
 *
 * e_m is the heat at which the solid begins to melt: that of the strength where it has a melting
 * temperature, c_v (T_melt - T_room), else the one at which the material has expanded by a
 * twentieth at no pressure, e_m = 0.05 c^2/Gamma. The latter is Gruneisen's rule (Ann. Phys. 39
 * (1912) 257, recalled): metals melt when heat has expanded them by 6 or 7 %, whatever their
 * melting temperature. With its latent heat a melt has up to 2 e_m, and most metals melt at 0.9 or
 * more of the density of the cold solid, so that what has both is no solid. The ends of the ramps
 * are round figures. Denser matter keeps its strength here, since what it bears in tension and
 * under pressure, where it melts at higher temperatures, is not modelled.
 *
 * Steinberg, Cochran and Guinan, J. Appl. Phys. 51 (1980) 1498, let modulus and yield stress vanish
 * above the energy of melting (recalled). */
#ifndef BOLIDE_MELTING_H
#define BOLIDE_MELTING_H

#include "material/eos.h"
#include "material/strength.h"

/* Zero: never melts. */
struct melting {
    double heat;                 /* e_m, J/kg */
    double per_heat;             /* 1/e_m, kg/J */
    double density, per_density; /* 0.9 rho_0, kg/m^3; 10/rho_0, m^3/kg */
};

/* That of a metal with the equation of state EOS. */
BOLIDE_INLINE struct melting melting_of(const struct eos *eos, const struct strength *strength)
{
    const double none[POINT_HISTORY] = {0.0}, density = eos_reference_density(eos);
    const struct strength_traits traits = strength_traits(strength);
    const struct eos_value rest = eos_evaluate(eos, density, 0.0, none);
    struct melting melting = {0.0, 0.0, 0.0, 0.0};
    if (!traits.melts || !(rest.dp_de > 0.0) || eos_traits(eos).gas)
        return melting;
    const double heat = traits.melting_heat > 0.0 ? traits.melting_heat
                                                  : 0.05 * density * rest.dp_drho / rest.dp_de;
    melting.heat = heat;
    melting.per_heat = 1.0 / heat;
    melting.density = 0.9 * density;
    melting.per_density = 10.0 / density;
    return melting;
}

/* 1 where material at DENSITY and ENERGY, J/kg, has lost some of its strength, else 0; without a
 * branch, for loops. */
BOLIDE_INLINE uint64_t melting_begins(const struct melting *melting, double density, double energy)
{
    return (uint64_t)(density < melting->density) & (uint64_t)(energy > melting->heat);
}

/* The fraction that is left of strength at DENSITY and ENERGY, J/kg. */
BOLIDE_INLINE double melting_left(const struct melting *melting, double density, double energy)
{
    if (!melting_begins(melting, density, energy))
        return 1.0;
    const double hot = (energy - melting->heat) * melting->per_heat,
                 thin = (melting->density - density) * melting->per_density;
    return 1.0 - minimum(maximum(hot, 0.0), 1.0) * minimum(maximum(thin, 0.0), 1.0);
}

/* Takes POINT, of whose strength LEFT remains, less than all, through a step as strength_step()
 * does. What stress it has lost with its strength is no flow. */
BOLIDE_INLINE void melting_step(const struct strength *strength, double left,
                                const struct motion *motion, struct point *point)
{
    struct strength soft = *strength;
    strength_melt(&soft, left);
    const double yield = left > 0.0 ? strength_yield(&soft, point) : 0.0;
    const double mises = sym3_mises(point->deviator);
    if (mises > yield)
        point->deviator = sym3_scale(yield / mises, point->deviator);
    if (left > 0.0)
        strength_step(&soft, motion, 0.0, point);
}

/* The same of any point. */
BOLIDE_INLINE void melting_flow(const struct melting *melting, const struct strength *strength,
                                const struct motion *motion, struct point *point)
{
    const double left = melting_left(melting, point->density, point->energy);
    if (left < 1.0)
        melting_step(strength, left, motion, point);
    else
        strength_step(strength, motion, 0.0, point);
}

#endif
