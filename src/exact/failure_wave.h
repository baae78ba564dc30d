/* A layer of glass that runs into a rigid wall: the elastic wave, and a failure wave behind it,
 * both jumps between uniform states:
 *
 *   elastic   rho (C_l - u) = rho_0 C_l, sigma = -rho_0 C_l u                     (2.23), (2.24)
 *   failed    rho_f (C_f + u - u_f) = rho C_f, sigma_f - sigma = -rho C_f (u_f - u)  (2.25), (2.26)
 *             -sigma_f = c + (1 + b) P_f, P = K (1 - rho_0/rho)                    (2.27), (2.28)
 *
 * in the frame of the undisturbed layer, whose boundary moves at u_f. x = rho/rho_0 is the root
 * just above one of the cubic (2.31). Source: Parshikov (2013), section 2.8. */
#ifndef BOLIDE_EXACT_FAILURE_WAVE_H
#define BOLIDE_EXACT_FAILURE_WAVE_H

#include "base/parameter.h"
#include "exact/exact.h"

struct exact_failure_wave {
    double impact;                               /* u_f, m/s */
    double density, bulk_modulus, shear_modulus; /* rho_0, K, G of intact glass */
    double speed;                                /* C_f, m/s */
    double failed, failed_slope;                 /* c, Pa; b */
};

extern const struct parameter exact_failure_wave_table[];
extern const struct exact_class exact_failure_wave_class;

#endif
