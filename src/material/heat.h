/* The thermal part of a material: temperature from density and energy, and what conduction needs.
 * Source: Parshikov (2013), (3.1)-(3.3) and the temperature on the shock adiabat after Walsh and Christian
 * (1955). */
#ifndef BOLIDE_HEAT_H
#define BOLIDE_HEAT_H

#include "base/vector.h"

/* NAN where a case says nothing. */
struct heat {
    double capacity;     /* C_V, J/(kg K) */
    double conductivity; /* lambda, W/(m K) */
    double temperature;  /* T_0, K, of the state of no pressure and no energy */
};

#endif
