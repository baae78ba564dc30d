/* Concrete after Holmquist, Johnson and Cook: pressure in three stages of mu = rho/rho_0 - 1, where
 * mu_max is the largest so far and unloading keeps what has been crushed:
 *
 *   elastic     mu <= mu_crush             p = K_e mu, K_e = P_crush/mu_crush, in tension too
 *   transition  mu_crush < mu <= mu_pl     the line from (mu_crush, P_crush) to (mu_pl, P_lock);
 *               unloading with K_u = (1 - F) K_e + F K_1, F = (mu_max - mu_crush)/(mu_pl - mu_crush)
 *   compacted   mu > mu_pl                 p = K_1 m + K_2 m^2 + K_3 m^3, m = (mu - mu_lock)/(1 + mu_lock);
 *               unloading with K_1
 *
 * mu_pl is where that cubic reaches P_lock. Energy does not matter. What tension concrete bears its
 * strength says. Source: Holmquist, Johnson and Cook, Proc. 14th Int. Symp. Ballistics (1993) 591,
 * restored for Cui, dissertation (2014). */
#ifndef BOLIDE_EOS_HJC_H
#define BOLIDE_EOS_HJC_H

#include "material/eos/common.h"

struct eos_hjc {
    double density;           /* rho_0, kg/m^3 */
    double crush_pressure;    /* P_crush, Pa */
    double crush_compression; /* mu_crush */
    double lock_pressure;     /* P_lock, Pa */
    double lock_compression;  /* mu_lock */
    double k1, k2, k3;        /* Pa */
};

#define EOS_hjc_NAME "hjc"
#define EOS_hjc_HELP \
    "concrete after Holmquist, Johnson and Cook: elastic, crushed, compacted, with unloading"
#define EOS_hjc_SAMPLE                                       \
    {                                                        \
        2400.0, 16e6, 0.001, 0.8e9, 0.1, 85e9, -171e9, 208e9 \
    } /* concrete */
#define EOS_hjc_PARAMETERS(T)                                                        \
    NUMBER(T, density, "kg/m^3", REQUIRED, POSITIVE, "density at zero pressure")     \
    NUMBER(T, crush_pressure, "Pa", REQUIRED, POSITIVE,                              \
           "P_crush: pressure at which pores begin to close")                        \
    NUMBER(T, crush_compression, "", REQUIRED, POSITIVE,                             \
           "mu_crush: mu = rho/rho_0 - 1 at this pressure")                          \
    NUMBER(T, lock_pressure, "Pa", REQUIRED, POSITIVE,                               \
           "P_lock: pressure at which all pores are closed")                         \
    NUMBER(T, lock_compression, "", REQUIRED, NOT_NEGATIVE,                          \
           "mu_lock: mu of the compacted concrete at zero pressure")                 \
    NUMBER(T, k1, "Pa", REQUIRED, POSITIVE,                                          \
           "K_1 of p = K_1 m + K_2 m^2 + K_3 m^3, m = (mu - mu_lock)/(1 + mu_lock)") \
    NUMBER(T, k2, "Pa", REQUIRED, ANY, "K_2")                                        \
    NUMBER(T, k3, "Pa", REQUIRED, ANY, "K_3")

/* mu_pl, by Newton's method from P_lock/K_1. */
BOLIDE_INLINE double hjc_full_compression(const struct eos_hjc *concrete)
{
    double m = concrete->lock_pressure / concrete->k1;
    for (int round = 0; round < 20; round++) {
        double over =
            m * (concrete->k1 + m * (concrete->k2 + m * concrete->k3)) - concrete->lock_pressure;
        if (!(fabs(over) > 1e-14 * concrete->lock_pressure))
            break;
        m -= over / (concrete->k1 + m * (2.0 * concrete->k2 + 3.0 * m * concrete->k3));
    }
    return concrete->lock_compression + m * (1.0 + concrete->lock_compression);
}

/* Pressure and its slope by mu. */
struct hjc_curve {
    double pressure, slope;
};

/* On the curve of first loading; FULL: mu_pl. */
BOLIDE_INLINE struct hjc_curve hjc_loading(const struct eos_hjc *concrete, double full, double mu)
{
    struct hjc_curve curve;
    if (mu <= concrete->crush_compression) {
        curve.slope = concrete->crush_pressure / concrete->crush_compression;
        curve.pressure = curve.slope * mu;
    } else if (mu <= full) {
        curve.slope = (concrete->lock_pressure - concrete->crush_pressure) /
                      (full - concrete->crush_compression);
        curve.pressure =
            concrete->crush_pressure + curve.slope * (mu - concrete->crush_compression);
    } else {
        double whole = 1.0 + concrete->lock_compression;
        double m = (mu - concrete->lock_compression) / whole;
        curve.pressure = m * (concrete->k1 + m * (concrete->k2 + m * concrete->k3));
        curve.slope = (concrete->k1 + m * (2.0 * concrete->k2 + 3.0 * m * concrete->k3)) / whole;
    }
    return curve;
}

