/* The plane steady detonation of an explosive: its speed D, the state of Chapman and Jouguet, where
 * all has burnt and the flow behind the front is as fast as its sound, and the state of von
 * Neumann, the spike, to which the shock compresses the unburnt explosive. With volumes v, v_0
 * ahead, and energies from that of the explosive at rest:
 *
 *   p = D^2 (v_0 - v)/v_0^2,   u = D (v_0 - v)/v_0,   e = p (v_0 - v)/2
 *
 * Source: Fickett and Davis, Detonation (1979), chapters 2 and 4; Parshikov (2013), (5.13),
 * (5.14). */
#ifndef BOLIDE_EXACT_DETONATION_H
#define BOLIDE_EXACT_DETONATION_H

#include "material/material.h"

/* By how much the speed that a material gives for its detonation may differ from that of its
 * products before a warning: speeds are measured to about one per cent. */
#define DETONATION_SPEED_TOLERANCE 0.01

/* SI units; the velocity is that of an explosive that is at rest ahead. The temperature is NAN
 * where the equation of state has none. */
struct detonation_state {
    double density, pressure, velocity, energy, sound, temperature, burnt;
};

struct detonation {
    double ahead; /* density of the explosive ahead of the front, kg/m^3 */
    double speed; /* m/s */
    struct detonation_state cj;
    struct detonation_state spike; /* all NAN where the unburnt explosive has no equation of state,
                                      or no shock of this speed */
};

/* Solves for MATERIAL with the density AHEAD, which may be less than that of its equation of state:
 * the explosive is porous then. False where it carries no detonation, as what has no pressure in
 * its volume at rest when it has burnt. */
bool detonation_solve(const struct material *material, double ahead, struct detonation *detonation);

/* The state of the reaction zone where BURNT has burnt; between 0 and 1 a spike is needed. *RATE is
 * that of the burning there, 1/s, NAN where the material has none. */
struct detonation_state detonation_zone(const struct material *material,
                                        const struct detonation *detonation, double burnt,
                                        double *rate);

/* The temperature of a state whose unburnt part has the volume EXPLOSIVE over that at rest, K; NAN
 * where the equation of state has none. */
double detonation_temperature(const struct material *material, double density, double pressure,
                              double burnt, double explosive);

#endif
