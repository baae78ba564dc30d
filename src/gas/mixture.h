/* Two materials in one cell: one velocity and one pressure, each with the fraction alpha_k of the
 * volume and the density rho_k of its own (Allaire, Clerc and Kokh, J. Comput. Phys. 181 (2002)
 * 577, with the isobaric closure). Each equation of state is linear in the specific energy, p =
 * p_0(rho) + b(rho) e, so that rho_k e_k = xi_k (p - p_0k) with xi_k = rho_k/b_k, and the mixture
 * has
 *
 *   rho e = sum alpha_k xi_k (p - p_0k)    xi rho c^2 = sum alpha_k xi_k rho_k c_k^2
 *   xi = sum alpha_k xi_k
 *
 * without iteration. The fractions follow the flow, d alpha/dt + u . grad alpha = 0. Of an
 * explosive p_0 counts as much as has burnt of it (row_unburn). */
#ifndef BOLIDE_GAS_MIXTURE_H
#define BOLIDE_GAS_MIXTURE_H

#include <math.h>

#include "material/eos.h"

/* Below a fraction of volume a material is not there, and its mass goes to the other one: of the
 * second, which is the denser one, so little that the mass of the first stays too; of the first,
 * whose fraction is the rest, what rounding leaves. */
static const double MIXTURE_NONE[2] = {1e-14, 1e-18};

/* Below this one the density of a material may be rounding, and bounds of its reference density
 * hold. */
static const double MIXTURE_TRACE = 1e-8;

/* Below this one a cell says nothing of a material's density to its neighbours. */
static const double MIXTURE_COUNTS = 1e-3;

/* A material of a mixture at a density: its weight alpha xi, p_0 and what its sound speed follows
 * from. */
struct mixture_part {
    double density, weight, cold, slope, rise;
    double ratio; /* b */
};

struct mixture {
    double density; /* of both */
    struct mixture_part part[2];
};

/* The density of a material of which MASS per volume of the cell fills FRACTION. */
BOLIDE_INLINE double mixture_density(const struct eos *eos, double mass, double fraction)
{
    const double reference = eos_reference_density(eos), density = mass / fraction;
    if (fraction >= MIXTURE_TRACE)
        return maximum(density, 1e-6 * reference);
    return minimum(maximum(density, 1e-4 * reference), 1e2 * reference);
}

/* The specific energy at which the rise of dp/drho is taken, J/kg. */
static const double MIXTURE_WARM = 1e6;

/* From the values of an equation of state at DENSITY with no energy, and with MIXTURE_WARM. */
BOLIDE_INLINE struct mixture_part mixture_part_from(struct eos_value cold, struct eos_value warm,
                                                    double density, double fraction, double burnt)
{
    struct mixture_part part;
    part.density = density;
    part.ratio = cold.dp_de;
    part.weight = fraction * density / cold.dp_de;
    part.cold = burnt * cold.pressure;
    part.slope = burnt * cold.dp_drho;
    part.rise = (warm.dp_drho - cold.dp_drho) / MIXTURE_WARM;
    return part;
}

static inline struct mixture_part mixture_part_of(const struct eos *eos, double density,
                                                  double fraction, double burnt)
{
    const double none[POINT_HISTORY] = {0.0};
    struct eos_value cold = {0.0, 0.0, 0.0, POINT_NO_SOUND}, warm = cold;
    switch (eos->kind) { /* both in one place: what they share is computed once */
#define MIXTURE_CASE(name)                                             \
    case EOS_##name:                                                   \
        cold = eos_##name(&eos->of.name, density, 0.0, none);          \
        warm = eos_##name(&eos->of.name, density, MIXTURE_WARM, none); \
        break;
        EOS_STATELESS(MIXTURE_CASE)
#undef MIXTURE_CASE
    default:
        break;
    }
    return mixture_part_from(cold, warm, density, fraction, burnt);
}

/* A mixture of EOS at DENSITY; FRACTION is that of the second, and BURNT what has of each: 1 unless
 * it is an explosive. */
BOLIDE_INLINE struct mixture mixture_of(const struct eos *const eos[2], const double density[2],
                                        double fraction, const double burnt[2])
{
    struct mixture mixture;
    mixture.part[0] = mixture_part_of(eos[0], density[0], 1.0 - fraction, burnt[0]);
    mixture.part[1] = mixture_part_of(eos[1], density[1], fraction, burnt[1]);
    mixture.density = (1.0 - fraction) * density[0] + fraction * density[1];
    return mixture;
}

