/* Barotropic liquid or solid of constant bulk modulus: p = K (1 - rho_0/rho).
 * Source: Parshikov (2013), (2.1) = (2.10). */
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
    double ratio = liquid->density / density;
    value.pressure = liquid->bulk_modulus * (1.0 - ratio);
    value.dp_drho = liquid->bulk_modulus * ratio / density;
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
    double ratio = liquid->density / density;
    struct heat_curve curve = {heat->temperature,
                               0.5 * liquid->bulk_modulus * square(1.0 - ratio) / liquid->density};
    return curve;
}

#endif