/* dp/dmu of unloading from MOST. */
BOLIDE_INLINE double hjc_unloading(const struct eos_hjc *concrete, double full, double most)
{
    double share = (most - concrete->crush_compression) / (full - concrete->crush_compression);
    double within = maximum(0.0, minimum(1.0, share));
    return (1.0 - within) * concrete->crush_pressure / concrete->crush_compression +
           within * concrete->k1;
}

/* The same from MOST and its PRESSURE, but at least so steep that the pressure is zero where closed
 * concrete is at rest: the cubic grows faster than K_1 above a compression of about one, and
 * expanded concrete would keep a pressure. */
BOLIDE_INLINE double hjc_release(const struct eos_hjc *concrete, double full, double most,
                                 double pressure)
{
    const double slope = hjc_unloading(concrete, full, most);
    return most > full ? maximum(slope, pressure / (most - concrete->lock_compression)) : slope;
}

BOLIDE_INLINE struct eos_value eos_hjc(const struct eos_hjc *concrete, double density,
                                       double energy, const double *history)
{
    (void)energy;
    struct eos_value value;
    double mu = density / concrete->density - 1.0, full = hjc_full_compression(concrete);
    double most = maximum(mu, history[HISTORY_largest_compression]);
    struct hjc_curve curve = hjc_loading(concrete, full, most);
    if (mu < most) {
        curve.slope = hjc_release(concrete, full, most, curve.pressure);
        curve.pressure -= curve.slope * (most - mu);
    }
    value.pressure = curve.pressure;
    value.dp_drho = curve.slope / concrete->density;
    value.dp_de = 0.0;
    value.status = 0;
    return value;
}

/* Notes the compression of DENSITY in HISTORY. Returns the compression that will not come back, d
 * mu_p = d mu - dp/K_u in the transition. */
BOLIDE_INLINE double eos_hjc_compact(const struct eos_hjc *concrete, double density,
                                     double *history)
{
    double mu = density / concrete->density - 1.0, before = history[HISTORY_largest_compression];
    if (mu <= before)
        return 0.0;
    history[HISTORY_largest_compression] = mu;
    if (mu <= concrete->crush_compression)
        return 0.0;
    double full = hjc_full_compression(concrete);
    double from = maximum(before, concrete->crush_compression), to = minimum(mu, full);
    double slope =
        (concrete->lock_pressure - concrete->crush_pressure) / (full - concrete->crush_compression);
    return to > from
               ? (to - from) * (1.0 - slope / hjc_unloading(concrete, full, 0.5 * (from + to)))
               : 0.0;
}

/* Why its parameters do not go together; NULL when they do. */
BOLIDE_INLINE const char *hjc_wrong(const struct eos_hjc *concrete)
{
    if (!(concrete->lock_pressure > concrete->crush_pressure))
        return "this is not above `crush_pressure`";
    double full = hjc_full_compression(concrete);
    double reached = hjc_loading(concrete, concrete->crush_compression, full).pressure;
    if (!(full > concrete->crush_compression &&
          fabs(reached / concrete->lock_pressure - 1.0) < 1e-9))
        return "the curve of k1, k2 and k3 does not reach this beyond `crush_compression`";
    return NULL;
}

BOLIDE_INLINE struct eos_traits eos_hjc_traits(const struct eos_hjc *concrete)
{
    struct eos_traits traits = eos_default_traits();
    traits.history = HISTORY_BIT(largest_compression);
    traits.largest_compression = 4.0 / 3.0 * (1.0 + concrete->lock_compression);
    traits.wrong = hjc_wrong(concrete);
    traits.wrong_key = "lock_pressure";
    return traits;
}

/* The energy that unloading from first loading gives back, at T_0: all other work, that of crushing
 * too, is heat. With n = rho/rho_0 and n_r where unloading with K_u ends, rho_0 e_r = K_u
 * [ln(n/n_r) - (n - n_r)/n]. */
BOLIDE_INLINE struct heat_curve eos_hjc_curve(const struct eos_hjc *concrete,
                                              const struct heat *heat, double density)
{
    double n = density / concrete->density, full = hjc_full_compression(concrete);
    double pressure = hjc_loading(concrete, full, n - 1.0).pressure;
    double modulus = hjc_release(concrete, full, n - 1.0, pressure);
    double back = pressure / modulus; /* n - n_r */
    double work = modulus * (logarithm(n / (n - back)) - back / n);
    struct heat_curve curve = {heat->temperature, work / concrete->density};
    return curve;
}

#endif
