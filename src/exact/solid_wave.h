/* One plane wave into a solid of any equation of state in uniaxial strain: a jump in compression, a
 * fan in expansion. While the solid is elastic its deviator follows the logarithmic strain, dS =
 * 4/3 G dx, x = ln(V/V_base); while it flows the deviator stays. P = p - S is the normal pressure.
 * Pressure and strain must belong together one to one and the curves be convex: phase changes split
 * waves in ways that are not looked for. Source: Wang, Chen and Huang (2024), section 1,
 * (8)-(11). */
#ifndef BOLIDE_EXACT_SOLID_WAVE_H
#define BOLIDE_EXACT_SOLID_WAVE_H

#include "material/eos.h"

/* What a wave runs into, and how the deviator behind it depends on strain: deviator + shear x. */
struct solid_base {
    const struct eos *eos;
    double volume, energy; /* m^3/kg, J/kg */
    double normal;         /* P ahead, Pa */
    double deviator;       /* just behind the front of the wave, Pa */
    double shear;          /* 4/3 G while elastic, 0 while plastic, Pa */
    bool sudden;           /* the deviator jumps at the front: yield and shock in one */
};

/* The state behind a wave, or inside a fan. */
struct solid_place {
    double strain, volume, energy, normal, deviator;
    double push;      /* change of velocity, away from the contact positive */
    double stiffness; /* -dP/dV along the curve here: speed times density, squared */
    double chord;     /* of a jump: (P - P_base)/(V_base - V), its impedance squared */
    bool valid;       /* the equation of state reaches here */
};

struct solid_place solid_jump(const struct solid_base *base, double strain);
struct solid_place solid_fan(const struct solid_base *base, double strain);

/* The place behind a wave that takes the base to NORMAL: a jump when that is more than there is,
 * else a fan, or a jump again where all of the fan would run at one speed. The strain is within
 * LIMIT (of its sign, at most infinite). False: the equation of state does not come to that
 * pressure. */
bool solid_wave_to(const struct solid_base *base, double normal, double limit,
                   struct solid_place *place);

#endif
