/* The curves of Kingery and Bulmash for TNT at sea level: C. N. Kingery and G. Bulmash, Airblast
 * parameters from TNT spherical air burst and hemispherical surface burst, ARBRL-TR-02555 (1984).
 * Lengths, times and impulses go with the cube root of the mass. */
#ifndef BOLIDE_EXACT_KINGERY_CURVES_H
#define BOLIDE_EXACT_KINGERY_CURVES_H

#include "exact/blast_wave.h"

enum kingery_charge { KINGERY_FREE_AIR, KINGERY_SURFACE };

enum kingery_quantity {
    KINGERY_PRESSURE, /* kPa, incident overpressure */
    KINGERY_REFLECTED_PRESSURE,
    KINGERY_IMPULSE, /* kPa ms/kg^(1/3) */
    KINGERY_REFLECTED_IMPULSE,
    KINGERY_ARRIVAL, /* ms/kg^(1/3) */
    KINGERY_DURATION,
    KINGERY_SPEED /* m/ms, of the front */
};

/* The quantity at the scaled distance Z, in m/kg^(1/3); NAN outside its range. */
double kingery_curve(enum kingery_charge charge, enum kingery_quantity quantity, double z);

/* The range of Z in which there is a pressure. */
double kingery_nearest(enum kingery_charge charge);
double kingery_farthest(enum kingery_charge charge);

/* The wave of MASS kg at DISTANCE m: incident, or as a rigid wall that faces the charge reflects
 * it. NAN outside the range. */
struct blast_wave kingery_wave(enum kingery_charge charge, double mass, double distance,
                               bool reflected);

/* The overpressure on a rigid surface at TIME since the detonation. COSINE is that of the angle of
 * incidence theta between the normal and the way to the charge; a surface that faces away has none.
 * With the incident p_i and the reflected p_r,
 *
 *   p = p_i (1 + cos^2 theta - 2 cos theta) + p_r cos^2 theta
 *
 * G. Randers-Pehrson and K. A. Bannister, Airblast loading model for DYNA2D and DYNA3D, ARL-TR-1310
 * (1997). Mach stems are not in it. Outside the range the value at its end. */
double kingery_load(enum kingery_charge charge, double mass, double distance, double cosine,
                    double time);

/* The integral of kingery_load from time FROM to time TO, Pa s, for intervals that are short beside
 * the positive phase: its begin and end may be anywhere in them. */
double kingery_load_impulse(enum kingery_charge charge, double mass, double distance, double cosine,
                            double from, double to);

#endif
