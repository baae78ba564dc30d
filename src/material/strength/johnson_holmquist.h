/* Brittle solids after Johnson and Holmquist (JH-2). p* = p/P_HEL, T* = T/P_HEL, and stresses over
 * sigma_HEL = 3/2 (HEL - P_HEL):
 *
 *   intact      sigma_i = A (p* + T*)^N [1 + C ln max(rate/rate_0, 1)]                       (2.33)
 *   fractured   sigma_f = min(B p*^M [1 + C ln max(rate/rate_0, 1)], sigma_max)              (2.34)
 *   strength    sigma = sigma_i - D (sigma_i - sigma_f)                                      (2.38)
 *   damage      dD = d eps_p/(D_1 (p* + T*)^D_2)                                      (2.41), (P.11)
 *   bulking     (K_1 mu + Dp)^2 grows by 2 beta K_1 (U_1 - U_2), U = sigma^2/(6 G)   (2.47)-(2.50)
 *   pressure    that of the equation of state plus Dp, and at least -T (1 - D)       (2.46)
 *
 * mu = rho/rho_0 - 1. Dp is history: it adds to the pressure of any equation of state, whose K_1 is
 * the slope at rest. The orders of a step, by name:
 *
 *   substep      the pressure of the new density; a return grows D by at most 0.005 at a time, and
 *                pressure and strength follow. It has a limit for small steps where strength falls
 *                faster than 3 G per plastic strain.
 *   consistent   one return at the pressure of the last step and its damage
 *   appendix     the plastic strain rate is the elastic rate of this step less the actual one of
 *                the last (P.9); damage before the return (P.15), (P.16); only beyond yield
 *   openradioss  the pressure of the new density; plastic strain over 3 sqrt(3) G; bulking by the
 *                whole change of the yield surface, that of the pressure too
 *
 * Source: Johnson and Holmquist (1994, 1999); Parshikov (2013), section 2.9 and appendix; the last
 * order as in OpenRadioss, law 79. The limit of tension and the first order are ours. */
#ifndef BOLIDE_STRENGTH_JOHNSON_HOLMQUIST_H
#define BOLIDE_STRENGTH_JOHNSON_HOLMQUIST_H

#include "base/exponential.h"
#include "material/strength/common.h"

enum johnson_holmquist_order {
    JOHNSON_HOLMQUIST_SUBSTEP,
    JOHNSON_HOLMQUIST_CONSISTENT,
    JOHNSON_HOLMQUIST_APPENDIX,
    JOHNSON_HOLMQUIST_OPENRADIOSS
};

struct strength_johnson_holmquist {
    double shear_modulus;              /* G, Pa */
    double a, n, b, m, c;              /* A, N, B, M, C */
    double rate;                       /* rate_0, 1/s */
    double most;                       /* sigma_max; NAN: none */
    double tension;                    /* T, Pa */
    double hel, hel_pressure;          /* HEL, P_HEL, Pa */
    double d1, d2;                     /* D_1, D_2 */
    double bulking;                    /* beta */
    int order;                         /* enum johnson_holmquist_order */
    bool tension_limit;                /* p >= -T (1 - D) */
    double rest_density, rest_modulus; /* rho_0, kg/m^3, and K_1, Pa, of the equation of state */
};

#define STRENGTH_johnson_holmquist_NAME "johnson-holmquist"
#define STRENGTH_johnson_holmquist_HELP \
    "ceramics and glass after Johnson and Holmquist (JH-2), with damage and bulking"
