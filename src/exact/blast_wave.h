/* The blast wave that passes a place, or that a wall there reflects: arrival, peak, positive phase
 * and impulse, and the pressure in between as a modified Friedlander curve, which has all of them:
 *
 *   p - p_0 = P (1 - s/T) exp(-b s/T),   s = t - t_a,   I/(P T) = 1/b - (1 - exp(-b))/b^2.
 *
 * W. E. Baker, Explosions in Air (1973), section 1.2. It ends with the
 * positive phase: b follows from the impulse of that phase alone. */
#ifndef BOLIDE_EXACT_BLAST_WAVE_H
#define BOLIDE_EXACT_BLAST_WAVE_H

#include "base/base.h"

struct blast_wave {
    double arrival;      /* s after the detonation */
    double overpressure; /* Pa, the peak */
    double duration;     /* s, of the positive phase; NAN: unknown */
    double impulse;      /* Pa s, of the positive phase; NAN: unknown */
};

/* b for the fraction I/(P T), which is between 0 and 1/2. */
double blast_wave_decay(double fraction);

/* The overpressure at TIME since the detonation, zero before the arrival and after the positive
 * phase. Where the duration is unknown the pressure falls
 * exponentially with the impulse; NAN where neither is known. */
double blast_wave_at(const struct blast_wave *wave, double time);

#endif
