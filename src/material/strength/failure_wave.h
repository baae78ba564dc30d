/* Glass that fails behind a failure wave: damage D spreads from what is damaged already, at a given
 * speed, where the stress is beyond the limit of the glass:
 *
 *   dD/dt = C_f |grad D| where sigma_e > sigma_D, 0 <= D <= 1                          (2.15)
 *   sigma_D = (1 - D) sigma_f + D sigma_c                                              (2.18)
 *   failed   sigma_c = sqrt(P_t^2 - (p - P_t)^2) below P_s, 1.5 (c + b p) above        (2.19)
 *   intact   sigma_f = 1.5 (a + s p)                                                   (2.20)
 *   then S = S_trial (sigma_D/sigma_e)^D where sigma_e > sigma_D                       (2.22)
 *
 * sigma_e is the Mises stress, or that of (2.16), which leaves S_zz out. Intact glass stays elastic
 * beyond sigma_f until the wave arrives. The solver supplies |grad D|, and D = 1 at the surface of
 * the body. Neither sigma_f nor sigma_c is below zero. Source: Parshikov (2013), section 2.8. */
#ifndef BOLIDE_STRENGTH_FAILURE_WAVE_H
#define BOLIDE_STRENGTH_FAILURE_WAVE_H

#include "base/exponential.h"
#include "material/strength/common.h"

enum failure_wave_stress { FAILURE_WAVE_MISES, FAILURE_WAVE_PRINTED };

struct strength_failure_wave {
    double shear_modulus;         /* G, Pa */
    double speed;                 /* C_f, m/s */
    double intact, intact_slope;  /* a, Pa; s */
    double failed, failed_slope;  /* c, Pa; b */
    double tip_pressure, tip_end; /* P_t, P_s, Pa */
    int stress;                   /* enum failure_wave_stress */
};

#define STRENGTH_failure_wave_NAME "failure-wave"
#define STRENGTH_failure_wave_HELP \
    "glass that fails behind a wave of given speed, which begins at its surface"
#define STRENGTH_failure_wave_PARAMETERS(T)                                                       \
    NUMBER(T, shear_modulus, "Pa", REQUIRED, POSITIVE, "shear modulus")                           \
    NUMBER(T, speed, "m/s", REQUIRED, POSITIVE, "C_f: speed of the failure wave in the material") \
    NUMBER(T, intact, "Pa", REQUIRED, NOT_NEGATIVE,                                               \
           "a: two thirds of the stress at which it may fail, without pressure")                  \
    NUMBER(T, intact_slope, "", REQUIRED, NOT_NEGATIVE, "s: its increase with pressure")          \
    NUMBER(T, failed, "Pa", REQUIRED, NOT_NEGATIVE,                                               \
           "c: two thirds of the strength of failed glass, extrapolated to no pressure")          \
    NUMBER(T, failed_slope, "", REQUIRED, NOT_NEGATIVE, "b: its increase with pressure")          \
    NUMBER(T, tip_pressure, "Pa", REQUIRED, NOT_NEGATIVE,                                         \
           "P_t: radius of the round tip of that strength, which begins at no pressure")          \
    NUMBER(T, tip_end, "Pa", REQUIRED, NOT_NEGATIVE, "P_s: pressure at which the tip ends")       \
    CHOICE(T, stress, "mises",                                                                    \
           "which stress is compared; mises; printed: (2.16) of the source, without S_zz",        \
           "mises", "printed")

/* sigma_D. */
BOLIDE_INLINE double failure_wave_limit(const struct strength_failure_wave *glass, double pressure,
                                        double damage)
{
    const double intact = maximum(0.0, 1.5 * (glass->intact + glass->intact_slope * pressure));
    const double tip = square(glass->tip_pressure) - square(pressure - glass->tip_pressure);
    const double cone = maximum(0.0, 1.5 * (glass->failed + glass->failed_slope * pressure));
    const double failed = pressure < glass->tip_end ? sqrt(maximum(tip, 0.0)) : cone;
    return (1.0 - damage) * intact + damage * failed;
}

/* sigma_e. */
BOLIDE_INLINE double failure_wave_stress(const struct strength_failure_wave *glass, struct sym3 s)
{
    const double printed = sqrt(1.5 * (square(s.xx) + square(s.yy) + 2.0 * square(s.xy)));
    return glass->stress == FAILURE_WAVE_PRINTED ? printed : sym3_mises(s);
}

BOLIDE_INLINE double strength_failure_wave_yield(const struct strength_failure_wave *glass,
                                                 const struct point *point)
{
    return failure_wave_limit(glass, point->pressure, point->history[HISTORY_damage]);
}

/* POINT->pressure is that of its density. */
BOLIDE_INLINE void strength_failure_wave(const struct strength_failure_wave *glass,
                                         const struct motion *motion, double bulk_modulus,
                                         struct point *point)
{
    (void)bulk_modulus;
    const struct sym3 trial = strength_elastic(glass->shear_modulus, motion, point->deviator);
    const double stress = failure_wave_stress(glass, trial),
                 damage = point->history[HISTORY_damage];
    const double spread = motion->dt * glass->speed * motion->damage_gradient;
    const bool begins = stress > failure_wave_limit(glass, point->pressure, damage);
    const double after = begins ? minimum(1.0, damage + spread) : damage;
    const double limit = failure_wave_limit(glass, point->pressure, after);
    const double relaxed = power(limit / maximum(stress, 1e-100), after);
    const double noise = 1e-13 * glass->shear_modulus; /* of what is at rest */
    const double keep = stress > limit + noise && after > 0.0 ? relaxed : 1.0;
    point->history[HISTORY_plastic_strain] +=
        (1.0 - keep) * sym3_mises(trial) / (3.0 * glass->shear_modulus);
    point->history[HISTORY_damage] = after;
    point->deviator = sym3_scale(keep, trial);
}

BOLIDE_INLINE void strength_failure_wave_batch(const struct strength_failure_wave *glass,
                                               struct batch *b)
{
    for (int k = 0; k < b->count; k++) {
        struct motion motion = batch_motion(b, k);
        struct point point = {.pressure = b->trial[k], .deviator = batch_tensor(b->deviator, k)};
        motion.damage_gradient = b->damage_gradient[k];
        point.history[HISTORY_damage] = b->damage[k];
        point.history[HISTORY_plastic_strain] = b->plastic_strain[k];
        strength_failure_wave(glass, &motion, 0.0, &point);
        b->damage[k] = point.history[HISTORY_damage];
        b->plastic_strain[k] = point.history[HISTORY_plastic_strain];
        b->failing[k] = 0;
        batch_keep_tensor(b->new_deviator, k, point.deviator);
    }
}

BOLIDE_INLINE struct strength_traits strength_failure_wave_traits(
    const struct strength_failure_wave *glass)
{
    struct strength_traits traits = strength_default_traits();
    traits.history = HISTORY_BIT(damage);
    traits.takes_pressure = true;
    traits.batched = true;
    traits.spread_speed = glass->speed;
    return traits;
}

#endif
