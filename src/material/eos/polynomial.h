/* Polynomial in the compression mu = rho/rho_0 - 1, without energy: the intact ceramics and glasses
 * of the Johnson-Holmquist models.
 *
 *   p = K_1 mu + K_2 mu^2 + K_3 mu^3   mu > 0
 *   p = K_1 mu                         mu <= 0
 *
 * Source: Johnson and Holmquist (1999); Parshikov (2013), (2.45). */
#ifndef BOLIDE_EOS_POLYNOMIAL_H
#define BOLIDE_EOS_POLYNOMIAL_H

#include "material/eos/common.h"

struct eos_polynomial {
    double density;        /* rho_0, kg/m^3: zero pressure */
    double bulk_modulus;   /* K_1, Pa */
    double second_modulus; /* K_2, Pa */
    double third_modulus;  /* K_3, Pa */
};

#define EOS_polynomial_NAME "polynomial"
#define EOS_polynomial_HELP \
    "p = K_1 mu + K_2 mu^2 + K_3 mu^3, mu = rho/rho_0 - 1: intact ceramics and glasses"
#define EOS_polynomial_SAMPLE         \
    {                                 \
        2510.0, 233e9, -593e9, 2800e9 \
    } /* boron carbide */
#define EOS_polynomial_PARAMETERS(T)                                                          \
    NUMBER(T, density, "kg/m^3", REQUIRED, POSITIVE, "density at zero pressure")              \
    NUMBER(T, bulk_modulus, "Pa", REQUIRED, POSITIVE,                                         \
           "K_1: bulk modulus at zero pressure, and in tension")                              \
    NUMBER(T, second_modulus, "Pa", REQUIRED, ANY, "K_2: coefficient of mu^2 in compression") \
    NUMBER(T, third_modulus, "Pa", REQUIRED, ANY, "K_3: coefficient of mu^3 in compression")

BOLIDE_INLINE struct eos_value eos_polynomial(const struct eos_polynomial *solid, double density,
                                              double energy, const double *history)
{
    (void)energy;
    (void)history;
    struct eos_value value;
    double mu = density / solid->density - 1.0;
    double second = mu > 0.0 ? solid->second_modulus : 0.0;
    double third = mu > 0.0 ? solid->third_modulus : 0.0;
    value.pressure = mu * (solid->bulk_modulus + mu * (second + mu * third));
    value.dp_drho = (solid->bulk_modulus + mu * (2.0 * second + 3.0 * mu * third)) / solid->density;
    value.dp_de = 0.0;
    value.status = 0;
    return value;
}

BOLIDE_INLINE struct eos_traits eos_polynomial_traits(const struct eos_polynomial *solid)
{
    struct eos_traits traits = eos_default_traits();
    traits.shock_slope = 0.5 * (1.0 + solid->second_modulus / solid->bulk_modulus);
    /* shock heating then adds about gamma (4 s) (1 - rho_0/rho)^2/12 to the pressure, a
     * twentieth */
    traits.largest_compression = 4.0 / 3.0;
    return traits;
}

/* The cold curve: rho_0 e_r is the integral of p/n^2 over n = rho/rho_0, term by term of mu = n -
 * 1. */
BOLIDE_INLINE struct heat_curve eos_polynomial_curve(const struct eos_polynomial *solid,
                                                     const struct heat *heat, double density)
{
    double n = density / solid->density, mu = n - 1.0, small = mu / n, log_n = logarithm(n);
    double work = solid->bulk_modulus * (log_n - small);
    if (mu > 0.0)
        work += solid->second_modulus * (mu - 2.0 * log_n + small) +
                solid->third_modulus * (0.5 * mu * (n + 1.0) - 3.0 * mu + 3.0 * log_n - small);
    struct heat_curve curve = {heat->temperature, work / solid->density};
    return curve;
}

#endif
