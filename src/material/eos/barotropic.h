/* Barotropic liquid or solid of constant bulk modulus, with an upper end of our own:
 *
 *   p = K (1 - rho_0/rho)               x = rho/(2 rho_0) <= 1
 *   p = K/2 + K/2 (x^7 - 1)/7           x > 1
 *
 * The line never exceeds K, so that nothing holds material under a higher pressure: a collision of
 * water at 3 km/s compressed it to 1e18 times its density. Where half of K is reached the curve
 * goes on with the same slope and the exponent of Tait's water. Source of the line: Parshikov
 * (2013), (2.1) = (2.10). */
#ifndef BOLIDE_EOS_BAROTROPIC_H
#define BOLIDE_EOS_BAROTROPIC_H

#include "material/eos/common.h"

struct eos_barotropic {
    double density;      /* rho_0, kg/m^3: zero pressure */
    double bulk_modulus; /* K, Pa */
};

#define EOS_barotropic_NAME "barotropic"
#define EOS_barotropic_HELP \
    "constant bulk modulus, p = bulk_modulus (1 - density_0/density), without energy"
#define EOS_barotropic_SAMPLE \
    {                         \
        1000.0, 2e9           \
    } /* water */
#define EOS_barotropic_PARAMETERS(T)                                             \
    NUMBER(T, density, "kg/m^3", REQUIRED, POSITIVE, "density at zero pressure") \
    NUMBER(T, bulk_modulus, "Pa", REQUIRED, POSITIVE, "bulk modulus")

BOLIDE_INLINE struct eos_value eos_barotropic(const struct eos_barotropic *liquid, double density,
                                              double energy, const double *history)
{
    (void)energy;
    (void)history;
    struct eos_value value;
    const double ratio = liquid->density / density, x = 0.5 * density / liquid->density;
    const double x6 = square(x * square(x)), half = 0.5 * liquid->bulk_modulus;
    const double line = liquid->bulk_modulus * (1.0 - ratio);
    const double slope = liquid->bulk_modulus * ratio / density;
    value.pressure = x > 1.0 ? half * (1.0 + (x * x6 - 1.0) / 7.0) : line;
    value.dp_drho = x > 1.0 ? 0.5 * half * x6 / liquid->density : slope;
    value.dp_de = 0.0;
    value.status = 0;
    return value;
}

BOLIDE_INLINE struct eos_traits eos_barotropic_traits(const struct eos_barotropic *liquid)
{
    struct eos_traits traits = eos_default_traits();
    (void)liquid;
    /* With K = rho_0 c^2 the pressure is (1 - s eta)^2 of that of the shock adiabat U_s = c + s u,
     * eta = 1 - rho_0/rho: a quarter less here for s = 1.5, a third less for water, s = 1.92. */
    traits.largest_compression = 1.1;
    return traits;
}

/* The cold curve. */
BOLIDE_INLINE struct heat_curve eos_barotropic_curve(const struct eos_barotropic *liquid,
                                                     const struct heat *heat, double density)
{
    const double ratio = liquid->density / density, x = 0.5 * density / liquid->density;
    const double x6 = square(x * square(x));
    const double work =
        x > 1.0 ? 0.25 + 3.0 / 7.0 * (1.0 - 1.0 / x) + (x6 - 1.0) / 84.0 : square(1.0 - ratio);
    struct heat_curve curve = {heat->temperature,
                               0.5 * liquid->bulk_modulus * work / liquid->density};
    return curve;
}

#endif
