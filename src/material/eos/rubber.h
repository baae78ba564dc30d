/* Rubber and other media of constant sound speed without energy: p = C_0^2 (rho - rho_0).
 * Source: Parshikov (2013), section 2.6. */
#ifndef BOLIDE_EOS_RUBBER_H
#define BOLIDE_EOS_RUBBER_H

#include "material/eos/common.h"

struct eos_rubber {
    double density; /* rho_0, kg/m^3: zero pressure */
    double sound;   /* C_0, m/s */
};

#define EOS_rubber_NAME "rubber"
#define EOS_rubber_HELP "constant sound speed, p = sound^2 (density - density_0), without energy"
#define EOS_rubber_SAMPLE \
    {                     \
        1010.0, 852.0     \
    } /* rubber */
#define EOS_rubber_PARAMETERS(T)                                                 \
    NUMBER(T, density, "kg/m^3", REQUIRED, POSITIVE, "density at zero pressure") \
    NUMBER(T, sound, "m/s", REQUIRED, POSITIVE, "sound speed")

BOLIDE_INLINE struct eos_value eos_rubber(const struct eos_rubber *rubber, double density,
                                          double energy, const double *history)
{
    (void)energy;
    (void)history;
    struct eos_value value;
    value.dp_drho = square(rubber->sound);
    value.pressure = value.dp_drho * (density - rubber->density);
    value.dp_de = 0.0;
    value.status = 0;
    return value;
}

BOLIDE_INLINE struct eos_traits eos_rubber_traits(const struct eos_rubber *rubber)
{
    struct eos_traits traits = eos_default_traits();
    (void)rubber;
    /* The pressure is (1 - s eta)^2/(1 - eta) of that of the shock adiabat U_s = c + s u, eta = 1 -
     * rho_0/rho: a fifth less here for s = 1.5, a quarter less for s = 1.92. */
    traits.largest_compression = 1.1;
    return traits;
}

/* The cold curve. */
BOLIDE_INLINE struct heat_curve eos_rubber_curve(const struct eos_rubber *rubber,
                                                 const struct heat *heat, double density)
{
    double ratio = rubber->density / density;
    struct heat_curve curve = {heat->temperature,
                               square(rubber->sound) * (ratio - 1.0 - logarithm(ratio))};
    return curve;
}

#endif