#define STRENGTH_johnson_holmquist_PARAMETERS(T)                                                   \
    NUMBER(T, shear_modulus, "Pa", REQUIRED, POSITIVE, "shear modulus")                            \
    NUMBER(T, a, "", REQUIRED, NOT_NEGATIVE, "A: strength of intact material")                     \
    NUMBER(T, n, "", REQUIRED, NOT_NEGATIVE, "N: exponent of its pressure")                        \
    NUMBER(T, b, "", REQUIRED, NOT_NEGATIVE, "B: strength of fractured material")                  \
    NUMBER(T, m, "", REQUIRED, NOT_NEGATIVE, "M: exponent of its pressure")                        \
    NUMBER(T, c, "", REQUIRED, NOT_NEGATIVE, "C: factor of the logarithm of the strain rate")      \
    NUMBER(T, rate, "1/s", "1 1/s", POSITIVE, "strain rate below which the rate has no effect")    \
    NUMBER(T, most, "", OPTIONAL, NOT_NEGATIVE,                                                    \
           "largest strength of fractured material, over that at the elastic limit; default: no "  \
           "limit")                                                                                \
    NUMBER(T, tension, "Pa", REQUIRED, NOT_NEGATIVE, "T: largest mean tension")                    \
    NUMBER(T, hel, "Pa", REQUIRED, POSITIVE, "HEL: stress at the Hugoniot elastic limit")          \
    NUMBER(T, hel_pressure, "Pa", REQUIRED, POSITIVE, "P_HEL: pressure at that limit")             \
    NUMBER(T, d1, "", REQUIRED, NOT_NEGATIVE, "D_1: factor of the failure strain; 0: at once")     \
    NUMBER(T, d2, "", REQUIRED, NOT_NEGATIVE, "D_2: exponent of the pressure in that strain")      \
    NUMBER(T, bulking, "", "1", FROM_ZERO_TO_ONE,                                                  \
           "beta: fraction of the lost elastic energy that becomes pressure")                      \
    CHOICE(T, order, "substep",                                                                    \
           "order of a step: substep; consistent, appendix: those of Parshikov (2013); "           \
           "openradioss: that of the program, with its factor of 1/sqrt(3) in the plastic strain", \
           "substep", "consistent", "appendix", "openradioss")                                     \
    FLAG(T, tension_limit, "yes",                                                                  \
         "whether the mean tension is at most T (1 - D), and failed material opens voids")

/* Takes what the model needs of the equation of state: REST is that at rest, of DENSITY. */
BOLIDE_INLINE void strength_johnson_holmquist_take(struct strength_johnson_holmquist *solid,
                                                   double density, const struct eos_value *rest)
{
    solid->rest_density = density;
    solid->rest_modulus = density * rest->dp_drho;
    if (isnan(solid->most))
        solid->most = INFINITY;
}

/* The overstress that flows: less is noise of what is at rest, by which failed material without
 * pressure would flow. */
BOLIDE_INLINE double johnson_holmquist_noise(const struct strength_johnson_holmquist *solid)
{
    return 1e-13 * solid->shear_modulus;
}

/* sigma_HEL, Pa. */
BOLIDE_INLINE double johnson_holmquist_unit(const struct strength_johnson_holmquist *solid)
{
    return 1.5 * (solid->hel - solid->hel_pressure);
}

/* 1 + C ln max(rate/rate_0, 1). */
BOLIDE_INLINE double johnson_holmquist_haste(const struct strength_johnson_holmquist *solid,
                                             double rate)
{
    return 1.0 + solid->c * logarithm(maximum(rate / solid->rate, 1.0));
}

/* The surfaces at one pressure, Pa, and the failure strain. */
struct johnson_holmquist_surface {
    double intact, fractured, strain;
};

BOLIDE_INLINE struct johnson_holmquist_surface johnson_holmquist_surface(
    const struct strength_johnson_holmquist *solid, double pressure, double haste)
{
    const double unit = johnson_holmquist_unit(solid);
    const double pulled = (pressure + solid->tension) / solid->hel_pressure;
    const double relative = pressure / solid->hel_pressure;
    struct johnson_holmquist_surface surface;
    const double log_pulled = logarithm(maximum(pulled, 1e-100)); /* of two powers */
    const double intact = exponential(solid->n * log_pulled),
                 strain = exponential(solid->d2 * log_pulled);
    surface.intact = pulled > 0.0 ? unit * (haste * solid->a * intact) : 0.0;
    surface.fractured = unit * minimum(haste * solid->b * power(relative, solid->m), solid->most);
    surface.strain = pulled > 0.0 ? solid->d1 * strain : 0.0;
    return surface;
}

BOLIDE_INLINE double johnson_holmquist_stress(struct johnson_holmquist_surface surface,
                                              double damage)
{
    return (1.0 - damage) * surface.intact + damage * surface.fractured;
}

/* Yield stress at PRESSURE, alone. */
BOLIDE_INLINE double johnson_holmquist_strength(const struct strength_johnson_holmquist *solid,
                                                double pressure, double damage, double haste)
{
    return johnson_holmquist_stress(johnson_holmquist_surface(solid, pressure, haste), damage);
}

BOLIDE_INLINE double strength_johnson_holmquist_yield(
    const struct strength_johnson_holmquist *solid, const struct point *point)
{
    return johnson_holmquist_strength(solid, point->pressure, point->history[HISTORY_damage], 1.0);
}

/* The damage after PLASTIC strain. */
BOLIDE_INLINE double johnson_holmquist_damage(double damage, double plastic, double strain)
{
    return strain > 0.0 ? minimum(1.0, damage + plastic / strain) : 1.0;
}