/* The pressure at ENERGY, rho e. */
BOLIDE_INLINE double mixture_pressure(const struct mixture *mixture, double energy)
{
    const struct mixture_part *part = mixture->part;
    return (energy + part[0].weight * part[0].cold + part[1].weight * part[1].cold) /
           (part[0].weight + part[1].weight);
}

BOLIDE_INLINE double mixture_sound_square(const struct mixture *mixture, double pressure)
{
    double sum = 0.0, all = 0.0;
    for (int k = 0; k < 2; k++) {
        const struct mixture_part *part = &mixture->part[k];
        const double energy = (pressure - part->cold) / part->ratio;
        sum += part->weight * part->density *
               eos_sound_square(pressure, part->slope + part->rise * energy, part->ratio,
                                part->density);
        all += part->weight;
    }
    return sum / (all * mixture->density);
}

/* The pressure of a material of a mixture at 0 K and its density. */
BOLIDE_INLINE double mixture_coldest(const struct eos *eos, const struct mixture_part *part)
{
    const struct heat any = {1.0, 1.0, 1.0}; /* the energy does not depend on it */
    return part->cold + part->ratio * eos_curve(eos, &any, part->density).energy;
}

/* The fraction of the second material at which it is not colder than 0 K, at least FRACTION, where
 * the cell has ENERGY, rho e, and MASS of each per volume. Both expand alike in the flow, so that
 * traces of products that come from high pressure would stay dense, with energy that others lack.
 * Nothing but the volumes changes; FRACTION stays where no volume is enough. */
static inline double mixture_thawed(const struct eos *const eos[2], const double mass[2],
                                    double fraction, double energy)
{
    enum { HALVINGS = 40 };
    static const double most = 0.999, all[2] = {1.0, 1.0};
    double low = log(fraction), high = log(most), found = fraction;
    for (int k = -2; k < HALVINGS && low < high; k++) {
        const double at = k == -2   ? low
                          : k == -1 ? high
                                    : 0.5 * (low + high),
                     part = k == -2 ? fraction : exp(at),
                     density[2] = {mixture_density(eos[0], mass[0], 1.0 - part),
                                   mixture_density(eos[1], mass[1], part)};
        const struct mixture mixture = mixture_of(eos, density, part, all);
        const bool warm =
            mixture_pressure(&mixture, energy) >= mixture_coldest(eos[1], &mixture.part[1]);
        if (k == -2 ? warm : k == -1 && !warm)
            return fraction;
        if (k >= 0)
            *(warm ? &high : &low) = at;
        if (warm)
            found = part;
    }
    return found;
}

/* The fraction of the second material at which the pressure is FLOOR, where it is less at FRACTION
 * and LIQUID, 0 or 1, is what pulls: bubbles of the gas around it open. The gas thins to a
 * thousandth of its reference density at most, and the liquid becomes little denser than its own;
 * FRACTION stays where that does not help. ENERGY and MASS as
 * above. */
static inline double mixture_opened(const struct eos *const eos[2], const double mass[2],
                                    double fraction, double energy, int liquid, double floor)
{
    enum { HALVINGS = 40 };
    static const double all[2] = {1.0, 1.0}, most_thin = 1e-3, most_dense = 1.1;
    const double gas = mass[1 - liquid] / (most_thin * eos_reference_density(eos[1 - liquid])),
                 dense = mass[liquid] / (most_dense * eos_reference_density(eos[liquid])),
                 own = liquid ? fraction : 1.0 - fraction,
                 least = maximum(1.0 - gas, dense); /* of the liquid's volume */
    double low = least, high = own;
    if (!(least < own))
        return fraction;
    for (int k = 0; k < HALVINGS; k++) {
        const double at = 0.5 * (low + high), part = liquid ? at : 1.0 - at,
                     density[2] = {mixture_density(eos[0], mass[0], 1.0 - part),
                                   mixture_density(eos[1], mass[1], part)};
        const struct mixture mixture = mixture_of(eos, density, part, all);
        *(mixture_pressure(&mixture, energy) < floor ? &high : &low) = at;
    }
    return liquid ? low : 1.0 - low;
}

/* G = (dp/de)/rho at given fractions. */
BOLIDE_INLINE double mixture_gamma(const struct mixture *mixture)
{
    return 1.0 / (mixture->part[0].weight + mixture->part[1].weight);
}

#endif
