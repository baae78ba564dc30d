/* Barotropic liquid or solid of constant bulk modulus: p = K (1 - rho_0/rho).
 * Source: Parshikov (2013), (2.1) = (2.10). */
#ifndef BOLIDE_EOS_BAROTROPIC_H
#define BOLIDE_EOS_BAROTROPIC_H

#include "material/point.h"

struct eos_barotropic {
    double density;      /* rho_0, kg/m^3: zero pressure */
    double bulk_modulus; /* K, Pa */
};

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

#endif