/* The bulking after the elastic energy on the yield surface has fallen from that of BEFORE to that
 * of AFTER, Pa, at mu = COMPRESSION. */
BOLIDE_INLINE double johnson_holmquist_bulking(const struct strength_johnson_holmquist *solid,
                                               double compression, double bulking, double before,
                                               double after)
{
    const double lost = (square(before) - square(after)) / (6.0 * solid->shear_modulus);
    const double linear = solid->rest_modulus * compression, whole = linear + bulking;
    if (!(lost > 0.0 && whole >= 0.0))
        return bulking;
    return sqrt(square(whole) + 2.0 * solid->bulking * solid->rest_modulus * lost) - linear;
}

/* A point during its return: mu, rate factor and trial Mises stress stay. */
struct johnson_holmquist_return {
    double compression, haste, pressure, mises;
    double damage, bulking, strain;
};

BOLIDE_INLINE struct johnson_holmquist_return johnson_holmquist_start(
    const struct strength_johnson_holmquist *solid, const struct motion *motion,
    const struct point *point, double mises)
{
    struct johnson_holmquist_return at;
    at.compression = point->density / solid->rest_density - 1.0;
    at.haste = johnson_holmquist_haste(solid, strength_strain_rate(motion->strain_rate));
    at.pressure = point->pressure;
    at.mises = mises;
    at.damage = point->history[HISTORY_damage];
    at.bulking = point->history[HISTORY_bulking];
    at.strain = point->history[HISTORY_plastic_strain];
    return at;
}

/* The plastic strain that takes STRESS down to YIELD, which falls with it, at the pressure of
 * SURFACE; sets *WHOLE to false where that is too much for one substep. */
BOLIDE_INLINE double johnson_holmquist_flow(const struct strength_johnson_holmquist *solid,
                                            struct johnson_holmquist_surface surface, double damage,
                                            double over, bool *whole)
{
    const double growth_of_substep = 0.005, modulus = 3.0 * solid->shear_modulus;
    if (damage >= 1.0)
        return over / modulus;
    *whole = false;
    if (!(surface.strain > 0.0))
        return over / modulus;
    const double most = minimum(growth_of_substep, 1.0 - damage) * surface.strain;
    const double left = modulus * surface.strain - (surface.intact - surface.fractured);
    *whole = over * surface.strain < most * left;
    return *whole ? over * surface.strain / left : most;
}

/* Returns a point whose Mises stress is beyond yield, in substeps. After the last one the bulking
 * has raised the pressure, and with it the strength: nothing is left to return. KNOWN is the
 * surface at the start, or NULL. */
BOLIDE_INLINE void johnson_holmquist_substeps(const struct strength_johnson_holmquist *solid,
                                              const struct johnson_holmquist_surface *known,
                                              struct johnson_holmquist_return *at)
{
    const double own = at->pressure - at->bulking; /* of the equation of state */
    for (bool whole = false; !whole; known = NULL) {
        double pressure = own + at->bulking;
        if (solid->tension_limit)
            pressure = maximum(pressure, -solid->tension * (1.0 - at->damage));
        const struct johnson_holmquist_surface surface =
            known ? *known : johnson_holmquist_surface(solid, pressure, at->haste);
        const double yield = johnson_holmquist_stress(surface, at->damage);
        if (!(at->mises > yield))
            return;
        whole = true;
        const double plastic =
            johnson_holmquist_flow(solid, surface, at->damage, at->mises - yield, &whole);
        at->strain += plastic;
        at->mises -= 3.0 * solid->shear_modulus * plastic;
        if (at->damage >= 1.0)
            return;
        at->damage = johnson_holmquist_damage(at->damage, plastic, surface.strain);
        at->bulking = johnson_holmquist_bulking(solid, at->compression, at->bulking, yield,
                                                johnson_holmquist_stress(surface, at->damage));
    }
}

/* The rate of the deviator in the last step, Pa/s, which the order of the appendix needs. */
BOLIDE_INLINE struct sym3 johnson_holmquist_last_rate(const double *history)
{
    const double *rate = history + HISTORY_deviator_rate_xx;
    struct sym3 s = {rate[0], rate[1], rate[2], rate[3], rate[4], rate[5]};
    return s;
}

/* The plastic strain of (P.9), (P.10): TRIAL is the elastic change of the deviator. */
BOLIDE_INLINE double johnson_holmquist_appendix_strain(
    const struct strength_johnson_holmquist *solid, const struct point *point, struct sym3 trial,
    double dt)
{
    const struct sym3 change = sym3_add(trial, sym3_scale(-1.0, point->deviator));
    const struct sym3 last = sym3_scale(-dt, johnson_holmquist_last_rate(point->history));
    return sqrt(2.0 / 3.0 * sym3_square(sym3_add(change, last))) / (2.0 * solid->shear_modulus);
}

