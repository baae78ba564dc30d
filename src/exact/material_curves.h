/* Compression and expansion curves of an equation of state, without strength: the isentrope of the
 * state at rest, and shock adiabats from rest, from a shocked state and from a porous body. */
#ifndef BOLIDE_EXACT_MATERIAL_CURVES_H
#define BOLIDE_EXACT_MATERIAL_CURVES_H

#include "material/material.h"

/* A state on a curve: kg/m^3, Pa, J/kg, K (NAN where the material has no temperature), m/s. SHOCK
 * is the speed of the shock that leads there relative to the material ahead of it, PARTICLE the
 * jump of velocity; both NAN on the isentrope. */
struct curve_state {
    double density, pressure, energy, temperature, sound, shock, particle;
};

/* Writes the COUNT states of the isentrope through rest at DENSITIES, which rise or fall from that
 * at rest. By the classical method of Runge and Kutta in steps of a thousandth of ln rho. */
void curve_isentrope(const struct material *material, const double *densities, int count,
                     struct curve_state *states);

/* The state behind a shock from AHEAD, whose volume is 1/DENSITY_AHEAD where pores are counted, at
 * DENSITY: e - e_0 = (p + p_0)(v_0 - v)/2. False where no shock leads: the adiabat ends, or the
 * pressure is not above that ahead. */
bool curve_shock(const struct material *material, const struct curve_state *ahead,
                 double density_ahead, double density, struct curve_state *behind);

/* The state at rest: without energy, or for a gas at 101.325 kPa. False where there is none. */
bool curve_rest(const struct material *material, struct curve_state *rest);

#endif