/* The orders of the sources: one return. PRESSURE is that which they take, PLASTIC the strain of
 * the appendix. */
BOLIDE_INLINE void johnson_holmquist_once(const struct strength_johnson_holmquist *solid,
                                          double pressure, double plastic, struct point *point,
                                          struct johnson_holmquist_return *at)
{
    const bool program = solid->order == JOHNSON_HOLMQUIST_OPENRADIOSS,
               appendix = solid->order == JOHNSON_HOLMQUIST_APPENDIX;
    const struct johnson_holmquist_surface surface =
        johnson_holmquist_surface(solid, pressure, at->haste);
    const double damage = at->damage, start = johnson_holmquist_stress(surface, damage);
    const double returned = (at->mises - start) / (3.0 * solid->shear_modulus);
    if (at->mises > start) {
        if (!appendix)
            plastic = program ? returned / sqrt(3.0) : returned;
        at->strain += plastic;
        at->damage = johnson_holmquist_damage(damage, plastic, surface.strain);
        at->mises =
            appendix ? minimum(at->mises, johnson_holmquist_stress(surface, at->damage)) : start;
    }
    if (!program || (at->compression > 0.0 && at->damage > damage))
        at->bulking =
            johnson_holmquist_bulking(solid, at->compression, at->bulking,
                                      program ? point->history[HISTORY_yield_before] : start,
                                      johnson_holmquist_stress(surface, at->damage));
    point->history[HISTORY_yield_before] = start;
}

/* The parts of a step on which failing goes on, the more the larger OVER, the overstress of its
 * trial, at a failure STRAIN. */
BOLIDE_INLINE int johnson_holmquist_parts(const struct strength_johnson_holmquist *solid,
                                          double over, double strain)
{
    const double most = 8.0, growth_of_part = 0.005;
    const double growth = over / (3.0 * solid->shear_modulus * growth_of_part);
    return (int)(growth < most * strain ? growth / strain : most) + 1;
}

/* A step on which failing goes on, in PARTS: pressure and strain grow together, the pressure by
 * MODULUS, until it has that of the step, where SURFACE is. Returns the deviator. */
BOLIDE_INLINE struct sym3 johnson_holmquist_fail(const struct strength_johnson_holmquist *solid,
                                                 const struct motion *motion, double modulus,
                                                 int parts,
                                                 struct johnson_holmquist_surface surface,
                                                 struct sym3 deviator, struct sym3 trial,
                                                 struct johnson_holmquist_return *at)
{
    const double compression = at->compression, own = at->pressure - at->bulking;
    const double change = -motion->dt * sym3_trace(motion->strain_rate) / parts;
    const struct sym3 shear = sym3_scale(1.0 / parts, sym3_add(trial, sym3_scale(-1.0, deviator)));
    for (int left = parts - 1; left >= 0; left--) {
        deviator = sym3_add(deviator, shear);
        const double mises = sym3_mises(deviator);
        at->mises = mises;
        at->compression = compression - left * change * (1.0 + compression);
        at->pressure = own - left * change * modulus + at->bulking;
        johnson_holmquist_substeps(solid, parts == 1 ? &surface : NULL, at);
        if (at->mises < mises)
            deviator = sym3_scale(at->mises / mises, deviator);
    }
    return deviator;
}

/* POINT->pressure is that of its density; that before the step is MOTION->pressure. */
BOLIDE_INLINE void strength_johnson_holmquist(const struct strength_johnson_holmquist *solid,
                                              const struct motion *motion, double bulk_modulus,
                                              struct point *point)
{
    double *const history = point->history;
    const struct sym3 trial = strength_elastic(solid->shear_modulus, motion, point->deviator);
    const double mises = sym3_mises(trial);
    struct johnson_holmquist_return at = johnson_holmquist_start(solid, motion, point, mises);
    struct sym3 s = trial;
    if (solid->order == JOHNSON_HOLMQUIST_SUBSTEP) {
        const struct johnson_holmquist_surface surface =
            johnson_holmquist_surface(solid, at.pressure, at.haste);
        const double yield = johnson_holmquist_stress(surface, at.damage);
        const bool flows = mises - yield > johnson_holmquist_noise(solid);
        if (flows && at.damage < 1.0) {
            const int parts = johnson_holmquist_parts(solid, mises - yield, surface.strain);
            s = johnson_holmquist_fail(solid, motion, bulk_modulus, parts, surface, point->deviator,
                                       trial, &at);
        } else if (flows) {
            at.strain += (mises - yield) / (3.0 * solid->shear_modulus);
            s = sym3_scale(yield / mises, trial);
        }
    } else {
        const bool program = solid->order == JOHNSON_HOLMQUIST_OPENRADIOSS;
        const double strain = johnson_holmquist_appendix_strain(solid, point, trial, motion->dt);
        johnson_holmquist_once(solid, program ? point->pressure : motion->pressure, strain, point,
                               &at);
        if (at.mises < mises)
            s = sym3_scale(at.mises / mises, trial);
    }
    if (solid->order == JOHNSON_HOLMQUIST_APPENDIX)
        sym3_store(sym3_scale(1.0 / motion->dt, sym3_add(s, sym3_scale(-1.0, point->deviator))),
                   history + HISTORY_deviator_rate_xx);
    point->deviator = s;
    history[HISTORY_damage] = at.damage;
    history[HISTORY_bulking] = at.bulking;
    history[HISTORY_plastic_strain] = at.strain;
}

/* The same of many points that do not flow or have failed; the few that are failing are noted, to
 * be taken by themselves. */
BOLIDE_INLINE void strength_johnson_holmquist_batch(const struct strength_johnson_holmquist *solid,
                                                    struct batch *b)
{
    for (int k = 0; k < b->count; k++) {
        const struct motion motion = batch_motion(b, k);
        const struct sym3 trial =
            strength_elastic(solid->shear_modulus, &motion, batch_tensor(b->deviator, k));
        const double mises = sym3_mises(trial), damage = b->damage[k];
        const double haste =
            johnson_holmquist_haste(solid, strength_strain_rate(motion.strain_rate));
        const double yield = johnson_holmquist_strength(solid, b->trial[k], damage, haste);
        const double over = mises - yield;
        const bool flows = over > johnson_holmquist_noise(solid), failed = damage >= 1.0;
        b->plastic_strain[k] += flows && failed ? over / (3.0 * solid->shear_modulus) : 0.0;
        batch_keep_tensor(b->new_deviator, k,
                          sym3_scale(flows && failed ? yield / mises : 1.0, trial));
        b->failing[k] = flows && !failed;
    }
}

/* Adds the bulking and cuts the tension. The sound stays that of the equation of state. */
BOLIDE_INLINE void strength_johnson_holmquist_cut(const struct strength_johnson_holmquist *solid,
                                                  const double *history, struct eos_value *value)
{
    value->pressure += history[HISTORY_bulking];
    if (solid->tension_limit)
        value->pressure =
            maximum(value->pressure, -solid->tension * (1.0 - history[HISTORY_damage]));
}

BOLIDE_INLINE double strength_johnson_holmquist_given_limit(
    const struct strength_johnson_holmquist *solid)
{
    return solid->hel;
}

/* Whether uniaxial strain to mu = COMPRESSION at RATE, 1/s, stays below the intact strength. */
BOLIDE_INLINE bool strength_johnson_holmquist_bears(const struct strength_johnson_holmquist *solid,
                                                    double compression, double pressure,
                                                    double rate)
{
    const double mises = 2.0 * solid->shear_modulus * logarithm(1.0 + compression);
    return mises <
           johnson_holmquist_strength(solid, pressure, 0.0, johnson_holmquist_haste(solid, rate));
}

BOLIDE_INLINE struct strength_traits strength_johnson_holmquist_traits(
    const struct strength_johnson_holmquist *solid)
{
    struct strength_traits traits = strength_default_traits();
    traits.history = HISTORY_BIT(damage) | HISTORY_BIT(bulking);
    if (solid->tension_limit)
        traits.history |= HISTORY_BIT(void_ratio);
    if (solid->order == JOHNSON_HOLMQUIST_OPENRADIOSS)
        traits.history |= HISTORY_BIT(yield_before);
    for (int k = 0; k < 6 && solid->order == JOHNSON_HOLMQUIST_APPENDIX; k++)
        traits.history |= HISTORY_BIT(deviator_rate_xx) << k;
    traits.takes_pressure = true;
    traits.limits_tension = solid->tension_limit;
    traits.batched = solid->order == JOHNSON_HOLMQUIST_SUBSTEP;
    traits.breaks = true;
    if (!(solid->hel > solid->hel_pressure)) {
        traits.wrong = "this is not above `hel_pressure`";
        traits.wrong_key = "hel";
    }
    return traits;
}

#endif
